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
use zoo_nodes::interfaces::EyeInterface;

use crate::cyclers::vision::Nodes;
use crate::databases::control;
use crate::databases::vision::AdditionalOutputs;
use crate::databases::vision::CyclerState;
use crate::databases::vision::Injections;
use crate::databases::vision::SharedOutputs;
use crate::databases::vision::Subscribed;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::vision::VISION_BOTTOM;
use crate::runtime::vision::VISION_TOP;
use crate::runtime::vision::Vision;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub vision_top: Writer<SharedOutputs>,
    pub vision_bottom: Writer<SharedOutputs>,
    pub control: Writer<control::SharedOutputs>,
}

impl<Hardware: EyeInterface + Send + Sync> Recorded for Vision<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("zoo_nodes::vision::horizon_finder", "horizon"),
        ("zoo_nodes::vision::spot_finder", "best"),
        ("zoo_nodes::vision::spot_finder", "spots"),
        ("zoo_nodes::vision::other_eye", "agreement"),
        ("zoo_nodes::shared::counter", "cycles"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("VisionTop", &self.vision_top)?;
        values.of("VisionBottom", &self.vision_bottom)?;
        values.of("Control", &self.control)?;
        Ok(())
    }

    fn save(
        &self,
        cycle: u64,
        slots: Slots<'_, SharedOutputs>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.eye.record(out);
        self.nodes.exposure.record(out);
        self.nodes.spot_finder.record(out);
        self.nodes.horizon_finder.record(out);
        self.nodes.other_eye.record(out);
        self.nodes.counter.record(out);
        out.put(&self.cycler_state);
        self.additional_outputs.cycler_instance.width.save(cycle, out);
        self.injections.save_injected(out);
        Foreign::save(&self.vision_top, out);
        Foreign::save(&self.vision_bottom, out);
        Foreign::save(&self.control, out);
        out.output(&self.own.current().exposure);
        out.output(&self.own.current().image);
        out.output(&self.own.previous().agreement);
        out.output(&slots.previous.spots);
        out.put(&self.subscribed);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("zoo_nodes::vision::eye", |body| &body.nodes.eye);
        types.node("zoo_nodes::vision::exposure", |body| &body.nodes.exposure);
        types.node("zoo_nodes::vision::spot_finder", |body| &body.nodes.spot_finder);
        types
            .node(
                "zoo_nodes::vision::horizon_finder",
                |body| &body.nodes.horizon_finder,
            );
        types.node("zoo_nodes::vision::other_eye", |body| &body.nodes.other_eye);
        types.node("zoo_nodes::shared::counter", |body| &body.nodes.counter);
        types.state(|body| &body.cycler_state);
        types
            .additional_output(
                "cycler_instance.width",
                |body| &body.additional_outputs.cycler_instance.width,
            );
        types.injections(|body| &body.injections);
        types.foreign("VisionTop", |body| &body.vision_top);
        types.foreign("VisionBottom", |body| &body.vision_bottom);
        types.foreign("Control", |body| &body.control);
        types.output("exposure", |body| &body.own.current().exposure);
        types.output("image", |body| &body.own.current().image);
        types.previous("agreement", |body| &body.own.previous().agreement);
        types.shared_previous("spots", |outputs| &outputs.spots);
        types.subscribed(|body| &body.subscribed);
    }

    fn load(
        &mut self,
        cycle: u64,
        slots: Loaded<'_, SharedOutputs>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.parameters.load_version(from, &mut outside.parameters, stored)?;
        self.nodes = load_nodes(from)?;
        self.cycler_state = from.take()?;
        self.additional_outputs.cycler_instance.width.load(cycle, from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        Foreign::load(
            &mut self.vision_top,
            from,
            &mut outside.vision_top,
            &mut |cycle| stored.value("VisionTop", cycle),
        )?;
        Foreign::load(
            &mut self.vision_bottom,
            from,
            &mut outside.vision_bottom,
            &mut |cycle| stored.value("VisionBottom", cycle),
        )?;
        Foreign::load(
            &mut self.control,
            from,
            &mut outside.control,
            &mut |cycle| stored.value("Control", cycle),
        )?;
        self.own.both_to_load().0.exposure = from.take()?;
        self.own.both_to_load().0.image = from.take()?;
        self.own.both_to_load().1.agreement = from.take()?;
        slots.previous.spots = from.take()?;
        let recorded: Subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = Subscribed {
            candidates: wanted.next_one() || recorded.candidates,
            cycler_instance_width: wanted.next_one() || recorded.cycler_instance_width,
        };
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().horizon);
        digests.add(&shared.best);
        digests.add(&shared.spots);
        digests.add(&self.own.previous().agreement);
        digests.add(&self.own.previous().cycles);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        eye: Guarded::recorded("zoo_nodes::vision::eye", OnFailure::Restart, from)?,
        exposure: Guarded::recorded(
            "zoo_nodes::vision::exposure",
            OnFailure::Restart,
            from,
        )?,
        spot_finder: Guarded::recorded(
            "zoo_nodes::vision::spot_finder",
            OnFailure::Skip,
            from,
        )?,
        horizon_finder: Guarded::recorded(
            "zoo_nodes::vision::horizon_finder",
            OnFailure::Restart,
            from,
        )?,
        other_eye: Guarded::recorded(
            "zoo_nodes::vision::other_eye",
            OnFailure::Restart,
            from,
        )?,
        counter: Guarded::recorded(
            "zoo_nodes::shared::counter",
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
    let (vision_top_writer, [vision_top_for_vision_top], []) = buffer([]);
    let (vision_bottom_writer, [vision_bottom_for_vision_top], []) = buffer([]);
    let (control_writer, [control_for_vision_top], []) = buffer([]);
    let vision_top_subscriptions = Subscriptions::new(
        &["candidates", "vision_top.width"],
    );
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        VISION_TOP,
        Vision {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            cycler_state: CyclerState::default(),
            hardware_interface: hardware.clone(),
            injections: vision_top_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_top,
            subscribed: Subscribed::default(),
            subscriptions: vision_top_subscriptions.clone(),
            vision_top: vision_top_for_vision_top,
            vision_bottom: vision_bottom_for_vision_top,
            control: control_for_vision_top,
            select: |parameters| &parameters.vision_top,
            select_exposure: |parameters| &parameters.exposure.vision_top,
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
                    vision_top: vision_top_writer,
                    vision_bottom: vision_bottom_writer,
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
    let (vision_top_writer, [vision_top_for_vision_bottom], []) = buffer([]);
    let (vision_bottom_writer, [vision_bottom_for_vision_bottom], []) = buffer([]);
    let (control_writer, [control_for_vision_bottom], []) = buffer([]);
    let vision_bottom_subscriptions = Subscriptions::new(
        &["candidates", "vision_bottom.width"],
    );
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        VISION_BOTTOM,
        Vision {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            cycler_state: CyclerState::default(),
            hardware_interface: hardware.clone(),
            injections: vision_bottom_injected,
            own: Swap::default(),
            parameters: parameters_for_vision_bottom,
            subscribed: Subscribed::default(),
            subscriptions: vision_bottom_subscriptions.clone(),
            vision_top: vision_top_for_vision_bottom,
            vision_bottom: vision_bottom_for_vision_bottom,
            control: control_for_vision_bottom,
            select: |parameters| &parameters.vision_bottom,
            select_exposure: |parameters| &parameters.exposure.vision_bottom,
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
                    vision_top: vision_top_writer,
                    vision_bottom: vision_bottom_writer,
                    control: control_writer,
                },
                vision_bottom_subscriptions,
            ),
        ),
    )
}
