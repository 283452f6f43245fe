//! Cycler `Drive` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Clock;
use framework::Consumer;
use framework::Cycler;
use framework::Guarded;
use framework::History;
use framework::Horizon;
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
use rover_nodes::interfaces::Encoders;
use rover_nodes::interfaces::Motors;

use crate::cyclers::drive::Nodes;
use crate::databases::drive::Historic;
use crate::databases::drive::Injections;
use crate::databases::drive::Perception;
use crate::databases::lidar;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::drive::DRIVE;
use crate::runtime::drive::Drive;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub lidar: Writer<lidar::SharedOutputs>,
}

impl<Hardware: Encoders + Motors + Send + Sync> Recorded for Drive<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("rover_nodes::drive::odometry", "pose"),
        ("rover_nodes::drive::steering", "speeds"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("Lidar", &self.perception.lidar)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, ()>,
        since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.parameters.save_version(out);
        self.nodes.wheel_receiver.record(out);
        self.nodes.odometry.record(out);
        self.nodes.steering.record(out);
        self.nodes.motor_sender.record(out);
        self.historic.pose.save(since, out);
        self.injections.save_injected(out);
        out.output(&self.own.current().rolled);
        Foreign::save(&self.perception.lidar, out);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types
            .node(
                "rover_nodes::drive::wheel_receiver",
                |body| &body.nodes.wheel_receiver,
            );
        types.node("rover_nodes::drive::odometry", |body| &body.nodes.odometry);
        types.node("rover_nodes::drive::steering", |body| &body.nodes.steering);
        types.node("rover_nodes::drive::motor_sender", |body| &body.nodes.motor_sender);
        types.history("pose", |body| &body.historic.pose);
        types.injections(|body| &body.injections);
        types.output("rolled", |body| &body.own.current().rolled);
        types.foreign("Lidar", |body| &body.perception.lidar);
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
        self.historic.pose.load(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        self.own.both_to_load().0.rolled = from.take()?;
        Foreign::load(
            &mut self.perception.lidar,
            from,
            &mut outside.lidar,
            &mut |cycle| stored.value("Lidar", cycle),
        )?;
        Ok(())
    }

    fn digests(&self, _shared: &(), digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().pose);
        digests.add(&self.own.previous().speeds);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        wheel_receiver: Guarded::recorded(
            "rover_nodes::drive::wheel_receiver",
            OnFailure::Stop,
            from,
        )?,
        odometry: Guarded::recorded(
            "rover_nodes::drive::odometry",
            OnFailure::Stop,
            from,
        )?,
        steering: Guarded::recorded(
            "rover_nodes::drive::steering",
            OnFailure::Stop,
            from,
        )?,
        motor_sender: Guarded::recorded(
            "rover_nodes::drive::motor_sender",
            OnFailure::Stop,
            from,
        )?,
    })
}

/// `Drive` alone, with the nodes of the frame that is loaded first.
pub fn replay_drive(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_drive], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [drive_injected], []) = buffer([]);
    let (lidar_writer, [], [lidar_queue_for_drive]) = buffer([32]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        DRIVE,
        Drive {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            historic: Historic {
                pose: History::new(Duration::from_secs(1)),
            },
            injections: drive_injected,
            own: Swap::default(),
            parameters: parameters_for_drive,
            perception: Perception {
                horizon: Horizon::new(),
                lidar: Consumer::new(lidar_queue_for_drive, Duration::from_secs(1)),
            },
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
                    lidar: lidar_writer,
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
