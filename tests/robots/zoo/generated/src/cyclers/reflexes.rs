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
use zoo_nodes::reflexes::create;
use zoo_nodes::reflexes::flinch;
use zoo_nodes::reflexes::node;

use crate::databases::reflexes::Frame;

/// The nodes of one instance; they keep their state between cycles.
pub struct Nodes {
    pub bumper: Guarded<bumper::Bumper>,
    pub create_node2: Guarded<create::Create>,
    pub flinch: Guarded<flinch::Flinch>,
    pub node: Guarded<node::Node>,
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
            create_node2: Guarded::new(
                "zoo_nodes::reflexes::create",
                OnFailure::Stop,
                Self::create_create_node2()?,
            ),
            node: Guarded::new(
                "zoo_nodes::reflexes::node",
                OnFailure::Stop,
                Self::create_node()?,
            ),
        })
    }

    /// Setup nodes: wait for the data this cycle is about.
    #[inline(always)]
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
    #[inline(always)]
    pub fn cycle(&mut self, frame: &mut Frame<'_, impl LampInterface>) -> Result<()> {
        self.flinch(frame)?;
        self.create_node2(frame)?;
        self.node(frame)?;
        Ok(())
    }

    /// As `cycle`, when it is timed or clients replace outputs.
    #[cold]
    #[inline(never)]
    pub fn cycle_closely(
        &mut self,
        frame: &mut Frame<'_, impl LampInterface>,
    ) -> Result<()> {
        self.cycle(frame)
    }

    /// hardware -> pressed
    #[inline(always)]
    fn bumper(&mut self, frame: &mut Frame<'_, impl BumperInterface>) -> Result<()> {
        let context = bumper::CycleContext {
            hardware_interface: frame.hardware_interface,
        };
        let outputs = self.bumper.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.pressed = outputs.pressed.value;
        Ok(())
    }

    /// -> sum
    #[inline(always)]
    fn create_node2<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = create::CycleContext {
            own: &frame.parameters.self_.x,
            perhaps: &frame.parameters.option.text,
            many: &frame.parameters.vec.numbers,
            nested: &frame.instance_a_b.x,
            joined: &frame.instance_a_b2.y,
        };
        let outputs = self.create_node2.call(&frame.cycle, |node| node.cycle(context))?;
        frame.own.sum = outputs.sum.value;
        if let Some(injections) = frame.injections {
            injections.sum.replace(&mut frame.own.sum);
        }
        Ok(())
    }

    /// pressed, perception VisionBottom.spots, latest Control.pose -> hardware
    #[inline(always)]
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
        self.flinch.call(&frame.cycle, |node| node.cycle(context))?;
        Ok(())
    }

    /// sum, procedure type_ -> nothing
    #[inline(always)]
    fn node<Hardware>(&mut self, frame: &mut Frame<'_, Hardware>) -> Result<()> {
        let context = node::CycleContext {
            sum: &frame.own.sum,
            add: frame.procedures.type_.call(),
        };
        self.node.call(&frame.cycle, |node| node.cycle(context))?;
        Ok(())
    }

    fn create_bumper() -> Result<bumper::Bumper> {
        let context = bumper::CreationContext {};
        bumper::Bumper::new(context).in_node("zoo_nodes::reflexes::bumper")
    }

    fn create_create_node2() -> Result<create::Create> {
        let context = create::CreationContext {};
        create::Create::new(context).in_node("zoo_nodes::reflexes::create")
    }

    fn create_flinch() -> Result<flinch::Flinch> {
        let context = flinch::CreationContext {};
        flinch::Flinch::new(context).in_node("zoo_nodes::reflexes::flinch")
    }

    fn create_node() -> Result<node::Node> {
        let context = node::CreationContext {};
        node::Node::new(context).in_node("zoo_nodes::reflexes::node")
    }
}
