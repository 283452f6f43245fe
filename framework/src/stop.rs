//! The signal that ends a run, shared by whoever may ask for it and whoever waits.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::error::Stopped;

/// Asks everything that belongs to one robot to come to an end, in order. Clones are the same signal.
#[derive(Clone, Debug, Default)]
pub struct Stop {
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    requested: AtomicBool,
    lock: Mutex<()>,
    changed: Condvar,
}

impl Stop {
    /// A signal that nobody has given yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks for the stop and wakes everybody who waits; a second time changes nothing.
    pub fn request(&self) {
        let _guard = self
            .shared
            .lock
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        self.shared.requested.store(true, Ordering::Release);
        self.shared.changed.notify_all();
    }

    /// Whether somebody asked for the stop.
    #[inline]
    pub fn is_requested(&self) -> bool {
        self.shared.requested.load(Ordering::Acquire)
    }

    /// [`Stopped`] once somebody asked for the stop; for loops in hardware interfaces.
    pub fn check(&self) -> Result<(), Stopped> {
        if self.is_requested() {
            Err(Stopped)
        } else {
            Ok(())
        }
    }

    /// Waits for at most `duration` on the wall clock; returns early, with [`Stopped`], when somebody asks for the stop.
    pub fn wait(&self, duration: Duration) -> Result<(), Stopped> {
        let end = Instant::now().checked_add(duration);
        let mut guard = self
            .shared
            .lock
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        loop {
            self.check()?;
            // Without an end (a duration beyond the clock's range) an hour at a time is as good.
            let left = end.map_or(Duration::from_secs(3600), |end| {
                end.saturating_duration_since(Instant::now())
            });
            if left.is_zero() {
                return Ok(());
            }
            let waited = self.shared.changed.wait_timeout(guard, left);
            guard = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}
