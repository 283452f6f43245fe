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
use framework::Policy;
use framework::QueueReport;
use framework::Reader;
use framework::Record;
use framework::Reference;
use framework::Reflect;
use framework::Result;
use framework::Scheduling;
use framework::Slots;
use framework::State;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::LegInterface;

use crate::cyclers::control::Nodes;
use crate::databases::control::AdditionalOutputs;
use crate::databases::control::Creation;
use crate::databases::control::CyclerState;
use crate::databases::control::Frame;
use crate::databases::control::Historic;
use crate::databases::control::Injections;
use crate::databases::control::OwnOutputs;
use crate::databases::control::Perception;
use crate::databases::control::Previous;
use crate::databases::control::Procedures;
use crate::databases::control::SharedOutputs;
use crate::databases::control::Subscribed;
use crate::parameters::Parameters;

/// What the manifest says about `Control`.
pub const CONTROL: InstanceDescription = InstanceDescription {
    name: "Control",
    cycler: "Control",
    kind: Kind::RealTime,
    on_failure: OnFailure::Stop,
    deadline: Some(Duration::from_millis(12)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(200),
    history: Duration::from_secs(2),
    lockstep_duration: None,
    scheduling: Scheduling {
        policy: Some(Policy::Fifo),
        priority: Some(80),
        cores: &[0],
    },
    record: Record::On,
};

/// What clients can listen to, in the order of `Subscribed`.
pub const ADDITIONAL_OUTPUTS: &[&str] = &["debug.certainty", "debug.watcher.seen"];

/// One instance: its nodes, and its ends of all buffers.
pub struct Control<Hardware> {
    pub nodes: Nodes,
    pub additional_outputs: AdditionalOutputs,
    pub capture_time: Option<Timestamp>,
    pub cycler_state: CyclerState,
    pub hardware_interface: Arc<Hardware>,
    pub historic: Historic,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub perception: Perception,
    pub procedures: Procedures,
    pub subscribed: Subscribed,
    pub subscriptions: Subscriptions,
}

impl<Hardware> Control<Hardware> {
    /// The nodes, and everything they may touch in this cycle.
    #[inline(always)]
    fn frame<'a>(
        &'a mut self,
        slots: Slots<'a, SharedOutputs>,
        cycle: Cycle,
    ) -> (&'a mut Nodes, Frame<'a, Hardware>) {
        let parameters = self.parameters.view().value();
        let (own, previous_own) = self.own.both();
        let frame = Frame {
            additional_outputs: &mut self.additional_outputs,
            capture_time: &mut self.capture_time,
            cycle,
            cycler_state: &mut self.cycler_state,
            hardware_interface: &self.hardware_interface,
            historic: &self.historic,
            injections: self.injections.view().value().get(),
            own,
            parameters,
            perception: &self.perception,
            previous: Previous {
                own: previous_own,
                shared: slots.previous,
            },
            procedures: &mut self.procedures,
            shared: slots.current,
            subscribed: self.subscribed,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: BodyInterface + LegInterface + Send + Sync> Body for Control<Hardware> {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.parameters.take();
        self.cycler_state = CyclerState::default();
        let parameters = self.parameters.view().value();
        let mut creation = Creation {
            cycler_state: &mut self.cycler_state,
            hardware_interface: &self.hardware_interface,
            parameters,
        };
        self.nodes = Nodes::new(&mut creation)?;
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
        self.perception
            .horizon
            .consume(
                cycle.time.start,
                [
                    &mut self.perception.vision_top,
                    &mut self.perception.vision_bottom,
                    &mut self.perception.hearing,
                ],
            );
        self.perception
            .vision
            .merge([&self.perception.vision_top, &self.perception.vision_bottom]);
        if self.subscriptions.changed() {
            let mut wanted = self.subscriptions.wanted();
            self.subscribed = Subscribed {
                debug_certainty: wanted.next_one(),
                debug_watcher_seen: wanted.next_one(),
            };
        }
        self.procedures.stop.take();
        self.procedures.walk.take();
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

    fn finish(&mut self, shared: &SharedOutputs, cycle: Cycle) {
        self.historic.pose.push(cycle.time.start, &shared.pose);
        self.own.swap();
        self.procedures.stop.close();
        self.procedures.walk.close();
    }

    fn abandon(&mut self) {
        self.procedures.stop.close();
        self.procedures.walk.close();
    }

    fn restore(&mut self) -> Result<()> {
        let parameters = self.parameters.view().value();
        let mut creation = Creation {
            cycler_state: &mut self.cycler_state,
            hardware_interface: &self.hardware_interface,
            parameters,
        };
        self.nodes.restore(&mut creation)
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.perception.vision_top.references("VisionTop", visit);
        self.perception.vision_bottom.references("VisionBottom", visit);
        self.perception.hearing.references("Hearing", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["joints", "seen", "pose", "report", "target", "plan", "speed", "cycles"]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "joints" => Some(&self.own.previous().joints),
            "seen" => Some(&self.own.previous().seen),
            "pose" => Some(&shared.pose),
            "report" => Some(&self.own.previous().report),
            "target" => Some(&shared.target),
            "plan" => Some(&self.own.previous().plan),
            "speed" => Some(&self.own.previous().speed),
            "cycles" => Some(&self.own.previous().cycles),
            _ => None,
        }
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "debug.certainty" => {
                Some(self.additional_outputs.debug.certainty.get(cycle)?)
            }
            "debug.watcher.seen" => {
                Some(self.additional_outputs.debug.watcher.seen.get(cycle)?)
            }
            _ => None,
        }
    }

    fn outputs<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        cycle: u64,
        visitor: &mut impl OutputVisitor<'a>,
    ) {
        visitor.output(Some(&self.own.previous().joints));
        visitor.output(Some(&self.own.previous().seen));
        visitor.output(Some(&shared.pose));
        visitor.output(Some(&self.own.previous().report));
        visitor.output(Some(&shared.target));
        visitor.output(Some(&self.own.previous().plan));
        visitor.output(Some(&self.own.previous().speed));
        visitor.output(Some(&self.own.previous().cycles));
        visitor.output(self.additional_outputs.debug.certainty.get(cycle));
        visitor.output(self.additional_outputs.debug.watcher.seen.get(cycle));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.body.report());
        visit(self.nodes.watcher.report());
        visit(self.nodes.pose_filter.report());
        visit(self.nodes.spot_filter.report());
        visit(self.nodes.gait.report());
        visit(self.nodes.legs.report());
        visit(self.nodes.counter.report());
    }

    fn queues(&self, visit: &mut dyn FnMut(QueueReport)) {
        visit(QueueReport {
            from: "VisionTop",
            counts: self.perception.vision_top.report(),
        });
        visit(QueueReport {
            from: "VisionBottom",
            counts: self.perception.vision_bottom.report(),
        });
        visit(QueueReport {
            from: "Hearing",
            counts: self.perception.hearing.report(),
        });
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("zoo_nodes::control::body", &mut self.nodes.body);
        visit("zoo_nodes::control::watcher", &mut self.nodes.watcher);
        visit("zoo_nodes::control::pose_filter", &mut self.nodes.pose_filter);
        visit("zoo_nodes::control::spot_filter", &mut self.nodes.spot_filter);
        visit("zoo_nodes::control::gait", &mut self.nodes.gait);
        visit("zoo_nodes::control::legs", &mut self.nodes.legs);
        visit("zoo_nodes::shared::counter", &mut self.nodes.counter);
        visit("cycler_state", &mut self.cycler_state);
    }
}
