//! `DATAFLOW.md`: the first file to read in a review.
//!
//! One line per fact, so that a change of a node changes the lines that say so and no others.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;

use super::{package, sentences};
use crate::resolve::robot::{
    Access, Content, CreationBinding, CycleBinding, Cycler, InstanceId, Node, OnFailure, Robot,
    Tree,
};
use crate::schedule::{CyclerSchedule, Edge, Reason, Schedule};

/// Who reads and writes what, in words.
#[derive(Clone, Debug, Serialize)]
pub struct Dataflow {
    pub robot: String,
    pub header: &'static str,
    pub cyclers: Vec<CyclerText>,
    pub parameters: Vec<ParameterText>,
    pub targets: Vec<TargetText>,
}

#[derive(Clone, Debug, Serialize)]
pub struct CyclerText {
    pub name: String,
    pub kind: &'static str,
    /// What the manifest says about it, one fact each.
    pub facts: Vec<String>,
    pub instances: Vec<InstanceText>,
    /// In the order they run.
    pub nodes: Vec<NodeText>,
    pub outputs: Vec<OutputText>,
}

#[derive(Clone, Debug, Serialize)]
pub struct InstanceText {
    pub name: String,
    pub facts: Vec<String>,
    /// How many slots its buffer has, as a sum.
    pub slots: String,
}

#[derive(Clone, Debug, Serialize)]
pub struct NodeText {
    pub path: String,
    pub summary: Option<String>,
    /// What it reads, writes and why it stands here, one fact each.
    pub facts: Vec<String>,
}

/// An output that other instances read.
#[derive(Clone, Debug, Serialize)]
pub struct OutputText {
    pub name: String,
    pub data: String,
    pub writer: String,
    pub readers: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
pub struct ParameterText {
    pub path: String,
    pub data: String,
    pub readers: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
pub struct TargetText {
    pub name: String,
    pub hardware: String,
    pub feature: String,
    pub triple: String,
}

/// Decides what `DATAFLOW.md` says.
pub fn describe(robot: &Robot, schedule: &Schedule) -> Dataflow {
    let cyclers = robot.cyclers.iter().zip(&schedule.cyclers).enumerate();
    let mut parameters = Vec::new();
    list_parameters(&robot.parameter_tree, "", &mut parameters);
    Dataflow {
        robot: robot.name.clone(),
        header: super::DO_NOT_EDIT,
        cyclers: cyclers
            .map(|(position, (cycler, schedule))| cycler_text(robot, position, cycler, schedule))
            .collect(),
        parameters,
        targets: robot
            .targets
            .iter()
            .map(|target| TargetText {
                name: target.name.clone(),
                hardware: target.hardware.clone(),
                feature: package::feature(&target.name),
                triple: target.triple.clone().unwrap_or_else(|| "the host's".to_owned()),
            })
            .collect(),
    }
}

fn cycler_text(
    robot: &Robot,
    position: usize,
    cycler: &Cycler,
    schedule: &CyclerSchedule,
) -> CyclerText {
    let nodes = schedule.order.iter().map(|node| NodeText {
        path: cycler.nodes[*node].path.clone(),
        summary: cycler.nodes[*node].summary.clone(),
        facts: node_facts(robot, cycler, schedule, *node),
    });
    let instances = cycler.instances.iter().enumerate().map(|(instance, _)| {
        instance_text(robot, InstanceId { cycler: position, instance })
    });
    CyclerText {
        name: cycler.name.clone(),
        kind: sentences::kind(cycler.kind),
        facts: cycler_facts(cycler),
        instances: instances.collect(),
        nodes: nodes.collect(),
        outputs: shared_outputs(robot, position, cycler),
    }
}

fn cycler_facts(cycler: &Cycler) -> Vec<String> {
    use crate::resolve::robot::CyclerKind;
    let mut facts = vec![format!("on failure: {}", on_failure(cycler.on_failure))];
    match cycler.kind {
        CyclerKind::Perception => {
            facts.push(format!("pending timeout: {}", duration(cycler.pending_timeout)));
            facts.push(format!("queue: {} cycles", cycler.queue));
        }
        CyclerKind::RealTime => {
            facts.push(format!("watchdog: {}", duration(cycler.watchdog)));
            if cycler.outputs.iter().any(|output| output.historic) {
                facts.push(format!("history: {}", duration(cycler.history)));
            }
        }
    }
    if let Some(lockstep) = cycler.lockstep_duration {
        facts.push(format!("duration in lockstep: {}", duration(lockstep)));
    }
    facts
}

fn instance_text(robot: &Robot, id: InstanceId) -> InstanceText {
    let cycler = &robot.cyclers[id.cycler];
    let instance = &cycler.instances[id.instance];
    let mut facts = Vec::new();
    if let Some(deadline) = instance.deadline {
        facts.push(format!("deadline {}", duration(deadline)));
    }
    if let Some(policy) = &instance.scheduling.policy {
        let priority = instance.scheduling.priority;
        facts.push(match priority {
            Some(priority) => format!("scheduled {policy} {priority}"),
            None => format!("scheduled {policy}"),
        });
    }
    if !instance.scheduling.cores.is_empty() {
        let cores: Vec<String> = instance.scheduling.cores.iter().map(ToString::to_string).collect();
        facts.push(format!("on cores {}", cores.join(", ")));
    }
    InstanceText { name: instance.name.clone(), facts, slots: slots(robot, id) }
}

/// 2 (being written, newest) and one per reader, and the window of each consumer.
fn slots(robot: &Robot, id: InstanceId) -> String {
    let count = |reads: &dyn Fn(&CycleBinding) -> bool| {
        let reading = robot.cyclers.iter().filter(|cycler| {
            cycler.nodes.iter().flat_map(|node| &node.cycle).any(|field| reads(&field.binding))
        });
        reading.map(|cycler| cycler.instances.len()).sum::<usize>()
    };
    let readers = count(&|binding| latest_of(binding).is_some_and(|(read, _)| *read == id));
    let consumers = count(&|binding| {
        matches!(binding, CycleBinding::Perception { instances, .. } if instances.contains(&id))
    });
    let queue = robot.cyclers[id.cycler].queue;
    let total = 2 + readers + consumers * queue;
    let mut sum = "2".to_owned();
    if readers > 0 {
        sum.push_str(&format!(" + {}", counted(readers, "reader")));
    }
    if consumers > 0 {
        sum.push_str(&format!(" + {} of {queue}", counted(consumers, "window")));
    }
    if sum == "2" { sum } else { format!("{total} = {sum}") }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// The newest cycle of which instance is read, and what of it.
fn latest_of(binding: &CycleBinding) -> Option<(&InstanceId, &Access)> {
    match binding {
        CycleBinding::OutputOf { instance, access, .. }
        | CycleBinding::RequiredOutputOf { instance, access, .. }
        | CycleBinding::Latest { instance, access, .. } => Some((instance, access)),
        _ => None,
    }
}

fn node_facts(
    robot: &Robot,
    cycler: &Cycler,
    schedule: &CyclerSchedule,
    position: usize,
) -> Vec<String> {
    let node = &cycler.nodes[position];
    let mut facts = Vec::new();
    for field in &node.creation {
        if let CreationBinding::Parameter { access, .. } = &field.binding {
            facts.push(format!("reads parameter `{}` when it is created", access.written));
        }
    }
    for field in &node.cycle {
        facts.extend(field_fact(robot, cycler, &field.name, &field.binding));
    }
    for field in &node.outputs {
        facts.push(match &field.binding {
            crate::resolve::robot::OutputBinding::MainOutput { data } => {
                format!("writes `{}`: `{}`", field.name, data.text)
            }
            crate::resolve::robot::OutputBinding::CaptureTime => {
                "gives the cycle its timestamp".to_owned()
            }
        });
    }
    for interface in node.cycle_bounds.iter().chain(&node.new_bounds) {
        let fact = format!("asks the hardware for `{}`", interface.path);
        if !facts.contains(&fact) {
            facts.push(fact);
        }
    }
    if node.on_failure != cycler.on_failure {
        facts.push(format!("on failure: {}", on_failure(node.on_failure)));
    }
    facts.push(place(cycler, schedule, position, node));
    facts
}

/// What one field of the cycle context reads or writes, and from whom.
fn field_fact(robot: &Robot, cycler: &Cycler, name: &str, binding: &CycleBinding) -> Option<String> {
    let instance = |id: &InstanceId| robot.cyclers[id.cycler].instances[id.instance].name.as_str();
    let writer = |id: &InstanceId, producer: usize| &robot.cyclers[id.cycler].nodes[producer].path;
    let own = |kind: &str, access: &Access, producer: usize| {
        format!("reads {kind}`{}` from `{}`", access.written, cycler.nodes[producer].path)
    };
    Some(match binding {
        CycleBinding::OwnOutput { access, producer, .. } => own("", access, *producer),
        CycleBinding::RequiredOwnOutput { access, producer, .. } => own("required ", access, *producer),
        CycleBinding::Previous { access, producer, .. } => own("previous ", access, *producer),
        CycleBinding::Historic { access, producer, .. } => own("historic ", access, *producer),
        CycleBinding::OutputOf { instance: id, access, producer, .. }
        | CycleBinding::Latest { instance: id, access, producer, .. } => {
            format!("reads latest `{}.{}` from `{}`", instance(id), access.written, writer(id, *producer))
        }
        CycleBinding::RequiredOutputOf { instance: id, access, producer, .. } => format!(
            "reads required latest `{}.{}` from `{}`",
            instance(id),
            access.written,
            writer(id, *producer)
        ),
        CycleBinding::Perception { instances, access, producer, .. } => {
            let from: Vec<String> =
                instances.iter().map(|id| format!("`{}.{}`", instance(id), access.written)).collect();
            let writer = writer(&instances[0], *producer);
            format!("reads in order of time {} from `{writer}`", from.join(", "))
        }
        CycleBinding::Parameter { access, .. } => format!("reads parameter `{}`", access.written),
        CycleBinding::CyclerState { access, shared: true, .. } => {
            format!("reads state `{}`", access.written)
        }
        CycleBinding::CyclerState { access, .. } => format!("writes state `{}`", access.written),
        CycleBinding::AdditionalOutput { access, data } => {
            format!("writes when subscribed `{}`: `{}`", access.written, data.text)
        }
        CycleBinding::Procedure { name, .. } => format!("answers procedure `{name}`"),
        CycleBinding::MainOutput { data } => format!("writes in place `{name}`: `{}`", data.text),
        CycleBinding::CycleTime | CycleBinding::HardwareInterface => return None,
    })
}

/// Why a node stands where it stands.
fn place(cycler: &Cycler, schedule: &CyclerSchedule, position: usize, node: &Node) -> String {
    let mut reasons: BTreeMap<usize, Vec<&Edge>> = BTreeMap::new();
    for edge in schedule.reasons(position) {
        reasons.entry(edge.from).or_default().push(edge);
    }
    if reasons.is_empty() {
        let part = if node.setup { "setup nodes" } else { "nodes" };
        return format!("waits for none of the {part}: stands here by the order of the manifest");
    }
    let reasons = reasons.into_iter().map(|(from, edges)| {
        let fields: Vec<String> = edges.into_iter().map(reason).collect();
        format!("`{}` ({})", cycler.nodes[from].path, fields.join(", "))
    });
    format!("after {}", reasons.collect::<Vec<_>>().join(", "))
}

fn reason(edge: &Edge) -> String {
    match edge.reason {
        Reason::CyclerState => format!("state `{}`", edge.path),
        Reason::Input | Reason::RequiredInput | Reason::HistoricInput => format!("`{}`", edge.path),
    }
}

/// Every output that other instances read, with its readers.
fn shared_outputs(robot: &Robot, position: usize, cycler: &Cycler) -> Vec<OutputText> {
    let outputs = cycler.outputs.iter().filter(|output| output.shared);
    outputs
        .map(|output| OutputText {
            name: output.name.clone(),
            data: output.data.text.clone(),
            writer: cycler.nodes[output.producer].path.clone(),
            readers: readers(robot, position, &output.name),
        })
        .collect()
}

fn readers(robot: &Robot, producing: usize, output: &str) -> Vec<String> {
    let mut readers = Vec::new();
    for cycler in &robot.cyclers {
        for node in &cycler.nodes {
            let reads = node.cycle.iter().filter_map(|field| match &field.binding {
                CycleBinding::Perception { instances, access, .. } => {
                    Some((instances.first()?.cycler, access, "in order of time"))
                }
                binding => latest_of(binding).map(|(id, access)| (id.cycler, access, "latest")),
            });
            for (from, access, how) in reads {
                let reader = format!("`{}` in `{}` ({how})", node.path, cycler.name);
                if from == producing && access.segments[0].name == output && !readers.contains(&reader) {
                    readers.push(reader);
                }
            }
        }
    }
    readers
}

fn list_parameters(
    tree: &Tree<crate::resolve::robot::Reader>,
    above: &str,
    parameters: &mut Vec<ParameterText>,
) {
    for branch in &tree.branches {
        let path = if above.is_empty() { branch.name.clone() } else { format!("{above}.{}", branch.name) };
        match &branch.content {
            Content::Leaf { data, users } => {
                let mut readers: Vec<String> = users.iter().map(|reader| format!("`{}`", reader.node)).collect();
                readers.sort();
                readers.dedup();
                parameters.push(ParameterText { path, data: data.text.clone(), readers });
            }
            Content::Inner(tree) | Content::Instance { tree, .. } => list_parameters(tree, &path, parameters),
        }
    }
}

/// As the manifest writes it.
fn on_failure(on_failure: OnFailure) -> &'static str {
    match on_failure {
        OnFailure::Stop => "stop",
        OnFailure::Restart => "restart",
        OnFailure::Skip => "skip",
        OnFailure::Hold => "hold",
    }
}

/// In the largest unit that says it in whole numbers.
fn duration(duration: Duration) -> String {
    let nanoseconds = duration.as_nanos();
    let units = [("s", 1_000_000_000), ("ms", 1_000_000), ("us", 1_000), ("ns", 1)];
    let (unit, length) = units
        .into_iter()
        .find(|(_, length)| nanoseconds % length == 0)
        .unwrap_or(("ns", 1));
    format!("{} {unit}", nanoseconds / length)
}
