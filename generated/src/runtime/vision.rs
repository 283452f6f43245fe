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
use hardware::CameraInterface;

use crate::cyclers::vision::Nodes;
use crate::databases::control;
use crate::databases::vision::AdditionalOutputs;
use crate::databases::vision::Frame;
use crate::databases::vision::Injections;
use crate::databases::vision::Latest;
use crate::databases::vision::OwnOutputs;
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
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// What the manifest says about `VisionBottom`.
pub const VISION_BOTTOM: InstanceDescription = InstanceDescription {
    name: "VisionBottom",
    cycler: "Vision",
    kind: Kind::Perception,
    on_failure: OnFailure::Restart,
    deadline: Some(Duration::from_millis(33)),
    pending_timeout: Duration::from_secs(1),
    watchdog: Duration::from_millis(300),
    history: Duration::from_secs(1),
    lockstep_duration: None,
    scheduling: Scheduling::BY_THE_SYSTEM,
    record: Record::On,
};

/// What clients can listen to, in the order of `Subscribed`.
pub const ADDITIONAL_OUTPUTS: &[&str] = &[
    "ball_candidates",
    "ball_proposals",
    "field_border_points",
    "image_circle",
    "image_lines",
    "line_points",
    "obstacle_feet",
    "penalty_mark_candidates",
];

/// One instance: its nodes, and its ends of all buffers.
pub struct Vision<Hardware> {
    pub nodes: Nodes,
    pub additional_outputs: AdditionalOutputs,
    pub capture_time: Option<Timestamp>,
    pub hardware_interface: Arc<Hardware>,
    pub injections: Reader<Injected<Injections>>,
    pub own: Swap<OwnOutputs>,
    pub parameters: Reader<Parameters>,
    pub subscribed: Subscribed,
    pub subscriptions: Subscriptions,
    pub control: Reader<control::SharedOutputs>,
    pub select: fn(&Parameters) -> &VisionInstance,
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
        let frame = Frame {
            additional_outputs: &mut self.additional_outputs,
            capture_time: &mut self.capture_time,
            cycle,
            hardware_interface: &self.hardware_interface,
            injections: self.injections.view().value().get(),
            instance_parameters: (self.select)(parameters),
            latest: Latest {
                control: self.control.view(),
            },
            own: self.own.both().0,
            parameters,
            shared: slots.current,
            subscribed: self.subscribed,
        };
        (&mut self.nodes, frame)
    }
}

impl<Hardware: CameraInterface + Send + Sync> Body for Vision<Hardware> {
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
        self.control.take();
        if self.subscriptions.changed() {
            let mut wanted = self.subscriptions.wanted();
            self.subscribed = Subscribed {
                ball_candidates: wanted.next_one(),
                ball_proposals: wanted.next_one(),
                field_border_points: wanted.next_one(),
                image_circle: wanted.next_one(),
                image_lines: wanted.next_one(),
                line_points: wanted.next_one(),
                obstacle_feet: wanted.next_one(),
                penalty_mark_candidates: wanted.next_one(),
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
        self.control.references("Control", visit);
        self.parameters.references("parameters", visit);
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        &[
            "image",
            "camera_matrix",
            "limb_mask",
            "field_color",
            "image_segments",
            "field_border",
            "lines",
            "center_circle",
            "corners",
            "penalty_mark",
            "ball_view",
            "balls",
            "obstacles",
        ]
    }

    fn main_output<'a>(
        &'a self,
        shared: &'a SharedOutputs,
        name: &str,
    ) -> Option<&'a dyn Reflect> {
        match name {
            "image" => Some(&self.own.previous().image),
            "camera_matrix" => Some(&self.own.previous().camera_matrix),
            "limb_mask" => Some(&shared.limb_mask),
            "field_color" => Some(&self.own.previous().field_color),
            "image_segments" => Some(&self.own.previous().image_segments),
            "field_border" => Some(&shared.field_border),
            "lines" => Some(&shared.lines),
            "center_circle" => Some(&shared.center_circle),
            "corners" => Some(&shared.corners),
            "penalty_mark" => Some(&shared.penalty_mark),
            "ball_view" => Some(&shared.ball_view),
            "balls" => Some(&shared.balls),
            "obstacles" => Some(&shared.obstacles),
            _ => None,
        }
    }

    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect> {
        match name {
            "ball_candidates" => {
                Some(self.additional_outputs.ball_candidates.get(cycle)?)
            }
            "ball_proposals" => Some(self.additional_outputs.ball_proposals.get(cycle)?),
            "field_border_points" => {
                Some(self.additional_outputs.field_border_points.get(cycle)?)
            }
            "image_circle" => Some(self.additional_outputs.image_circle.get(cycle)?),
            "image_lines" => Some(self.additional_outputs.image_lines.get(cycle)?),
            "line_points" => Some(self.additional_outputs.line_points.get(cycle)?),
            "obstacle_feet" => Some(self.additional_outputs.obstacle_feet.get(cycle)?),
            "penalty_mark_candidates" => {
                Some(self.additional_outputs.penalty_mark_candidates.get(cycle)?)
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
        visitor.output(Some(&self.own.previous().camera_matrix));
        visitor.output(Some(&shared.limb_mask));
        visitor.output(Some(&self.own.previous().field_color));
        visitor.output(Some(&self.own.previous().image_segments));
        visitor.output(Some(&shared.field_border));
        visitor.output(Some(&shared.lines));
        visitor.output(Some(&shared.center_circle));
        visitor.output(Some(&shared.corners));
        visitor.output(Some(&shared.penalty_mark));
        visitor.output(Some(&shared.ball_view));
        visitor.output(Some(&shared.balls));
        visitor.output(Some(&shared.obstacles));
        visitor.output(self.additional_outputs.ball_candidates.get(cycle));
        visitor.output(self.additional_outputs.ball_proposals.get(cycle));
        visitor.output(self.additional_outputs.field_border_points.get(cycle));
        visitor.output(self.additional_outputs.image_circle.get(cycle));
        visitor.output(self.additional_outputs.image_lines.get(cycle));
        visitor.output(self.additional_outputs.line_points.get(cycle));
        visitor.output(self.additional_outputs.obstacle_feet.get(cycle));
        visitor.output(self.additional_outputs.penalty_mark_candidates.get(cycle));
    }

    fn nodes(&self, visit: &mut dyn FnMut(NodeReport)) {
        visit(self.nodes.image_receiver.report());
        visit(self.nodes.camera_matrix_extractor.report());
        visit(self.nodes.limb_projector.report());
        visit(self.nodes.field_color_detection.report());
        visit(self.nodes.image_segmenter.report());
        visit(self.nodes.field_border.report());
        visit(self.nodes.line_detection.report());
        visit(self.nodes.center_circle_detection.report());
        visit(self.nodes.corner_detection.report());
        visit(self.nodes.penalty_mark_detection.report());
        visit(self.nodes.ball_detection.report());
        visit(self.nodes.obstacle_detection.report());
    }

    fn queues(&self, _visit: &mut dyn FnMut(QueueReport)) {}

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        visit("vision::image_receiver", &mut self.nodes.image_receiver);
        visit(
            "vision::camera_matrix_extractor",
            &mut self.nodes.camera_matrix_extractor,
        );
        visit("vision::limb_projector", &mut self.nodes.limb_projector);
        visit("vision::field_color_detection", &mut self.nodes.field_color_detection);
        visit("vision::image_segmenter", &mut self.nodes.image_segmenter);
        visit("vision::field_border", &mut self.nodes.field_border);
        visit("vision::line_detection", &mut self.nodes.line_detection);
        visit(
            "vision::center_circle_detection",
            &mut self.nodes.center_circle_detection,
        );
        visit("vision::corner_detection", &mut self.nodes.corner_detection);
        visit("vision::penalty_mark_detection", &mut self.nodes.penalty_mark_detection);
        visit("vision::ball_detection", &mut self.nodes.ball_detection);
        visit("vision::obstacle_detection", &mut self.nodes.obstacle_detection);
    }
}
