//! Cycler `Weather` in a recording: what its cycles take, saved and given back.
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
use sprinkler_nodes::RainGauge;

use crate::cyclers::weather::Nodes;
use crate::databases::weather::Injections;
use crate::databases::weather::SharedOutputs;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::weather::WEATHER;
use crate::runtime::weather::Weather;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
}

impl<Hardware: RainGauge + Send + Sync> Recorded for Weather<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("sprinkler_nodes::rain_mean", "mean_rain"),
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
        self.nodes.rain_receiver.record(out);
        self.nodes.rain_mean.record(out);
        self.injections.save_injected(out);
        out.output(&self.own.current().rain);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("sprinkler_nodes::rain_receiver", |body| &body.nodes.rain_receiver);
        types.node("sprinkler_nodes::rain_mean", |body| &body.nodes.rain_mean);
        types.injections(|body| &body.injections);
        types.output("rain", |body| &body.own.current().rain);
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
        self.own.both_to_load().0.rain = from.take()?;
        Ok(())
    }

    fn digests(&self, shared: &SharedOutputs, digests: &mut Digests<'_, '_>) {
        digests.add(&shared.mean_rain);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        rain_receiver: Guarded::recorded(
            "sprinkler_nodes::rain_receiver",
            OnFailure::Stop,
            from,
        )?,
        rain_mean: Guarded::recorded(
            "sprinkler_nodes::rain_mean",
            OnFailure::Stop,
            from,
        )?,
    })
}

/// `Weather` alone, with the nodes of the frame that is loaded first.
pub fn replay_weather(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_weather], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [weather_injected], []) = buffer([]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        WEATHER,
        Weather {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: weather_injected,
            own: Swap::default(),
            parameters: parameters_for_weather,
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
