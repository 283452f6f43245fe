//! The consuming side of a buffer: every complete cycle, in order.

use std::collections::VecDeque;

use super::slots::{Entry, Slots, Taken};
use super::sync::Arc;
use crate::time::Timestamp;

/// Takes every complete cycle once, in order, and keeps up to its window of them.
pub struct Queue<T> {
    slots: Arc<Slots<T>>,
    /// Which of the consumers of the slots it is.
    consumer: usize,
    /// Sequence number of the cycle to take next.
    next: u32,
    window: usize,
    held: VecDeque<Taken>,
    dropped: u64,
}

impl<T> Queue<T> {
    pub(super) fn new(slots: Arc<Slots<T>>, consumer: usize, next: u32, window: usize) -> Self {
        Self {
            slots,
            consumer,
            next,
            window,
            held: VecDeque::with_capacity(window),
            dropped: 0,
        }
    }

    /// Timestamp of the cycle that is on its way.
    ///
    /// Ask before [`take`](Self::take): what is not announced any more is abandoned or can be taken.
    #[inline]
    pub fn announced(&self) -> Option<Timestamp> {
        self.slots.announced()
    }

    /// Takes the next complete cycle and keeps it; `None` if there is none or the window is full.
    #[inline]
    pub fn take(&mut self) -> Option<&Entry<T>> {
        let completed = self.slots.completed();
        self.skip_unlisted(completed);
        while waiting(self.next, completed) > 0 {
            if self.is_full() {
                if self.slots.can_take(self.consumer, self.next) {
                    return None;
                }
            } else if let Some(held) = self.slots.take(self.consumer, self.next) {
                self.next = self.next.wrapping_add(1);
                self.held.push_back(held);
                return self.get(self.held.len() - 1);
            }
            self.next = self.next.wrapping_add(1);
            self.dropped += 1;
        }
        None
    }

    /// A cycle that was taken and not released, oldest first.
    #[inline]
    pub fn get(&self, index: usize) -> Option<&Entry<T>> {
        Some(self.slots.read_taken(self.held.get(index)?))
    }

    /// Lets go of the `count` oldest.
    #[inline]
    pub fn release(&mut self, count: usize) {
        let mut last = None;
        for _ in 0..count.min(self.held.len()) {
            last = self.held.pop_front();
        }
        if let Some(last) = last {
            self.slots.release_up_to(self.consumer, last);
        }
    }

    /// How many cycles are complete and not taken; some of them may be overwritten already.
    #[inline]
    pub fn waiting(&self) -> usize {
        waiting(self.next, self.slots.completed())
    }

    /// How many it has taken and not released.
    #[inline]
    pub fn len(&self) -> usize {
        self.held.len()
    }

    /// Whether it keeps none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// Whether it keeps as many as it can.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.held.len() == self.window
    }

    /// How many it can keep.
    #[inline]
    pub fn window(&self) -> usize {
        self.window
    }

    /// Cycles that were overwritten before they were taken.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Announced cycles that were abandoned.
    pub fn abandoned(&self) -> u64 {
        self.slots.abandoned()
    }

    /// Goes on to the oldest cycle that is still listed, without looking for each.
    #[inline]
    fn skip_unlisted(&mut self, completed: u32) {
        let waiting = waiting(self.next, completed);
        let listed = self.slots.listed_cycles();
        if waiting > listed {
            let lost = waiting - listed;
            self.dropped += lost as u64;
            self.next = self.next.wrapping_add(lost as u32);
        }
    }
}

/// Cycles from `next` to `completed`; sequence numbers start over after the last.
#[inline]
fn waiting(next: u32, completed: u32) -> usize {
    completed.wrapping_add(1).wrapping_sub(next) as usize
}

impl<T> Drop for Queue<T> {
    fn drop(&mut self) {
        // Who is gone must not keep slots; what stays queued for it, the writer takes when it must.
        self.release(self.held.len());
    }
}
