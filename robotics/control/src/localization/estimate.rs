//! Owns `Estimate`, where the robot believes itself: a Gaussian over x, y and heading in the field frame.
//!
//! Extended Kalman filter; Joseph's form of the update keeps the covariance positive definite whatever
//! is measured (Bar-Shalom, Li and Kirubarajan 2001, section 5.2.3).
//!
//! Invariant: the covariance is symmetric and positive definite while all numbers are finite.

use nalgebra::{Isometry2, Matrix2, Matrix3, RowVector3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use crate::angle::wrap;

/// x and y in m, the heading in rad.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Estimate {
    pub(super) mean: Vector3<f32>,
    pub(super) covariance: Matrix3<f32>,
}

/// How wrong one number of a measurement is, and what it says about the pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Innovation {
    /// What was measured less what was expected.
    pub(super) residual: f32,
    /// How the expectation changes with x, y and heading.
    pub(super) gradient: RowVector3<f32>,
    /// Of the measurement, in the square of its unit.
    pub(super) variance: f32,
}

impl Estimate {
    /// Known so well: one standard deviation of each coordinate in m, and of the heading in rad.
    pub(super) fn new(pose: Isometry2<f32>, position_noise: f32, heading_noise: f32) -> Self {
        let deviations = Vector3::new(position_noise, position_noise, heading_noise);
        Self {
            mean: pose.translation.vector.push(pose.rotation.angle()),
            covariance: Matrix3::from_diagonal(&deviations.component_mul(&deviations)),
        }
    }

    /// From the ground frame to the field frame.
    pub(super) fn pose(&self) -> Isometry2<f32> {
        Isometry2::new(self.mean.xy(), self.mean.z)
    }

    pub(super) fn is_finite(&self) -> bool {
        let numbers = self.mean.iter().chain(self.covariance.iter());
        numbers.copied().all(f32::is_finite)
    }

    /// The robot has moved so in its own frame; `noise` are the variances of x, y and heading of that.
    pub(super) fn predict(&mut self, movement: &Isometry2<f32>, noise: &Vector3<f32>) {
        let rotation = self.pose().rotation;
        let moved: Vector2<f32> = rotation * movement.translation.vector;
        self.mean.x += moved.x;
        self.mean.y += moved.y;
        self.mean.z = wrap(self.mean.z + movement.rotation.angle());
        let mut transition = Matrix3::identity();
        transition[(0, 2)] = -moved.y;
        transition[(1, 2)] = moved.x;
        let turn: Matrix2<f32> = rotation.to_rotation_matrix().into_inner();
        let mut added = Matrix3::from_diagonal(noise);
        let planar = turn * Matrix2::from_diagonal(&noise.xy()) * turn.transpose();
        added.fixed_view_mut::<2, 2>(0, 0).copy_from(&planar);
        let covariance = transition * self.covariance * transition.transpose() + added;
        self.covariance = (covariance + covariance.transpose()) * 0.5;
    }

    /// Learns one number.
    pub(super) fn learn(&mut self, innovation: &Innovation) {
        let Innovation {
            residual,
            gradient,
            variance,
        } = *innovation;
        let seen: Vector3<f32> = self.covariance * gradient.transpose();
        let expected = (gradient * seen).x + variance;
        if expected <= 0.0 || !expected.is_finite() {
            return;
        }
        let gain = seen / expected;
        self.mean += gain * residual;
        self.mean.z = wrap(self.mean.z);
        let kept = Matrix3::identity() - gain * gradient;
        let covariance =
            kept * self.covariance * kept.transpose() + gain * gain.transpose() * variance;
        self.covariance = (covariance + covariance.transpose()) * 0.5;
    }

    /// How far two numbers together are off, in standard deviations squared of what was expected.
    pub(super) fn deviation(&self, pair: &[Innovation; 2]) -> Option<f32> {
        let [first, second] = pair;
        let together = |a: &Innovation, b: &Innovation| {
            (a.gradient * self.covariance * b.gradient.transpose()).x
        };
        let mixed = together(first, second);
        let expected = Matrix2::new(
            together(first, first) + first.variance,
            mixed,
            mixed,
            together(second, second) + second.variance,
        );
        let residual = Vector2::new(first.residual, second.residual);
        let deviation = residual.dot(&(expected.try_inverse()? * residual));
        deviation.is_finite().then_some(deviation)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[derive(Clone, Debug)]
    enum Step {
        Move([f32; 3]),
        Learn {
            residual: f32,
            gradient: [f32; 3],
            deviation: f32,
        },
    }

    fn steps() -> impl Strategy<Value = Vec<Step>> {
        let moved = prop::array::uniform3(-0.5_f32..0.5).prop_map(Step::Move);
        let learnt = (
            -2.0_f32..2.0,
            prop::array::uniform3(-4.0_f32..4.0),
            0.02_f32..2.0,
        )
            .prop_map(|(residual, gradient, deviation)| Step::Learn {
                residual,
                gradient,
                deviation,
            });
        prop::collection::vec(prop_oneof![moved, learnt], 1..300)
    }

    proptest! {
        #[test]
        fn the_covariance_stays_symmetric_and_positive_definite(steps in steps()) {
            let mut estimate = Estimate::new(Isometry2::new(Vector2::new(-3.0, 1.0), 0.4), 0.3, 0.2);
            for step in steps {
                match step {
                    Step::Move([x, y, turn]) => {
                        let noise = Vector3::new(0.01 * x * x, 0.01 * y * y, 0.01 * turn * turn);
                        estimate.predict(&Isometry2::new(Vector2::new(x, y), turn), &noise);
                    }
                    Step::Learn { residual, gradient, deviation } => estimate.learn(&Innovation {
                        residual,
                        gradient: RowVector3::from(gradient),
                        variance: deviation * deviation,
                    }),
                }
                prop_assert!(estimate.is_finite());
                prop_assert_eq!(estimate.covariance, estimate.covariance.transpose());
                prop_assert!(estimate.covariance.cholesky().is_some(), "{}", estimate.covariance);
            }
        }
    }

    #[test]
    fn a_movement_turns_with_the_robot_and_makes_it_less_sure() {
        let mut estimate = Estimate::new(
            Isometry2::new(Vector2::new(1.0, 2.0), std::f32::consts::FRAC_PI_2),
            0.1,
            0.1,
        );
        estimate.predict(
            &Isometry2::new(Vector2::new(1.0, 0.0), 0.0),
            &Vector3::new(0.04, 0.0, 0.0),
        );
        assert!((estimate.mean.xy() - Vector2::new(1.0, 3.0)).norm() < 1e-6);
        // What scatters ahead of the robot scatters along y, what its heading scatters along x.
        assert!((estimate.covariance[(1, 1)] - 0.05).abs() < 1e-6);
        assert!((estimate.covariance[(0, 0)] - 0.02).abs() < 1e-6);
    }

    #[test]
    fn a_sure_measurement_counts_more_than_an_unsure_one() {
        let far = |deviation: f32| {
            let mut estimate = Estimate::new(Isometry2::identity(), 0.5, 0.1);
            estimate.learn(&Innovation {
                residual: 1.0,
                gradient: RowVector3::new(1.0, 0.0, 0.0),
                variance: deviation * deviation,
            });
            estimate.mean.x
        };
        assert!((far(0.5) - 0.5).abs() < 1e-6);
        assert!(far(0.1) > 0.9 && far(2.0) < 0.1);
    }
}
