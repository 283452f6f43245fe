//! Cycler `Lights` between its buffers and its nodes.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Body;
use framework::Cycle;
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
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::interfaces::MetronomeInterface;

use crate::cyclers::lights::Nodes;
use crate::databases::control;
use crate::databases::lights::CyclerState;
use crate::databases::lights::Frame;
use crate::databases::lights::Latest;

/// What the manifest says about `Lights`.
pub const LIGHTS: InstanceDescription = InstanceDescription {
    name: "Lights",
    cycler: "Lights",
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
pub struct Lights<Hardware> {
    pub nodes: Nodes,
    pub cycler_state: CyclerState,
    pub hardware_interface: Arc<Hardware>,
    pub control: Reader<control::SharedOutputs>,
}

impl<Hardware> Lights<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(&'a mut self, cycle: Cycle) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let frame = Frame {
            cycle,
            cycler_state: &mut self.cycler_state,
            hardware_interface: &self.hardware_interface,
            latest: Latest {
                control: self.control.view(),
            },
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: LampInterface + LegInterface + MetronomeInterface + Send + Sync> Body
for Lights<Hardware> {
    type Shared = ();

    fn create(&mut self) -> Result<()> {
        self.cycler_state = CyclerState::default();
        self.nodes = Nodes::new()?;
        Ok(())
    }

    fn wait(
        &mut self,
        _slots: Slots<'_, ()>,
        cycle: Cycle,
    ) -> Result<Option<Timestamp>> {
        let (nodes, mut frame) = self.frame(cycle);
        nodes.setup(&mut frame)?;
        Ok(None)
    }

    fn begin(&mut self, _slots: Slots<'_, ()>, _cycle: Cycle) {
        self.control.take();
    }

    fn run(&mut self, _slots: Slots<'_, ()>, cycle: Cycle) -> Result<()> {
        if cycle.timed {
            let (nodes, mut frame) = self.frame(cycle);
            return nodes.cycle_closely(&mut frame);
        }
        let (nodes, mut frame) = self.frame(cycle);
        nodes.cycle(&mut frame)
    }

    fn finish(&mut self, _shared: &(), _cycle: Cycle) {}

    fn abandon(&mut self) {}

    fn restore(&mut self) -> Result<()> {
        // The states of all nodes are whole.
        Ok(())
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.control.references("Control", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        _name: &str,
    ) -> Option<&'a dyn Reflect> {
        None
    }

    fn additional_output(&self, _name: &str, _cycle: u64) -> Option<&dyn Reflect> {
        None
    }

    fn outputs<'a>(
        &'a self,
        _shared: &'a (),
        _cycle: u64,
        _visitor: &mut impl OutputVisitor<'a>,
    ) {}

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.setup_node.report());
        visit(self.nodes.lamp.report());
        visit(self.nodes.cycle_node.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("zoo_nodes::lights::setup", &mut self.nodes.setup_node);
        visit("zoo_nodes::lights::lamp", &mut self.nodes.lamp);
        visit("zoo_nodes::lights::cycle", &mut self.nodes.cycle_node);
        visit("cycler_state", &mut self.cycler_state);
    }
}
