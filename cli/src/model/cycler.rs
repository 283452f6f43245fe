//! One cycler: its database, its nodes, and what stands between its buffers and its nodes.

mod outputs;
mod sources;

use serde::Serialize;

use super::frame::{self, FrameField, Hardware, InstanceParameters};
use super::names::{Names, PRELUDE, constant_case, name_nodes, snake_case};
use super::node::{NodeModel, StepOutput, Surroundings, asked};
use super::parameters::Parameters;
use super::sentences;
use super::structs::Struct;
use crate::resolve::robot::{Cycler, InstanceId, Interface, Node, Robot};
use crate::schedule::{CyclerSchedule, Schedule};

pub(super) use outputs::outputs;

/// Fields that a body may have itself.
const FIELDS_OF_BODIES: [&str; 14] = [
    "additional_outputs",
    "capture_time",
    "cycler_state",
    "hardware_interface",
    "historic",
    "injections",
    "nodes",
    "own",
    "parameters",
    "perception",
    "procedures",
    "select",
    "subscribed",
    "subscriptions",
];

/// `databases/<cycler>.rs`, `cyclers/<cycler>.rs` and `runtime/<cycler>.rs`.
#[derive(Clone, Debug, Serialize)]
pub struct CyclerModel {
    /// In the robot's cyclers.
    pub position: usize,
    /// `Vision`.
    pub name: String,
    /// `vision`.
    pub module: String,
    /// The struct of its instances in `runtime/<cycler>.rs`: `Vision`.
    pub body: String,
    /// Which kind and which instances, as a sentence.
    pub title: String,
    /// Main outputs, sorted by name.
    pub outputs: Vec<OutputField>,
    /// Names of the main outputs in manifest order of their nodes.
    pub output_names: Vec<String>,
    /// The root first; none if there are no additional outputs.
    pub additional_structs: Vec<Struct>,
    pub additional_outputs: Vec<AdditionalOutput>,
    /// The constant with their names, which is none of an instance: `ADDITIONAL_OUTPUTS`.
    pub additional_names: String,
    /// The root first; none if there are no states.
    pub state_structs: Vec<Struct>,
    pub procedures: Vec<ProcedureField>,
    pub perception: Option<Perception>,
    /// Instances whose newest cycle it reads, in manifest order.
    pub latest: Vec<Source>,
    /// Whether what the last finished cycle wrote is read: own outputs, shared outputs.
    pub previous: Previous,
    pub instance_parameters: Vec<InstanceParameters>,
    /// Fields of `Frame`, sorted.
    pub frame: Vec<FrameField>,
    /// Fields of `Creation`, sorted; without any there is no `Creation`.
    pub creation: Vec<FrameField>,
    /// A node may be created from `Frame` in the middle of a cycle.
    pub renews: bool,
    /// In manifest order.
    pub nodes: Vec<NodeModel>,
    pub setup: Calls,
    pub cycle: Calls,
    /// Positions in `nodes` in the order they are created.
    pub creation_order: Vec<usize>,
    /// What `new` of any node asks of the hardware.
    pub creation_hardware: Hardware,
    /// What `restore` of any node asks of the hardware.
    pub restore_hardware: Hardware,
    /// What all of it asks of the hardware; absent if no node touches it.
    pub hardware: Hardware,
}

/// Calls in the order they run.
#[derive(Clone, Debug, Serialize)]
pub struct Calls {
    pub nodes: Vec<String>,
    pub hardware: Hardware,
}

/// A main output of the cycler.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct OutputField {
    pub name: String,
    /// Absolute type.
    pub data: String,
    /// Path of the node that writes it.
    pub node: String,
    pub shared: bool,
    pub historic: bool,
    /// A setup node writes it.
    pub setup: bool,
    /// Some node reads it as previous, or its producer holds.
    pub previous: bool,
}

/// A declared additional output.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AdditionalOutput {
    /// Its path as written.
    pub written: String,
    /// Its field in `Subscribed`.
    pub flag: String,
    /// Its names for clients, one for each instance if they differ.
    pub names: Vec<String>,
    /// Fields from `AdditionalOutputs` to its slot.
    pub place: Vec<String>,
    /// A setup node writes it.
    pub setup: bool,
}

/// A procedure that a node of the cycler answers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProcedureField {
    pub name: String,
    pub request: String,
    pub response: String,
    /// Path of the node that answers.
    pub node: String,
}

/// What is consumed in order of time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Perception {
    /// In manifest order.
    pub lanes: Vec<Source>,
    /// Cyclers whose instances are read as one.
    pub interleavings: Vec<Interleaving>,
    /// The field with how far all of them are consumed, which is none of an instance: `horizon`.
    pub horizon: String,
}

/// The order over all instances of one perception cycler.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Interleaving {
    pub field: String,
    pub lanes: Vec<String>,
}

/// An instance that is read.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Source {
    pub id: InstanceId,
    /// `VisionTop`.
    pub instance: String,
    /// `vision_top`.
    pub field: String,
    /// The field of the body that reads its newest cycle.
    pub reader: String,
    /// Who writes its cycles in a replay: a field of `Outside`.
    pub writer: String,
    /// Module of its database: `vision`.
    pub module: String,
}

/// Which parts of the last finished cycle are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Previous {
    pub own: bool,
    pub shared: bool,
}

impl CyclerModel {
    /// Whether `Frame` has this field.
    pub fn has(&self, field: &FrameField) -> bool {
        self.frame.contains(field)
    }

    /// Whether `Frame` has a lifetime.
    pub fn frame_borrows(&self) -> bool {
        self.frame.iter().any(FrameField::borrows)
    }

    /// Whether some main output stays with the instance.
    pub fn has_own(&self) -> bool {
        self.outputs.iter().any(|output| !output.shared)
    }

    /// Whether some main output is read by other instances.
    pub fn has_shared(&self) -> bool {
        self.outputs.iter().any(|output| output.shared)
    }

    /// Whether clients see the same names of additional outputs in every instance.
    pub fn names_are_shared(&self) -> bool {
        self.additional_outputs
            .iter()
            .all(|output| output.names.len() == 1)
    }

    /// Whether the parameters are read at all.
    pub fn has_parameters(&self) -> bool {
        self.frame
            .iter()
            .chain(&self.creation)
            .any(|field| matches!(field, FrameField::Parameters | FrameField::Instance(_)))
    }

    /// Whether the nodes share states.
    pub fn has_states(&self) -> bool {
        !self.state_structs.is_empty()
    }

    /// Main outputs that are read by time.
    pub fn historic(&self) -> impl Iterator<Item = &OutputField> {
        self.outputs.iter().filter(|output| output.historic)
    }

    /// Outputs of setup nodes, which clients replace when a cycle begins.
    pub fn setup_outputs(&self) -> Vec<StepOutput> {
        let outputs = self.outputs.iter().filter(|output| output.setup);
        outputs
            .map(|output| StepOutput {
                name: output.name.clone(),
                shared: output.shared,
                in_place: false,
            })
            .collect()
    }

    /// Whether any node touches the hardware.
    pub fn is_generic(&self) -> bool {
        self.hardware != Hardware::Absent
    }
}

/// The cycler at this position of the robot's.
pub fn at(cyclers: &[CyclerModel], position: usize) -> &CyclerModel {
    let mut all = cyclers.iter();
    all.find(|cycler| cycler.position == position)
        .expect("a cycler that runs is described")
}

/// Decides everything about the cycler at this position.
pub fn describe(
    robot: &Robot,
    position: usize,
    schedule: &Schedule,
    parameters: &Parameters,
) -> CyclerModel {
    let (cycler, schedule) = (&robot.cyclers[position], &schedule.cyclers[position]);
    let instance_parameters = frame::instance_parameters(cycler, parameters);
    let creation = frame::creation_fields(cycler, &instance_parameters);
    let frame = frame::frame_fields(cycler, &instance_parameters);
    let additional_outputs = outputs::additional_outputs(cycler);
    let surroundings = Surroundings {
        robot,
        cycler,
        instance_parameters: &instance_parameters,
        additional_outputs: &additional_outputs,
        frame_is_generic: frame.contains(&FrameField::HardwareInterface),
        creation_is_generic: creation.contains(&FrameField::HardwareInterface),
    };
    let names = name_nodes(&cycler.nodes);
    let named = names.into_iter().zip(&cycler.nodes);
    let nodes: Vec<NodeModel> = named
        .map(|(name, node)| surroundings.describe(name, node))
        .collect();
    let latest = sources::latest(robot, cycler, &instance_parameters);
    let created = surroundings.creation_is_generic;
    let touched = surroundings.frame_is_generic || created;
    CyclerModel {
        position,
        name: cycler.name.clone(),
        module: snake_case(&cycler.name),
        body: body(cycler),
        title: sentences::cycler_title(cycler),
        outputs: outputs::outputs(cycler),
        output_names: outputs::output_names(cycler),
        additional_structs: outputs::additional_structs(robot, cycler),
        state_structs: outputs::state_structs(robot, cycler),
        procedures: outputs::procedures(cycler),
        perception: sources::perception(robot, cycler, &latest),
        latest,
        previous: previous(cycler),
        renews: frame::renews_from_frame(cycler),
        setup: calls(schedule, &nodes, true),
        cycle: calls(schedule, &nodes, false),
        creation_order: schedule.creation.clone(),
        creation_hardware: union(cycler, created, |node| vec![&node.new_bounds]),
        restore_hardware: union(cycler, created, |node| vec![&node.restore_bounds]),
        hardware: union(cycler, touched, |node| {
            vec![&node.new_bounds, &node.cycle_bounds, &node.restore_bounds]
        }),
        additional_outputs,
        additional_names: additional_names(cycler),
        instance_parameters,
        frame,
        creation,
        nodes,
    }
}

/// What the struct of the instances is called: like the cycler, unless that hides the prelude's or
/// the struct's own type parameter.
fn body(cycler: &Cycler) -> String {
    let taken = PRELUDE.into_iter().chain(["Hardware"]);
    Names::with(taken.map(str::to_owned)).give(&cycler.name)
}

/// What the constant with the names of additional outputs is called beside those of the instances.
fn additional_names(cycler: &Cycler) -> String {
    let instances = cycler.instances.iter();
    let taken = instances.map(|instance| constant_case(&instance.name));
    Names::with(taken).give("ADDITIONAL_OUTPUTS")
}

/// What all nodes together ask of the hardware, if there is a type parameter for it.
fn union(
    cycler: &Cycler,
    generic: bool,
    bounds: impl Fn(&Node) -> Vec<&Vec<Interface>>,
) -> Hardware {
    let bounds = cycler.nodes.iter().flat_map(bounds).flatten();
    let markers = cycler.nodes.iter().flat_map(|node| &node.markers);
    let (bounds, markers): (Vec<_>, Vec<_>) =
        (bounds.cloned().collect(), markers.cloned().collect());
    asked(generic, &bounds, &markers)
}

fn previous(cycler: &Cycler) -> Previous {
    let reads = |shared: bool| {
        let mut outputs = cycler.outputs.iter();
        outputs.any(|output| output.previous && output.shared == shared)
    };
    Previous {
        own: reads(false),
        shared: reads(true),
    }
}

fn calls(schedule: &CyclerSchedule, nodes: &[NodeModel], setup: bool) -> Calls {
    let called = schedule
        .order
        .iter()
        .map(|node| &nodes[*node])
        .filter(|node| node.setup == setup);
    let mut hardware = Hardware::Absent;
    for node in called.clone() {
        hardware = match (hardware, node.step.hardware.clone()) {
            (Hardware::Asked(mut one), Hardware::Asked(other)) => {
                one.extend(other);
                frame::sort_bounds(&mut one);
                Hardware::Asked(one)
            }
            (Hardware::Absent, other) => other,
            (one, Hardware::Absent) => one,
        };
    }
    Calls {
        nodes: called.map(|node| node.name.clone()).collect(),
        hardware,
    }
}
