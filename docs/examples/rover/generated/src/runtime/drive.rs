//! Cycler `Drive` between its buffers and its nodes.
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
use rover_nodes::interfaces::Encoders;
use rover_nodes::interfaces::Motors;

use crate::cyclers::drive::Nodes;
use crate::databases::drive::Frame;
use crate::databases::drive::Historic;
use crate::databases::drive::Injections;
use crate::databases::drive::OwnOutputs;
use crate::databases::drive::Perception;
use crate::parameters::Parameters;

/// What the manifest says about `Drive`.
pub const DRIVE: InstanceDescription = InstanceDescription {
    name: "Drive",
    cycler: "Drive",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(20)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(200),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Drive<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub historic: Historic,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub perception: Perception,
}

impl<Hardware> Drive<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(&'a mut self, cycle: Cycle) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let frame = Frame {
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            historic: &self.historic,
            injections: self.injections.view().value().get(),
            own: self.own.both().0,
            parameters,
            perception: &self.perception,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: Encoders + Motors + Send + Sync> Body for Drive<Hardware> {
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
        self.perception.horizon.consume(cycle.time.start, [&mut self.perception.lidar]);
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

    fn finish(&mut self, _shared: &(), cycle: Cycle) {
        self.historic.pose.push(cycle.time.start, &self.own.current().pose);
        self.own.swap();
    }

    fn abandon(&mut self) {}

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.perception.lidar.references("Lidar", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["rolled", "pose", "speeds"]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "rolled" => Some(&self.own.previous().rolled),
            "pose" => Some(&self.own.previous().pose),
            "speeds" => Some(&self.own.previous().speeds),
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
        visitor.output(Some(&self.own.previous().rolled));
        visitor.output(Some(&self.own.previous().pose));
        visitor.output(Some(&self.own.previous().speeds));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.wheel_receiver.report());
        visit(self.nodes.odometry.report());
        visit(self.nodes.steering.report());
        visit(self.nodes.motor_sender.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        visit(QueueReport {
            from: "Lidar",
            counts: self.perception.lidar.report(),
        });
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("rover_nodes::drive::wheel_receiver", &mut self.nodes.wheel_receiver);
        visit("rover_nodes::drive::odometry", &mut self.nodes.odometry);
        visit("rover_nodes::drive::steering", &mut self.nodes.steering);
        visit("rover_nodes::drive::motor_sender", &mut self.nodes.motor_sender);
    }
}
