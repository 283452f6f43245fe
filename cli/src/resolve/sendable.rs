//! Whether every node can move to the thread of its cycler, where that can be known.

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::scan::{NodeSource, Sources};

/// Adds an error for each field of a state that surely keeps its node on one thread; the number of states of which
/// nobody but rustc can tell whether they do.
pub(super) fn check_states<'a>(
    nodes: impl Iterator<Item = &'a NodeSource>,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) -> usize {
    let mut unknown = 0;
    for node in nodes {
        let state = &node.signatures.node;
        let found = sources.library.tied_state(&node.module, state);
        unknown += usize::from(found.is_unknown);
        for tied in found.fields {
            let message = format!("the node `{state}` cannot be moved to the thread of its cycler");
            let blame = match &tied.within {
                Some(within) => format!("`{}` in `{within}` is not `Send`", tied.what),
                None => format!("`{}` is not `Send`", tied.what),
            };
            let error = Diagnostic::new(Code::UnsendableState, message)
                .at(node.file(), tied.range, blame)
                .help("keep something in its place that is `Send`: `Arc` for `Rc`, `Mutex` for `RefCell` in an `Arc`, `dyn Trait + Send`");
            diagnostics.add(error);
        }
    }
    unknown
}
