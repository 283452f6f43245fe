//! Writers of one cycler state that nothing but the manifest orders: told, and kept in its order.

use petgraph::algo::has_path_connecting;
use petgraph::graph::NodeIndex;

use super::edges::overlap;
use super::{Edge, Graph, Reason};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::resolve::robot::{Access, CycleBinding, Cycler, Field, Node};

/// Warns of each pair of writers once, where the later one writes.
pub(super) fn warn(cycler: &Cycler, graph: &Graph, diagnostics: &mut Diagnostics) {
    let pairs = pairs(cycler).filter(|pair| !is_ordered(graph, pair.earlier, pair.later));
    let mut pairs: Vec<_> = pairs.collect();
    pairs.sort_by_key(|pair| (pair.later, pair.earlier));
    for Pair {
        earlier,
        later,
        one,
        other,
    } in pairs
    {
        let (first, second) = (&cycler.nodes[earlier], &cycler.nodes[later]);
        diagnostics.add(describe(first, one, second, other));
    }
}

/// Orders writers of one state as the manifest has them where nothing else does, and gives the new edges.
///
/// One pair after the other, as the manifest has them: a pair that the edges before have ordered,
/// either way, is left alone, so that no ring arises.
pub(super) fn keep_order(cycler: &Cycler, graph: &mut Graph) -> Vec<Edge> {
    let mut added = Vec::new();
    for pair in pairs(cycler) {
        if is_ordered(graph, pair.earlier, pair.later) {
            continue;
        }
        let (field, access) = pair.other;
        let fields = &cycler.nodes[pair.later].cycle;
        let edge = Edge {
            from: pair.earlier,
            to: pair.later,
            reason: Reason::Manifest,
            field: (fields.iter().position(|one| std::ptr::eq(one, field))).unwrap_or_default(),
            path: access.written.clone(),
        };
        let (from, to) = (NodeIndex::new(edge.from), NodeIndex::new(edge.to));
        graph.add_edge(from, to, edge.clone());
        added.push(edge);
    }
    added
}

/// Two nodes of one part of the cycle that write one state.
pub(super) struct Pair<'a> {
    pub(super) earlier: usize,
    pub(super) later: usize,
    one: Write<'a>,
    other: Write<'a>,
}

/// By the earlier node, then by the later one. Setup nodes run before all nodes, so they make no pair with one.
pub(super) fn pairs(cycler: &Cycler) -> impl Iterator<Item = Pair<'_>> {
    let nodes = &cycler.nodes;
    (0..nodes.len()).flat_map(move |earlier| {
        (earlier + 1..nodes.len()).filter_map(move |later| {
            let (first, second) = (&nodes[earlier], &nodes[later]);
            let (one, other) = common_state(first, second)?;
            (first.setup == second.setup).then_some(Pair {
                earlier,
                later,
                one,
                other,
            })
        })
    })
}

pub(super) fn is_ordered(graph: &Graph, one: usize, other: usize) -> bool {
    let (one, other) = (NodeIndex::new(one), NodeIndex::new(other));
    has_path_connecting(graph, one, other, None) || has_path_connecting(graph, other, one, None)
}

/// The fields with which both write one state.
fn common_state<'a>(first: &'a Node, second: &'a Node) -> Option<(Write<'a>, Write<'a>)> {
    writes(first).find_map(|one| {
        let other = writes(second).find(|other| overlap(one.1, other.1))?;
        Some((one, other))
    })
}

type Write<'a> = (&'a Field<CycleBinding>, &'a Access);

fn writes(node: &Node) -> impl Iterator<Item = Write<'_>> {
    node.cycle.iter().filter_map(|field| match &field.binding {
        CycleBinding::CyclerState {
            access,
            shared: false,
            ..
        } => Some((field, access)),
        _ => None,
    })
}

fn describe(first: &Node, one: Write<'_>, second: &Node, other: Write<'_>) -> Diagnostic {
    let state = &other.1.written;
    Diagnostic::new(
        Code::UnorderedStateWriters,
        format!(
            "`{}` and `{}` write the cycler state `{state}`, and only the manifest orders them",
            first.path, second.path
        ),
    )
    .at(&second.file, other.0.range.clone(), "written here, too")
    .at(&first.file, one.0.range.clone(), "written here")
    .help(format!(
        "let one of them read an output of the other, or write `CyclerState<&T, \"{state}\">` where it is only read"
    ))
}
