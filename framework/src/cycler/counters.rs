//! Counts of one instance that others may read while it runs.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::scheduling::Granted;
use crate::time::Timestamp;

macro_rules! counters {
    ($($(#[doc = $doc:literal])+ $name:ident,)+) => {
        /// Counts of one instance; written by its thread, read by anybody.
        #[derive(Debug, Default)]
        pub struct Counters {
            $($(#[doc = $doc])+ pub $name: Counter,)+
            begun_at: AtomicU64,
            granted: OnceLock<Granted>,
        }

        /// The counts of one instance at one moment.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Counts {
            $($(#[doc = $doc])+ pub $name: u64,)+
        }

        impl Counters {
            /// All counts now.
            pub fn read(&self) -> Counts {
                Counts { $($name: self.$name.get(),)+ }
            }
        }
    };
}

counters! {
    /// Finished cycles.
    cycles,
    /// Begun cycles that were not finished.
    abandoned,
    /// Calls of nodes that failed, and failures outside any node.
    failures,
    /// Calls of nodes that did not happen because a required input was absent.
    skipped,
    /// Times that the setup nodes started over because nothing came.
    no_events,
    /// Cycles longer than the deadline.
    overruns,
    /// Times that nodes and states were created anew.
    restarts,
    /// Capture times that were replaced: in the future, too old, or not after the last.
    corrected,
    /// Lockstep: data that newer data replaced before the instance could begin.
    missed,
}

/// One count.
#[derive(Debug, Default)]
pub struct Counter(AtomicU64);

impl Counter {
    /// Counts `more`. Only one thread at a time counts, the instance's, so that no read-modify-write is needed.
    #[inline]
    pub fn add(&self, more: u64) {
        if more > 0 {
            self.0.store(self.get() + more, Ordering::Relaxed);
        }
    }

    /// The count now.
    #[inline]
    pub fn get(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

impl Counters {
    /// What the system gave its thread; `None` before it runs, and where nothing was asked.
    pub fn granted(&self) -> Option<&Granted> {
        self.granted.get()
    }

    /// A thread is asked for once; what it got at first stands.
    pub(crate) fn grant(&self, granted: Granted) {
        let _ = self.granted.set(granted);
    }

    /// When the cycle began that has not ended; for the watchdog.
    pub fn begun_at(&self) -> Option<Timestamp> {
        // One more than the time, so that zero is free to say that there is none.
        let begun_at = self.begun_at.load(Ordering::Relaxed);
        begun_at.checked_sub(1).map(Timestamp::from_nanos)
    }

    #[inline]
    pub(super) fn begin(&self, now: Timestamp) {
        self.begun_at
            .store(now.next().as_nanos(), Ordering::Relaxed);
    }

    #[inline]
    pub(super) fn end(&self) {
        self.begun_at.store(0, Ordering::Relaxed);
    }
}
