//! Cycler `Garden` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use sprinkler_nodes::SoilProbe;
use sprinkler_nodes::Valve;
use sprinkler_nodes::soil_receiver;
use sprinkler_nodes::thirst;
use sprinkler_nodes::valve_choice;
use sprinkler_nodes::valve_sender;

use crate::databases::garden::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub soil_receiver: Guarded<soil_receiver::SoilReceiver>,
    pub thirst: Guarded<thirst::Thirst>,
    pub valve_choice: Guarded<valve_choice::ValveChoice>,
    pub valve_sender: Guarded<valve_sender::ValveSender>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            soil_receiver: Guarded::new(
                "sprinkler_nodes::soil_receiver",
                OnFailure::Stop,
                Self::create_soil_receiver()?,
            ),
            thirst: Guarded::new(
                "sprinkler_nodes::thirst",
                OnFailure::Stop,
                Self::create_thirst()?,
            ),
            valve_choice: Guarded::new(
                "sprinkler_nodes::valve_choice",
                OnFailure::Stop,
                Self::create_valve_choice()?,
            ),
            valve_sender: Guarded::new(
                "sprinkler_nodes::valve_sender",
                OnFailure::Stop,
                Self::create_valve_sender()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(&mut self, frame: &mut Frame<'_, impl SoilProbe>) -> Result<()> {
        self.soil_receiver(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.moisture.replace(&mut frame.own.moisture);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl Valve>) -> Result<()> {
        self.thirst(frame)?;
        self.valve_choice(frame)?;
        self.valve_sender(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(&mut self, frame: &mut Frame<'_, impl Valve>) -> Result<()> {
        self.cycle(frame)
    }

    /// hardware -> moisture
    #[inline(always)]
    fn soil_receiver(&mut self, frame: &mut Frame<'_, impl SoilProbe>) -> Result<()> {
        let context = soil_receiver::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.soil_receiver.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.moisture = outputs.moisture.value;
        *frame.capture_time = Some(outputs.captured_at.0);
        Ok(())
    }

    /// moisture, latest Weather.mean_rain -> thirst
    #[inline(always)]
    fn thirst<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = thirst::CycleContext {
            moisture: &frame.own.moisture,
            rain: frame
                .latest
                .weather
                .latest(frame.cycle.time.start, |outputs| &outputs.mean_rain),
            wanted: &frame.parameters.thirst.wanted,
            enough_rain: &frame.parameters.thirst.enough_rain,
        };
        let outputs = self.thirst.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.thirst = outputs.thirst.value;
        if let Some(injections) = frame.injections {
            injections.thirst.replace(&mut frame.own.thirst);
        }
        Ok(())
    }

    /// thirst, previous valve -> valve
    #[inline(always)]
    fn valve_choice<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = valve_choice::CycleContext {
            thirst: &frame.own.thirst,
            was_open: &frame.previous.own.valve,
            opens: &frame.parameters.valve_choice.opens,
            closes: &frame.parameters.valve_choice.closes,
        };
        let outputs = self.valve_choice.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.valve = outputs.valve.value;
        if let Some(injections) = frame.injections {
            injections.valve.replace(&mut frame.own.valve);
        }
        Ok(())
    }

    /// valve (required) -> hardware
    #[inline(always)]
    fn valve_sender(&mut self, frame: &mut Frame<'_, impl Valve>) -> Result<()> {
        if let Some(valve) = frame.own.valve.as_ref() {
            let context = valve_sender::CycleContext {
                hardware_interface: frame.hardware_interface,
                valve,
            };
            self.valve_sender.call(&frame.cycle, |node| node.cycle(context))?;
        } else {
            // A required input is absent.
            self.valve_sender.skip();
        }
        Ok(())
    }

    fn create_soil_receiver() -> Result<soil_receiver::SoilReceiver> {
        let context = soil_receiver::CreationContext {};
        soil_receiver::SoilReceiver::new(context)
            .in_node("sprinkler_nodes::soil_receiver")
    }

    fn create_thirst() -> Result<thirst::Thirst> {
        let context = thirst::CreationContext {};
        thirst::Thirst::new(context).in_node("sprinkler_nodes::thirst")
    }

    fn create_valve_choice() -> Result<valve_choice::ValveChoice> {
        let context = valve_choice::CreationContext {};
        valve_choice::ValveChoice::new(context).in_node("sprinkler_nodes::valve_choice")
    }

    fn create_valve_sender() -> Result<valve_sender::ValveSender> {
        let context = valve_sender::CreationContext {};
        valve_sender::ValveSender::new(context).in_node("sprinkler_nodes::valve_sender")
    }
}
