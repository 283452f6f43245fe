//! When somebody who speaks at equal intervals speaks next.

use std::time::Duration;

use framework::Timestamp;

/// Equal intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rhythm {
    first: Duration,
    period: Duration,
    count: u64,
}

impl Rhythm {
    pub(super) const fn new(first: Duration, period: Duration) -> Self {
        Self {
            first,
            period,
            count: 0,
        }
    }

    /// When it is time again.
    pub(super) fn due(&self) -> Timestamp {
        let passed = Duration::from_nanos(self.period.as_nanos() as u64 * self.count);
        Timestamp::ZERO + self.first + passed
    }

    /// Goes on to the next time; how many there were before.
    pub(super) fn advance(&mut self) -> u64 {
        self.count += 1;
        self.count - 1
    }

    /// Leaves out what has passed.
    pub(super) fn skip_to(&mut self, now: Timestamp) {
        let passed = (now - Timestamp::ZERO).saturating_sub(self.first);
        let missed = passed.as_nanos().div_ceil(self.period.as_nanos()) as u64;
        self.count = self.count.max(missed);
    }
}
