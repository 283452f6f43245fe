//! When an instance may start anew, and when it has failed for good.

use std::collections::VecDeque;
use std::time::Duration;

use crate::time::Timestamp;

const FIRST_BACK_OFF: Duration = Duration::from_millis(100);
const LONGEST_BACK_OFF: Duration = Duration::from_secs(5);
/// So many failures ...
const TOO_MANY: usize = 5;
/// ... within this time are a failure for good; so long without one ends the doubling.
const WITHIN: Duration = Duration::from_secs(60);

/// The failures of one instance that asked for a restart.
#[derive(Debug)]
pub(super) struct Restarts {
    recent: VecDeque<Timestamp>,
    back_off: Duration,
}

impl Default for Restarts {
    fn default() -> Self {
        Self {
            recent: VecDeque::with_capacity(TOO_MANY),
            back_off: FIRST_BACK_OFF,
        }
    }
}

impl Restarts {
    /// When to start anew after a failure now; `None` if it was one too many.
    pub(super) fn after_failure(&mut self, now: Timestamp) -> Option<Timestamp> {
        while self
            .recent
            .front()
            .is_some_and(|oldest| now - *oldest >= WITHIN)
        {
            self.recent.pop_front();
        }
        if self.recent.is_empty() {
            self.back_off = FIRST_BACK_OFF;
        }
        self.recent.push_back(now);
        if self.recent.len() >= TOO_MANY {
            return None;
        }
        let at = now + self.back_off;
        self.back_off = (self.back_off * 2).min(LONGEST_BACK_OFF);
        Some(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: u64) -> Timestamp {
        Timestamp::ZERO + Duration::from_secs(seconds)
    }

    #[test]
    fn the_fifth_failure_in_a_minute_is_one_too_many() {
        let mut restarts = Restarts::default();
        let delays: Vec<_> = (0..4)
            .map(|second| {
                restarts
                    .after_failure(at(second))
                    .map(|end| end - at(second))
            })
            .collect();
        let expected = [100, 200, 400, 800].map(|millis| Some(Duration::from_millis(millis)));
        assert_eq!(delays, expected);
        assert_eq!(restarts.after_failure(at(59)), None);
    }

    #[test]
    fn the_back_off_doubles_to_five_seconds_and_a_quiet_minute_ends_it() {
        let mut restarts = Restarts::default();
        let mut longest = Duration::ZERO;
        for failure in 0..20 {
            let now = at(failure * 20);
            longest = restarts
                .after_failure(now)
                .expect("three in a minute are allowed")
                - now;
        }
        assert_eq!(longest, Duration::from_secs(5));
        let later = at(20 * 20 + 60);
        assert_eq!(restarts.after_failure(later), Some(later + FIRST_BACK_OFF));
    }
}
