//! Cycler `Control` between its buffers and its nodes.
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
use k1_nodes::interfaces::BodyInterface;
use k1_nodes::interfaces::MotorInterface;

use crate::cyclers::control::Nodes;
use crate::databases::control::Frame;
use crate::databases::control::Injections;
use crate::databases::control::OwnOutputs;
use crate::parameters::Parameters;

/// What the manifest says about `Control`.
pub const CONTROL: InstanceDescription = InstanceDescription {
    name: "Control",
    cycler: "Control",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(2)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(50),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Control<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
}

impl<Hardware> Control<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(&'a mut self, cycle: Cycle) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let frame = Frame {
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            own: self.own.both().0,
            parameters,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: BodyInterface + MotorInterface + Send + Sync> Body for Control<Hardware> {
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
        self.capture_time = None;
        let (nodes, mut frame) = self.frame(cycle);
        nodes.setup(&mut frame)?;
        Ok(self.capture_time)
    }

    fn begin(&mut self, _slots: Slots<'_, ()>, cycle: Cycle) {
        self.parameters.take();
        self.injections.take();
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
    }

    fn abandon(&mut self) {}

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["body", "standing", "head_yaw", "arm_pitch", "motor_commands"]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "body" => Some(&self.own.previous().body),
            "standing" => Some(&self.own.previous().standing),
            "head_yaw" => Some(&self.own.previous().head_yaw),
            "arm_pitch" => Some(&self.own.previous().arm_pitch),
            "motor_commands" => Some(&self.own.previous().motor_commands),
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
        visitor.output(Some(&self.own.previous().body));
        visitor.output(Some(&self.own.previous().standing));
        visitor.output(Some(&self.own.previous().head_yaw));
        visitor.output(Some(&self.own.previous().arm_pitch));
        visitor.output(Some(&self.own.previous().motor_commands));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.body_receiver.report());
        visit(self.nodes.prepare.report());
        visit(self.nodes.look_around.report());
        visit(self.nodes.wave.report());
        visit(self.nodes.motor_sender.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("k1_nodes::body_receiver", &mut self.nodes.body_receiver);
        visit("k1_nodes::prepare", &mut self.nodes.prepare);
        visit("k1_nodes::look_around", &mut self.nodes.look_around);
        visit("k1_nodes::wave", &mut self.nodes.wave);
        visit("k1_nodes::motor_sender", &mut self.nodes.motor_sender);
    }
}
