//! Why one node runs before another.

mod page;

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, VecDeque};

use camino::Utf8PathBuf;
use serde::Serialize;

use super::nodes::{self, Place};
use crate::graph::{Edge as GraphEdge, Graph};
use crate::outcome::Refusal;
use crate::pipeline::Understood;
use crate::resolve::robot::{Cycler, Robot};
use crate::schedule::{CyclerSchedule, Edge, Reason};

pub(super) use page::text;

/// What there is to say about two nodes.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    version: u32,
    /// In every cycler that has both.
    orders: Vec<Order>,
    /// If none has.
    apart: Option<Apart>,
}

#[derive(Debug, PartialEq, Eq, Serialize)]
struct Order {
    cycler: String,
    first: Stop,
    second: Stop,
    /// From the first node to the second.
    steps: Vec<Step>,
}

/// A node with its place in the cycle, from 0.
#[derive(Debug, PartialEq, Eq, Serialize)]
struct Stop {
    node: String,
    order: usize,
}

/// Why one node runs before another one.
#[derive(Debug, PartialEq, Eq, Serialize)]
struct Step {
    before: String,
    after: String,
    #[serde(flatten)]
    why: Why,
}

#[derive(Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "why", rename_all = "kebab-case")]
enum Why {
    /// A field of the later node reads what the earlier one writes.
    Field {
        field: String,
        kind: &'static str,
        path: String,
        file: Utf8PathBuf,
        line: usize,
    },
    /// Both write this state, and the earlier one stands first in the manifest.
    Writers {
        field: String,
        path: String,
        file: Utf8PathBuf,
        line: usize,
    },
    /// Setup nodes run first.
    Setup,
    /// Nothing orders them, and it stands first.
    Manifest,
}

/// Nodes of different cyclers.
#[derive(Debug, Serialize)]
struct Apart {
    nodes: [String; 2],
    cyclers: [String; 2],
    /// Between the two.
    edges: Vec<GraphEdge>,
}

/// Looks both nodes up and says which runs first, in whichever order they were named.
pub(super) fn explain(
    understood: &Understood,
    graph: &Graph,
    names: [&str; 2],
) -> Result<Answer, Refusal> {
    let robot = &understood.robot;
    let (one, other) = (nodes::find(robot, names[0])?, nodes::find(robot, names[1])?);
    let mut orders = Vec::new();
    for a in &one {
        for b in other
            .iter()
            .filter(|b| b.cycler == a.cycler && b.node != a.node)
        {
            let schedule = &understood.schedule.cyclers[a.cycler];
            orders.push(order(a.cycler(), schedule, a.node, b.node));
        }
    }
    let apart = match (one.first(), other.first()) {
        (Some(a), Some(b)) if orders.is_empty() => Some(apart(robot, graph, *a, *b)?),
        _ => None,
    };
    Ok(Answer {
        version: 1,
        orders,
        apart,
    })
}

fn order(cycler: &Cycler, schedule: &CyclerSchedule, one: usize, other: usize) -> Order {
    let place = |node: usize| schedule.place(node).unwrap_or_default();
    let (first, second) = if place(one) < place(other) {
        (one, other)
    } else {
        (other, one)
    };
    let stop = |node: usize| Stop {
        node: cycler.nodes[node].path.clone(),
        order: place(node),
    };
    let reasons = Reasons { cycler, schedule };
    Order {
        cycler: cycler.name.clone(),
        first: stop(first),
        second: stop(second),
        steps: reasons.steps(first, second),
    }
}

struct Reasons<'a> {
    cycler: &'a Cycler,
    schedule: &'a CyclerSchedule,
}

impl Reasons<'_> {
    /// From a node to one that runs later.
    fn steps(&self, first: usize, second: usize) -> Vec<Step> {
        if let Some(chain) = self.chain(first, second) {
            return chain.into_iter().map(|edge| self.field(edge)).collect();
        }
        let nodes = &self.cycler.nodes;
        if nodes[first].setup != nodes[second].setup {
            return vec![self.step(first, second, Why::Setup)];
        }
        // A node that stands first and runs later waits for one that runs between the two.
        let place = self.schedule.place(first);
        let waits = self.schedule.reasons(second);
        let waits = waits.filter(|edge| self.schedule.place(edge.from) > place);
        match waits.min_by_key(|edge| self.schedule.place(edge.from)) {
            Some(edge) if second < first => {
                let mut steps = self.steps(first, edge.from);
                steps.push(self.field(edge));
                steps
            }
            _ => vec![self.step(first, second, Why::Manifest)],
        }
    }

    /// The shortest way along edges.
    fn chain(&self, first: usize, second: usize) -> Option<Vec<&Edge>> {
        let mut reached_by: BTreeMap<usize, &Edge> = BTreeMap::new();
        let mut queue = VecDeque::from([first]);
        while let Some(node) = queue.pop_front() {
            for edge in self.schedule.edges.iter().filter(|edge| edge.from == node) {
                if let Entry::Vacant(unreached) = reached_by.entry(edge.to) {
                    unreached.insert(edge);
                    queue.push_back(edge.to);
                }
            }
        }
        let mut chain = vec![*reached_by.get(&second)?];
        while chain[0].from != first {
            chain.insert(0, reached_by.get(&chain[0].from)?);
        }
        Some(chain)
    }

    fn field(&self, edge: &Edge) -> Step {
        let reader = &self.cycler.nodes[edge.to];
        let field = &reader.cycle[edge.field];
        let (name, path) = (field.name.clone(), edge.path.clone());
        let (file, line) = (reader.file.clone(), field.line);
        let why = match edge.reason {
            Reason::Manifest => Why::Writers {
                field: name,
                path,
                file,
                line,
            },
            _ => Why::Field {
                field: name,
                kind: edge.reason.kind(),
                path,
                file,
                line,
            },
        };
        self.step(edge.from, edge.to, why)
    }

    fn step(&self, before: usize, after: usize, why: Why) -> Step {
        let path = |node: usize| self.cycler.nodes[node].path.clone();
        Step {
            before: path(before),
            after: path(after),
            why,
        }
    }
}

fn apart(robot: &Robot, graph: &Graph, one: Place<'_>, other: Place<'_>) -> Result<Apart, Refusal> {
    let (a, b) = (one.node(), other.node());
    if a.path == b.path {
        let message = format!("`{}` is one node", a.path);
        return Err(Refusal::wrong_usage(message).help("name two nodes"));
    }
    let is = |edge: &GraphEdge, from: &str, to: &str| edge.from.node == from && edge.to.node == to;
    let between = |edge: &&GraphEdge| is(edge, &a.path, &b.path) || is(edge, &b.path, &a.path);
    Ok(Apart {
        nodes: [a.path.clone(), b.path.clone()],
        cyclers: [one.cycler, other.cycler].map(|cycler| robot.cyclers[cycler].name.clone()),
        edges: graph.edges.iter().filter(between).cloned().collect(),
    })
}

#[cfg(test)]
mod tests;
