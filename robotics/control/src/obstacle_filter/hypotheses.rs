//! The places where something may stand, each a Kalman filter for a position that hardly changes.
//!
//! Invariant: the covariance of a place, `variance` times the identity, is positive definite while all numbers are finite.

use framework::{Timestamp, math};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::obstacles::ObstacleKind;

use super::ObstacleFilterParameters;
use crate::places::{self, Places};

/// More are not kept: the one that least speaks for makes room.
pub(super) const MOST_HYPOTHESES: usize = 16;

/// Something that stands in the start frame.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(super) struct Hypothesis {
    /// In m.
    pub(super) position: Point2<f32>,
    /// Of each coordinate, in m².
    variance: f32,
    /// How many measurements speak for it.
    pub(super) evidence: f32,
    pub(super) kind: ObstacleKind,
    pub(super) seen_at: Timestamp,
}

/// Where something stands, in the start frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measurement {
    /// In m.
    pub(super) position: Point2<f32>,
    /// One standard deviation, in m.
    pub(super) noise: f32,
    /// As how many measurements it counts.
    pub(super) evidence: f32,
    pub(super) kind: ObstacleKind,
}

/// Hypotheses as they are at one time.
pub(super) type Hypotheses = Places<Hypothesis, MOST_HYPOTHESES>;

impl Hypotheses {
    /// What becomes of them until `time`; nothing where that is in the past.
    pub(super) fn predict(&mut self, time: Timestamp, parameters: &ObstacleFilterParameters) {
        self.advance(time, |hypothesis, elapsed, now| {
            hypothesis.variance += math::powi(parameters.position_noise, 2) * elapsed;
            let silence = (now - hypothesis.seen_at).as_secs_f32();
            hypothesis.is_finite() && silence <= parameters.forget_after
        });
    }

    /// Gives what was measured at `seen_at` to the nearest hypothesis, or begins a new one.
    pub(super) fn learn(
        &mut self,
        measurement: &Measurement,
        seen_at: Timestamp,
        parameters: &ObstacleFilterParameters,
    ) {
        let distance =
            |hypothesis: &Hypothesis| (hypothesis.position - measurement.position).norm();
        let nearest = self
            .iter_mut()
            .map(|hypothesis| (distance(hypothesis), hypothesis))
            .filter(|(distance, _)| *distance <= parameters.same_place)
            .min_by(|(a, _), (b, _)| a.total_cmp(b));
        match nearest {
            Some((_, hypothesis)) => hypothesis.learn(measurement, seen_at, parameters),
            None => self.insert(Hypothesis {
                position: measurement.position,
                variance: measurement.variance(parameters),
                evidence: measurement.evidence,
                kind: measurement.kind,
                seen_at,
            }),
        }
    }
}

impl places::Hypothesis for Hypothesis {
    fn position(&self) -> Point2<f32> {
        self.position
    }

    fn evidence(&self) -> f32 {
        self.evidence
    }
}

impl Hypothesis {
    fn is_finite(&self) -> bool {
        let numbers = [
            self.position.x,
            self.position.y,
            self.variance,
            self.evidence,
        ];
        numbers.into_iter().all(f32::is_finite)
    }

    /// Moves towards the measurement; once a robot, always a robot.
    fn learn(
        &mut self,
        measurement: &Measurement,
        seen_at: Timestamp,
        parameters: &ObstacleFilterParameters,
    ) {
        let noise = measurement.variance(parameters);
        let expected = self.variance + noise;
        if !expected.is_finite() {
            return;
        }
        let gain = self.variance / expected;
        self.position += (measurement.position - self.position) * gain;
        // One less the gain, times the variance, but never rounded to nothing.
        self.variance = gain * noise;
        self.evidence = (self.evidence + measurement.evidence).min(parameters.most_evidence);
        self.seen_at = self.seen_at.max(seen_at);
        if measurement.kind == ObstacleKind::Robot {
            self.kind = ObstacleKind::Robot;
        }
    }
}

impl Measurement {
    /// Of each coordinate, in m².
    fn variance(&self, parameters: &ObstacleFilterParameters) -> f32 {
        math::powi(self.noise.max(parameters.least_noise), 2)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::testing::ParameterFile;
    use proptest::prelude::*;

    use super::*;

    /// After how many seconds something is perceived where, and how exactly: from the toes to the end of the field.
    fn measurements() -> impl Strategy<Value = Vec<(f32, [f32; 2], f32)>> {
        let place = prop::array::uniform2(-5.0_f32..5.0);
        let noise = prop_oneof![Just(0.0), 0.0_f32..1.0, Just(f32::INFINITY)];
        prop::collection::vec((0.0_f32..1.0, place, noise), 1..300)
    }

    proptest! {
        #[test]
        fn the_covariance_stays_positive_definite(measurements in measurements()) {
            let file = ParameterFile::new(include_str!("../../../parameters/default.toml"));
            let parameters: ObstacleFilterParameters = file.get("obstacle_filter");
            let mut hypotheses = Hypotheses::default();
            let mut now = Timestamp::ZERO;
            for (elapsed, [x, y], noise) in measurements {
                now = now + Duration::from_secs_f32(elapsed);
                hypotheses.predict(now, &parameters);
                let measurement = Measurement {
                    position: Point2::new(x, y),
                    noise,
                    evidence: 1.0,
                    kind: ObstacleKind::Unknown,
                };
                hypotheses.learn(&measurement, now, &parameters);
                for hypothesis in hypotheses.iter() {
                    prop_assert!(hypothesis.variance > 0.0, "{hypothesis:?}");
                }
            }
        }
    }
}
