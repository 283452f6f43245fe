//! Cycler `Hearing` in a recording: what its cycles take, saved and given back.
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
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
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
use zoo_nodes::interfaces::EarInterface;

use crate::cyclers::hearing::Nodes;
use crate::databases::hearing::Injections;
use crate::databases::hearing::SharedOutputs;
use crate::recording::Sink;
use crate::runtime::hearing::HEARING;
use crate::runtime::hearing::Hearing;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
}

impl<Hardware: EarInterface + Send + Sync> Recorded for Hearing<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("zoo_nodes::hearing::whistle", "whistle"),
    ];

    fn values(&self, _values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        slots: Slots<'_, SharedOutputs>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.nodes.ear.record(out);
        self.nodes.whistle.record(out);
        self.injections.save_injected(out);
        out.output(&slots.previous.loudness);
        out.output(&slots.previous.whistle);
        out.output(&slots.current.loudness);
    }

    fn describe(types: &mut Describing<Self>) {
        types.node("zoo_nodes::hearing::ear", |body| &body.nodes.ear);
        types.node("zoo_nodes::hearing::whistle", |body| &body.nodes.whistle);
        types.injections(|body| &body.injections);
        types.shared_previous("loudness", |outputs| &outputs.loudness);
        types.shared_previous("whistle", |outputs| &outputs.whistle);
        types.shared_output("loudness", |outputs| &outputs.loudness);
    }

    fn load(
        &mut self,
        _cycle: u64,
        slots: Loaded<'_, SharedOutputs>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        _stored: &Stored<'_>,
    ) -> Result<()> {
        self.nodes = load_nodes(from)?;
        self.injections.load_injected(from, &mut outside.injections)?;
        slots.previous.loudness = from.take()?;
        slots.previous.whistle = from.take()?;
        slots.current.loudness = from.take()?;
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&shared.whistle);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        ear: Guarded::recorded("zoo_nodes::hearing::ear", OnFailure::Hold, from)?,
        whistle: Guarded::recorded("zoo_nodes::hearing::whistle", OnFailure::Hold, from)?,
    })
}

/// `Hearing` alone, with the nodes of the frame that is loaded first.
pub fn replay_hearing(
    from: &mut Loading<'_>,
    _stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let hardware = Arc::new(Sink);
    let (injections_writer, [hearing_injected], []) = buffer([]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        HEARING,
        Hearing {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: hearing_injected,
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
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
