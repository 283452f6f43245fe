//! Cycler `Vision` between its buffers and its nodes.
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
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use zoo_nodes::interfaces::EyeInterface;

use crate::cyclers::vision::Nodes;
use crate::databases::control;
use crate::databases::vision::AdditionalOutputs;
use crate::databases::vision::Creation;
use crate::databases::vision::CyclerState;
use crate::databases::vision::Frame;
use crate::databases::vision::Injections;
use crate::databases::vision::Latest;
use crate::databases::vision::OwnOutputs;
use crate::databases::vision::Previous;
use crate::databases::vision::SharedOutputs;
use crate::databases::vision::Subscribed;
use crate::parameters::Parameters;
use crate::parameters::VisionInstance;

/// What the manifest says about `VisionTop`.
pub const VISION_TOP: InstanceDescription = InstanceDescription {
    name: "VisionTop",
    cycler: "Vision",
    kind: Kind::Perception,
    on_failure: OnFailure::Restart,
    deadline: Some(Duration::from_millis(33)),
    pending_timeout: Duration::from_millis(500),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: Some(Duration::from_millis(20)),
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// What the manifest says about `VisionBottom`.
pub const VISION_BOTTOM: InstanceDescription = InstanceDescription {
    name: "VisionBottom",
    cycler: "Vision",
    kind: Kind::Perception,
    on_failure: OnFailure::Restart,
    deadline: Some(Duration::from_millis(40)),
    pending_timeout: Duration::from_millis(500),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: Some(Duration::from_millis(20)),
    scheduling: Scheduling {
        policy: None,
        priority: None,
        cores: &[1],
    },
    record: Record::On,
};

/// One instance: its nodes, and its ends of all buffers.
pub struct Vision<Hardware> {
    pub nodes: Nodes,
    pub additional_outputs: AdditionalOutputs,
    pub capture_time: Option<Timestamp>,
    pub cycler_state: CyclerState,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub subscribed: Subscribed,
    pub subscriptions: Subscriptions,
    pub vision_top: Reader<SharedOutputs>,
    pub vision_bottom: Reader<SharedOutputs>,
    pub control: Reader<control::SharedOutputs>,
    pub select: fn(&Parameters) -> &VisionInstance,
    pub select_exposure: fn(&Parameters) -> &f32,
}

impl<Hardware> Vision<Hardware> {
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
            injections: self.injections.view().value().get(),
            instance_exposure: (self.select_exposure)(parameters),
            instance_parameters: (self.select)(parameters),
            latest: Latest {
                vision_top: self.vision_top.view(),
                vision_bottom: self.vision_bottom.view(),
                control: self.control.view(),
            },
            own,
            parameters,
            previous: Previous {
                own: previous_own,
                shared: slots.previous,
            },
            shared: slots.current,
            subscribed: self.subscribed,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: EyeInterface + Send + Sync> Body for Vision<Hardware> {
    type Shared = SharedOutputs;

    fn create(&mut self) -> Result<()> {
        self.parameters.take();
        self.cycler_state = CyclerState::default();
        let parameters = self.parameters.view().value();
        let mut creation = Creation {
            cycler_state: &mut self.cycler_state,
            instance_parameters: (self.select)(parameters),
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
        self.vision_top.take();
        self.vision_bottom.take();
        self.control.take();
        if self.subscriptions.changed() {
            let mut wanted = self.subscriptions.wanted();
            self.subscribed = Subscribed {
                candidates: wanted.next_one(),
                cycler_instance_width: wanted.next_one(),
            };
        }
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
        self.vision_top.references("VisionTop", visit);
        self.vision_bottom.references("VisionBottom", visit);
        self.control.references("Control", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &["image", "exposure", "best", "spots", "horizon", "agreement", "cycles"]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "image" => Some(&self.own.previous().image),
            "exposure" => Some(&self.own.previous().exposure),
            "best" => Some(&shared.best),
            "spots" => Some(&shared.spots),
            "horizon" => Some(&self.own.previous().horizon),
            "agreement" => Some(&self.own.previous().agreement),
            "cycles" => Some(&self.own.previous().cycles),
            _ => None,
        }
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "candidates" => Some(self.additional_outputs.candidates.get(cycle)?),
            "vision_top.width" | "vision_bottom.width" => {
                Some(self.additional_outputs.cycler_instance.width.get(cycle)?)
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
        visitor.output(Some(&self.own.previous().image));
        visitor.output(Some(&self.own.previous().exposure));
        visitor.output(Some(&shared.best));
        visitor.output(Some(&shared.spots));
        visitor.output(Some(&self.own.previous().horizon));
        visitor.output(Some(&self.own.previous().agreement));
        visitor.output(Some(&self.own.previous().cycles));
        visitor.output(self.additional_outputs.candidates.get(cycle));
        visitor.output(self.additional_outputs.cycler_instance.width.get(cycle));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.eye.report());
        visit(self.nodes.exposure.report());
        visit(self.nodes.spot_finder.report());
        visit(self.nodes.horizon_finder.report());
        visit(self.nodes.other_eye.report());
        visit(self.nodes.counter.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("zoo_nodes::vision::eye", &mut self.nodes.eye);
        visit("zoo_nodes::vision::exposure", &mut self.nodes.exposure);
        visit("zoo_nodes::vision::spot_finder", &mut self.nodes.spot_finder);
        visit("zoo_nodes::vision::horizon_finder", &mut self.nodes.horizon_finder);
        visit("zoo_nodes::vision::other_eye", &mut self.nodes.other_eye);
        visit("zoo_nodes::shared::counter", &mut self.nodes.counter);
        visit("cycler_state", &mut self.cycler_state);
    }
}
