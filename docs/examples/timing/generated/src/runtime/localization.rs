//! Cycler `Localization` between its buffers and its nodes.
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
use timing_nodes::interfaces::Console;
use timing_nodes::interfaces::Pace;

use crate::cyclers::localization::Nodes;
use crate::databases::localization::Frame;
use crate::databases::localization::Injections;
use crate::databases::localization::OwnOutputs;
use crate::databases::localization::Perception;
use crate::parameters::Parameters;

/// What the manifest says about `Localization`.
pub const LOCALIZATION: InstanceDescription = InstanceDescription {
    name: "Localization",
    cycler: "Localization",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(10)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(5),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Localization<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub perception: Perception,
}

impl<Hardware> Localization<Hardware> {
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
            perception: &self.perception,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: Console + Pace + Send + Sync> Body for Localization<Hardware> {
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
        self.perception
            .horizon
            .consume(
                cycle.time.start,
                [
                    &mut self.perception.vision,
                    &mut self.perception.odometry,
                    &mut self.perception.radio,
                ],
            );
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
        self.perception.vision.references("Vision", visit);
        self.perception.odometry.references("Odometry", visit);
        self.perception.radio.references("Radio", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["sets"]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "sets" => Some(&self.own.previous().sets),
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
        visitor.output(Some(&self.own.previous().sets));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.pace_receiver.report());
        visit(self.nodes.position_filter.report());
        visit(self.nodes.set_printer.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        visit(QueueReport {
            from: "Vision",
            counts: self.perception.vision.report(),
        });
        visit(QueueReport {
            from: "Odometry",
            counts: self.perception.odometry.report(),
        });
        visit(QueueReport {
            from: "Radio",
            counts: self.perception.radio.report(),
        });
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("timing_nodes::pace_receiver", &mut self.nodes.pace_receiver);
        visit("timing_nodes::position_filter", &mut self.nodes.position_filter);
        visit("timing_nodes::set_printer", &mut self.nodes.set_printer);
    }
}
