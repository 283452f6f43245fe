//! The writing side of a buffer.

use super::slots::{Entry, Pen, Slots};
use super::sync::Arc;
use crate::time::Timestamp;

/// The only one who writes. Dropping it abandons a cycle that is announced.
pub struct Writer<T> {
    slots: Arc<Slots<T>>,
    pen: Pen,
    is_announced: bool,
}

impl<T> Writer<T> {
    pub(super) fn new(slots: Arc<Slots<T>>, pen: Pen) -> Self {
        Self {
            slots,
            pen,
            is_announced: false,
        }
    }

    /// The slot being written, with what some older cycle left in it, and the newest complete one.
    #[inline]
    pub fn slots(&mut self) -> (&mut T, &T) {
        let (writing, newest) = self.slots.both(&mut self.pen);
        (&mut writing.value, &newest.value)
    }

    /// The newest complete cycle.
    #[inline]
    pub fn newest(&self) -> &Entry<T> {
        self.slots.newest_of(&self.pen)
    }

    /// Tells consumers that a cycle with this timestamp is on its way.
    ///
    /// One that was announced before and not completed counts as abandoned.
    #[inline]
    pub fn announce(&mut self, timestamp: Timestamp) {
        self.abandon();
        self.is_announced = true;
        self.slots.announce(timestamp);
    }

    /// Publishes the slot: the newest for readers, the next in order for consumers.
    ///
    /// `cycle` counts from 1.
    #[inline]
    pub fn complete(&mut self, cycle: u64, timestamp: Timestamp) {
        let (writing, _) = self.slots.both(&mut self.pen);
        writing.cycle = cycle;
        writing.timestamp = timestamp;
        self.is_announced = false;
        self.slots.publish(&mut self.pen);
    }

    /// Withdraws the announcement, if there is one; the next cycle writes the slot again.
    #[inline]
    pub fn abandon(&mut self) {
        if self.is_announced {
            self.is_announced = false;
            self.slots.withdraw();
        }
    }

    /// How many slots there are, and the bytes of all of them, without what values own on the heap.
    pub fn size(&self) -> (usize, usize) {
        let slots = self.slots.len();
        (slots, slots * size_of::<Entry<T>>())
    }

    /// How many announced cycles were abandoned.
    pub fn abandoned(&self) -> u64 {
        self.slots.abandoned()
    }
}

impl<T> Drop for Writer<T> {
    fn drop(&mut self) {
        self.abandon();
    }
}
