//! Cycler `Garden` between its buffers and its nodes.
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
use sprinkler_nodes::SoilProbe;
use sprinkler_nodes::Valve;

use crate::cyclers::garden::Nodes;
use crate::databases::garden::Frame;
use crate::databases::garden::Injections;
use crate::databases::garden::Latest;
use crate::databases::garden::OwnOutputs;
use crate::databases::garden::Previous;
use crate::databases::weather;
use crate::parameters::Parameters;

/// What the manifest says about `Garden`.
pub const GARDEN: InstanceDescription = InstanceDescription {
    name: "Garden",
    cycler: "Garden",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(100)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Garden<Hardware> {
    pub nodes: Nodes,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub weather: Reader<weather::SharedOutputs>,
}

impl<Hardware> Garden<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(&'a mut self, cycle: Cycle) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let (own, previous_own) = self.own.both();
        let frame = Frame {
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            latest: Latest {
                weather: self.weather.view(),
            },
            own,
            parameters,
            previous: Previous { own: previous_own },
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: SoilProbe + Valve + Send + Sync> Body for Garden<Hardware> {
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
        self.weather.take();
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
        self.weather.references("Weather", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["moisture", "thirst", "valve"]
    }

    fn main_output<'a>(
        &'a self,
        _shared: &'a (),
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "moisture" => Some(&self.own.previous().moisture),
            "thirst" => Some(&self.own.previous().thirst),
            "valve" => Some(&self.own.previous().valve),
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
        visitor.output(Some(&self.own.previous().moisture));
        visitor.output(Some(&self.own.previous().thirst));
        visitor.output(Some(&self.own.previous().valve));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.soil_receiver.report());
        visit(self.nodes.thirst.report());
        visit(self.nodes.valve_choice.report());
        visit(self.nodes.valve_sender.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("sprinkler_nodes::soil_receiver", &mut self.nodes.soil_receiver);
        visit("sprinkler_nodes::thirst", &mut self.nodes.thirst);
        visit("sprinkler_nodes::valve_choice", &mut self.nodes.valve_choice);
        visit("sprinkler_nodes::valve_sender", &mut self.nodes.valve_sender);
    }
}
