//! Where data comes from, and when.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use framework::Timestamp;

/// Data for one instance, in the order of the manifest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Source {
    TopEye,
    BottomEye,
    Ear,
    Body,
    Bumper,
    Metronome,
}

const ALL: [Source; 6] = [
    Source::TopEye,
    Source::BottomEye,
    Source::Ear,
    Source::Body,
    Source::Bumper,
    Source::Metronome,
];

/// Numbers of the next data of each source.
#[derive(Debug, Default)]
pub(crate) struct Sources {
    next: [u64; ALL.len()],
}

impl Source {
    /// The instance that waits for it.
    pub(crate) fn instance(self) -> &'static str {
        match self {
            Self::TopEye => "VisionTop",
            Self::BottomEye => "VisionBottom",
            Self::Ear => "Hearing",
            Self::Body => "Control",
            Self::Bumper => "Reflexes",
            Self::Metronome => "Lights",
        }
    }

    /// When the data of this number is ready.
    pub(crate) fn time(self, number: u64) -> Timestamp {
        let (first, period) = self.milliseconds();
        Timestamp::ZERO + Duration::from_millis(first + number * period)
    }

    /// When the first is ready, and how long it takes to the next.
    fn milliseconds(self) -> (u64, u64) {
        match self {
            Self::TopEye => (33, 33),
            Self::BottomEye => (50, 33),
            Self::Ear => (20, 20),
            Self::Body => (12, 12),
            Self::Bumper => (10, 10),
            Self::Metronome => (100, 100),
        }
    }
}

impl Sources {
    /// The source whose next data is ready first, and its number.
    pub(crate) fn next(&self) -> (Source, u64) {
        let numbered = ALL.into_iter().zip(self.next);
        numbered
            .min_by_key(|(source, number)| source.time(*number))
            .unwrap_or((ALL[0], 0))
    }

    /// The newest data that is ready now and was not taken, else the next.
    pub(crate) fn next_after(&self, source: Source, now: Timestamp) -> u64 {
        let (first, period) = source.milliseconds();
        let elapsed = (now - Timestamp::ZERO).as_millis() as u64;
        let newest = elapsed
            .checked_sub(first)
            .map_or(0, |elapsed| elapsed / period);
        newest.max(self.next[source as usize])
    }

    /// What comes after this number is next.
    pub(crate) fn advance(&mut self, source: Source, number: u64) {
        self.next[source as usize] = number + 1;
    }
}

/// Counters stay right whatever panicked.
pub(crate) fn locked(sources: &Mutex<Sources>) -> MutexGuard<'_, Sources> {
    sources.lock().unwrap_or_else(PoisonError::into_inner)
}
