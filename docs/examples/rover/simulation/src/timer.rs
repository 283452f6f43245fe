//! A sense with a fixed period.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::Timestamp;

/// When its samples are there.
pub(crate) struct Timer {
    period: Duration,
    /// When the next sample is read, and when lockstep is told about the next.
    next: Mutex<(Timestamp, Timestamp)>,
}

impl Timer {
    pub(crate) fn new(period: Duration) -> Self {
        let first = Timestamp::ZERO + period;
        Self {
            period,
            next: Mutex::new((first, first)),
        }
    }

    /// The time of the newest sample that is ready and was not read, else of the next.
    pub(crate) fn read(&self, now: Timestamp) -> Timestamp {
        let mut next = self.lock();
        let mut at = next.0;
        while at + self.period <= now {
            at = at + self.period;
        }
        next.0 = at + self.period;
        at
    }

    pub(crate) fn next_event(&self) -> Timestamp {
        self.lock().1
    }

    pub(crate) fn tell_event(&self) -> Timestamp {
        let mut next = self.lock();
        let at = next.1;
        next.1 = at + self.period;
        at
    }

    /// Two times cannot be half done.
    fn lock(&self) -> MutexGuard<'_, (Timestamp, Timestamp)> {
        self.next.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
