//! What a cycle sees of the newest cycle of another instance.

use std::ops::Deref;
use std::time::Duration;

use super::slots::Entry;
use crate::time::Timestamp;

/// The cycle that a reader holds. Before the first one it shows the initial value.
#[derive(Debug)]
pub struct View<'a, T> {
    entry: &'a Entry<T>,
    is_new: bool,
}

/// A value of another instance with its origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Latest<V> {
    /// What the instance wrote.
    pub value: V,
    /// Timestamp of the cycle that wrote it.
    pub timestamp: Timestamp,
    /// Number of the cycle that wrote it.
    pub cycle: u64,
    /// Timestamp of the reading cycle minus `timestamp`, zero if that is the later one.
    pub age: Duration,
    /// Whether the reading instance's previous cycle saw an older one, or none.
    pub is_new: bool,
}

impl<'a, T> View<'a, T> {
    #[inline]
    pub(super) fn new(entry: &'a Entry<T>, is_new: bool) -> Self {
        Self { entry, is_new }
    }

    /// The value, if a cycle has written it.
    #[inline]
    pub fn written(self) -> Option<&'a T> {
        (self.entry.cycle != 0).then_some(&self.entry.value)
    }

    /// The value, for as long as the reader is not asked to take again.
    #[inline]
    pub fn value(self) -> &'a T {
        &self.entry.value
    }

    /// Number of the cycle that wrote it; 0 before the first.
    #[inline]
    pub fn cycle(self) -> u64 {
        self.entry.cycle
    }

    /// Timestamp of the cycle that wrote it.
    #[inline]
    pub fn timestamp(self) -> Timestamp {
        self.entry.timestamp
    }

    /// Whether the reading instance's previous cycle saw an older one, or none.
    #[inline]
    pub fn is_new(self) -> bool {
        self.is_new
    }

    /// One value with its origin as a cycle at `now` sees it; `None` before the first cycle.
    #[inline]
    pub fn latest<V>(self, now: Timestamp, path: impl FnOnce(&'a T) -> V) -> Option<Latest<V>> {
        let value = self.written()?;
        Some(Latest {
            value: path(value),
            timestamp: self.entry.timestamp,
            cycle: self.entry.cycle,
            age: now - self.entry.timestamp,
            is_new: self.is_new,
        })
    }
}

impl<T> Clone for View<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for View<'_, T> {}

impl<T> Deref for View<'_, T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        &self.entry.value
    }
}
