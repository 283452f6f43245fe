//! Falls, squats and poses on the ground, as the sensors tell them.

use std::f32::consts::FRAC_PI_2;

use framework::math;
use framework::testing::{AdditionalProbe, cycle_time};
use kinematics::forward_kinematics;

use super::*;

/// A robot whose sensors tell one story.
struct Robot {
    node: FallStateFilter,
    now: u64,
    positions: Joints<f32>,
    has_ground_contact: bool,
    longest_fall: f32,
}

impl Robot {
    fn with_legs(hip_pitch: f32, knee_pitch: f32, ankle_pitch: f32) -> Self {
        Self {
            node: FallStateFilter::new(CreationContext {}).unwrap(),
            now: 0,
            positions: Joints {
                left_hip_pitch: hip_pitch,
                right_hip_pitch: hip_pitch,
                left_knee_pitch: knee_pitch,
                right_knee_pitch: knee_pitch,
                left_ankle_pitch: ankle_pitch,
                right_ankle_pitch: ankle_pitch,
                left_shoulder_pitch: FRAC_PI_2,
                right_shoulder_pitch: FRAC_PI_2,
                ..Joints::default()
            },
            has_ground_contact: true,
            longest_fall: 1.0,
        }
    }

    fn standing() -> Self {
        Self::with_legs(-0.3, 0.9, -0.6)
    }

    /// Cycles of 12 ms with that roll and pitch, at rest.
    fn rest(&mut self, seconds: f32, roll: f32, pitch: f32) -> FallState {
        let cycles = (seconds / 0.012).ceil() as usize;
        let states = (0..cycles).map(|_| self.cycle(roll, pitch, Vector3::zeros()));
        states.last().unwrap()
    }

    /// One cycle of 12 ms; what the accelerometer says comes from gravity alone.
    fn cycle(&mut self, roll: f32, pitch: f32, gyroscope: Vector3<f32>) -> FallState {
        let orientation = UnitQuaternion::from_euler_angles(roll, pitch, 0.7);
        let accelerometer = orientation.inverse() * Vector3::new(0.0, 0.0, 9.81);
        self.feel(orientation, accelerometer, gyroscope)
    }

    fn feel(
        &mut self,
        orientation: UnitQuaternion<f32>,
        accelerometer: Vector3<f32>,
        gyroscope: Vector3<f32>,
    ) -> FallState {
        self.now += 12;
        let poses = forward_kinematics(&self.positions);
        let mut overhang = AdditionalProbe::default();
        let context = CycleContext {
            inertial: &InertialMeasurement {
                gyroscope,
                accelerometer,
                ..InertialMeasurement::default()
            },
            orientation: &orientation,
            positions: &self.positions,
            robot_kinematics: &RobotKinematics::from(&poses),
            center_of_mass: &poses.center_of_mass(),
            has_ground_contact: &self.has_ground_contact,
            cycle_time: cycle_time(self.now, 12),
            tilt: &TiltLimits {
                forward: 0.5,
                backward: 0.3,
                sideways: 0.5,
                hysteresis: 0.1,
            },
            overhang: &0.02,
            tilting_rotation: &0.5,
            acceleration_time: &0.24,
            resting_deviation: &7.0,
            sitting: &Sitting {
                pitch: -0.39,
                hip_pitch: -0.78,
                knee_pitch: 2.11,
                ankle_pitch: -1.18,
                legs_deviation: 1.2,
            },
            longest_fall: &self.longest_fall,
            center_of_mass_overhang: overhang.output(),
        };
        self.node.cycle(context).unwrap().fall_state.value
    }
}

#[test]
fn a_robot_that_sways_stays_upright() {
    let mut robot = Robot::standing();
    for cycle in 0..500 {
        let (sine, cosine) = math::sin_cos(cycle as f32 * 0.1);
        let gyroscope = Vector3::new(cosine, -sine, 0.0);
        let state = robot.cycle(0.12 * sine, 0.12 * cosine, gyroscope);
        assert_eq!(state, FallState::Upright);
    }
}

#[test]
fn the_torso_beyond_a_limit_falls_to_that_side() {
    for (roll, pitch, direction) in [
        (0.0, 0.55, FallDirection::Forward),
        (0.0, -0.35, FallDirection::Backward),
        (-0.55, 0.0, FallDirection::Left),
        (0.55, 0.0, FallDirection::Right),
    ] {
        let mut robot = Robot::standing();
        robot.rest(0.5, 0.0, 0.0);
        let state = robot.rest(0.012, roll, pitch);
        assert_eq!(state, FallState::Falling(direction));
    }
}

#[test]
fn a_fall_in_both_directions_ends_on_the_side_that_gravity_says() {
    for (pitch, first, last) in [
        (1.5, FallDirection::Forward, Facing::Down),
        (-1.5, FallDirection::Backward, Facing::Up),
    ] {
        let mut robot = Robot::standing();
        robot.rest(0.5, 0.0, 0.0);
        let mut seen = vec![FallState::Upright];
        for cycle in 0..200_u16 {
            let state = robot.cycle(
                0.0,
                pitch * (f32::from(cycle) / 60.0).min(1.0),
                Vector3::zeros(),
            );
            if *seen.last().unwrap() != state {
                seen.push(state);
            }
        }
        let expected = [
            FallState::Upright,
            FallState::Falling(first),
            FallState::Lying(last),
        ];
        assert_eq!(seen, expected);
    }
}

#[test]
fn the_centre_of_mass_beyond_the_soles_is_a_fall_while_the_robot_tilts_outwards() {
    let outwards = Vector3::new(0.0, 1.0, 0.0);
    for (gyroscope, has_ground_contact, expected) in [
        (outwards, true, FallState::Falling(FallDirection::Forward)),
        (-outwards, true, FallState::Upright),
        (Vector3::zeros(), true, FallState::Upright),
        (outwards, false, FallState::Upright),
    ] {
        let mut robot = Robot::standing();
        robot.has_ground_contact = has_ground_contact;
        let state = robot.cycle(0.0, 0.48, gyroscope);
        assert_eq!(state, expected, "{gyroscope}");
    }
}

#[test]
fn between_limit_and_hysteresis_a_fall_goes_on_and_then_it_is_over() {
    let mut robot = Robot::standing();
    robot.rest(0.012, 0.0, 0.45);
    robot.rest(0.012, 0.0, 0.55);
    let falling = FallState::Falling(FallDirection::Forward);
    assert_eq!(robot.rest(0.2, 0.0, 0.45), falling);
    assert_eq!(robot.rest(0.2, 0.0, 0.35), FallState::Upright);
}

#[test]
fn no_fall_lasts_longer_than_a_second() {
    let mut robot = Robot::standing();
    robot.rest(0.5, 0.0, 0.0);
    let falling = FallState::Falling(FallDirection::Right);
    assert_eq!(robot.rest(0.98, 1.5, 0.0), falling);
    let state = robot.rest(0.05, 1.5, 0.0);
    assert!(matches!(state, FallState::Lying(_)), "{state:?}");
    assert!(matches!(robot.rest(5.0, 1.5, 0.0), FallState::Lying(_)));
    assert_eq!(robot.rest(0.5, 0.0, 0.0), FallState::Upright);
}

#[test]
fn a_longest_fall_that_is_infinite_or_no_number_ends_no_fall() {
    for longest_fall in [f32::INFINITY, f32::NAN] {
        let mut robot = Robot::standing();
        robot.longest_fall = longest_fall;
        robot.rest(0.5, 0.0, 0.0);
        let falling = FallState::Falling(FallDirection::Right);
        assert_eq!(robot.rest(3.0, 1.5, 0.0), falling, "{longest_fall}");
    }
}

#[test]
fn upside_down_is_not_upright() {
    let mut robot = Robot::standing();
    robot.has_ground_contact = false;
    for (roll, pitch) in [(3.1, 0.0), (0.0, 3.1), (-3.1, 0.05)] {
        let state = robot.rest(3.0, roll, pitch);
        assert!(matches!(state, FallState::Lying(_)), "{state:?}");
    }
}

#[test]
fn a_robot_that_is_rolled_over_lies_on_the_other_side() {
    let mut robot = Robot::standing();
    assert_eq!(robot.rest(0.1, 0.0, 1.5), FallState::Lying(Facing::Down));
    let state = robot.rest(1.0, 0.0, -1.5);
    assert_eq!(state, FallState::Lying(Facing::Up));
}

#[test]
fn on_its_bottom_with_folded_legs_the_robot_sits_and_never_fell() {
    let mut robot = Robot::with_legs(-0.78, 2.11, -1.18);
    assert_eq!(robot.rest(1.0, 0.0, 0.0), FallState::Upright);
    assert_eq!(robot.rest(0.1, 0.0, -0.39), FallState::Upright);
    robot.has_ground_contact = false;
    assert_eq!(robot.rest(1.0, 0.0, -0.39), FallState::Sitting);
    robot.has_ground_contact = true;
    assert_eq!(robot.rest(1.0, 0.0, 0.0), FallState::Upright);
}

#[test]
fn a_robot_that_squats_does_not_sit_before_its_soles_feel_the_ground() {
    let mut robot = Robot::with_legs(-0.87, 2.11, -1.18);
    robot.has_ground_contact = false;
    assert_eq!(robot.rest(0.1, 0.0, -0.06), FallState::Upright);
}

#[test]
fn with_straight_legs_leaning_back_is_a_fall() {
    let mut robot = Robot::standing();
    robot.has_ground_contact = false;
    robot.rest(0.5, 0.0, 0.0);
    let state = robot.rest(0.5, 0.0, -0.39);
    assert_eq!(state, FallState::Falling(FallDirection::Backward));
}

#[test]
fn what_is_no_number_is_survived() {
    let mut robot = Robot::standing();
    let nothing = Vector3::repeat(f32::NAN);
    let orientation = UnitQuaternion::from_scaled_axis(nothing);
    robot.positions = Joints::filled(f32::NAN);
    assert_eq!(
        robot.feel(orientation, nothing, nothing),
        FallState::Upright
    );
    let mut robot = Robot::standing();
    robot.feel(orientation, nothing, nothing);
    assert_eq!(robot.rest(1.0, 0.0, 0.0), FallState::Upright);
}
