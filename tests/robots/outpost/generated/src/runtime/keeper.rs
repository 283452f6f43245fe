//! Cycler `Keeper` between its buffers and its nodes.
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
use outpost_nodes::interfaces::ClockInterface;

use crate::cyclers::keeper::Nodes;
use crate::databases::keeper::Frame;
use crate::databases::keeper::Injections;
use crate::databases::keeper::Latest;
use crate::databases::keeper::OwnOutputs;
use crate::databases::keeper::Perception;
use crate::databases::lookout;
use crate::parameters::Parameters;

/// What the manifest says about `Keeper`.
pub const KEEPER: InstanceDescription = InstanceDescription {
    name: "Keeper",
    cycler: "Keeper",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: None,
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(5),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Keeper<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub perception: Perception,
    pub lookout_north: Reader<lookout::SharedOutputs>,
}

impl<Hardware> Keeper<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(&'a mut self, cycle: Cycle) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let frame = Frame {
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            latest: Latest {
                lookout_north: self.lookout_north.view(),
            },
            own: self.own.both().0,
            parameters,
            perception: &self.perception,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: ClockInterface + Send + Sync> Body for Keeper<Hardware> {
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
        self.lookout_north.take();
        self.perception
            .horizon
            .consume(
                cycle.time.start,
                [&mut self.perception.lookout_north, &mut self.perception.lookout_south],
            );
        self.perception
            .lookout
            .merge([&self.perception.lookout_north, &self.perception.lookout_south]);
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
        self.lookout_north.references("LookoutNorth", visit);
        self.perception.lookout_north.references("LookoutNorth", visit);
        self.perception.lookout_south.references("LookoutSouth", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["entries", "newest_in_the_north", "provisional"]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "entries" => Some(&self.own.previous().entries),
            "newest_in_the_north" => Some(&self.own.previous().newest_in_the_north),
            "provisional" => Some(&self.own.previous().provisional),
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
        visitor.output(Some(&self.own.previous().entries));
        visitor.output(Some(&self.own.previous().newest_in_the_north));
        visitor.output(Some(&self.own.previous().provisional));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.clock.report());
        visit(self.nodes.book.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        visit(QueueReport {
            from: "LookoutNorth",
            counts: self.perception.lookout_north.report(),
        });
        visit(QueueReport {
            from: "LookoutSouth",
            counts: self.perception.lookout_south.report(),
        });
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("outpost_nodes::keeper::clock", &mut self.nodes.clock);
        visit("outpost_nodes::keeper::book", &mut self.nodes.book);
    }
}
