//! What a node reads, writes and asks for, and why it stands where it stands; one fact each.

use std::collections::BTreeMap;

use super::{instance_name, on_failure};
use crate::resolve::robot::{
    Access, CreationBinding, CycleBinding, Cycler, InstanceId, Node, OutputBinding, Robot,
};
use crate::schedule::{CyclerSchedule, Edge, Reason};

/// In the order in which the node declares them.
pub(super) fn node_facts(
    robot: &Robot,
    cycler: &Cycler,
    schedule: &CyclerSchedule,
    position: usize,
) -> Vec<String> {
    let node = &cycler.nodes[position];
    let mut facts = Vec::new();
    for field in &node.creation {
        if let CreationBinding::Parameter { access, .. } = &field.binding {
            facts.push(format!(
                "reads parameter `{}` when it is created",
                access.written
            ));
        }
    }
    for field in &node.cycle {
        facts.extend(field_fact(robot, cycler, &field.name, &field.binding));
    }
    for field in &node.outputs {
        facts.push(match &field.binding {
            OutputBinding::MainOutput { data } => {
                format!("writes `{}`: `{}`", field.name, data.text)
            }
            OutputBinding::CaptureTime => "gives the cycle its timestamp".to_owned(),
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
fn field_fact(
    robot: &Robot,
    cycler: &Cycler,
    name: &str,
    binding: &CycleBinding,
) -> Option<String> {
    if let Some((kind, access, producer)) = own_read(binding) {
        let (path, writer) = (&access.written, &cycler.nodes[producer].path);
        return Some(format!("reads {kind}`{path}` from `{writer}`"));
    }
    if let Some((kind, instances, access, producer)) = foreign_read(binding) {
        let path = |id: &InstanceId| format!("`{}.{}`", instance_name(robot, *id), access.written);
        let paths: Vec<String> = instances.iter().map(path).collect();
        let writer = &robot.cyclers[instances[0].cycler].nodes[producer].path;
        return Some(format!("reads {kind} {} from `{writer}`", paths.join(", ")));
    }
    let (deed, what) = match binding {
        CycleBinding::Parameter { access, .. } => ("reads parameter", &access.written),
        CycleBinding::CyclerState { access, shared, .. } => (
            if *shared {
                "reads state"
            } else {
                "writes state"
            },
            &access.written,
        ),
        CycleBinding::Procedure { name, .. } => ("answers procedure", name),
        CycleBinding::AdditionalOutput { access, data } => {
            let (path, data) = (&access.written, &data.text);
            return Some(format!("writes when subscribed `{path}`: `{data}`"));
        }
        CycleBinding::MainOutput { data } => {
            return Some(format!("writes in place `{name}`: `{}`", data.text));
        }
        _ => return None,
    };
    Some(format!("{deed} `{what}`"))
}

/// How an output of the own cycler is read, and of which node.
fn own_read(binding: &CycleBinding) -> Option<(&'static str, &Access, usize)> {
    Some(match binding {
        CycleBinding::OwnOutput {
            access, producer, ..
        } => ("", access, *producer),
        CycleBinding::RequiredOwnOutput {
            access, producer, ..
        } => ("required ", access, *producer),
        CycleBinding::Previous {
            access, producer, ..
        } => ("previous ", access, *producer),
        CycleBinding::Historic {
            access, producer, ..
        } => ("historic ", access, *producer),
        _ => return None,
    })
}

/// How an output of other instances is read, of which, and of which node.
fn foreign_read(binding: &CycleBinding) -> Option<(&'static str, &[InstanceId], &Access, usize)> {
    let one = std::slice::from_ref;
    Some(match binding {
        CycleBinding::OutputOf {
            instance,
            access,
            producer,
            ..
        }
        | CycleBinding::Latest {
            instance,
            access,
            producer,
            ..
        } => ("latest", one(instance), access, *producer),
        CycleBinding::RequiredOutputOf {
            instance,
            access,
            producer,
            ..
        } => ("required latest", one(instance), access, *producer),
        CycleBinding::Perception {
            instances,
            access,
            producer,
            ..
        } => ("in order of time", instances, access, *producer),
        _ => return None,
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
    // As the fields stand, so that the manifest's order does not move them.
    let mut reasons: Vec<_> = reasons.into_iter().collect();
    reasons.sort_by_key(|(_, edges)| edges.iter().map(|edge| edge.field).min());
    let reasons = reasons.into_iter().map(|(from, edges)| {
        let fields: Vec<String> = edges.into_iter().map(reason).collect();
        format!("`{}` ({})", cycler.nodes[from].path, fields.join(", "))
    });
    format!("after {}", reasons.collect::<Vec<_>>().join(", "))
}

fn reason(edge: &Edge) -> String {
    match edge.reason {
        Reason::CyclerState => format!("state `{}`", edge.path),
        Reason::Manifest => format!(
            "writes state `{}`, too, and stands first in the manifest",
            edge.path
        ),
        Reason::Input | Reason::RequiredInput | Reason::HistoricInput => format!("`{}`", edge.path),
    }
}
