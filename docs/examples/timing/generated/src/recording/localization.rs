//! Cycler `Localization` in a recording: what its cycles take, saved and given back.
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
use timing_nodes::interfaces::Console;
use timing_nodes::interfaces::Pace;

use crate::cyclers::localization::Nodes;
use crate::databases::localization::Injections;
use crate::databases::localization::Perception;
use crate::databases::odometry;
use crate::databases::radio;
use crate::databases::vision;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::localization::LOCALIZATION;
use crate::runtime::localization::Localization;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub vision: Writer<vision::SharedOutputs>,
    pub odometry: Writer<odometry::SharedOutputs>,
    pub radio: Writer<radio::SharedOutputs>,
}

impl<Hardware: Console + Pace + Send + Sync> Recorded for Localization<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("timing_nodes::position_filter", "sets"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("Vision", &self.perception.vision)?;
        values.of("Odometry", &self.perception.odometry)?;
        values.of("Radio", &self.perception.radio)?;
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
        self.nodes.pace_receiver.record(out);
        self.nodes.position_filter.record(out);
        self.nodes.set_printer.record(out);
        self.injections.save_injected(out);
        Foreign::save(&self.perception.vision, out);
        Foreign::save(&self.perception.odometry, out);
        Foreign::save(&self.perception.radio, out);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("timing_nodes::pace_receiver", |body| &body.nodes.pace_receiver);
        types.node("timing_nodes::position_filter", |body| &body.nodes.position_filter);
        types.node("timing_nodes::set_printer", |body| &body.nodes.set_printer);
        types.injections(|body| &body.injections);
        types.foreign("Vision", |body| &body.perception.vision);
        types.foreign("Odometry", |body| &body.perception.odometry);
        types.foreign("Radio", |body| &body.perception.radio);
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
            &mut self.perception.vision,
            from,
            &mut outside.vision,
            &mut |cycle| stored.value("Vision", cycle),
        )?;
        Foreign::load(
            &mut self.perception.odometry,
            from,
            &mut outside.odometry,
            &mut |cycle| stored.value("Odometry", cycle),
        )?;
        Foreign::load(
            &mut self.perception.radio,
            from,
            &mut outside.radio,
            &mut |cycle| stored.value("Radio", cycle),
        )?;
        Ok(())
    }

    fn digests(&self, _shared: &(), digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().sets);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        pace_receiver: Guarded::recorded(
            "timing_nodes::pace_receiver",
            OnFailure::Stop,
            from,
        )?,
        position_filter: Guarded::recorded(
            "timing_nodes::position_filter",
            OnFailure::Stop,
            from,
        )?,
        set_printer: Guarded::recorded(
            "timing_nodes::set_printer",
            OnFailure::Stop,
            from,
        )?,
    })
}

/// `Localization` alone, with the nodes of the frame that is loaded first.
pub fn replay_localization(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_localization], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [localization_injected], []) = buffer([]);
    let (vision_writer, [], [vision_queue_for_localization]) = buffer([32]);
    let (odometry_writer, [], [odometry_queue_for_localization]) = buffer([512]);
    let (radio_writer, [], [radio_queue_for_localization]) = buffer([32]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        LOCALIZATION,
        Localization {
            nodes: load_nodes(from)?,
            capture_time: None,
            hardware_interface: hardware.clone(),
            injections: localization_injected,
            own: Swap::default(),
            parameters: parameters_for_localization,
            perception: Perception {
                horizon: Horizon::new(),
                vision: Consumer::new(
                    vision_queue_for_localization,
                    Duration::from_secs(5),
                ),
                odometry: Consumer::new(
                    odometry_queue_for_localization,
                    Duration::from_secs(1),
                ),
                radio: Consumer::new(
                    radio_queue_for_localization,
                    Duration::from_secs(1),
                ),
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
                    vision: vision_writer,
                    odometry: odometry_writer,
                    radio: radio_writer,
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
