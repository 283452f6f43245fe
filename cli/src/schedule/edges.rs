//! Which fields make one node run after another.

use super::{Edge, Reason};
use crate::resolve::robot::{Access, CycleBinding, Cycler};

/// Every reason of one cycler, sorted.
pub(super) fn edges(cycler: &Cycler) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (to, node) in cycler.nodes.iter().enumerate() {
        for (field, declared) in node.cycle.iter().enumerate() {
            match &declared.binding {
                CycleBinding::OwnOutput {
                    access, producer, ..
                } => {
                    edges.push(edge(*producer, to, Reason::Input, field, access));
                }
                CycleBinding::RequiredOwnOutput {
                    access, producer, ..
                } => {
                    edges.push(edge(*producer, to, Reason::RequiredInput, field, access));
                }
                CycleBinding::Historic {
                    access, producer, ..
                } => {
                    edges.push(edge(*producer, to, Reason::HistoricInput, field, access));
                }
                CycleBinding::CyclerState {
                    access,
                    shared: true,
                    ..
                } => {
                    edges.extend(
                        writers(cycler, to, access)
                            .map(|from| edge(from, to, Reason::CyclerState, field, access)),
                    );
                }
                _ => {}
            }
        }
    }
    // A setup node that reads a node is a mistake of its own, and no ring.
    edges.retain(|edge| !cycler.nodes[edge.to].setup || cycler.nodes[edge.from].setup);
    edges.sort();
    edges
}

/// Nodes that write the state that `reader` reads, in its part of the cycle: between setup nodes
/// and nodes state orders nothing, a setup node sees what the cycle before left.
fn writers<'a>(
    cycler: &'a Cycler,
    reader: usize,
    read: &'a Access,
) -> impl Iterator<Item = usize> + 'a {
    let setup = cycler.nodes[reader].setup;
    let writes = move |binding: &CycleBinding| {
        matches!(binding, CycleBinding::CyclerState { access, shared: false, .. }
            if overlap(access, read))
    };
    cycler
        .nodes
        .iter()
        .enumerate()
        .filter(move |(writer, node)| *writer != reader && node.setup == setup)
        .filter(move |(_, node)| node.cycle.iter().any(|field| writes(&field.binding)))
        .map(|(writer, _)| writer)
}

/// Whether one path leads through the other.
pub(crate) fn overlap(left: &Access, right: &Access) -> bool {
    left.segments
        .iter()
        .zip(&right.segments)
        .all(|(left, right)| left.name == right.name)
}

fn edge(from: usize, to: usize, reason: Reason, field: usize, access: &Access) -> Edge {
    Edge {
        from,
        to,
        reason,
        field,
        path: access.written.clone(),
    }
}
