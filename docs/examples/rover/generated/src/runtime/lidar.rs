//! Cycler `Lidar` between its buffers and its nodes.
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

use crate::cyclers::lidar::Nodes;
use crate::databases::lidar::Frame;
use crate::databases::lidar::Injections;
use crate::databases::lidar::OwnOutputs;
use crate::databases::lidar::SharedOutputs;
use crate::parameters::Parameters;

/// What the manifest says about `Lidar`.
pub const LIDAR: InstanceDescription = InstanceDescription {
    name: "Lidar",
    cycler: "Lidar",
    kind: Kind::Perception,
    on_failure: OnFailure::Restart,
    deadline: Some(Duration::from_millis(100)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: Some(Duration::from_millis(20)),
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Lidar<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
}

impl<Hardware> Lidar<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(
        &'a mut self,
        slots: Slots<'a, SharedOutputs>,
        cycle: Cycle,
    ) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let frame = Frame {
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            own: self.own.both().0,
            parameters,
            shared: slots.current,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: rover_nodes::interfaces::Lidar + Send + Sync> Body for Lidar<Hardware> {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.parameters.take();
        self.nodes = Nodes::new()?;
        Ok(())
    }

    fn wait(
        &mut self,
        slots: Slots<'_, SharedOutputs>,
        cycle: Cycle,
    ) -> Result<Option<Timestamp>> {
        self.parameters.take();
        self.capture_time = None;
        let (nodes, mut frame) = self.frame(slots, cycle);
        nodes.setup(&mut frame)?;
        Ok(self.capture_time)
    }

    fn begin(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) {
        self.parameters.take();
        self.injections.take();
        let (_, mut frame) = self.frame(slots, cycle);
        Nodes::inject(&mut frame);
    }

    fn run(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) -> Result<()> {
        if cycle.timed || self.injections.view().get().is_some() {
            let (nodes, mut frame) = self.frame(slots, cycle);
            return nodes.cycle_closely(&mut frame);
        }
        let (nodes, mut frame) = self.frame(slots, cycle);
        nodes.cycle(&mut frame)
    }

    fn finish(&mut self, _shared: &SharedOutputs, _cycle: Cycle) {
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
        &["scan", "freeways"]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "scan" => Some(&self.own.previous().scan),
            "freeways" => Some(&shared.freeways),
            _ => None,
        }
    }

    fn additional_output(&self, _name: &str, _cycle: u64) -> Option<&dyn Reflect> {
        None
    }

    fn outputs<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        _cycle: u64,
        visitor: &mut impl OutputVisitor<'a>,
    ) {
        visitor.output(Some(&self.own.previous().scan));
        visitor.output(Some(&shared.freeways));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.scan_receiver.report());
        visit(self.nodes.freeway_detection.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("rover_nodes::lidar::scan_receiver", &mut self.nodes.scan_receiver);
        visit(
            "rover_nodes::lidar::freeway_detection",
            &mut self.nodes.freeway_detection,
        );
    }
}
