//! Cycler `Garden` in a recording: what its cycles take, saved and given back.
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
use sprinkler_nodes::SoilProbe;
use sprinkler_nodes::Valve;

use crate::cyclers::garden::Nodes;
use crate::databases::garden::Injections;
use crate::databases::weather;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::garden::GARDEN;
use crate::runtime::garden::Garden;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub weather: Writer<weather::SharedOutputs>,
}

impl<Hardware: SoilProbe + Valve + Send + Sync> Recorded for Garden<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("sprinkler_nodes::thirst", "thirst"),
        ("sprinkler_nodes::valve_choice", "valve"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("Weather", &self.weather)?;
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
        self.nodes.soil_receiver.record(out);
        self.nodes.thirst.record(out);
        self.nodes.valve_choice.record(out);
        self.nodes.valve_sender.record(out);
        self.injections.save_injected(out);
        Foreign::save(&self.weather, out);
        out.output(&self.own.current().moisture);
        out.output(&self.own.previous().valve);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("sprinkler_nodes::soil_receiver", |body| &body.nodes.soil_receiver);
        types.node("sprinkler_nodes::thirst", |body| &body.nodes.thirst);
        types.node("sprinkler_nodes::valve_choice", |body| &body.nodes.valve_choice);
        types.node("sprinkler_nodes::valve_sender", |body| &body.nodes.valve_sender);
        types.injections(|body| &body.injections);
        types.foreign("Weather", |body| &body.weather);
        types.output("moisture", |body| &body.own.current().moisture);
        types.previous("valve", |body| &body.own.previous().valve);
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
            &mut self.weather,
            from,
            &mut outside.weather,
            &mut |cycle| stored.value("Weather", cycle),
        )?;
        self.own.both_to_load().0.moisture = from.take()?;
        self.own.both_to_load().1.valve = from.take()?;
        Ok(())
    }

    fn digests(&self, _shared: &(), digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().thirst);
        digests.add(&self.own.previous().valve);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        soil_receiver: Guarded::recorded(
            "sprinkler_nodes::soil_receiver",
            OnFailure::Stop,
            from,
        )?,
        thirst: Guarded::recorded("sprinkler_nodes::thirst", OnFailure::Stop, from)?,
        valve_choice: Guarded::recorded(
            "sprinkler_nodes::valve_choice",
            OnFailure::Stop,
            from,
        )?,
        valve_sender: Guarded::recorded(
            "sprinkler_nodes::valve_sender",
            OnFailure::Stop,
            from,
        )?,
    })
}

/// `Garden` alone, with the nodes of the frame that is loaded first.
pub fn replay_garden(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_garden], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [garden_injected], []) = buffer([]);
    let (weather_writer, [weather_for_garden], []) = buffer([]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        GARDEN,
        Garden {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: garden_injected,
            own: Swap::default(),
            parameters: parameters_for_garden,
            weather: weather_for_garden,
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
                    weather: weather_writer,
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
