//! One cycler: its database, its nodes, and what stands between its buffers and its nodes.

use std::collections::BTreeSet;

use super::frame::{self, FrameField, Hardware, InstanceParameters};
use super::names::{Names, name_nodes, plain, snake_case};
use super::node::{NodeModel, StepOutput, Surroundings, asked};
use super::parameters::Parameters;
use super::sentences;
use super::structs::{Struct, Structs};
use crate::resolve::robot::{
    CycleBinding, Cycler, InstanceId, Interface, Node, Robot, StateUse, Tree, Writer,
};
use crate::schedule::CyclerSchedule;

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
#[derive(Clone, Debug)]
pub struct CyclerModel {
    /// `Vision`.
    pub name: String,
    /// `vision`.
    pub module: String,
    /// Which kind and which instances, as a sentence.
    pub title: String,
    /// Main outputs, sorted by name.
    pub outputs: Vec<OutputField>,
    /// Names of the main outputs in manifest order of their nodes.
    pub output_names: Vec<String>,
    /// The root first; none if there are no additional outputs.
    pub additional_structs: Vec<Struct>,
    pub additional_outputs: Vec<AdditionalOutput>,
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
    /// What `new` of any node asks of the hardware.
    pub creation_hardware: Hardware,
    /// What `restore` of any node asks of the hardware.
    pub restore_hardware: Hardware,
    /// What all of it asks of the hardware; absent if no node touches it.
    pub hardware: Hardware,
}

/// Calls in the order they run.
#[derive(Clone, Debug)]
pub struct Calls {
    pub nodes: Vec<String>,
    pub hardware: Hardware,
}

#[derive(Clone, Debug, PartialEq, Eq)]
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
}

/// A declared additional output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdditionalOutput {
    /// Its field in `Subscribed`.
    pub flag: String,
    /// Its names for clients, one for each instance if they differ.
    pub names: Vec<String>,
    /// Fields from `AdditionalOutputs` to its slot.
    pub place: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProcedureField {
    pub name: String,
    pub request: String,
    pub response: String,
    /// Path of the node that answers.
    pub node: String,
}

/// What is consumed in order of time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Perception {
    /// In manifest order.
    pub lanes: Vec<Source>,
    /// Cyclers whose instances are read as one.
    pub interleavings: Vec<Interleaving>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interleaving {
    pub field: String,
    pub lanes: Vec<String>,
}

/// An instance that is read.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source {
    pub id: InstanceId,
    /// `VisionTop`.
    pub instance: String,
    /// `vision_top`.
    pub field: String,
    /// The field of the body that reads its newest cycle.
    pub reader: String,
    /// Module of its database: `vision`.
    pub module: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Previous {
    pub own: bool,
    pub shared: bool,
}

impl CyclerModel {
    pub fn has(&self, field: &FrameField) -> bool {
        self.frame.contains(field)
    }

    /// Whether `Frame` has a lifetime.
    pub fn frame_borrows(&self) -> bool {
        self.frame.iter().any(FrameField::borrows)
    }

    pub fn has_own(&self) -> bool {
        self.outputs.iter().any(|output| !output.shared)
    }

    pub fn has_shared(&self) -> bool {
        self.outputs.iter().any(|output| output.shared)
    }

    /// Whether the parameters are read at all.
    pub fn has_parameters(&self) -> bool {
        self.frame.iter().chain(&self.creation).any(|field| {
            matches!(field, FrameField::Parameters | FrameField::Instance(_))
        })
    }

    pub fn has_states(&self) -> bool {
        !self.state_structs.is_empty()
    }

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

    pub fn is_generic(&self) -> bool {
        self.hardware != Hardware::Absent
    }
}

/// Decides everything about one cycler.
pub fn describe(
    robot: &Robot,
    cycler: &Cycler,
    schedule: &CyclerSchedule,
    parameters: &Parameters,
) -> CyclerModel {
    let instance_parameters = frame::instance_parameters(cycler, parameters);
    let creation = frame::creation_fields(cycler, &instance_parameters);
    let frame = frame::frame_fields(cycler, &instance_parameters);
    let additional_outputs = additional_outputs(cycler);
    let flags: Vec<(String, String)> = additional_outputs.iter().map(|(path, output)| (path.clone(), output.flag.clone())).collect();
    let surroundings = Surroundings {
        robot,
        cycler,
        instance_parameters: &instance_parameters,
        flags: &flags,
        frame_is_generic: frame.contains(&FrameField::HardwareInterface),
        creation_is_generic: creation.contains(&FrameField::HardwareInterface),
    };
    let names = name_nodes(&cycler.nodes);
    let nodes: Vec<NodeModel> = names
        .iter()
        .zip(&cycler.nodes)
        .map(|(name, node)| surroundings.describe(name.clone(), node))
        .collect();
    let generic = surroundings.frame_is_generic || surroundings.creation_is_generic;
    let union = |generic: bool, bounds: &dyn Fn(&Node) -> Vec<Interface>| {
        asked(generic, &cycler.nodes.iter().flat_map(bounds).collect::<Vec<_>>())
    };
    CyclerModel {
        name: cycler.name.clone(),
        module: snake_case(&cycler.name),
        title: sentences::cycler_title(cycler),
        outputs: outputs(cycler),
        output_names: output_names(cycler),
        additional_structs: structs(robot, "AdditionalOutputs", &cycler.additional_outputs, &writers),
        additional_outputs: additional_outputs.into_iter().map(|(_, output)| output).collect(),
        state_structs: structs(robot, "CyclerState", &cycler.states, &users),
        procedures: procedures(cycler),
        perception: perception(robot, cycler),
        latest: latest(robot, cycler),
        previous: Previous {
            own: cycler.outputs.iter().any(|output| output.previous && !output.shared),
            shared: cycler.outputs.iter().any(|output| output.previous && output.shared),
        },
        renews: frame::renews_from_frame(cycler),
        setup: calls(schedule, &nodes, true),
        cycle: calls(schedule, &nodes, false),
        creation_hardware: union(surroundings.creation_is_generic, &|node| node.new_bounds.clone()),
        restore_hardware: union(surroundings.creation_is_generic, &|node| {
            node.restore_bounds.clone()
        }),
        hardware: union(generic, &|node| {
            [&node.new_bounds[..], &node.cycle_bounds, &node.restore_bounds].concat()
        }),
        instance_parameters,
        frame,
        creation,
        nodes,
    }
}

fn outputs(cycler: &Cycler) -> Vec<OutputField> {
    let outputs = cycler.outputs.iter().map(|output| {
        let producer = &cycler.nodes[output.producer];
        OutputField {
            name: plain(&output.name).to_owned(),
            data: output.data.text.clone(),
            node: producer.path.clone(),
            shared: output.shared,
            historic: output.historic,
            setup: producer.setup,
        }
    });
    outputs.collect()
}

fn output_names(cycler: &Cycler) -> Vec<String> {
    let mut outputs: Vec<_> = cycler.outputs.iter().collect();
    outputs.sort_by_key(|output| output.producer);
    outputs.into_iter().map(|output| plain(&output.name).to_owned()).collect()
}

fn structs<U>(
    robot: &Robot,
    root: &str,
    tree: &Tree<U>,
    docs: &dyn Fn(&[U]) -> String,
) -> Vec<Struct> {
    if tree.branches.is_empty() {
        return Vec::new();
    }
    Structs::new(robot, root, docs).describe(root, tree)
}

fn writers(writers: &[Writer]) -> String {
    sentences::list(writers.iter().map(|writer| writer.node.as_str()))
}

fn users(users: &[StateUse]) -> String {
    let readers: Vec<String> =
        users.iter().filter(|one| one.shared).map(|one| format!("{} (reads)", one.node)).collect();
    let writers = users.iter().filter(|one| !one.shared).map(|one| one.node.as_str());
    sentences::list(writers.chain(readers.iter().map(String::as_str)))
}

/// Every additional output by its path as written.
fn additional_outputs(cycler: &Cycler) -> Vec<(String, AdditionalOutput)> {
    let instances: Vec<String> =
        cycler.instances.iter().map(|instance| snake_case(&instance.name)).collect();
    let mut flags = Names::default();
    let mut found: Vec<(String, AdditionalOutput)> = Vec::new();
    for field in cycler.nodes.iter().flat_map(|node| &node.cycle) {
        let CycleBinding::AdditionalOutput { access, .. } = &field.binding else {
            continue;
        };
        if found.iter().any(|(path, _)| *path == access.written) {
            continue;
        }
        let place: Vec<String> = access.segments.iter().map(|segment| segment.name.clone()).collect();
        let by_instance = access.segments.iter().any(|segment| segment.instance);
        let whose = if by_instance { &instances[..] } else { &instances[..1] };
        let names = whose.iter().map(|instance| {
            let segments = access.segments.iter();
            let names: Vec<&str> = segments
                .map(|segment| if segment.instance { instance } else { plain(&segment.name) })
                .collect();
            names.join(".")
        });
        let names = names.collect();
        let output = AdditionalOutput { flag: flags.give(&place.join("_")), names, place };
        found.push((access.written.clone(), output));
    }
    found.sort_by(|left, right| left.1.place.cmp(&right.1.place));
    found
}

fn procedures(cycler: &Cycler) -> Vec<ProcedureField> {
    let mut procedures: Vec<ProcedureField> = cycler
        .nodes
        .iter()
        .flat_map(|node| node.cycle.iter().map(move |field| (node, field)))
        .filter_map(|(node, field)| match &field.binding {
            CycleBinding::Procedure { name, request, response } => Some(ProcedureField {
                name: name.clone(),
                request: request.text.clone(),
                response: response.text.clone(),
                node: node.path.clone(),
            }),
            _ => None,
        })
        .collect();
    procedures.sort_by(|left, right| left.name.cmp(&right.name));
    procedures
}

/// Every perception instance that any node consumes, once.
fn perception(robot: &Robot, cycler: &Cycler) -> Option<Perception> {
    let mut lanes = BTreeSet::new();
    let mut cyclers = BTreeSet::new();
    for field in cycler.nodes.iter().flat_map(|node| &node.cycle) {
        if let CycleBinding::Perception { instances, .. } = &field.binding {
            lanes.extend(instances.iter().copied());
            if let [first, _, ..] = instances.as_slice() {
                cyclers.insert(first.cycler);
            }
        }
    }
    if lanes.is_empty() {
        return None;
    }
    let lanes: Vec<Source> = lanes.into_iter().map(|id| source(robot, id)).collect();
    let interleavings = cyclers.into_iter().map(|cycler| Interleaving {
        field: snake_case(&robot.cyclers[cycler].name),
        lanes: lanes
            .iter()
            .filter(|lane| lane.id.cycler == cycler)
            .map(|lane| lane.field.clone())
            .collect(),
    });
    Some(Perception { interleavings: interleavings.collect(), lanes })
}

fn latest(robot: &Robot, cycler: &Cycler) -> Vec<Source> {
    let instances: BTreeSet<InstanceId> = cycler
        .nodes
        .iter()
        .flat_map(|node| &node.cycle)
        .filter_map(|field| match &field.binding {
            CycleBinding::OutputOf { instance, .. }
            | CycleBinding::RequiredOutputOf { instance, .. }
            | CycleBinding::Latest { instance, .. } => Some(*instance),
            _ => None,
        })
        .collect();
    let mut names = Names::with(FIELDS_OF_BODIES.map(str::to_owned));
    let sources = instances.into_iter().map(|id| source(robot, id));
    sources.map(|source| Source { reader: names.give(&source.field), ..source }).collect()
}

/// An instance as those name it who read it.
fn source(robot: &Robot, id: InstanceId) -> Source {
    let cycler = &robot.cyclers[id.cycler];
    let instance = cycler.instances[id.instance].name.clone();
    let field = snake_case(&instance);
    Source { id, reader: field.clone(), field, instance, module: snake_case(&cycler.name) }
}

fn calls(schedule: &CyclerSchedule, nodes: &[NodeModel], setup: bool) -> Calls {
    let called = schedule.order.iter().map(|node| &nodes[*node]).filter(|node| node.setup == setup);
    let mut hardware = Hardware::Absent;
    for node in called.clone() {
        hardware = match (hardware, node.step.hardware.clone()) {
            (Hardware::Asked(mut one), Hardware::Asked(other)) => {
                one.extend(other);
                one.sort();
                one.dedup();
                Hardware::Asked(one)
            }
            (Hardware::Absent, other) => other,
            (one, Hardware::Absent) => one,
        };
    }
    Calls { nodes: called.map(|node| node.name.clone()).collect(), hardware }
}
