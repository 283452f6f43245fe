//! Estimates how the torso is turned against the world, from what the gyroscope and gravity say.
//!
//! A complementary filter after Valenti, Dryanovski and Xiao, "Keeping a Good Attitude" (Sensors
//! 15(8), 2015): the gyroscope turns the estimate, and gravity pulls roll and pitch back. Yaw comes
//! from the gyroscope alone, whose bias is learnt while the robot is still.
//!
//! Invariant: what is no number, a sample or a parameter, leaves the estimate as it was.

use framework::{AdditionalOutput, CycleTime, Input, MainOutput, Parameter, Result, context};
use kinematics::inertial::GRAVITY;
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use types::sensor_data::InertialMeasurement;

use crate::level::torso_to_level;
use crate::low_pass::share;

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

    /// After so long, a wrong tilt has shrunk to a third.
    #[reflect(unit = "s", range = 0.0..)]
    gravity_time: Parameter<f32, "orientation_filter.gravity_time">,
    /// Share of gravity by which the acceleration may differ to be trusted fully.
    trusted_deviation: Parameter<f32, "orientation_filter.trusted_deviation">,
    /// Share of gravity from which on the acceleration is not trusted at all.
    refused_deviation: Parameter<f32, "orientation_filter.refused_deviation">,
    /// How fast the gyroscope's bias is learnt.
    #[reflect(unit = "s", range = 0.0..)]
    bias_time: Parameter<f32, "orientation_filter.bias_time">,
    /// A robot that turns less is taken to be still.
    #[reflect(unit = "rad/s", range = 0.0..)]
    still_rotation: Parameter<f32, "orientation_filter.still_rotation">,

    /// In rad: how far gravity is from where the gyroscope expected it.
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
            let is_sample = accelerometer.iter().all(|number| number.is_finite());
            let orientation = is_sample.then(|| tilt(accelerometer));
            self.torso_to_world = orientation.filter(is_number);
            return Ok(MainOutputs {
                orientation: self.torso_to_world.unwrap_or_default().into(),
            });
        };

        let step = context
            .cycle_time
            .since_last
            .as_secs_f32()
            .min(LONGEST_STEP);
        let deviation = (accelerometer.norm() / GRAVITY as f32 - 1.0).abs();
        let trust = trust(
            deviation,
            *context.trusted_deviation,
            *context.refused_deviation,
        );
        let rotation = gyroscope - self.bias;
        let still_rotation = *context.still_rotation;
        if trust > 0.0 && still_rotation.is_finite() && rotation.norm() < still_rotation {
            self.bias += rotation * share(step, *context.bias_time);
        }

        let predicted = last * UnitQuaternion::from_scaled_axis((gyroscope - self.bias) * step);
        let correction = to_vertical(predicted * accelerometer);
        context.innovation.fill_if_subscribed(|| correction.angle());
        let gain = trust * share(step, *context.gravity_time);
        let mut orientation = correction.powf(gain) * predicted;
        orientation.renormalize();
        if !is_number(&orientation) {
            orientation = last;
        }
        self.torso_to_world = Some(orientation);
        Ok(MainOutputs {
            orientation: orientation.into(),
        })
    }
}

fn is_number(orientation: &UnitQuaternion<f32>) -> bool {
    orientation.coords.iter().all(|number| number.is_finite())
}

/// Roll and pitch that explain the acceleration as gravity; yaw is 0.
fn tilt(acceleration: Vector3<f32>) -> UnitQuaternion<f32> {
    torso_to_level(&to_vertical(acceleration))
}

/// The shortest rotation that makes `up` point up; upside down or without direction: none.
fn to_vertical(up: Vector3<f32>) -> UnitQuaternion<f32> {
    UnitQuaternion::rotation_between(&up, &Vector3::z()).unwrap_or_default()
}

/// 1 up to `trusted`, 0 from `refused` on, linear between; 0 where one of them is no number.
fn trust(deviation: f32, trusted: f32, refused: f32) -> f32 {
    if ![deviation, trusted, refused]
        .into_iter()
        .all(f32::is_finite)
    {
        return 0.0;
    }
    if deviation <= trusted {
        return 1.0;
    }
    ((refused - deviation) / (refused - trusted)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::{AdditionalSlot, Timestamp, math};

    use super::*;

    const PARAMETERS: [f32; 5] = [1.2, 0.1, 0.2, 5.0, 0.05];
    const RUINED: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

    /// Gravity as a torso with that orientation feels it.
    fn at_rest(orientation: UnitQuaternion<f32>) -> InertialMeasurement {
        InertialMeasurement {
            accelerometer: orientation.inverse() * Vector3::new(0.0, 0.0, GRAVITY as f32),
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
        cycle_with(node, inertial, &PARAMETERS)
    }

    /// With the parameters in the order of the context.
    fn cycle_with(
        node: &mut OrientationFilter,
        inertial: &InertialMeasurement,
        parameters: &[f32; 5],
    ) -> (UnitQuaternion<f32>, Option<f32>) {
        let [
            gravity_time,
            trusted_deviation,
            refused_deviation,
            bias_time,
            still_rotation,
        ] = parameters;
        let mut slot = AdditionalSlot::default();
        let context = CycleContext {
            inertial,
            cycle_time: CycleTime {
                start: Timestamp::ZERO,
                since_last: Duration::from_millis(12),
            },
            gravity_time,
            trusted_deviation,
            refused_deviation,
            bias_time,
            still_rotation,
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
        assert!((left - 0.2 * math::exp(-1.0_f32)).abs() < 2e-3, "{left}");
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

    /// A node that has seen something wrong finds the truth and stays there.
    fn assert_recovers(node: &mut OrientationFilter, case: &str) {
        let truth = at_rest(UnitQuaternion::from_euler_angles(0.1, -0.2, 0.0));
        for _ in 0..1000 {
            cycle(node, &truth);
        }
        let before = node.torso_to_world.unwrap();
        let (roll, pitch, _) = before.euler_angles();
        assert!((roll - 0.1).abs() < 1e-2, "{case}: roll {roll}");
        assert!((pitch + 0.2).abs() < 1e-2, "{case}: pitch {pitch}");
        for _ in 0..100 {
            cycle(node, &truth);
        }
        let drift = node.torso_to_world.unwrap().angle_to(&before) / 1.2;
        assert!(drift < 5e-3, "{case}: {drift} rad/s");
    }

    #[test]
    fn a_parameter_that_is_no_number_spoils_nothing_for_good() {
        for index in 0..PARAMETERS.len() {
            for ruined in RUINED {
                let case = format!("parameter {index} is {ruined}");
                let mut node = filter();
                let mut moving = at_rest(UnitQuaternion::from_euler_angles(0.1, -0.1, 0.0));
                // Between what is trusted and what is refused.
                moving.accelerometer *= 1.15;
                moving.gyroscope = Vector3::new(0.0, 0.0, 0.5);
                cycle(&mut node, &moving);
                let mut parameters = PARAMETERS;
                parameters[index] = ruined;
                for _ in 0..100 {
                    let (orientation, _) = cycle_with(&mut node, &moving, &parameters);
                    assert!(
                        orientation.coords.iter().all(|number| number.is_finite()),
                        "{case}: {orientation}"
                    );
                }
                assert_recovers(&mut node, &case);
            }
        }
    }

    #[test]
    fn a_sample_that_is_no_number_leaves_the_orientation_as_it_was() {
        for axis in 0..3 {
            for ruined in RUINED {
                let truth = at_rest(UnitQuaternion::from_euler_angles(0.1, -0.2, 0.0));
                let mut no_rotation = truth;
                no_rotation.gyroscope[axis] = ruined;
                let mut no_gravity = truth;
                no_gravity.accelerometer[axis] = ruined;
                for broken in [no_rotation, no_gravity] {
                    let case = format!("{broken:?}");
                    let mut node = filter();
                    let (first, _) = cycle(&mut node, &broken);
                    assert!(
                        first.coords.iter().all(|number| number.is_finite()),
                        "{case}: {first}"
                    );
                    let (before, _) = cycle(&mut node, &truth);
                    let (after, _) = cycle(&mut node, &broken);
                    assert!(after.angle_to(&before) < 1e-3, "{case}: {after}");
                    assert_recovers(&mut node, &case);
                }
            }
        }
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
