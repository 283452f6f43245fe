//! Makes one call of one node fail; `tests/tests/failures.rs` puts a call of [`strike`] into each.

use std::cell::RefCell;

/// The next call of this node fails.
#[derive(Clone, Debug)]
pub struct Fault {
    pub node: String,
    pub panics: bool,
}

thread_local! {
    static FAULT: RefCell<Option<Fault>> = const { RefCell::new(None) };
}

/// In lockstep every node runs on this thread.
pub fn arm(fault: Fault) {
    FAULT.set(Some(fault));
}

/// Whether nobody has called the node since it was armed.
pub fn is_armed() -> bool {
    FAULT.with_borrow(Option::is_some)
}

pub(crate) fn strike(node: &str) -> Result<(), &'static str> {
    let armed = FAULT.with_borrow(|fault| fault.as_ref().is_some_and(|fault| fault.node == node));
    if !armed {
        return Ok(());
    }
    match FAULT.take() {
        Some(fault) if fault.panics => panic!("struck"),
        _ => Err("struck"),
    }
}
