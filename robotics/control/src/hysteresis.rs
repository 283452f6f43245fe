//! Owns decisions that do not flutter: with a gap between two thresholds, and only after a while.

use serde::{Deserialize, Serialize};

/// Whether a value is above `threshold`; what has been above it only stops being so `hysteresis`
/// lower. What is no number is not above anything.
pub fn exceeds(value: f32, threshold: f32, hysteresis: f32, has_exceeded: bool) -> bool {
    if has_exceeded {
        value > threshold - hysteresis
    } else {
        value > threshold
    }
}

/// A yes or no that only changes when it has been contradicted without a break for a while.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct Debounced {
    value: bool,
    /// For how long it has been contradicted, in s.
    contradicted: Option<f32>,
}

impl Debounced {
    /// What was decided last; no at first.
    pub fn value(&self) -> bool {
        self.value
    }

    /// The decision `step` seconds after the one before; `delay` seconds after the first
    /// contradicting measurement it changes, at once where that is no positive number.
    pub fn update(&mut self, measured: bool, step: f32, delay: f32) -> bool {
        if measured == self.value {
            self.contradicted = None;
            return self.value;
        }
        // The time before the first contradiction contradicts nothing, however long it was.
        let contradicted = self.contradicted.map_or(0.0, |before| before + step);
        if contradicted < delay {
            self.contradicted = Some(contradicted);
        } else {
            *self = Self {
                value: measured,
                contradicted: None,
            };
        }
        self.value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_the_thresholds_everything_stays_as_it_is() {
        for has_exceeded in [false, true] {
            assert_eq!(exceeds(0.9, 1.0, 0.2, has_exceeded), has_exceeded);
        }
        assert!(exceeds(1.1, 1.0, 0.2, false));
        assert!(!exceeds(0.7, 1.0, 0.2, true));
        assert!(!exceeds(f32::NAN, 1.0, 0.2, true));
    }

    #[test]
    fn a_decision_changes_after_the_delay_and_not_before() {
        let mut decision = Debounced::default();
        for _ in 0..10 {
            assert!(!decision.update(true, 0.01, 0.095));
        }
        assert!(decision.update(true, 0.01, 0.095));
    }

    #[test]
    fn every_agreement_starts_the_delay_anew() {
        let mut decision = Debounced::default();
        for _ in 0..100 {
            decision.update(true, 0.01, 0.03);
            decision.update(true, 0.01, 0.03);
            decision.update(false, 0.01, 0.03);
        }
        assert!(!decision.value());
    }

    #[test]
    fn a_late_cycle_is_no_long_contradiction() {
        let mut decision = Debounced::default();
        assert!(!decision.update(true, 5.0, 0.1));
    }

    #[test]
    fn without_a_delay_decisions_follow_at_once() {
        for delay in [0.0, -1.0, f32::NAN] {
            assert!(Debounced::default().update(true, 0.0, delay));
        }
    }
}
