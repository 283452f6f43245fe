//! Owns the pace of what is sent: never more often than wanted, nor than allowed.

use framework::Timestamp;
use serde::{Deserialize, Serialize};

/// When something was sent last.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(crate) struct Pace {
    sent_at: Option<Timestamp>,
}

impl Pace {
    /// Whether it is time again, `interval` s after the last time and not less than `least` s; then
    /// this is the last time, whether sending succeeds or not: a failure is no reason to send more
    /// often.
    pub(crate) fn is_due(&mut self, now: Timestamp, interval: f32, least: f32) -> bool {
        // An interval that is no number is the least one.
        let interval = interval.max(least);
        let is_due = self
            .sent_at
            .is_none_or(|sent_at| (now - sent_at).as_secs_f32() >= interval);
        if is_due {
            self.sent_at = Some(now);
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::at_millis;

    use super::*;

    #[test]
    fn it_is_time_after_the_interval_and_never_before_the_least_one() {
        for (interval, least, expected) in [
            (1.0, 0.5, [0, 1000, 2000]),
            (0.1, 0.5, [0, 500, 1000]),
            (f32::NAN, 0.5, [0, 500, 1000]),
        ] {
            let mut pace = Pace::default();
            let mut is_due = |millis: &u64| pace.is_due(at_millis(*millis), interval, least);
            let due: Vec<u64> = (0..=2000).step_by(100).filter(|at| is_due(at)).collect();
            assert_eq!(due[..3], expected, "every {interval} s");
        }
    }
}
