//! Cycler `Keeper` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;
use std::time::Duration;

use framework::Clock;
use framework::Consumer;
use framework::Cycler;
use framework::Guarded;
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
use outpost_nodes::interfaces::ClockInterface;

use crate::cyclers::keeper::Nodes;
use crate::databases::keeper::Injections;
use crate::databases::keeper::Perception;
use crate::databases::lookout;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::keeper::KEEPER;
use crate::runtime::keeper::Keeper;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub lookout_north: Writer<lookout::SharedOutputs>,
    pub lookout_north2: Writer<lookout::SharedOutputs>,
    pub lookout_south: Writer<lookout::SharedOutputs>,
}

impl<Hardware: ClockInterface + Send + Sync> Recorded for Keeper<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("outpost_nodes::keeper::book", "entries"),
        ("outpost_nodes::keeper::book", "newest_in_the_north"),
        ("outpost_nodes::keeper::book", "provisional"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("LookoutNorth", &self.lookout_north)?;
        values.of("LookoutNorth", &self.perception.lookout_north)?;
        values.of("LookoutSouth", &self.perception.lookout_south)?;
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
        self.nodes.clock.record(out);
        self.nodes.book.record(out);
        self.injections.save_injected(out);
        Foreign::save(&self.lookout_north, out);
        Foreign::save(&self.perception.lookout_north, out);
        Foreign::save(&self.perception.lookout_south, out);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("outpost_nodes::keeper::clock", |body| &body.nodes.clock);
        types.node("outpost_nodes::keeper::book", |body| &body.nodes.book);
        types.injections(|body| &body.injections);
        types.foreign("LookoutNorth", |body| &body.lookout_north);
        types.foreign("LookoutNorth", |body| &body.perception.lookout_north);
        types.foreign("LookoutSouth", |body| &body.perception.lookout_south);
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
        Foreign::load(
            &mut self.lookout_north,
            from,
            &mut outside.lookout_north,
            &mut |cycle| stored.value("LookoutNorth", cycle),
        )?;
        Foreign::load(
            &mut self.perception.lookout_north,
            from,
            &mut outside.lookout_north2,
            &mut |cycle| stored.value("LookoutNorth", cycle),
        )?;
        Foreign::load(
            &mut self.perception.lookout_south,
            from,
            &mut outside.lookout_south,
            &mut |cycle| stored.value("LookoutSouth", cycle),
        )?;
        self.perception
            .lookout
            .merge([&self.perception.lookout_north, &self.perception.lookout_south]);
        Ok(())
    }

    fn digests(&self, _shared: &(), digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().entries);
        digests.add(&self.own.previous().newest_in_the_north);
        digests.add(&self.own.previous().provisional);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        clock: Guarded::recorded("outpost_nodes::keeper::clock", OnFailure::Stop, from)?,
        book: Guarded::recorded("outpost_nodes::keeper::book", OnFailure::Stop, from)?,
    })
}

/// `Keeper` alone, with the nodes of the frame that is loaded first.
pub fn replay_keeper(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_keeper], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [keeper_injected], []) = buffer([]);
    let (lookout_north_writer, [lookout_north_for_keeper], []) = buffer([]);
    let (lookout_north2_writer, [], [lookout_north_queue_for_keeper]) = buffer([8]);
    let (lookout_south_writer, [], [lookout_south_queue_for_keeper]) = buffer([8]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        KEEPER,
        Keeper {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: keeper_injected,
            own: Swap::default(),
            parameters: parameters_for_keeper,
            perception: Perception {
                horizon: Horizon::new(),
                lookout: Interleaving::new(),
                lookout_north: Consumer::new(
                    lookout_north_queue_for_keeper,
                    Duration::from_secs(5),
                ),
                lookout_south: Consumer::new(
                    lookout_south_queue_for_keeper,
                    Duration::from_secs(5),
                ),
            },
            lookout_north: lookout_north_for_keeper,
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
                    lookout_north: lookout_north_writer,
                    lookout_north2: lookout_north2_writer,
                    lookout_south: lookout_south_writer,
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
