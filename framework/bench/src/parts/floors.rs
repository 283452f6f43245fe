//! The least that handing over a value can cost: what the framework's parts are compared with.
//!
//! Both promise less than the framework does: the rotating buffer has no queues, the ring has one consumer and blocks its
//! writer where the framework drops the oldest. One thread is both sides here, so values are lent by `&mut` and what is
//! measured is the protocol: every atomic operation that two threads would need.

use std::sync::atomic::{AtomicU32, AtomicU64, AtomicUsize, Ordering};

const SLOTS: usize = 4;

/// Slots of which one is the newest: the writer takes one that nobody reads, a reader counts itself in and out.
pub(super) struct Rotating<T> {
    values: [T; SLOTS],
    readers: [AtomicU32; SLOTS],
    newest: AtomicUsize,
}

impl<T> Rotating<T> {
    pub(super) fn new(value: impl Fn() -> T) -> Self {
        Self {
            values: std::array::from_fn(|_| value()),
            readers: Default::default(),
            newest: AtomicUsize::new(0),
        }
    }

    #[inline]
    pub(super) fn write(&mut self, write: impl FnOnce(&mut T)) {
        let newest = self.newest.load(Ordering::Relaxed);
        let mut slot = newest;
        loop {
            slot = (slot + 1) % SLOTS;
            if slot != newest && self.readers[slot].load(Ordering::SeqCst) == 0 {
                break;
            }
        }
        write(&mut self.values[slot]);
        // Readers count themselves in before they look again, the writer looks at the counts after this.
        self.newest.swap(slot, Ordering::SeqCst);
    }

    #[inline]
    pub(super) fn read(&self, read: impl FnOnce(&T)) {
        let slot = loop {
            let slot = self.newest.load(Ordering::SeqCst);
            self.readers[slot].fetch_add(1, Ordering::SeqCst);
            if self.newest.load(Ordering::SeqCst) == slot {
                break slot;
            }
            self.readers[slot].fetch_sub(1, Ordering::Release);
        };
        read(&self.values[slot]);
        self.readers[slot].fetch_sub(1, Ordering::Release);
    }
}

/// A ring between one writer and one consumer, and the time of what is on its way.
pub(super) struct Ring<T> {
    values: Vec<T>,
    written: AtomicUsize,
    consumed: AtomicUsize,
    announced: AtomicU64,
}

impl<T> Ring<T> {
    pub(super) fn new(length: usize, value: impl Fn() -> T) -> Self {
        Self {
            values: (0..length).map(|_| value()).collect(),
            written: AtomicUsize::new(0),
            consumed: AtomicUsize::new(0),
            announced: AtomicU64::new(u64::MAX),
        }
    }

    #[inline]
    pub(super) fn announce(&mut self, nanos: u64) {
        self.announced.store(nanos, Ordering::Release);
    }

    #[inline]
    pub(super) fn complete(&mut self, write: impl FnOnce(&mut T)) {
        let written = self.written.load(Ordering::Relaxed);
        let is_full = written - self.consumed.load(Ordering::Acquire) == self.values.len();
        assert!(!is_full, "it is consumed at once");
        let place = written & (self.values.len() - 1);
        write(&mut self.values[place]);
        self.written.store(written + 1, Ordering::Release);
        self.announced.store(u64::MAX, Ordering::Release);
    }

    #[inline]
    pub(super) fn consume(&mut self, read: impl FnOnce(&T)) {
        let consumed = self.consumed.load(Ordering::Relaxed);
        let _pending = self.announced.load(Ordering::Acquire);
        if self.written.load(Ordering::Acquire) > consumed {
            read(&self.values[consumed & (self.values.len() - 1)]);
            self.consumed.store(consumed + 1, Ordering::Release);
        }
    }
}
