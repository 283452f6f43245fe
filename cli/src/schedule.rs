//! In which order the nodes of each cycler run, and why: stage ④, from [`Robot`] to [`Schedule`].
//!
//! Setup nodes come first, then nodes; within each, again and again the node that is ready and
//! stands first in the manifest, so that a new node never moves unrelated lines. petgraph's own
//! topological sort promises no such order and is therefore not used.
//!
//! Writers of one state whom no input orders keep the order of the manifest, whatever else they wait for.
//!
//! Nodes are created in an order of their own, by the states of their creation contexts.
//!
//! Invariant: every node stands in the order of its cycler exactly once.

mod creation;
mod edges;
mod rings;
mod writers;

use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::EdgeRef;
use serde::Serialize;

use crate::diagnostics::{Diagnostics, Reported};
use crate::resolve::robot::{Cycler, Robot};

pub(crate) use edges::overlap;

/// The order of the nodes of every cycler, in the order of [`Robot::cyclers`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Schedule {
    pub cyclers: Vec<CyclerSchedule>,
}

/// The order of one cycler's nodes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CyclerSchedule {
    /// Positions in [`Cycler::nodes`] in the order they run, setup nodes first.
    pub order: Vec<usize>,
    /// The same positions in the order the nodes are created.
    pub creation: Vec<usize>,
    /// Why a node runs after another, sorted.
    pub edges: Vec<Edge>,
}

/// One node runs after another because of one field.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Edge {
    /// Position of the node that runs first.
    pub from: usize,
    /// Position of the node that waits for it.
    pub to: usize,
    pub reason: Reason,
    /// Position in the cycle context of `to` of the field that asks for it.
    pub field: usize,
    /// The output or state that is read, as written.
    pub path: String,
}

/// The kind of field that makes one node run after another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Reason {
    /// This cycle's value.
    Input,
    /// This cycle's value, which must be present.
    RequiredInput,
    /// Values by time, this cycle's included.
    HistoricInput,
    /// A `CyclerState` that is only read runs after the nodes that write it.
    CyclerState,
    /// Both write one state, and `from` stands first in the manifest.
    Manifest,
}

impl Reason {
    /// The kind of field, as its author writes it.
    pub fn kind(self) -> &'static str {
        match self {
            Self::Input => "Input",
            Self::RequiredInput => "RequiredInput",
            Self::HistoricInput => "HistoricInput",
            Self::CyclerState | Self::Manifest => "CyclerState",
        }
    }
}

impl CyclerSchedule {
    /// Why this node does not run earlier: the edges that end at it.
    pub fn reasons(&self, node: usize) -> impl Iterator<Item = &Edge> {
        self.edges.iter().filter(move |edge| edge.to == node)
    }

    /// Where this node stands in the order, from 0.
    pub fn place(&self, node: usize) -> Option<usize> {
        self.order.iter().position(|placed| *placed == node)
    }
}

/// Orders the nodes of every cycler.
///
/// # Errors
/// Every ring of nodes that wait for each other is a `dependency-cycle`.
pub fn schedule(robot: &Robot, diagnostics: &mut Diagnostics) -> Result<Schedule, Reported> {
    let mut cyclers = Vec::new();
    let mut reported = None;
    for cycler in &robot.cyclers {
        let mut edges = edges::edges(cycler);
        let mut graph = graph(cycler, &edges);
        for ring in rings::rings(&graph) {
            reported = Some(diagnostics.fail(rings::describe(cycler, &ring)));
        }
        writers::warn(cycler, &graph, diagnostics);
        edges.extend(writers::keep_order(cycler, &mut graph));
        edges.sort();
        match creation::order(cycler, diagnostics) {
            Ok(creation) => cyclers.push(CyclerSchedule {
                order: order(cycler, &graph),
                creation,
                edges,
            }),
            Err(ring) => reported = Some(ring),
        }
    }
    match reported {
        Some(reported) => Err(reported),
        None => Ok(Schedule { cyclers }),
    }
}

type Graph = DiGraph<usize, Edge>;

fn graph(cycler: &Cycler, edges: &[Edge]) -> Graph {
    let mut graph = Graph::new();
    for node in 0..cycler.nodes.len() {
        graph.add_node(node);
    }
    for edge in edges {
        graph.add_edge(
            NodeIndex::new(edge.from),
            NodeIndex::new(edge.to),
            edge.clone(),
        );
    }
    graph
}

/// Again and again the first ready node. Nodes of a ring are never ready and are left out.
fn order(cycler: &Cycler, graph: &Graph) -> Vec<usize> {
    let mut order = Vec::with_capacity(cycler.nodes.len());
    let mut placed = vec![false; cycler.nodes.len()];
    for setup in [true, false] {
        let is_part = |node: usize| cycler.nodes[node].setup == setup;
        while let Some(node) = first_ready(graph, &mut placed, is_part) {
            order.push(node);
        }
    }
    order
}

/// Places the first node of the manifest that waits for none that is not placed.
fn first_ready(
    graph: &Graph,
    placed: &mut [bool],
    is_part: impl Fn(usize) -> bool,
) -> Option<usize> {
    let is_ready = |node: usize| {
        graph
            .edges_directed(NodeIndex::new(node), petgraph::Direction::Incoming)
            .all(|edge| placed[edge.source().index()])
    };
    let mut nodes = 0..placed.len();
    let next = nodes.find(|node| is_part(*node) && !placed[*node] && is_ready(*node))?;
    placed[next] = true;
    Some(next)
}

#[cfg(test)]
mod tests;
