//! In which order the nodes of a cycler are created: that of the manifest, but who reads a state there after who writes it.
//!
//! Setup nodes and nodes are created together, so state orders them as it orders nodes among themselves.

use petgraph::graph::NodeIndex;

use super::edges::overlap;
use super::{Edge, Graph, Reason, first_ready, graph, rings, writers};
use crate::diagnostics::{Diagnostics, Reported};
use crate::resolve::robot::{Access, CreationBinding, Cycler, Node};

/// Positions of the nodes in the order they are created.
///
/// # Errors
/// Nodes that wait for each other are a `dependency-cycle`.
pub(super) fn order(
    cycler: &Cycler,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<usize>, Reported> {
    let mut graph = graph(cycler, &edges(cycler));
    let mut reported = None;
    for ring in rings::rings(&graph) {
        reported = Some(diagnostics.fail(rings::describe_creation(cycler, &ring)));
    }
    if let Some(reported) = reported {
        return Err(reported);
    }
    keep_order(cycler, &mut graph);
    let mut placed = vec![false; cycler.nodes.len()];
    let mut order = Vec::with_capacity(cycler.nodes.len());
    while let Some(node) = first_ready(&graph, &mut placed, |_| true) {
        order.push(node);
    }
    Ok(order)
}

/// Readers of a state after all who write it. An edge's `field` is one of the creation context.
fn edges(cycler: &Cycler) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (to, node) in cycler.nodes.iter().enumerate() {
        for (field, read) in states(node, true) {
            let writes = |from: &usize| {
                *from != to
                    && states(&cycler.nodes[*from], false).any(|(_, one)| overlap(one, read))
            };
            edges.extend((0..cycler.nodes.len()).filter(writes).map(|from| Edge {
                from,
                to,
                reason: Reason::CyclerState,
                field,
                path: read.written.clone(),
            }));
        }
    }
    edges.sort();
    edges
}

/// Writers of one state whom nothing else orders keep the order of the manifest, whatever else they wait for.
fn keep_order(cycler: &Cycler, graph: &mut Graph) {
    let nodes = &cycler.nodes;
    for earlier in 0..nodes.len() {
        for later in earlier + 1..nodes.len() {
            let common = states(&nodes[earlier], false).find_map(|(_, one)| {
                states(&nodes[later], false).find(|(_, other)| overlap(one, other))
            });
            let Some((field, access)) = common else {
                continue;
            };
            if writers::is_ordered(graph, earlier, later) {
                continue;
            }
            let edge = Edge {
                from: earlier,
                to: later,
                reason: Reason::Manifest,
                field,
                path: access.written.clone(),
            };
            graph.add_edge(NodeIndex::new(earlier), NodeIndex::new(later), edge);
        }
    }
}

/// The states that a node reads, or writes, when it is created: position of the field, and path.
fn states(node: &Node, reads: bool) -> impl Iterator<Item = (usize, &Access)> {
    let fields = node.creation.iter().enumerate();
    fields.filter_map(move |(position, field)| match &field.binding {
        CreationBinding::CyclerState { access, shared, .. } if *shared == reads => {
            Some((position, access))
        }
        _ => None,
    })
}
