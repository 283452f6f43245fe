//! Cycler `Reflexes` (real-time), one instance.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Guarded;
use framework::InNode;
use framework::OnFailure;
use framework::PerceptionInput;
use framework::Result;
use zoo_nodes::interfaces::BumperInterface;
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::reflexes::bumper;
use zoo_nodes::reflexes::flinch;

use crate::databases::reflexes::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub bumper: Guarded<bumper::Bumper>,
    pub flinch: Guarded<flinch::Flinch>,
}

impl Nodes {
    pub fn new() -> Result<Self> {
        Ok(Self {
            bumper: Guarded::new(
                "zoo_nodes::reflexes::bumper",
                OnFailure::Stop,
                Self::create_bumper()?,
            ),
            flinch: Guarded::new(
                "zoo_nodes::reflexes::flinch",
                OnFailure::Stop,
                Self::create_flinch()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    pub fn setup(&mut self, frame: &mut Frame<'_, impl BumperInterface>) -> Result<()> {
        self.bumper(frame)?;
        Ok(())
    }

    /// Clients' values in place of what setup nodes wrote.
    pub fn inject<Hardware>(frame: &mut Frame<'_, Hardware>) {
        if let Some(injections) = frame.injections {
            injections.pressed.replace(&mut frame.own.pressed);
        }
    }

    /// Nodes: each call reads only what a call above it, or another cycler, wrote.
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl LampInterface>) -> Result<()> {
        self.flinch(frame)?;
        Ok(())
    }

    /// hardware -> pressed
    fn bumper(&mut self, frame: &mut Frame<'_, impl BumperInterface>) -> Result<()> {
        let context = bumper::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.bumper.call(frame.cycle, |node| node.cycle(context))?;
        frame.own.pressed = outputs.pressed.value;
        Ok(())
    }

    /// pressed, perception VisionBottom.spots, latest Control.pose -> hardware
    fn flinch(&mut self, frame: &mut Frame<'_, impl LampInterface>) -> Result<()> {
        let bottom = frame.perception.vision_bottom.project(|outputs| &outputs.spots);
        let context = flinch::CycleContext {
            pressed: &frame.own.pressed,
            bottom: PerceptionInput::new(&bottom),
            pose: frame
                .latest
                .control
                .latest(frame.cycle.time.start, |outputs| &outputs.pose),
            hardware_interface: frame.hardware_interface,
        };
        self.flinch.call(frame.cycle, |node| node.cycle(context))?;
        Ok(())
    }

    fn create_bumper() -> Result<bumper::Bumper> {
        let context = bumper::CreationContext {};
        bumper::Bumper::new(context).in_node("zoo_nodes::reflexes::bumper")
    }

    fn create_flinch() -> Result<flinch::Flinch> {
        let context = flinch::CreationContext {};
        flinch::Flinch::new(context).in_node("zoo_nodes::reflexes::flinch")
    }
}
