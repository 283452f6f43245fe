//! Cycler `Radio` between its buffers and its nodes.
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
use framework::Timestamp;

use crate::cyclers::radio::Nodes;
use crate::databases::radio::Frame;
use crate::databases::radio::Injections;
use crate::databases::radio::SharedOutputs;

/// What the manifest says about `Radio`.
pub const RADIO: InstanceDescription = InstanceDescription {
    name: "Radio",
    cycler: "Radio",
    kind: Kind::Perception,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(10)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(5),
    lockstep_duration: Some(Duration::from_millis(2)),
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Radio<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
}

impl<Hardware> Radio<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(
        &'a mut self,
        slots: Slots<'a, SharedOutputs>,
        cycle: Cycle,
    ) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let frame = Frame {
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            shared: slots.current,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: timing_nodes::interfaces::Radio + Send + Sync> Body for Radio<Hardware> {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.nodes = Nodes::new()?;
        Ok(())
    }

    fn wait(
        &mut self,
        slots: Slots<'_, SharedOutputs>,
        cycle: Cycle,
    ) -> Result<Option<Timestamp>> {
        self.capture_time = None;
        let (nodes, mut frame) = self.frame(slots, cycle);
        nodes.setup(&mut frame)?;
        Ok(self.capture_time)
    }

    fn begin(&mut self, slots: Slots<'_, SharedOutputs>, cycle: Cycle) {
        self.injections.take();
        let (_, mut frame) = self.frame(slots, cycle);
        Nodes::inject(&mut frame);
    }

    fn run(&mut self, _slots: Slots<'_, SharedOutputs>, _cycle: Cycle) -> Result<()> {
        Ok(())
    }

    fn finish(&mut self, _shared: &SharedOutputs, _cycle: Cycle) {}

    fn abandon(&mut self) {}

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, _visit: &mut dyn FnMut(Reference)) {}

    fn main_outputs(&self) -> &'static [&'static str] {
        &["measurement"]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "measurement" => Some(&shared.measurement),
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
        visitor.output(Some(&shared.measurement));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.message_receiver.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("timing_nodes::message_receiver", &mut self.nodes.message_receiver);
    }
}
