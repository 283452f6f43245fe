//! Cycler `Control` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Body;
use framework::Clock;
use framework::Consumer;
use framework::Cycler;
use framework::Guarded;
use framework::History;
use framework::Horizon;
use framework::Injected;
use framework::Interleaving;
use framework::OnFailure;
use framework::Result;
use framework::Slots;
use framework::Subscriptions;
use framework::Swap;
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
use framework::buffer_of;
use framework::procedure;
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
use zoo_nodes::interfaces::BodyInterface;
use zoo_nodes::interfaces::LegInterface;

use crate::cyclers::control::Nodes;
use crate::databases::control::AdditionalOutputs;
use crate::databases::control::CyclerState;
use crate::databases::control::Historic;
use crate::databases::control::Injections;
use crate::databases::control::Perception;
use crate::databases::control::Procedures;
use crate::databases::control::SharedOutputs;
use crate::databases::control::Subscribed;
use crate::databases::hearing;
use crate::databases::vision;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::control::ADDITIONAL_OUTPUTS;
use crate::runtime::control::CONTROL;
use crate::runtime::control::Control;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub vision_top: Writer<vision::SharedOutputs>,
    pub vision_bottom: Writer<vision::SharedOutputs>,
    pub hearing: Writer<hearing::SharedOutputs>,
}

impl<Hardware: BodyInterface + LegInterface + Send + Sync> Recorded
for Control<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("zoo_nodes::control::pose_filter", "pose"),
        ("zoo_nodes::control::spot_filter", "report"),
        ("zoo_nodes::control::spot_filter", "target"),
        ("zoo_nodes::control::watcher", "seen"),
        ("zoo_nodes::control::gait", "plan"),
        ("zoo_nodes::control::gait", "speed"),
        ("zoo_nodes::shared::counter", "cycles"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("VisionTop", &self.perception.vision_top)?;
        values.of("VisionBottom", &self.perception.vision_bottom)?;
        values.of("Hearing", &self.perception.hearing)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        slots: Slots<'_, SharedOutputs>,
        since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.body.record(out);
        self.nodes.watcher.record(out);
        self.nodes.pose_filter.record(out);
        self.nodes.spot_filter.record(out);
        self.nodes.gait.record(out);
        self.nodes.legs.record(out);
        self.nodes.counter.record(out);
        out.put(&self.cycler_state);
        self.historic.pose.save(since, out);
        self.injections.save_injected(out);
        out.output(&self.own.current().joints);
        Foreign::save(&self.perception.vision_top, out);
        Foreign::save(&self.perception.vision_bottom, out);
        Foreign::save(&self.perception.hearing, out);
        out.output(&self.own.previous().plan);
        out.output(&self.own.previous().report);
        out.output(&self.own.previous().speed);
        out.output(&slots.previous.target);
        self.procedures.stop.save(out);
        self.procedures.walk.save(out);
        out.put(&self.subscribed);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("zoo_nodes::control::body", |body| &body.nodes.body);
        types.node("zoo_nodes::control::watcher", |body| &body.nodes.watcher);
        types.node("zoo_nodes::control::pose_filter", |body| &body.nodes.pose_filter);
        types.node("zoo_nodes::control::spot_filter", |body| &body.nodes.spot_filter);
        types.node("zoo_nodes::control::gait", |body| &body.nodes.gait);
        types.node("zoo_nodes::control::legs", |body| &body.nodes.legs);
        types.node("zoo_nodes::shared::counter", |body| &body.nodes.counter);
        types.state(|body| &body.cycler_state);
        types.history("pose", |body| &body.historic.pose);
        types.injections(|body| &body.injections);
        types.output("joints", |body| &body.own.current().joints);
        types.foreign("VisionTop", |body| &body.perception.vision_top);
        types.foreign("VisionBottom", |body| &body.perception.vision_bottom);
        types.foreign("Hearing", |body| &body.perception.hearing);
        types.previous("plan", |body| &body.own.previous().plan);
        types.previous("report", |body| &body.own.previous().report);
        types.previous("speed", |body| &body.own.previous().speed);
        types.shared_previous("target", |outputs| &outputs.target);
        types.procedure("stop", |body| &body.procedures.stop);
        types.procedure("walk", |body| &body.procedures.walk);
        types.subscribed(|body| &body.subscribed);
    }

    fn load(
        &mut self,
        _cycle: u64,
        slots: Loaded<'_, SharedOutputs>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.parameters.load_version(from, &mut outside.parameters, stored)?;
        self.nodes = load_nodes(from)?;
        let mut again = *from;
        self.cycler_state = from.take()?;
        self.historic.pose.load(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        self.own.both_to_load().0.joints = from.take()?;
        Foreign::load(
            &mut self.perception.vision_top,
            from,
            &mut outside.vision_top,
            &mut |cycle| stored.value("VisionTop", cycle),
        )?;
        Foreign::load(
            &mut self.perception.vision_bottom,
            from,
            &mut outside.vision_bottom,
            &mut |cycle| stored.value("VisionBottom", cycle),
        )?;
        Foreign::load(
            &mut self.perception.hearing,
            from,
            &mut outside.hearing,
            &mut |cycle| stored.value("Hearing", cycle),
        )?;
        self.perception
            .vision
            .merge([&self.perception.vision_top, &self.perception.vision_bottom]);
        self.own.both_to_load().1.plan = from.take()?;
        self.own.both_to_load().1.report = from.take()?;
        self.own.both_to_load().1.speed = from.take()?;
        slots.previous.target = from.take()?;
        self.procedures.stop.load(from)?;
        self.procedures.walk.load(from)?;
        let recorded: Subscribed = from.take()?;
        let mut wanted = self.subscriptions.wanted();
        self.subscribed = Subscribed {
            debug_certainty: wanted.next_one() || recorded.debug_certainty,
            debug_watcher_seen: wanted.next_one() || recorded.debug_watcher_seen,
        };
        Body::restore(self)?;
        self.cycler_state = again.take()?;
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&shared.pose);
        digests.add(&self.own.previous().report);
        digests.add(&shared.target);
        digests.add(&self.own.previous().seen);
        digests.add(&self.own.previous().plan);
        digests.add(&self.own.previous().speed);
        digests.add(&self.own.previous().cycles);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        body: Guarded::recorded("zoo_nodes::control::body", OnFailure::Stop, from)?,
        watcher: Guarded::recorded(
            "zoo_nodes::control::watcher",
            OnFailure::Stop,
            from,
        )?,
        pose_filter: Guarded::recorded(
            "zoo_nodes::control::pose_filter",
            OnFailure::Stop,
            from,
        )?,
        spot_filter: Guarded::recorded(
            "zoo_nodes::control::spot_filter",
            OnFailure::Hold,
            from,
        )?,
        gait: Guarded::recorded("zoo_nodes::control::gait", OnFailure::Hold, from)?,
        legs: Guarded::recorded("zoo_nodes::control::legs", OnFailure::Skip, from)?,
        counter: Guarded::recorded("zoo_nodes::shared::counter", OnFailure::Stop, from)?,
    })
}

/// `Control` alone, with the nodes of the frame that is loaded first.
pub fn replay_control(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_control], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [control_injected], []) = buffer([]);
    let (vision_top_writer, [], [vision_top_queue_for_control]) = buffer([8]);
    let (vision_bottom_writer, [], [vision_bottom_queue_for_control]) = buffer([8]);
    let (hearing_writer, [], [hearing_queue_for_control]) = buffer([32]);
    let control_subscriptions = Subscriptions::new(ADDITIONAL_OUTPUTS);
    let (_, control_stop_answerer) = procedure();
    let (_, control_walk_answerer) = procedure();
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        CONTROL,
        Control {
            nodes: load_nodes(from)?,
            additional_outputs: AdditionalOutputs::default(),
            capture_time: None,
            cycler_state: CyclerState::default(),
            hardware_interface: hardware.clone(),
            historic: Historic {
                pose: History::new(Duration::from_secs(2)),
            },
            injections: control_injected,
            own: Swap::default(),
            parameters: parameters_for_control,
            perception: Perception {
                horizon: Horizon::new(),
                vision: Interleaving::new(),
                vision_top: Consumer::new(
                    vision_top_queue_for_control,
                    Duration::from_millis(500),
                ),
                vision_bottom: Consumer::new(
                    vision_bottom_queue_for_control,
                    Duration::from_millis(500),
                ),
                hearing: Consumer::new(hearing_queue_for_control, Duration::from_secs(1)),
            },
            procedures: Procedures {
                stop: control_stop_answerer,
                walk: control_walk_answerer,
            },
            subscribed: Subscribed::default(),
            subscriptions: control_subscriptions.clone(),
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
                    hearing: hearing_writer,
                },
                control_subscriptions,
            ),
        ),
    )
}
