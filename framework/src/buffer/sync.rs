//! Atomics and cells of the standard library; the loom models bring their own module in its place.

use std::cell::UnsafeCell;
pub(super) use std::hint::spin_loop as relax;
pub(super) use std::sync::Arc;
pub(super) use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

/// A value that is read or written by whoever the word of its slot allows to.
pub(super) struct Place<T>(UnsafeCell<T>);

impl<T> Place<T> {
    pub(super) fn new(value: T) -> Self {
        Self(UnsafeCell::new(value))
    }

    /// For one who shares the slot.
    #[inline]
    pub(super) fn shared(&self) -> *const T {
        self.0.get()
    }

    /// For the one who has the slot alone.
    #[inline]
    pub(super) fn exclusive(&self) -> *mut T {
        self.0.get()
    }
}
