//! One place where the ball may lie: a Kalman filter for its position and velocity.

use framework::{Timestamp, math};
use nalgebra::{Matrix2, Matrix2x4, Matrix4, Matrix4x2, Point2, Vector2, Vector4};
use serde::{Deserialize, Serialize};

use super::BallFilterParameters;
use crate::low_pass;
use crate::places::{self, Hypothesis as _};

/// A ball in the start frame, and how well it is known.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(super) struct Hypothesis {
    /// Position in m, velocity in m/s.
    mean: Vector4<f32>,
    covariance: Matrix4<f32>,
    /// How many sightings speak for it, older ones less.
    pub(super) validity: f32,
    pub(super) seen_at: Timestamp,
    /// Images since then that would have shown it and did not.
    pub(super) missed: u32,
    /// Whether the image that is looked at shows it: it shows a ball once.
    pub(super) is_shown: bool,
}

/// Where a camera saw a ball, in the start frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sighting {
    /// In m.
    pub(super) position: Point2<f32>,
    /// Covariance in m².
    pub(super) noise: Matrix2<f32>,
    pub(super) seen_at: Timestamp,
}

impl Hypothesis {
    /// At rest where it was seen, as far as anybody knows.
    pub(super) fn seen_first(sighting: &Sighting, parameters: &BallFilterParameters) -> Self {
        Self {
            mean: Vector4::new(sighting.position.x, sighting.position.y, 0.0, 0.0),
            covariance: covariance(sighting.noise, parameters),
            validity: 1.0,
            seen_at: sighting.seen_at,
            missed: 0,
            is_shown: true,
        }
    }

    /// In m/s; zero where it is so slow that it may as well be noise.
    pub(super) fn velocity(&self, parameters: &BallFilterParameters) -> Vector2<f32> {
        let velocity = Vector2::new(self.mean.z, self.mean.w);
        if velocity.norm() >= parameters.resting_speed {
            velocity
        } else {
            Vector2::zeros()
        }
    }

    /// Of the position, in m².
    pub(super) fn position_covariance(&self) -> Matrix2<f32> {
        self.covariance.fixed_view::<2, 2>(0, 0).into_owned()
    }

    pub(super) fn is_finite(&self) -> bool {
        let numbers = self.mean.iter().chain(&self.covariance);
        numbers.copied().all(f32::is_finite) && self.validity.is_finite()
    }

    /// What becomes of it in so many seconds: it rolls, slower and slower, unless it rests.
    pub(super) fn predict(&mut self, elapsed: f32, parameters: &BallFilterParameters) {
        let kept = low_pass::left(elapsed, parameters.rolling_time);
        let reach = parameters.rolling_time * (1.0 - kept);
        let step = self.velocity(parameters) * reach;
        self.mean.x += step.x;
        self.mean.y += step.y;
        self.mean.z *= kept;
        self.mean.w *= kept;

        let mut transition = Matrix4::identity();
        (transition[(0, 2)], transition[(1, 3)]) = (reach, reach);
        (transition[(2, 2)], transition[(3, 3)]) = (kept, kept);
        self.covariance = transition * self.covariance * transition.transpose();
        let position_noise = math::powi(parameters.position_noise, 2) * elapsed;
        let velocity_noise = math::powi(parameters.velocity_noise, 2) * elapsed;
        for (index, noise) in [
            position_noise,
            position_noise,
            velocity_noise,
            velocity_noise,
        ]
        .into_iter()
        .enumerate()
        {
            self.covariance[(index, index)] += noise;
        }
        self.validity *= low_pass::left(elapsed, parameters.validity_time);
    }

    /// How far away the sighting is, in standard deviations of where it was expected.
    pub(super) fn deviation(&self, sighting: &Sighting) -> Option<f32> {
        let expected = (self.position_covariance() + sighting.noise).try_inverse()?;
        let error = sighting.position - self.position();
        Some(error.dot(&(expected * error)).sqrt())
    }

    /// Moves towards the sighting, and believes more in itself.
    pub(super) fn learn(&mut self, sighting: &Sighting, parameters: &BallFilterParameters) {
        if self
            .deviation(sighting)
            .is_some_and(|deviation| deviation > parameters.gate)
        {
            self.forget_velocity(parameters);
        }
        let expected = self.position_covariance() + sighting.noise;
        let Some(inverse) = expected.try_inverse() else {
            return;
        };
        let of_position: Matrix4x2<f32> = self.covariance.fixed_columns::<2>(0).into_owned();
        let gain: Matrix4x2<f32> = of_position * inverse;
        self.mean += gain * (sighting.position - self.position());
        let by_position: Matrix2x4<f32> = of_position.transpose();
        let covariance = self.covariance - gain * by_position;
        self.covariance = (covariance + covariance.transpose()) * 0.5;
        self.validity = (self.validity + 1.0).min(parameters.most_validity);
        // An image that arrives late is no reason to forget a younger one.
        self.seen_at = self.seen_at.max(sighting.seen_at);
        self.missed = 0;
        self.is_shown = true;
    }

    /// Believes less in itself: an image does not show it where it would have to.
    pub(super) fn miss(&mut self, parameters: &BallFilterParameters) {
        self.validity *= parameters.missed_validity;
        self.missed = self.missed.saturating_add(1);
    }

    /// A ball that was kicked or stopped: nobody knows how fast it is now.
    fn forget_velocity(&mut self, parameters: &BallFilterParameters) {
        let position = self.position_covariance();
        self.covariance = covariance(position, parameters);
    }
}

impl places::Hypothesis for Hypothesis {
    fn position(&self) -> Point2<f32> {
        Point2::new(self.mean.x, self.mean.y)
    }

    fn evidence(&self) -> f32 {
        self.validity
    }
}

/// Of a ball with a velocity that nobody knows.
fn covariance(position: Matrix2<f32>, parameters: &BallFilterParameters) -> Matrix4<f32> {
    let speed_variance = math::powi(parameters.initial_speed, 2);
    let mut covariance = Matrix4::from_diagonal_element(speed_variance);
    covariance.fixed_view_mut::<2, 2>(0, 0).copy_from(&position);
    covariance
}

#[cfg(test)]
mod tests {
    use framework::testing::ParameterFile;
    use proptest::prelude::*;

    use super::super::noise;
    use super::*;

    /// After how many seconds a ball is seen where, seen from the start: it jumps, which is a kick or another ball.
    fn sightings() -> impl Strategy<Value = Vec<(f32, [f32; 2])>> {
        let seen = (0.0_f32..1.0, prop::array::uniform2(-9.0_f32..9.0));
        prop::collection::vec(seen, 1..300)
    }

    proptest! {
        #[test]
        fn the_covariance_stays_symmetric_and_positive_definite(sightings in sightings()) {
            let file = ParameterFile::new(include_str!("../../../parameters/default.toml"));
            let parameters: BallFilterParameters = file.get("ball_filter");
            let mut ball: Option<Hypothesis> = None;
            for (elapsed, [x, y]) in sightings {
                let position = Point2::new(x, y);
                let sighting = Sighting {
                    position,
                    noise: noise(position.coords, &parameters),
                    seen_at: Timestamp::ZERO,
                };
                let ball = ball.get_or_insert_with(|| Hypothesis::seen_first(&sighting, &parameters));
                ball.predict(elapsed, &parameters);
                let predicted = ball.covariance;
                ball.learn(&sighting, &parameters);
                prop_assert!(ball.is_finite());
                for covariance in [predicted, ball.covariance] {
                    let asymmetry = (covariance - covariance.transpose()).abs().max();
                    prop_assert!(asymmetry <= 1e-6 * covariance.max(), "{}", covariance);
                    prop_assert!(covariance.cholesky().is_some(), "{}", covariance);
                }
            }
        }
    }
}
