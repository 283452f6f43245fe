//! Cycler `Radio` in a recording: what its cycles take, saved and given back.
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

use crate::cyclers::radio::Nodes;
use crate::databases::radio::Injections;
use crate::databases::radio::SharedOutputs;
use crate::recording::Sink;
use crate::runtime::radio::RADIO;
use crate::runtime::radio::Radio;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
}

impl<Hardware: timing_nodes::interfaces::Radio + Send + Sync> Recorded
for Radio<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[];

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
        self.nodes.message_receiver.record(out);
        self.injections.save_injected(out);
        out.output(&slots.current.measurement);
    }

    fn describe(types: &mut Describing<Self>) {
        types
            .node("timing_nodes::message_receiver", |body| &body.nodes.message_receiver);
        types.injections(|body| &body.injections);
        types.shared_output("measurement", |outputs| &outputs.measurement);
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
        slots.current.measurement = from.take()?;
        Ok(())
    }

    fn digests(&self, _shared: &SharedOutputs, _digests: &mut Digests<'_, '_>) {}
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        message_receiver: Guarded::recorded(
            "timing_nodes::message_receiver",
            OnFailure::Stop,
            from,
        )?,
    })
}

/// `Radio` alone, with the nodes of the frame that is loaded first.
pub fn replay_radio(
    from: &mut Loading<'_>,
    _stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let hardware = Arc::new(Sink);
    let (injections_writer, [radio_injected], []) = buffer([]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        RADIO,
        Radio {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: radio_injected,
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
