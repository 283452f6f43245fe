//! Loom's doubles of what the buffer takes from the standard library.

use loom::cell::UnsafeCell;
pub(super) use loom::sync::Arc;
pub(super) use loom::sync::atomic::{AtomicU32, AtomicU64, Ordering};
pub(super) use loom::thread::yield_now as relax;

/// A value whose accesses loom orders: each call counts as one, at that moment.
pub(super) struct Place<T>(UnsafeCell<T>);

impl<T> Place<T> {
    pub(super) fn new(value: T) -> Self {
        Self(UnsafeCell::new(value))
    }

    pub(super) fn shared(&self) -> *const T {
        self.0.with(|pointer| pointer)
    }

    pub(super) fn exclusive(&self) -> *mut T {
        self.0.with_mut(|pointer| pointer)
    }
}
