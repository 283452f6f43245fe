//! Writers of one cycler state that nothing but the manifest orders.

use petgraph::algo::has_path_connecting;
use petgraph::graph::NodeIndex;

use super::Graph;
use super::edges::overlap;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::resolve::robot::{Access, CycleBinding, Cycler, Field, Node};

/// Warns of each pair of writers once, where the later one writes.
pub(super) fn warn(cycler: &Cycler, graph: &Graph, diagnostics: &mut Diagnostics) {
    for (later, second) in cycler.nodes.iter().enumerate() {
        for (earlier, first) in cycler.nodes[..later].iter().enumerate() {
            let (from, to) = (NodeIndex::new(earlier), NodeIndex::new(later));
            // Setup nodes run before all nodes.
            let ordered = first.setup != second.setup
                || has_path_connecting(graph, from, to, None)
                || has_path_connecting(graph, to, from, None);
            if !ordered && let Some((one, other)) = common_state(first, second) {
                diagnostics.add(describe(first, one, second, other));
            }
        }
    }
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
