//! Steps, turns and standing still, with the truth beside them.

use std::f32::consts::{FRAC_PI_2, PI};

use framework::math;
use framework::testing::cycle_time;
use kinematics::forward_kinematics;
use nalgebra::Translation3;
use types::joints::Joints;

use super::*;

/// Cycles of one step.
const STEP: u16 = 30;

/// What the robot feels in one cycle.
#[derive(Clone, Copy)]
struct Felt {
    soles_to_torso: Feet<Isometry3<f32>>,
    orientation: UnitQuaternion<f32>,
    gyroscope: Vector3<f32>,
    support_side: Option<Side>,
    fall_state: FallState,
}

impl Felt {
    fn new(joints: &Joints<f32>, side: Side) -> Self {
        Self {
            soles_to_torso: RobotKinematics::from(&forward_kinematics(joints)).soles_to_torso,
            orientation: UnitQuaternion::identity(),
            gyroscope: Vector3::zeros(),
            support_side: Some(side),
            fall_state: FallState::Upright,
        }
    }
}

fn node() -> OdometryProvider {
    OdometryProvider::new(CreationContext {}).unwrap()
}

fn cycle(node: &mut OdometryProvider, felt: Felt) -> Isometry2<f32> {
    cycle_scaled(node, felt, [1.0, 1.0])
}

/// With these scales of what the joints say, ahead and to the left.
fn cycle_scaled(
    node: &mut OdometryProvider,
    felt: Felt,
    [forward_scale, left_scale]: [f32; 2],
) -> Isometry2<f32> {
    let context = CycleContext {
        robot_kinematics: &RobotKinematics {
            soles_to_torso: felt.soles_to_torso,
            ..RobotKinematics::default()
        },
        support_side: felt.support_side.as_ref(),
        orientation: &felt.orientation,
        inertial: &InertialMeasurement {
            gyroscope: felt.gyroscope,
            ..InertialMeasurement::default()
        },
        fall_state: &felt.fall_state,
        cycle_time: cycle_time(12, 12),
        forward_scale: &forward_scale,
        left_scale: &left_scale,
        still_distance: &0.005,
        still_angle: &0.03,
        still_rotation: &0.05,
        still_time: &0.3,
    };
    node.cycle(context).unwrap().odometry.value.ground_to_start
}

/// Hip, knee and ankle pitch that bring the ankle so far ahead of and below the hip, sole level.
fn leg(ahead: f32, below: f32) -> [f32; 3] {
    let (thigh, tibia) = (0.1_f32, 0.1029_f32);
    let length = math::hypot(ahead, below);
    let angle = |near: f32, other: f32, far: f32| {
        math::acos((near * near + other * other - far * far) / (2.0 * near * other))
    };
    let hip = -math::atan2(ahead, below) - angle(thigh, length, tibia);
    let knee = PI - angle(thigh, tibia, length);
    [hip, knee, -hip - knee]
}

/// Joints with the feet so far ahead of the hips and so high above the floor.
fn joints(ahead: Feet<f32>, height: Feet<f32>) -> Joints<f32> {
    let left = leg(ahead.left, 0.18 - height.left);
    let right = leg(ahead.right, 0.18 - height.right);
    Joints {
        left_hip_pitch: left[0],
        left_knee_pitch: left[1],
        left_ankle_pitch: left[2],
        right_hip_pitch: right[0],
        right_knee_pitch: right[1],
        right_ankle_pitch: right[2],
        ..Joints::default()
    }
}

fn standing() -> Joints<f32> {
    joints(Feet::default(), Feet::default())
}

/// Values of the swinging and the supporting foot.
fn feet(support: Side, swinging: f32, supporting: f32) -> Feet<f32> {
    match support {
        Side::Left => Feet {
            left: supporting,
            right: swinging,
        },
        Side::Right => Feet {
            left: swinging,
            right: supporting,
        },
    }
}

/// Steps of so many m with alternating support, from standing to the middle of the last step.
fn walk(node: &mut OdometryProvider, steps: u16, length: f32) -> Isometry2<f32> {
    cycle(node, Felt::new(&standing(), Side::Left));
    let mut reached = Isometry2::identity();
    for step in 0..steps {
        let side = [Side::Left, Side::Right][usize::from(step % 2)];
        // The first step begins and the last one ends with the feet side by side.
        let first = if step == 0 { STEP / 2 } else { 0 };
        let last = if step == steps - 1 { STEP / 2 } else { STEP };
        for phase in first..=last {
            let phase = f32::from(phase) / f32::from(STEP);
            let ahead = feet(side, phase - 0.5, 0.5 - phase).map(|share| share * length);
            let height = feet(side, 0.02 * math::sin(phase * PI), 0.0);
            reached = cycle(node, Felt::new(&joints(ahead, height), side));
        }
    }
    reached
}

fn assert_place(reached: &Isometry2<f32>, x: f32, y: f32, heading: f32) {
    let error = reached.translation.vector - Vector2::new(x, y);
    assert!(error.norm() < 1e-4, "{reached}");
    assert!(
        wrap(reached.rotation.angle() - heading).abs() < 1e-4,
        "{reached}"
    );
}

/// Numbers between -1 and 1 that scatter.
fn noise(seed: &mut u32) -> f32 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*seed >> 8) as f32 / (1_u32 << 23) as f32 - 1.0
}

#[test]
fn walking_gets_the_robot_as_far_as_its_steps_are_long() {
    assert_place(&walk(&mut node(), 11, 0.04), 0.4, 0.0, 0.0);
    assert_place(&walk(&mut node(), 11, -0.03), -0.3, 0.0, 0.0);
}

#[test]
fn steps_are_scaled_along_and_across_the_heading_of_the_robot() {
    let mut node = node();
    let side = Side::Left;
    let soles = Felt::new(&standing(), side).soles_to_torso;
    let felt = |soles_to_torso, yaw| Felt {
        soles_to_torso,
        orientation: UnitQuaternion::from_euler_angles(0.0, 0.0, yaw),
        gyroscope: Vector3::z(),
        ..Felt::new(&standing(), side)
    };
    let scales = [1.5, 0.5];
    cycle_scaled(&mut node, felt(soles, 0.0), scales);
    let turned = cycle_scaled(&mut node, felt(soles, FRAC_PI_2), scales);
    // The right sole swings 4 cm ahead and 2 cm to the left, the middle between both half as far.
    let moved_soles = Feet {
        right: Translation3::new(0.04, 0.02, 0.0) * soles.right,
        ..soles
    };
    let reached = cycle_scaled(&mut node, felt(moved_soles, FRAC_PI_2), scales);
    let way = turned.inverse() * reached;
    let expected = Vector2::new(1.5 * 0.02, 0.5 * 0.01);
    assert!((way.translation.vector - expected).norm() < 1e-4, "{way}");
}

#[test]
fn stepping_in_place_gets_nowhere() {
    assert_place(&walk(&mut node(), 100, 0.0), 0.0, 0.0, 0.0);
}

#[test]
fn a_standing_robot_does_not_move_at_all_whatever_its_sensors_scatter() {
    let mut node = node();
    walk(&mut node, 5, 0.04);
    let still = Felt::new(&standing(), Side::Left);
    let cycles = (0..30).map(|_| cycle(&mut node, still));
    let before = cycles.last().unwrap();
    let mut seed = 1;
    let mut yaw = 0.0;
    for count in 0..5000 {
        let joints = standing().map(|angle| angle + 0.001 * noise(&mut seed));
        let side = [Side::Left, Side::Right][count % 2];
        yaw += 0.012 * (0.001 + 0.01 * noise(&mut seed));
        let felt = Felt {
            orientation: UnitQuaternion::from_euler_angles(
                0.002 * noise(&mut seed),
                0.002 * noise(&mut seed),
                yaw,
            ),
            gyroscope: Vector3::from_fn(|_, _| 0.02 * noise(&mut seed)),
            ..Felt::new(&joints, side)
        };
        assert_eq!(cycle(&mut node, felt), before, "cycle {count}");
    }
    assert!(yaw.abs() > 0.02, "the orientation drifted by {yaw} rad");
    // What drifted meanwhile is not made up for.
    let felt = Felt {
        orientation: UnitQuaternion::from_euler_angles(0.0, 0.0, yaw),
        gyroscope: Vector3::new(0.0, 0.1, 0.0),
        ..Felt::new(&standing(), Side::Left)
    };
    let after = cycle(&mut node, felt);
    assert!(after.rotation.angle_to(&before.rotation).abs() < 1e-3);
}

#[test]
fn a_robot_that_never_moved_is_still_from_its_first_cycle_on() {
    let mut node = node();
    let mut felt = Felt::new(&standing(), Side::Left);
    for count in 0_u16..100 {
        felt.orientation = UnitQuaternion::from_euler_angles(0.0, 0.0, 1e-4 * f32::from(count));
        assert_eq!(cycle(&mut node, felt), Isometry2::identity());
    }
}

#[test]
fn changing_the_supporting_foot_is_no_movement() {
    let mut node = node();
    let astride = joints(
        Feet {
            left: 0.04,
            right: -0.04,
        },
        Feet::default(),
    );
    for count in 0..100 {
        let side = [Side::Left, Side::Right][count % 2];
        let felt = Felt {
            // So that the robot does not count as still.
            gyroscope: Vector3::new(0.0, 1.0, 0.0),
            ..Felt::new(&astride, side)
        };
        assert_place(&cycle(&mut node, felt), 0.0, 0.0, 0.0);
    }
}

#[test]
fn walking_in_an_arc_ends_where_the_feet_are_even_while_the_torso_sways() {
    let mut node = node();
    // Along a circle about (0, 0.5), the torso half a step between its footprints.
    let place = |angle: f32| {
        Isometry3::new(
            Vector3::new(0.5 * math::sin(angle), 0.5 - 0.5 * math::cos(angle), 0.0),
            Vector3::z() * angle,
        )
    };
    let footprint = |angle: f32, y: f32| place(angle) * Translation3::new(0.0, y, 0.0);
    let turn = 0.08;
    let mut prints = Feet {
        left: footprint(0.0, 0.05),
        right: footprint(0.0, -0.05),
    };
    let mut reached = Isometry2::identity();
    let mut truth = Isometry2::identity();
    for step in 0_u16..20 {
        let side = [Side::Left, Side::Right][usize::from(step % 2)];
        let begin = f32::from(step) * turn;
        let (from, to) = match side {
            Side::Left => (prints.right, footprint(begin + turn, -0.05)),
            Side::Right => (prints.left, footprint(begin + turn, 0.05)),
        };
        for phase in 0..=STEP {
            let phase = f32::from(phase) / f32::from(STEP);
            let mut swinging = from.lerp_slerp(&to, phase);
            swinging.translation.z = 0.02 * math::sin(phase * PI);
            match side {
                Side::Left => prints.right = swinging,
                Side::Right => prints.left = swinging,
            }
            let sway = math::sin(phase * PI);
            let heading = begin + phase * turn;
            let torso = Isometry3::from_parts(
                (place(heading) * Translation3::new(0.0, 0.02 * sway, 0.26)).translation,
                UnitQuaternion::from_euler_angles(0.05 * sway, 0.1 - 0.03 * sway, heading),
            );
            let middle = (prints.left.translation.vector + prints.right.translation.vector) / 2.0;
            truth = Isometry2::new(middle.xy(), heading);
            let felt = Felt {
                soles_to_torso: prints.map(|sole| torso.inv_mul(&sole)),
                orientation: torso.rotation,
                gyroscope: Vector3::z() * turn / (f32::from(STEP) * 0.012),
                ..Felt::new(&standing(), side)
            };
            reached = cycle(&mut node, felt);
        }
    }
    assert!(truth.translation.vector.norm() > 0.6);
    let expected = truth.translation.vector;
    assert_place(&reached, expected.x, expected.y, truth.rotation.angle());
}

#[test]
fn a_robot_that_is_carried_feels_only_that_it_is_turned() {
    let mut node = node();
    for cycles in 0_u16..=100 {
        let turned = f32::from(cycles) / 100.0;
        let ahead = feet(Side::Left, 0.05 * turned, 0.0);
        let felt = Felt {
            orientation: UnitQuaternion::from_euler_angles(0.0, 0.0, FRAC_PI_2 * turned),
            gyroscope: Vector3::new(0.0, 0.0, 1.3),
            support_side: None,
            ..Felt::new(&joints(ahead, Feet::default()), Side::Left)
        };
        cycle(&mut node, felt);
    }
    assert_place(&put_down(&mut node, FRAC_PI_2), 0.0, 0.0, FRAC_PI_2);
}

/// Stands again, with that yaw.
fn put_down(node: &mut OdometryProvider, yaw: f32) -> Isometry2<f32> {
    let felt = Felt {
        orientation: UnitQuaternion::from_euler_angles(0.0, 0.0, yaw),
        ..Felt::new(&standing(), Side::Right)
    };
    cycle(node, felt);
    cycle(node, felt)
}

#[test]
fn legs_of_a_lying_robot_walk_nowhere() {
    let mut node = node();
    cycle(&mut node, Felt::new(&standing(), Side::Left));
    for pitch in [0.5, 1.0, 1.5, 1.0, 0.5] {
        for ahead in [0.05, 0.0] {
            let ahead = feet(Side::Left, ahead, 0.0);
            let felt = Felt {
                orientation: UnitQuaternion::from_euler_angles(0.0, pitch, 0.0),
                gyroscope: Vector3::new(0.0, 1.0, 0.0),
                fall_state: FallState::Lying(types::fall_state::Facing::Down),
                ..Felt::new(&joints(ahead, Feet::default()), Side::Left)
            };
            assert_place(&cycle(&mut node, felt), 0.0, 0.0, 0.0);
        }
    }
}

#[test]
fn what_is_no_number_is_left_out() {
    let mut node = node();
    let nothing = Felt {
        orientation: UnitQuaternion::from_scaled_axis(Vector3::repeat(f32::NAN)),
        ..Felt::new(&Joints::filled(f32::NAN), Side::Left)
    };
    assert_place(&cycle(&mut node, nothing), 0.0, 0.0, 0.0);
    let reached = walk(&mut node, 6, 0.04);
    assert_place(&cycle(&mut node, nothing), reached.translation.x, 0.0, 0.0);
    let reached = walk(&mut node, 6, 0.04);
    assert!((reached.translation.x - 0.4).abs() < 2e-3, "{reached}");
}
