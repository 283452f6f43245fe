//! Estimates how the torso is turned against the world, from what the gyroscope and gravity say.
//!
//! A complementary filter after Valenti, Dryanovski and Xiao, "Keeping a Good Attitude" (Sensors
//! 15(8), 2015): the gyroscope turns the estimate, and gravity pulls roll and pitch back. Yaw comes
//! from the gyroscope alone, whose bias is learnt while the robot is still.

use framework::{AdditionalOutput, CycleTime, Input, MainOutput, Parameter, Result, context};
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use types::sensor_data::InertialMeasurement;

/// Standard gravity in m/s² (CGPM 1901).
const GRAVITY: f32 = 9.80665;

/// A longer gap between samples is no measurement of a rotation any more, in s.
const LONGEST_STEP: f32 = 0.1;

/// The estimate so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct OrientationFilter {
    torso_to_world: Option<UnitQuaternion<f32>>,
    /// What the gyroscope reports though nothing turns, in rad/s.
    bias: Vector3<f32>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    inertial: Input<InertialMeasurement, "sensor_data.inertial">,
    cycle_time: CycleTime,

    /// In s: after so long, a wrong tilt has shrunk to a third.
    gravity_time: Parameter<f32, "orientation_filter.gravity_time">,
    /// Share of gravity by which the acceleration may differ to be trusted fully.
    trusted_deviation: Parameter<f32, "orientation_filter.trusted_deviation">,
    /// Share of gravity from which on the acceleration is not trusted at all.
    refused_deviation: Parameter<f32, "orientation_filter.refused_deviation">,
    /// In s: how fast the gyroscope's bias is learnt.
    bias_time: Parameter<f32, "orientation_filter.bias_time">,
    /// In rad/s: a robot that turns less is taken to be still.
    still_rotation: Parameter<f32, "orientation_filter.still_rotation">,

    innovation: AdditionalOutput<f32, "orientation_filter.innovation">,
}

#[context]
pub struct MainOutputs {
    /// From the torso frame to a level frame that does not turn; its yaw was 0 at the start.
    orientation: MainOutput<UnitQuaternion<f32>>,
}

impl OrientationFilter {
    /// Knows nothing yet.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            torso_to_world: None,
            bias: Vector3::zeros(),
        })
    }

    /// Predicts with the gyroscope, then corrects with gravity.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let InertialMeasurement {
            gyroscope,
            accelerometer,
            ..
        } = *context.inertial;
        let Some(last) = self.torso_to_world else {
            let orientation = tilt(accelerometer);
            self.torso_to_world = Some(orientation);
            return Ok(MainOutputs {
                orientation: orientation.into(),
            });
        };

        let step = context
            .cycle_time
            .since_last
            .as_secs_f32()
            .min(LONGEST_STEP);
        let deviation = (accelerometer.norm() / GRAVITY - 1.0).abs();
        let trust = trust(
            deviation,
            *context.trusted_deviation,
            *context.refused_deviation,
        );
        let rotation = gyroscope - self.bias;
        if trust > 0.0 && rotation.norm() < *context.still_rotation {
            self.bias += rotation * share(step, *context.bias_time);
        }

        let predicted = last * UnitQuaternion::from_scaled_axis((gyroscope - self.bias) * step);
        let correction = to_vertical(predicted * accelerometer);
        context.innovation.fill_if_subscribed(|| correction.angle());
        let gain = trust * share(step, *context.gravity_time);
        let mut orientation = correction.powf(gain) * predicted;
        orientation.renormalize();
        self.torso_to_world = Some(orientation);
        Ok(MainOutputs {
            orientation: orientation.into(),
        })
    }
}

/// Roll and pitch that explain the acceleration as gravity; yaw is 0.
fn tilt(acceleration: Vector3<f32>) -> UnitQuaternion<f32> {
    let (roll, pitch, _) = to_vertical(acceleration).euler_angles();
    UnitQuaternion::from_euler_angles(roll, pitch, 0.0)
}

/// The shortest rotation that makes `up` point up; upside down or without direction: none.
fn to_vertical(up: Vector3<f32>) -> UnitQuaternion<f32> {
    UnitQuaternion::rotation_between(&up, &Vector3::z()).unwrap_or_default()
}

/// 1 up to `trusted`, 0 from `refused` on, linear between.
fn trust(deviation: f32, trusted: f32, refused: f32) -> f32 {
    if deviation <= trusted {
        return 1.0;
    }
    ((refused - deviation) / (refused - trusted)).clamp(0.0, 1.0)
}

/// How much of a difference vanishes in a step, so that a third is left after `time`.
fn share(step: f32, time: f32) -> f32 {
    1.0 - (-step / time.max(f32::EPSILON)).exp()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::{AdditionalSlot, Timestamp};

    use super::*;

    /// Gravity as a torso with that orientation feels it.
    fn at_rest(orientation: UnitQuaternion<f32>) -> InertialMeasurement {
        InertialMeasurement {
            accelerometer: orientation.inverse() * Vector3::new(0.0, 0.0, GRAVITY),
            ..InertialMeasurement::default()
        }
    }

    fn filter() -> OrientationFilter {
        OrientationFilter::new(CreationContext {}).unwrap()
    }

    /// One cycle of 12 ms; the innovation, too.
    fn cycle(
        node: &mut OrientationFilter,
        inertial: &InertialMeasurement,
    ) -> (UnitQuaternion<f32>, Option<f32>) {
        let mut slot = AdditionalSlot::default();
        let context = CycleContext {
            inertial,
            cycle_time: CycleTime {
                start: Timestamp::ZERO,
                since_last: Duration::from_millis(12),
            },
            gravity_time: &1.2,
            trusted_deviation: &0.1,
            refused_deviation: &0.2,
            bias_time: &5.0,
            still_rotation: &0.05,
            innovation: AdditionalOutput::new(true, 1, &mut slot),
        };
        let orientation = node.cycle(context).unwrap().orientation.value;
        (orientation, slot.get(1).copied())
    }

    #[test]
    fn the_first_sample_gives_roll_and_pitch() {
        let expected = UnitQuaternion::from_euler_angles(0.2, -0.3, 0.0);
        let (orientation, _) = cycle(&mut filter(), &at_rest(expected));
        assert!(orientation.angle_to(&expected) < 1e-3);
    }

    #[test]
    fn turning_in_place_changes_only_the_yaw() {
        let mut node = filter();
        let mut inertial = at_rest(UnitQuaternion::identity());
        cycle(&mut node, &inertial);
        inertial.gyroscope.z = 0.5;
        for _ in 0..100 {
            cycle(&mut node, &inertial);
        }
        let (roll, pitch, yaw) = node.torso_to_world.unwrap().euler_angles();
        assert!((yaw - 0.6).abs() < 1e-3, "{yaw}");
        assert!(roll.abs() < 1e-4 && pitch.abs() < 1e-4);
    }

    #[test]
    fn gravity_mends_a_wrong_tilt_and_says_how_wrong_it_was() {
        let mut node = filter();
        cycle(
            &mut node,
            &at_rest(UnitQuaternion::from_euler_angles(0.0, 0.2, 0.0)),
        );
        let truth = at_rest(UnitQuaternion::identity());
        let (_, innovation) = cycle(&mut node, &truth);
        assert!((innovation.unwrap() - 0.2).abs() < 1e-3);
        for _ in 0..99 {
            cycle(&mut node, &truth);
        }
        // 100 cycles are the filter's time constant.
        let left = node.torso_to_world.unwrap().angle();
        assert!((left - 0.2 * (-1.0_f32).exp()).abs() < 2e-3, "{left}");
    }

    #[test]
    fn a_shove_is_not_taken_for_gravity() {
        let mut node = filter();
        cycle(&mut node, &at_rest(UnitQuaternion::identity()));
        let mut shoved = at_rest(UnitQuaternion::identity());
        shoved.accelerometer.x = 12.0;
        for _ in 0..100 {
            cycle(&mut node, &shoved);
        }
        assert!(node.torso_to_world.unwrap().angle() < 1e-6);
    }

    #[test]
    fn the_bias_of_a_robot_at_rest_is_learnt() {
        let mut node = filter();
        let mut inertial = at_rest(UnitQuaternion::identity());
        inertial.gyroscope = Vector3::new(0.0, 0.0, 0.02);
        for _ in 0..5000 {
            cycle(&mut node, &inertial);
        }
        let before = node.torso_to_world.unwrap();
        cycle(&mut node, &inertial);
        let drift = node.torso_to_world.unwrap().angle_to(&before) / 0.012;
        assert!(drift < 1e-3, "{drift} rad/s");
    }

    #[test]
    fn no_acceleration_at_all_is_survived() {
        let mut node = filter();
        for _ in 0..2 {
            let (orientation, _) = cycle(&mut node, &InertialMeasurement::default());
            assert_eq!(orientation, UnitQuaternion::identity());
        }
    }
}
