//! Rings of nodes that wait for each other, reported whole.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::ops::Range;

use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;

use super::{Edge, Graph, Reason};
use crate::diagnostics::{Code, Diagnostic, Label};
use crate::resolve::robot::Cycler;

/// One ring of every knot of nodes: the shortest through the knot's first node of the manifest.
/// The first edge starts at that node, each other one where the edge before ends.
pub(super) fn rings(graph: &Graph) -> Vec<Vec<Edge>> {
    let mut rings: Vec<Vec<Edge>> = petgraph::algo::tarjan_scc(graph)
        .into_iter()
        .filter_map(|knot| {
            let knot: BTreeSet<NodeIndex> = knot.into_iter().collect();
            ring_through(graph, *knot.first()?, &knot)
        })
        .collect();
    rings.sort();
    rings
}

/// The shortest way from a node back to itself, if there is one.
fn ring_through(graph: &Graph, start: NodeIndex, knot: &BTreeSet<NodeIndex>) -> Option<Vec<Edge>> {
    let mut reached_by: BTreeMap<NodeIndex, &Edge> = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(node) = queue.pop_front() {
        let mut outgoing: Vec<_> = graph
            .edges(node)
            .map(|edge| (edge.target(), edge.weight()))
            .collect();
        outgoing.sort_by_key(|(_, edge)| *edge);
        for (target, edge) in outgoing {
            if !knot.contains(&target) || reached_by.contains_key(&target) {
                continue;
            }
            reached_by.insert(target, edge);
            if target == start {
                return Some(way_back(&reached_by, start));
            }
            queue.push_back(target);
        }
    }
    None
}

fn way_back(reached_by: &BTreeMap<NodeIndex, &Edge>, start: NodeIndex) -> Vec<Edge> {
    let mut ring = Vec::new();
    let mut node = start;
    loop {
        let edge = reached_by[&node];
        ring.push(edge.clone());
        node = NodeIndex::new(edge.from);
        if node == start {
            ring.reverse();
            return ring;
        }
    }
}

/// The ring as a diagnostic: the whole ring in its message, the field of every edge as a place.
pub(super) fn describe(cycler: &Cycler, ring: &[Edge]) -> Diagnostic {
    let message = format!(
        "nodes of cycler `{}` wait for each other: {}",
        cycler.name,
        whole(cycler, ring)
    );
    let is_input = |edge: &Edge| edge.reason != Reason::CyclerState;
    let deed = match ring.iter().any(is_input) {
        true => {
            "break the ring where a value of the cycle before is good enough: write \
             `PreviousInput` in place of one of these inputs"
        }
        false => {
            "break the ring where a value of the cycle before is good enough: write one of these \
             states as a `MainOutput`, and read it as a `PreviousInput`"
        }
    };
    let mut diagnostic = Diagnostic::new(Code::DependencyCycle, message).help(deed);
    let range = |edge: &Edge| cycler.nodes[edge.to].cycle[edge.field].range.clone();
    let labels = ring.iter().map(|edge| label(cycler, edge, range(edge)));
    diagnostic.spans = labels.collect();
    diagnostic
}

/// As [`describe`], of a ring whose edges are fields of creation contexts.
pub(super) fn describe_creation(cycler: &Cycler, ring: &[Edge]) -> Diagnostic {
    let message = format!(
        "nodes of cycler `{}` wait for each other when they are created: {}",
        cycler.name,
        whole(cycler, ring)
    );
    let range = |edge: &Edge| cycler.nodes[edge.to].creation[edge.field].range.clone();
    let labels = ring.iter().map(|edge| label(cycler, edge, range(edge)));
    let mut diagnostic = Diagnostic::new(Code::DependencyCycle, message)
        .help("break the ring: let one of these nodes read the state in its cycle, or compute it from parameters");
    diagnostic.spans = labels.collect();
    diagnostic
}

fn whole(cycler: &Cycler, ring: &[Edge]) -> String {
    let path = |node: usize| cycler.nodes[node].path.as_str();
    let mut whole = format!("`{}`", path(ring[0].from));
    for edge in ring {
        whole.push_str(&format!(" → `{}`", path(edge.to)));
    }
    whole
}

fn label(cycler: &Cycler, edge: &Edge, range: Range<usize>) -> Label {
    let (from, to) = (&cycler.nodes[edge.from], &cycler.nodes[edge.to]);
    let what = match edge.reason {
        Reason::Input | Reason::RequiredInput | Reason::HistoricInput => "reads",
        Reason::CyclerState | Reason::Manifest => "reads the state",
    };
    Label {
        file: to.file.clone(),
        range,
        text: format!(
            "`{}` {what} `{}` after `{}` wrote it",
            to.path, edge.path, from.path
        ),
    }
}
