//! Which nodes may begin in a cycle of which only a part runs: a replay of some nodes.

use std::cell::RefCell;

use crate::error::Stopped;

thread_local! {
    static WANTED: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

/// However the cycle ends, the next one has nodes of its own.
struct Forget;

impl Drop for Forget {
    fn drop(&mut self) {
        WANTED.take();
    }
}

/// Runs partial cycles of this thread up to the first node that is none of these.
pub(crate) fn only<T>(nodes: &[String], run: impl FnOnce() -> T) -> T {
    WANTED.set(nodes.to_vec());
    let _forget = Forget;
    run()
}

/// # Errors
/// [`Stopped`], if the node is none of those.
pub(super) fn may_begin(node: &str) -> Result<(), Stopped> {
    let is_wanted = WANTED.with_borrow(|wanted| wanted.iter().any(|one| one == node));
    if is_wanted { Ok(()) } else { Err(Stopped) }
}
