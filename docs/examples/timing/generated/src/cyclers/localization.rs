//! Cycler `Localization` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use timing_nodes::interfaces::Console;
use timing_nodes::interfaces::Pace;
use timing_nodes::pace_receiver;
use timing_nodes::position_filter;
use timing_nodes::set_printer;

use crate::databases::localization::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub pace_receiver: Guarded<pace_receiver::PaceReceiver>,
    pub position_filter: Guarded<position_filter::PositionFilter>,
    pub set_printer: Guarded<set_printer::SetPrinter>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            pace_receiver: Guarded::new(
                "timing_nodes::pace_receiver",
                OnFailure::Stop,
                Self::create_pace_receiver()?,
            ),
            position_filter: Guarded::new(
                "timing_nodes::position_filter",
                OnFailure::Stop,
                Self::create_position_filter()?,
            ),
            set_printer: Guarded::new(
                "timing_nodes::set_printer",
                OnFailure::Stop,
                Self::create_set_printer()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl Pace>) -> Result<()> {
        self.pace_receiver(frame)?;
        Ok(())
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl Console>) -> Result<()> {
        self.position_filter(frame)?;
        self.set_printer(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(&mut self, frame: &mut Frame<'_, impl Console>) -> Result<()> {
        self.cycle(frame)
    }

    /// hardware -> nothing
    #[inline(always)]
    fn pace_receiver(&mut self, frame: &mut Frame<'_, impl Pace>) -> Result<()> {
        let context = pace_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.pace_receiver.call(&frame.cycle, |node| node.cycle(context))?;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// perception Vision.measurement, perception Odometry.measurement, perception
    /// Radio.measurement -> sets
    #[inline(always)]
    fn position_filter<Hardware>(
        &mut self,
        frame: &mut Frame<'_, Hardware>,
    ) -> Result<()> {
        let vision = frame.perception.vision.project(|outputs| &outputs.measurement);
        let odometry = frame.perception.odometry.project(|outputs| &outputs.measurement);
        let radio = frame.perception.radio.project(|outputs| &outputs.measurement);
        let context = position_filter::CycleContext {
            vision: PerceptionInput::new(&vision),
            odometry: PerceptionInput::new(&odometry),
            radio: PerceptionInput::new(&radio),
            cycle_time: frame.cycle.time,
            trust: &frame.parameters.position_filter.trust,
        };
        let outputs = self
            .position_filter
            .call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.sets = outputs.sets.value;
        if let Some(injections) = frame.injections {
            injections.sets.replace(&mut frame.own.sets);
        }
        Ok(())
    }

    /// sets (required) -> hardware
    #[inline(always)]
    fn set_printer(&mut self, frame: &mut Frame<'_, impl Console>) -> Result<()> {
        if let Some(sets) = frame.own.sets.as_ref() {
            let context = set_printer::CycleContext {
                hardware_interface: frame.hardware_interface,
                sets,
            };
            self.set_printer.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.set_printer.skip();
        }
        Ok(())
    }

    fn create_pace_receiver() -> Result<pace_receiver::PaceReceiver> {
        let context = pace_receiver::CreationContext {};
        pace_receiver::PaceReceiver::new(context).in_node("timing_nodes::pace_receiver")
    }

    fn create_position_filter() -> Result<position_filter::PositionFilter> {
        let context = position_filter::CreationContext {};
        position_filter::PositionFilter::new(context)
            .in_node("timing_nodes::position_filter")
    }

    fn create_set_printer() -> Result<set_printer::SetPrinter> {
        let context = set_printer::CreationContext {};
        set_printer::SetPrinter::new(context).in_node("timing_nodes::set_printer")
    }
}
