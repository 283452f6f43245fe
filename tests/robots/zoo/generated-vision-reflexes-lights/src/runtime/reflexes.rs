//! Cycler `Reflexes` between its buffers and its nodes.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Body;
use framework::Cycle;
use framework::Injected;
use framework::InstanceDescription;
use framework::Kind;
use framework::NodeReport;
use framework::OnFailure;
use framework::OutputVisitor;
use framework::QueueReport;
use framework::Reader;
use framework::Record;
use framework::Reference;
use framework::Reflect;
use framework::Result;
use framework::Scheduling;
use framework::Slots;
use framework::State;
use framework::Swap;
use framework::Timestamp;
use zoo_nodes::interfaces::BumperInterface;
use zoo_nodes::interfaces::LampInterface;

use crate::cyclers::reflexes::Nodes;
use crate::databases::control;
use crate::databases::reflexes::Frame;
use crate::databases::reflexes::Injections;
use crate::databases::reflexes::Latest;
use crate::databases::reflexes::OwnOutputs;
use crate::databases::reflexes::Perception;
use crate::databases::reflexes::Procedures;
use crate::parameters::ABReflexesInstance;
use crate::parameters::ABReflexesInstance2;
use crate::parameters::Parameters;

/// What the manifest says about `Reflexes`.
pub const REFLEXES: InstanceDescription = InstanceDescription {
    name: "Reflexes",
    cycler: "Reflexes",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: None,
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Reflexes<Hardware> {
    pub nodes: Nodes,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub perception: Perception,
    pub procedures: Procedures,
    pub control: Reader<control::SharedOutputs>,
    pub select_a_b: fn(&Parameters) -> &ABReflexesInstance,
    pub select_a_b2: fn(&Parameters) -> &ABReflexesInstance2,
}

impl<Hardware> Reflexes<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(&'a mut self, cycle: Cycle) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let frame = Frame {
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            instance_a_b: (self.select_a_b)(parameters),
            instance_a_b2: (self.select_a_b2)(parameters),
            latest: Latest {
                control: self.control.view(),
            },
            own: self.own.both().0,
            parameters,
            perception: &self.perception,
            procedures: &mut self.procedures,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: BumperInterface + LampInterface + Send + Sync> Body
for Reflexes<Hardware> {
    type Shared = ();

    fn create(&mut self) -> Result<()> {
        self.parameters.take();
        self.nodes = Nodes::new()?;
        Ok(())
    }

    fn wait(
        &mut self,
        _slots: Slots<'_, ()>,
        cycle: Cycle,
    ) -> Result<Option<Timestamp>> {
        self.parameters.take();
        let (nodes, mut frame) = self.frame(cycle);
        nodes.setup(&mut frame)?;
        Ok(None)
    }

    fn begin(&mut self, _slots: Slots<'_, ()>, cycle: Cycle) {
        self.parameters.take();
        self.injections.take();
        self.control.take();
        self.perception
            .horizon
            .consume(cycle.time.start, [&mut self.perception.vision_bottom]);
        self.procedures.type_.take();
        let (_, mut frame) = self.frame(cycle);
        Nodes::inject(&mut frame);
    }

    fn run(&mut self, _slots: Slots<'_, ()>, cycle: Cycle) -> Result<()> {
        if cycle.timed || self.injections.view().get().is_some() {
            let (nodes, mut frame) = self.frame(cycle);
            return nodes.cycle_closely(&mut frame);
        }
        let (nodes, mut frame) = self.frame(cycle);
        nodes.cycle(&mut frame)
    }

    fn finish(&mut self, _shared: &(), _cycle: Cycle) {
        self.own.swap();
        self.procedures.type_.close();
    }

    fn abandon(&mut self) {
        self.procedures.type_.close();
    }

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.control.references("Control", visit);
        self.perception.vision_bottom.references("VisionBottom", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["pressed", "sum"]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "pressed" => Some(&self.own.previous().pressed),
            "sum" => Some(&self.own.previous().sum),
            _ => None,
        }
    }

    fn additional_output(&self, _name: &str, _cycle: u64) -> Option<&dyn Reflect> {
        None
    }

    fn outputs<'a>(
        &'a self,
        _shared: &'a (),
        _cycle: u64,
        visitor: &mut impl OutputVisitor<'a>,
    ) {
        visitor.output(Some(&self.own.previous().pressed));
        visitor.output(Some(&self.own.previous().sum));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.bumper.report());
        visit(self.nodes.flinch.report());
        visit(self.nodes.create_node2.report());
        visit(self.nodes.node.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        visit(QueueReport {
            from: "VisionBottom",
            counts: self.perception.vision_bottom.report(),
        });
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("zoo_nodes::reflexes::bumper", &mut self.nodes.bumper);
        visit("zoo_nodes::reflexes::flinch", &mut self.nodes.flinch);
        visit("zoo_nodes::reflexes::create", &mut self.nodes.create_node2);
        visit("zoo_nodes::reflexes::node", &mut self.nodes.node);
    }
}
