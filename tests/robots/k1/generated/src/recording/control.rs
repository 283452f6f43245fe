//! Cycler `Control` in a recording: what its cycles take, saved and given back.
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
use framework::recorded::Loaded;
use framework::recorded::Loading;
use framework::recorded::Recorded;
use framework::recorded::SaveError;
use framework::recorded::Saving;
use framework::recorded::Stored;
use framework::recorded::Values;
use framework::replay::Alone;
use framework::replay::Replay;
use k1_nodes::interfaces::BodyInterface;
use k1_nodes::interfaces::MotorInterface;

use crate::cyclers::control::Nodes;
use crate::databases::control::Injections;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::control::CONTROL;
use crate::runtime::control::Control;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
}

impl<Hardware: BodyInterface + MotorInterface + Send + Sync> Recorded
for Control<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("k1_nodes::prepare", "standing"),
        ("k1_nodes::look_around", "head_yaw"),
        ("k1_nodes::wave", "arm_pitch"),
        ("k1_nodes::motor_sender", "motor_commands"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, ()>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.body_receiver.record(out);
        self.nodes.prepare.record(out);
        self.nodes.look_around.record(out);
        self.nodes.wave.record(out);
        self.nodes.motor_sender.record(out);
        self.injections.save_injected(out);
        out.output(&self.own.current().body);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("k1_nodes::body_receiver", |body| &body.nodes.body_receiver);
        types.node("k1_nodes::prepare", |body| &body.nodes.prepare);
        types.node("k1_nodes::look_around", |body| &body.nodes.look_around);
        types.node("k1_nodes::wave", |body| &body.nodes.wave);
        types.node("k1_nodes::motor_sender", |body| &body.nodes.motor_sender);
        types.injections(|body| &body.injections);
        types.output("body", |body| &body.own.current().body);
    }

    fn load(
        &mut self,
        _cycle: u64,
        _slots: Loaded<'_, ()>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.parameters.load_version(from, &mut outside.parameters, stored)?;
        self.nodes = load_nodes(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        self.own.both_to_load().0.body = from.take()?;
        Ok(())
    }

    fn digests(&self, _shared: &(), digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().standing);
        digests.add(&self.own.previous().head_yaw);
        digests.add(&self.own.previous().arm_pitch);
        digests.add(&self.own.previous().motor_commands);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        body_receiver: Guarded::recorded(
            "k1_nodes::body_receiver",
            OnFailure::Stop,
            from,
        )?,
        prepare: Guarded::recorded("k1_nodes::prepare", OnFailure::Stop, from)?,
        look_around: Guarded::recorded("k1_nodes::look_around", OnFailure::Stop, from)?,
        wave: Guarded::recorded("k1_nodes::wave", OnFailure::Stop, from)?,
        motor_sender: Guarded::recorded("k1_nodes::motor_sender", OnFailure::Stop, from)?,
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
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        CONTROL,
        Control {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: control_injected,
            own: Swap::default(),
            parameters: parameters_for_control,
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
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
