//! Cycler `Lights` in a recording: what its cycles take, saved and given back.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use std::sync::Arc;

use framework::Clock;
use framework::Cycler;
use framework::Guarded;
use framework::OnFailure;
use framework::Result;
use framework::Slots;
use framework::Subscriptions;
use framework::Timestamp;
use framework::Writer;
use framework::buffer;
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
use zoo_nodes::interfaces::LampInterface;
use zoo_nodes::interfaces::LegInterface;
use zoo_nodes::interfaces::MetronomeInterface;

use crate::cyclers::lights::Nodes;
use crate::databases::control;
use crate::databases::lights::CyclerState;
use crate::recording::Sink;
use crate::runtime::lights::LIGHTS;
use crate::runtime::lights::Lights;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub control: Writer<control::SharedOutputs>,
}

impl<Hardware: LampInterface + LegInterface + MetronomeInterface + Send + Sync> Recorded
for Lights<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.of("Control", &self.control)?;
        Ok(())
    }

    fn save(
        &self,
        _cycle: u64,
        _slots: Slots<'_, ()>,
        _since: Option<Timestamp>,
        out: &mut Saving<'_, '_>,
    ) {
        self.nodes.setup_node.record(out);
        self.nodes.lamp.record(out);
        self.nodes.cycle_node.record(out);
        out.put(&self.cycler_state);
        Foreign::save(&self.control, out);
    }

    fn describe(types: &mut Describing<Self>) {
        types.node("zoo_nodes::lights::setup", |body| &body.nodes.setup_node);
        types.node("zoo_nodes::lights::lamp", |body| &body.nodes.lamp);
        types.node("zoo_nodes::lights::cycle", |body| &body.nodes.cycle_node);
        types.state(|body| &body.cycler_state);
        types.foreign("Control", |body| &body.control);
    }

    fn load(
        &mut self,
        _cycle: u64,
        _slots: Loaded<'_, ()>,
        outside: &mut Outside,
        from: &mut Loading<'_>,
        stored: &Stored<'_>,
    ) -> Result<()> {
        self.nodes = load_nodes(from)?;
        self.cycler_state = from.take()?;
        Foreign::load(
            &mut self.control,
            from,
            &mut outside.control,
            &mut |cycle| stored.value("Control", cycle),
        )?;
        Ok(())
    }

    fn digests(&self, _shared: &(), _digests: &mut Digests<'_, '_>) {}
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        setup_node: Guarded::recorded(
            "zoo_nodes::lights::setup",
            OnFailure::Stop,
            from,
        )?,
        lamp: Guarded::recorded("zoo_nodes::lights::lamp", OnFailure::Stop, from)?,
        cycle_node: Guarded::recorded("zoo_nodes::lights::cycle", OnFailure::Stop, from)?,
    })
}

/// `Lights` alone, with the nodes of the frame that is loaded first.
pub fn replay_lights(
    from: &mut Loading<'_>,
    _stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let hardware = Arc::new(Sink);
    let (control_writer, [control_for_lights], []) = buffer([]);
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        LIGHTS,
        Lights {
            nodes: load_nodes(from)?,
            cycler_state: CyclerState::default(),
            hardware_interface: hardware.clone(),
            control: control_for_lights,
        },
        writer,
        Clock::stepped(),
    );
    Ok(
        Box::new(
            Alone::new(
                cycler,
                Outside { control: control_writer },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
