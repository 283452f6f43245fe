//! Panics of nodes: errors that name the node. Whoever catches one tells it, once, as any other failure.
//!
//! The standard hook prints three lines and a hint about backtraces for every panic, and it cannot know the instance. Outside
//! of instances whatever hook was installed before is called. Two panics at once end the process before anybody catches one:
//! those the hook tells.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{PanicHookInfo, set_hook, take_hook};
use std::sync::Once;
use std::thread::panicking;

use crate::error::Error;
use crate::guarded::OnFailure;
use crate::report::{flush, tell};

thread_local! {
    static INSIDE: Cell<Option<&'static str>> = const { Cell::new(None) };
    /// A panic that nobody is known to have caught yet.
    static IS_OPEN: Cell<bool> = const { Cell::new(false) };
    /// What it said.
    static LAST: RefCell<Option<String>> = const { RefCell::new(None) };
    static OF_NODE: Cell<Option<(&'static str, OnFailure)>> = const { Cell::new(None) };
}

/// While it lives, panics of this thread are those of the instance (or other part) with this name.
pub(super) struct Inside {
    before: Option<&'static str>,
}

#[inline]
pub(super) fn enter(name: &'static str) -> Inside {
    forget_caught();
    Inside {
        before: INSIDE.replace(Some(name)),
    }
}

impl Drop for Inside {
    #[inline]
    fn drop(&mut self) {
        INSIDE.set(self.before);
    }
}

/// Where nothing unwinds, the last panic was caught by the node that it was in: it is nobody else's, nor one of two at once.
#[inline]
pub(super) fn forget_caught() {
    if IS_OPEN.get() && !panicking() {
        IS_OPEN.set(false);
    }
}

/// The instance that this thread works for.
pub(super) fn inside() -> Option<&'static str> {
    INSIDE.get()
}

/// Leaves panics inside of instances to whoever catches them; once per process.
pub(super) fn install_hook() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |panic| match INSIDE.get() {
            Some(name) => {
                let message = describe(panic);
                let is_second = IS_OPEN.replace(true);
                let first = LAST.replace(Some(message.clone()));
                if let Some(first) = first.filter(|_| is_second) {
                    tell(format_args!("{name} {first}\n{name} {message}"));
                    flush();
                }
            }
            None => before(panic),
        }));
    });
}

/// The panic that unwinds on this thread comes from this node, unless it came from one inside of it.
pub(super) fn unwind_from(node: &'static str, on_failure: OnFailure) {
    let inner = OF_NODE.take();
    OF_NODE.set(inner.or(Some((node, on_failure))));
}

/// The panic that was just caught on this thread, as an error of the node that it comes from.
#[cold]
#[inline(never)]
pub(super) fn of_caught(caught: std::thread::Result<()>) -> Error {
    let error = match caught {
        Err(payload) => {
            let is_open = IS_OPEN.replace(false);
            let described = LAST.take().filter(|_| is_open);
            Error::new(described.unwrap_or_else(|| format!("panicked: {}", text(payload.as_ref()))))
        }
        Ok(()) => Error::new("ended without a result"),
    };
    match OF_NODE.take() {
        Some((node, on_failure)) => error.of_node(node, Some(on_failure)),
        None => error,
    }
}

fn describe(panic: &PanicHookInfo<'_>) -> String {
    let place = panic
        .location()
        .map_or_else(String::new, |place| format!(" at {place}"));
    format!("panicked{place}: {}", text(panic.payload()))
}

fn text(payload: &(dyn Any + Send)) -> &str {
    let borrowed = payload.downcast_ref::<&str>().copied();
    borrowed
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("without a message")
}
