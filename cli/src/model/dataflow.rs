//! `DATAFLOW.md`: the first file to read in a review.
//!
//! One line per fact, so that a change of a node changes the lines that say so and no others.

mod buffers;
mod nodes;

use std::time::Duration;

use serde::Serialize;

use super::{outside, package, sentences};
use crate::resolve::robot::{
    Content, Cycler, CyclerKind, InstanceId, OnFailure, Reader, Robot, Tree,
};
use crate::schedule::{CyclerSchedule, Schedule};
use buffers::{instance_text, shared_outputs};
use nodes::node_facts;

/// Of a cycler that a partial robot does without.
const LEFT_OUT: &str = "It is left out. Stubs stand in for the instances that are read; until one is fed nobody has written it.";

/// Of a cycler that another machine runs.
const FED: &str = "Another machine runs it and feeds the instances that are read; until one is fed nobody has written it.";

/// Who reads and writes what, in words.
#[derive(Clone, Debug, Serialize)]
pub struct Dataflow {
    /// Behind "Data flow of".
    pub title: String,
    pub header: &'static str,
    /// The command that writes it, if that is not the header's.
    pub command: Option<String>,
    pub cyclers: Vec<CyclerText>,
    /// Cyclers that are read and do not run here.
    pub outside: Vec<OutsideText>,
    pub parameters: Vec<ParameterText>,
    pub targets: Vec<TargetText>,
}

/// A section: one cycler.
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

/// A section: one cycler that does not run here, and what of it is read.
#[derive(Clone, Debug, Serialize)]
pub struct OutsideText {
    pub name: String,
    pub kind: &'static str,
    /// Who writes in its place.
    pub about: &'static str,
    pub instances: Vec<InstanceText>,
    pub outputs: Vec<OutputText>,
}

/// A row: one instance.
#[derive(Clone, Debug, Serialize)]
pub struct InstanceText {
    pub name: String,
    pub facts: Vec<String>,
    /// How many slots its buffer has, as a sum.
    pub slots: String,
}

/// A section: one node.
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

/// A row: one parameter.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterText {
    pub path: String,
    pub data: String,
    pub readers: Vec<String>,
}

/// A row: one target.
#[derive(Clone, Debug, Serialize)]
pub struct TargetText {
    pub name: String,
    pub hardware: String,
    pub feature: String,
    pub triple: String,
}

/// Decides what `DATAFLOW.md` says.
pub fn describe(robot: &Robot, schedule: &Schedule) -> Dataflow {
    let mut parameters = Vec::new();
    list_parameters(&robot.parameter_tree, "", &mut parameters);
    Dataflow {
        title: match &robot.partial {
            None => format!("the robot `{}`", robot.name),
            Some(partial) => format!(
                "the robot `{}` with {} alone",
                robot.name,
                sentences::and(&partial.only)
            ),
        },
        header: super::DO_NOT_EDIT,
        command: robot.partial.as_ref().map(|_| robot.command()),
        cyclers: robot
            .running()
            .map(|(position, cycler)| {
                cycler_text(robot, position, cycler, &schedule.cyclers[position])
            })
            .collect(),
        outside: outside::cyclers(robot)
            .map(|(position, cycler)| OutsideText {
                name: cycler.name.clone(),
                kind: sentences::kind(cycler.kind),
                about: if cycler.remote { FED } else { LEFT_OUT },
                instances: outside::instances(robot)
                    .into_iter()
                    .filter(|id| id.cycler == position)
                    .map(|id| instance_text(robot, id))
                    .collect(),
                outputs: shared_outputs(robot, position, cycler),
            })
            .collect(),
        parameters,
        targets: robot
            .targets
            .iter()
            .map(|target| TargetText {
                name: target.name.clone(),
                hardware: target.hardware.clone(),
                feature: package::feature(&target.name),
                triple: target
                    .triple
                    .clone()
                    .unwrap_or_else(|| "the host's".to_owned()),
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
    let instances = (0..cycler.instances.len()).map(|instance| InstanceId {
        cycler: position,
        instance,
    });
    CyclerText {
        name: cycler.name.clone(),
        kind: sentences::kind(cycler.kind),
        facts: cycler_facts(cycler),
        instances: instances.map(|id| instance_text(robot, id)).collect(),
        nodes: nodes.collect(),
        outputs: shared_outputs(robot, position, cycler),
    }
}

fn cycler_facts(cycler: &Cycler) -> Vec<String> {
    let mut facts = vec![format!("on failure: {}", on_failure(cycler.on_failure))];
    match cycler.kind {
        CyclerKind::Perception => {
            facts.push(format!(
                "pending timeout: {}",
                duration(cycler.pending_timeout)
            ));
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

fn list_parameters(tree: &Tree<Reader>, above: &str, parameters: &mut Vec<ParameterText>) {
    for branch in &tree.branches {
        let path = if above.is_empty() {
            branch.name.clone()
        } else {
            format!("{above}.{}", branch.name)
        };
        match &branch.content {
            Content::Leaf { data, users } => {
                let mut readers: Vec<String> = users
                    .iter()
                    .map(|reader| format!("`{}`", reader.node))
                    .collect();
                readers.sort();
                readers.dedup();
                parameters.push(ParameterText {
                    path,
                    data: data.text.clone(),
                    readers,
                });
            }
            Content::Inner(tree) | Content::Instance { tree, .. } => {
                list_parameters(tree, &path, parameters)
            }
        }
    }
}

fn instance_name(robot: &Robot, id: InstanceId) -> &str {
    &robot.cyclers[id.cycler].instances[id.instance].name
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
    let units = [
        ("s", 1_000_000_000),
        ("ms", 1_000_000),
        ("us", 1_000),
        ("ns", 1),
    ];
    let (unit, length) = units
        .into_iter()
        .find(|(_, length)| nanoseconds.is_multiple_of(*length))
        .unwrap_or(("ns", 1));
    format!("{} {unit}", nanoseconds / length)
}
