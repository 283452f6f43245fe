//! The clock that everything in one robot goes by: real in the threads driver, virtual in lockstep.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use rustix::time::{ClockId, clock_gettime};

use crate::error::{Error, Result};
use crate::stop::Stop;
use crate::time::Timestamp;
use crate::timing::blocking;

/// The one clock of a robot. Clones are the same clock.
#[derive(Clone, Debug)]
pub struct Clock(Source);

#[derive(Clone, Debug)]
enum Source {
    /// Nanoseconds of the system's monotonic clock.
    Wall {
        start: u64,
    },
    Stepped {
        now: Arc<AtomicU64>,
    },
    /// What a replay shows, and the system's clock at its start.
    Shown {
        now: Arc<AtomicU64>,
        start: u64,
    },
}

impl Clock {
    /// Monotonic time, from zero now.
    pub fn wall() -> Self {
        Self(Source::Wall { start: monotonic() })
    }

    /// Virtual time for lockstep, from zero; only the driver moves it.
    pub fn stepped() -> Self {
        Self(Source::Stepped {
            now: Arc::default(),
        })
    }

    /// The time that a replay shows, which goes wherever clients send it.
    pub(crate) fn shown(time: Timestamp) -> Self {
        Self(Source::Shown {
            now: Arc::new(AtomicU64::new(time.as_nanos())),
            start: monotonic(),
        })
    }

    /// Whether time is virtual: then nothing may wait for it.
    pub fn is_stepped(&self) -> bool {
        matches!(self.0, Source::Stepped { .. })
    }

    /// What tells virtual time from that of other robots, as long as it exists; clones have the same.
    pub(crate) fn identity(&self) -> Option<usize> {
        match &self.0 {
            Source::Wall { .. } | Source::Shown { .. } => None,
            Source::Stepped { now } => Some(Arc::as_ptr(now).addr()),
        }
    }

    /// Time since the start of the run.
    #[inline]
    pub fn now(&self) -> Timestamp {
        match &self.0 {
            Source::Wall { start } => Timestamp::from_nanos(monotonic().saturating_sub(*start)),
            Source::Stepped { now } | Source::Shown { now, .. } => {
                Timestamp::from_nanos(now.load(Ordering::Relaxed))
            }
        }
    }

    /// Time that never goes back, for rates: that of the system where a replay shows another.
    pub(crate) fn passed(&self) -> Timestamp {
        match &self.0 {
            Source::Shown { start, .. } => {
                Timestamp::from_nanos(monotonic().saturating_sub(*start))
            }
            _ => self.now(),
        }
    }

    /// Waits until `time` on a wall clock, counted as blocked; [`crate::Stopped`] if the robot is stopped meanwhile.
    ///
    /// On a stepped clock nothing ever waits: an error if the time has not come.
    pub fn wait_until(&self, time: Timestamp, stop: &Stop) -> Result<()> {
        match &self.0 {
            Source::Wall { .. } => Ok(blocking(|| stop.wait(time - self.now()))?),
            Source::Stepped { .. } if self.now() >= time => Ok(stop.check()?),
            Source::Stepped { .. } | Source::Shown { .. } => Err(Error::new(format!(
                "would have to wait until {time}, which lockstep cannot: it is {}",
                self.now()
            ))),
        }
    }

    /// Shows another time, in a replay.
    pub(crate) fn show(&self, time: Timestamp) {
        if let Source::Shown { now, .. } = &self.0 {
            now.store(time.as_nanos(), Ordering::Relaxed);
        }
    }

    /// Moves virtual time ahead, never back.
    pub(crate) fn advance_to(&self, time: Timestamp) {
        if let Source::Stepped { now } = &self.0 {
            now.fetch_max(time.as_nanos(), Ordering::Relaxed);
        }
    }
}

/// Nanoseconds of the system's monotonic clock. Asked directly: an `Instant` costs twice as much to subtract as to read.
#[inline]
fn monotonic() -> u64 {
    let now = clock_gettime(ClockId::Monotonic);
    // Neither is negative, and seconds since the machine started leave room for nanoseconds.
    now.tv_sec as u64 * 1_000_000_000 + now.tv_nsec as u64
}
