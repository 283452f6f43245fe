//! Cycler `Reflexes` in a recording: what its cycles take, saved and given back.
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
use framework::procedure;
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
use zoo_nodes::interfaces::BumperInterface;
use zoo_nodes::interfaces::LampInterface;

use crate::cyclers::reflexes::Nodes;
use crate::databases::control;
use crate::databases::reflexes::Injections;
use crate::databases::reflexes::Perception;
use crate::databases::reflexes::Procedures;
use crate::databases::vision;
use crate::parameters::Parameters;
use crate::recording::Sink;
use crate::runtime::reflexes::REFLEXES;
use crate::runtime::reflexes::Reflexes;

/// In a replay: who writes what an instance reads.
pub struct Outside {
    pub injections: Writer<Injected<Injections>>,
    pub parameters: Writer<Parameters>,
    pub control: Writer<control::SharedOutputs>,
    pub vision_bottom: Writer<vision::SharedOutputs>,
}

impl<Hardware: BumperInterface + LampInterface + Send + Sync> Recorded
for Reflexes<Hardware> {
    type Outside = Outside;
    const DIGESTED: &'static [(&'static str, &'static str)] = &[
        ("zoo_nodes::reflexes::create", "sum"),
    ];

    fn values(&self, values: &mut Values<'_, '_>) -> Result<(), SaveError> {
        values.parameters(&self.parameters)?;
        values.of("Control", &self.control)?;
        values.of("VisionBottom", &self.perception.vision_bottom)?;
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
        self.nodes.bumper.record(out);
        self.nodes.flinch.record(out);
        self.nodes.create_node2.record(out);
        self.nodes.node.record(out);
        self.injections.save_injected(out);
        Foreign::save(&self.control, out);
        out.output(&self.own.current().pressed);
        Foreign::save(&self.perception.vision_bottom, out);
        self.procedures.type_.save(out);
    }

    fn describe(types: &mut Describing<Self>) {
        types.parameters(|body| &body.parameters);
        types.node("zoo_nodes::reflexes::bumper", |body| &body.nodes.bumper);
        types.node("zoo_nodes::reflexes::flinch", |body| &body.nodes.flinch);
        types.node("zoo_nodes::reflexes::create", |body| &body.nodes.create_node2);
        types.node("zoo_nodes::reflexes::node", |body| &body.nodes.node);
        types.injections(|body| &body.injections);
        types.foreign("Control", |body| &body.control);
        types.output("pressed", |body| &body.own.current().pressed);
        types.foreign("VisionBottom", |body| &body.perception.vision_bottom);
        types.procedure("type_", |body| &body.procedures.type_);
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
            &mut self.control,
            from,
            &mut outside.control,
            &mut |cycle| stored.value("Control", cycle),
        )?;
        self.own.both_to_load().0.pressed = from.take()?;
        Foreign::load(
            &mut self.perception.vision_bottom,
            from,
            &mut outside.vision_bottom,
            &mut |cycle| stored.value("VisionBottom", cycle),
        )?;
        self.procedures.type_.load(from)?;
        Ok(())
    }

    fn digests(&self, _shared: &(), digests: &mut Digests<'_, '_>) {
        digests.add(&self.own.previous().sum);
    }
}

/// The nodes as `save` wrote them, in manifest order.
fn load_nodes(from: &mut Loading<'_>) -> Result<Nodes> {
    Ok(Nodes {
        bumper: Guarded::recorded("zoo_nodes::reflexes::bumper", OnFailure::Stop, from)?,
        flinch: Guarded::recorded("zoo_nodes::reflexes::flinch", OnFailure::Stop, from)?,
        create_node2: Guarded::recorded(
            "zoo_nodes::reflexes::create",
            OnFailure::Stop,
            from,
        )?,
        node: Guarded::recorded("zoo_nodes::reflexes::node", OnFailure::Stop, from)?,
    })
}

/// `Reflexes` alone, with the nodes of the frame that is loaded first.
pub fn replay_reflexes(
    from: &mut Loading<'_>,
    stored: &Stored<'_>,
) -> Result<Box<dyn Replay>> {
    let start: Parameters = stored.parameters(from)?;
    let (parameters_writer, [parameters_for_reflexes], []) = buffer_of(
        || start.clone(),
        [],
    );
    let hardware = Arc::new(Sink);
    let (injections_writer, [reflexes_injected], []) = buffer([]);
    let (control_writer, [control_for_reflexes], []) = buffer([]);
    let (vision_bottom_writer, [], [vision_bottom_queue_for_reflexes]) = buffer([8]);
    let (_, reflexes_type_answerer) = procedure();
    let (writer, [], []) = buffer([]);
    let cycler = Cycler::new(
        REFLEXES,
        Reflexes {
            nodes: load_nodes(from)?,
            hardware_interface: hardware.clone(),
            injections: reflexes_injected,
            own: Swap::default(),
            parameters: parameters_for_reflexes,
            perception: Perception {
                horizon: Horizon::new(),
                vision_bottom: Consumer::new(
                    vision_bottom_queue_for_reflexes,
                    Duration::from_millis(500),
                ),
            },
            procedures: Procedures {
                type_: reflexes_type_answerer,
            },
            control: control_for_reflexes,
            select_a_b: |parameters| &parameters.a.b.reflexes,
            select_a_b2: |parameters| &parameters.a_b.reflexes,
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
                    control: control_writer,
                    vision_bottom: vision_bottom_writer,
                },
                Subscriptions::new(&[]),
            ),
        ),
    )
}
