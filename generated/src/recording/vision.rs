//! Cycler `Vision` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Clock;
use framework::Cycler;
use framework::Guarded;
use framework::Injected;
use framework::OnFailure;
use framework::Result;
use framework::Slots;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
use framework::buffer_of;
use framework::recorded::Describing;
use framework::recorded::Digests;
use framework::recorded::Foreign;
use framework::recorded::Loaded;
use framework::recorded::Loading;
use framework::recorded::Recorded;
use framework::recorded::SaveError;
use framework::recorded::Saving;
use framework::recorded::Stored;
use framework::recorded::Values;
use framework::replay::Alone;
use framework::replay::Replay;
use hardware::CameraInterface;

use crate::cyclers::vision::Nodes;
use crate::databases::control;
use crate::databases::vision::AdditionalOutputs;
use crate::databases::vision::Injections;
use crate::databases::vision::SharedOutputs;
use crate::databases::vision::Subscribed;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::vision::ADDITIONAL_OUTPUTS;
use crate::runtime::vision::VISION_BOTTOM;
use crate::runtime::vision::VISION_TOP;
use crate::runtime::vision::Vision;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub control: Writer<control::SharedOutputs>,
}

impl<Hardware: CameraInterface + Send + Sync> Recorded for Vision<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("vision::camera_matrix_extractor", "camera_matrix"),
        ("vision::limb_projector", "limb_mask"),
        ("vision::field_color_detection", "field_color"),
        ("vision::image_segmenter", "image_segments"),
        ("vision::field_border", "field_border"),
        ("vision::line_detection", "lines"),
        ("vision::center_circle_detection", "center_circle"),
        ("vision::corner_detection", "corners"),
        ("vision::penalty_mark_detection", "penalty_mark"),
        ("vision::ball_detection", "ball_view"),
        ("vision::ball_detection", "balls"),
        ("vision::obstacle_detection", "obstacles"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("Control", &self.control)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, SharedOutputs>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.image_receiver.record(out);
        self.nodes.camera_matrix_extractor.record(out);
        self.nodes.limb_projector.record(out);
        self.nodes.field_color_detection.record(out);
        self.nodes.image_segmenter.record(out);
        self.nodes.field_border.record(out);
        self.nodes.line_detection.record(out);
        self.nodes.center_circle_detection.record(out);
        self.nodes.corner_detection.record(out);
        self.nodes.penalty_mark_detection.record(out);
        self.nodes.ball_detection.record(out);
        self.nodes.obstacle_detection.record(out);
        self.injections.save_injected(out);
        Foreign::save(&self.control, out);
        out.output(&self.own.current().image);
        out.put(&self.subscribed);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("vision::image_receiver", |body| &body.nodes.image_receiver);
        types
            .node(
                "vision::camera_matrix_extractor",
                |body| &body.nodes.camera_matrix_extractor,
            );
        types.node("vision::limb_projector", |body| &body.nodes.limb_projector);
        types
            .node(
                "vision::field_color_detection",
                |body| &body.nodes.field_color_detection,
            );
        types.node("vision::image_segmenter", |body| &body.nodes.image_segmenter);
        types.node("vision::field_border", |body| &body.nodes.field_border);
        types.node("vision::line_detection", |body| &body.nodes.line_detection);
        types
            .node(
                "vision::center_circle_detection",
                |body| &body.nodes.center_circle_detection,
            );
        types.node("vision::corner_detection", |body| &body.nodes.corner_detection);
        types
            .node(
                "vision::penalty_mark_detection",
                |body| &body.nodes.penalty_mark_detection,
            );
        types.node("vision::ball_detection", |body| &body.nodes.ball_detection);
        types.node("vision::obstacle_detection", |body| &body.nodes.obstacle_detection);
        types.injections(|body| &body.injections);
        types.foreign("Control", |body| &body.control);
        types.output("image", |body| &body.own.current().image);
        types.subscribed(|body| &body.subscribed);
    }

    fn load(
        &mut self,
        _cycle: u64,
        _slots: Loaded<'_, SharedOutputs>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.parameters.load_version(from, &mut outside.parameters, stored)?;
        self.nodes = load_nodes(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        Foreign::load(
            &mut self.control,
            from,
            &mut outside.control,
            &mut |cycle| stored.value("Control", cycle),
        )?;
        self.own.both_to_load().0.image = from.take()?;
        let recorded: Subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = Subscribed {
            ball_candidates: wanted.next_one() || recorded.ball_candidates,
            ball_proposals: wanted.next_one() || recorded.ball_proposals,
            field_border_points: wanted.next_one() || recorded.field_border_points,
            image_circle: wanted.next_one() || recorded.image_circle,
            image_lines: wanted.next_one() || recorded.image_lines,
            line_points: wanted.next_one() || recorded.line_points,
            obstacle_feet: wanted.next_one() || recorded.obstacle_feet,
            penalty_mark_candidates: wanted.next_one()
                || recorded.penalty_mark_candidates,
        };
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().camera_matrix);
        digests.add(&shared.limb_mask);
        digests.add(&self.own.previous().field_color);
        digests.add(&self.own.previous().image_segments);
        digests.add(&shared.field_border);
        digests.add(&shared.lines);
        digests.add(&shared.center_circle);
        digests.add(&shared.corners);
        digests.add(&shared.penalty_mark);
        digests.add(&shared.ball_view);
        digests.add(&shared.balls);
        digests.add(&shared.obstacles);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        image_receiver: Guarded::recorded(
            "vision::image_receiver",
            OnFailure::Restart,
            from,
        )?,
        camera_matrix_extractor: Guarded::recorded(
            "vision::camera_matrix_extractor",
            OnFailure::Restart,
            from,
        )?,
        limb_projector: Guarded::recorded(
            "vision::limb_projector",
            OnFailure::Restart,
            from,
        )?,
        field_color_detection: Guarded::recorded(
            "vision::field_color_detection",
            OnFailure::Restart,
            from,
        )?,
        image_segmenter: Guarded::recorded(
            "vision::image_segmenter",
            OnFailure::Restart,
            from,
        )?,
        field_border: Guarded::recorded(
            "vision::field_border",
            OnFailure::Restart,
            from,
        )?,
        line_detection: Guarded::recorded(
            "vision::line_detection",
            OnFailure::Restart,
            from,
        )?,
        center_circle_detection: Guarded::recorded(
            "vision::center_circle_detection",
            OnFailure::Restart,
            from,
        )?,
        corner_detection: Guarded::recorded(
            "vision::corner_detection",
            OnFailure::Restart,
            from,
        )?,
        penalty_mark_detection: Guarded::recorded(
            "vision::penalty_mark_detection",
            OnFailure::Restart,
            from,
        )?,
        ball_detection: Guarded::recorded(
            "vision::ball_detection",
            OnFailure::Restart,
            from,
        )?,
        obstacle_detection: Guarded::recorded(
            "vision::obstacle_detection",
            OnFailure::Restart,
            from,
        )?,
    })
}

/// `VisionTop` alone, with the nodes of the frame that is loaded first.
pub fn replay_vision_top(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_vision_top], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [vision_top_injected], []) = buffer([]);
    let (control_writer, [control_for_vision_top], []) = buffer([]);
    let vision_top_subscriptions = Subscriptions::new(ADDITIONAL_OUTPUTS);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        VISION_TOP,
        Vision {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: vision_top_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_top,
            subscribed: Subscribed::default(),
            subscriptions: vision_top_subscriptions.clone(),
            control: control_for_vision_top,
            select: |parameters| &parameters.vision_top,
        },
        writer,
        Clock::stepped(),
    );
    Ok(
        Box::new(
            Alone::new(
                cycler,
                Outside {
                    injections: injections_writer,
                    parameters: parameters_writer,
                    control: control_writer,
                },
                vision_top_subscriptions,
            ),
        ),
    )
}

/// `VisionBottom` alone, with the nodes of the frame that is loaded first.
pub fn replay_vision_bottom(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_vision_bottom], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [vision_bottom_injected], []) = buffer([]);
    let (control_writer, [control_for_vision_bottom], []) = buffer([]);
    let vision_bottom_subscriptions = Subscriptions::new(ADDITIONAL_OUTPUTS);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        VISION_BOTTOM,
        Vision {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: vision_bottom_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_bottom,
            subscribed: Subscribed::default(),
            subscriptions: vision_bottom_subscriptions.clone(),
            control: control_for_vision_bottom,
            select: |parameters| &parameters.vision_bottom,
        },
        writer,
        Clock::stepped(),
    );
    Ok(
        Box::new(
            Alone::new(
                cycler,
                Outside {
                    injections: injections_writer,
                    parameters: parameters_writer,
                    control: control_writer,
                },
                vision_bottom_subscriptions,
            ),
        ),
    )
}
