//! Cycler `Lights` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::Result;
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::interfaces::MetronomeInterface;
use zoo_nodes::lights::cycle;
use zoo_nodes::lights::lamp;
use zoo_nodes::lights::setup;

use crate::databases::lights::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub cycle_node: Guarded<cycle::Cycle>,
    pub lamp: Guarded<lamp::Lamp>,
    pub setup_node: Guarded<setup::Setup>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            setup_node: Guarded::new(
                "zoo_nodes::lights::setup",
                OnFailure::Stop,
                Self::create_setup_node()?,
            ),
            lamp: Guarded::new(
                "zoo_nodes::lights::lamp",
                OnFailure::Stop,
                Self::create_lamp()?,
            ),
            cycle_node: Guarded::new(
                "zoo_nodes::lights::cycle",
                OnFailure::Stop,
                Self::create_cycle_node()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
    pub fn setup(
        &mut self,
        frame: &mut Frame<'_, impl MetronomeInterface>,
    ) -> Result<()> {
        self.setup_node(frame)?;
        Ok(())
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    #[inline(always)]
    pub fn cycle(
        &mut self,
        frame: &mut Frame<'_, impl LampInterface + LegInterface>,
    ) -> Result<()> {
        self.lamp(frame)?;
        self.cycle_node(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(
        &mut self,
        frame: &mut Frame<'_, impl LampInterface + LegInterface>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// -> nothing
    #[inline(always)]
    fn cycle_node<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = cycle::CycleContext {};
        self.cycle_node.call(&frame.cycle, |node| node.cycle(context))?;
        Ok(())
    }

    /// latest Control.pose.heading, state beat -> hardware
    #[inline(always)]
    fn lamp(
        &mut self,
        frame: &mut Frame<'_, impl LampInterface + LegInterface>,
    ) -> Result<()> {
        let context = lamp::CycleContext {
            heading: &frame.latest.control.pose.heading,
            beat: &frame.cycler_state.beat,
            hardware_interface: frame.hardware_interface,
        };
        self.lamp.call(&frame.cycle, |node| node.cycle(context))?;
        Ok(())
    }

    /// hardware, state beat -> nothing
    #[inline(always)]
    fn setup_node(
        &mut self,
        frame: &mut Frame<'_, impl MetronomeInterface>,
    ) -> Result<()> {
        let context = setup::CycleContext {
            hardware_interface: frame.hardware_interface,
            beat: &mut frame.cycler_state.beat,
        };
        self.setup_node.call(&frame.cycle, |node| node.cycle(context))?;
        Ok(())
    }

    fn create_cycle_node() -> Result<cycle::Cycle> {
        let context = cycle::CreationContext {};
        cycle::Cycle::new(context).in_node("zoo_nodes::lights::cycle")
    }

    fn create_lamp() -> Result<lamp::Lamp> {
        let context = lamp::CreationContext {};
        lamp::Lamp::new(context).in_node("zoo_nodes::lights::lamp")
    }

    fn create_setup_node() -> Result<setup::Setup> {
        let context = setup::CreationContext {};
        setup::Setup::new(context).in_node("zoo_nodes::lights::setup")
    }
}
