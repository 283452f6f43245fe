//! Cycler `Lidar` in a recording: what its cycles take, saved and given back.
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

use crate::cyclers::lidar::Nodes;
use crate::databases::lidar::Injections;
use crate::databases::lidar::SharedOutputs;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::lidar::LIDAR;
use crate::runtime::lidar::Lidar;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
}

impl<Hardware: rover_nodes::interfaces::Lidar + Send + Sync> Recorded
for Lidar<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("rover_nodes::lidar::freeway_detection", "freeways"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
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
        self.nodes.scan_receiver.record(out);
        self.nodes.freeway_detection.record(out);
        self.injections.save_injected(out);
        out.output(&self.own.current().scan);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types
            .node("rover_nodes::lidar::scan_receiver", |body| &body.nodes.scan_receiver);
        types
            .node(
                "rover_nodes::lidar::freeway_detection",
                |body| &body.nodes.freeway_detection,
            );
        types.injections(|body| &body.injections);
        types.output("scan", |body| &body.own.current().scan);
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
        self.own.both_to_load().0.scan = from.take()?;
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&shared.freeways);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        scan_receiver: Guarded::recorded(
            "rover_nodes::lidar::scan_receiver",
            OnFailure::Restart,
            from,
        )?,
        freeway_detection: Guarded::recorded(
            "rover_nodes::lidar::freeway_detection",
            OnFailure::Restart,
            from,
        )?,
    })
}

/// `Lidar` alone, with the nodes of the frame that is loaded first.
pub fn replay_lidar(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_lidar], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [lidar_injected], []) = buffer([]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        LIDAR,
        Lidar {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: lidar_injected,
            own: Swap::default(),
            parameters: parameters_for_lidar,
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
