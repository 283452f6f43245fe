//! Inverse and forward kinematics of the legs agree, and what is out of reach is reached for.

use kinematics::inverse::{THIGH, TIBIA, hip};
use kinematics::{LegsAngles, forward_kinematics, leg_angles};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use types::feet::{Feet, Side};
use types::joints::Joints;

const SIDES: [Side; 2] = [Side::Left, Side::Right];

/// Of the legs alone, within the limits of their joints; knees are bent, as one pose of the foot has two angles where they
/// are bent the other way.
fn legs() -> impl Strategy<Value = Joints<f64>> {
    let leg = || {
        (
            -0.37..0.37_f64,
            -1.5..0.45_f64,
            0.02..2.1_f64,
            -1.15..0.9_f64,
            -0.39..0.39_f64,
        )
    };
    (-1.1..0.7_f64, leg(), leg()).prop_map(|(hip_yaw_pitch, left, right)| Joints {
        hip_yaw_pitch,
        left_hip_roll: left.0,
        left_hip_pitch: left.1,
        left_knee_pitch: left.2,
        left_ankle_pitch: left.3,
        left_ankle_roll: left.4,
        right_hip_roll: -right.0,
        right_hip_pitch: right.1,
        right_knee_pitch: right.2,
        right_ankle_pitch: right.3,
        right_ankle_roll: -right.4,
        ..Joints::default()
    })
}

fn soles(joints: &Joints<f64>) -> Feet<Isometry3<f64>> {
    let poses = forward_kinematics(joints);
    Feet {
        left: poses.sole(Side::Left),
        right: poses.sole(Side::Right),
    }
}

fn pose_of(angles: &LegsAngles<f64>) -> Joints<f64> {
    let mut joints = Joints::default();
    angles.write_to(&mut joints);
    joints
}

/// In m and rad, the greater.
fn difference(one: &Isometry3<f64>, other: &Isometry3<f64>) -> f64 {
    let apart = one.inv_mul(other);
    let turned = apart.rotation.imag().norm() * 2.0;
    apart.translation.vector.norm().max(turned)
}

fn ankle(sole: &Isometry3<f64>) -> Point3<f64> {
    sole * Point3::new(0.0, 0.0, kinematics::feet::SOLE_BELOW_ANKLE)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn both_ways_are_one(joints in legs(), left_share in 0.0..1.0) {
        let asked = soles(&joints);
        let angles = leg_angles(&asked, left_share);
        prop_assert_eq!(angles.is_reached, Feet { left: true, right: true });
        let found = pose_of(&angles);
        for (found, asked) in found.to_array().iter().zip(joints.to_array()) {
            prop_assert!((found - asked).abs() < 1e-9, "{found} {asked}");
        }
        let reached = soles(&found);
        for side in SIDES {
            prop_assert!(difference(reached.on(side), asked.on(side)) < 1e-9);
        }
    }

    #[test]
    fn soles_that_turn_as_they_like_stay_where_they_are(
        joints in legs(),
        turned in -0.4..0.4,
        left_share in 0.0..1.0,
    ) {
        let mut asked = soles(&joints);
        asked.left.rotation *= UnitQuaternion::from_euler_angles(0.0, 0.0, turned);
        let reached = soles(&pose_of(&leg_angles(&asked, left_share)));
        for side in SIDES {
            let apart = ankle(reached.on(side)) - ankle(asked.on(side));
            prop_assert!(apart.norm() < 1e-9);
        }
    }

    #[test]
    fn the_foot_whose_share_is_all_has_its_yaw(joints in legs(), turned in -0.3..0.3) {
        let mut asked = soles(&joints);
        asked.left.rotation *= UnitQuaternion::from_euler_angles(0.0, 0.0, turned);
        for (share, side) in [(1.0, Side::Left), (0.0, Side::Right)] {
            let reached = soles(&pose_of(&leg_angles(&asked, share)));
            prop_assert!(difference(reached.on(side), asked.on(side)) < 1e-9);
        }
    }

    #[test]
    fn what_is_out_of_reach_is_pointed_at(
        direction in (-1.0..1.0, -0.5..0.5, -1.0..-0.3_f64),
        distance in 0.21..1.0,
    ) {
        let direction = Vector3::new(direction.0, direction.1, direction.2).normalize();
        let target = hip::<f64>(Side::Left) + direction * distance;
        let level = UnitQuaternion::identity();
        let down = Vector3::new(0.0, 0.0, -kinematics::feet::SOLE_BELOW_ANKLE);
        let asked = Feet {
            left: Isometry3::from_parts(Translation3::from(target + down), level),
            right: soles(&Joints::filled(0.0)).right,
        };
        let angles = leg_angles(&asked, 0.0);
        prop_assert_eq!(angles.is_reached, Feet { left: false, right: true });
        prop_assert_eq!(angles.legs.left.knee_pitch, 0.0);
        let reached = ankle(&soles(&pose_of(&angles)).left) - hip::<f64>(Side::Left);
        prop_assert!((reached - direction * (THIGH + TIBIA)).norm() < 1e-9);
    }

    #[test]
    fn nothing_is_no_number(pose in prop::array::uniform6(-1.0..1.0)) {
        let [x, y, z, roll, pitch, yaw] = pose;
        let rotation = UnitQuaternion::from_euler_angles(3.0 * roll, 3.0 * pitch, 3.0 * yaw);
        let sole = Isometry3::from_parts(Translation3::new(x, y, z), rotation);
        let angles = leg_angles(&Feet { left: sole, right: sole }, 0.5);
        prop_assert!(pose_of(&angles).to_array().iter().all(|angle| angle.is_finite()));
    }
}

#[test]
fn the_hip_itself_is_no_number_to_fear() {
    let sole = Isometry3::from_parts(
        Translation3::from(hip::<f64>(Side::Left))
            * Translation3::new(0.0, 0.0, -kinematics::feet::SOLE_BELOW_ANKLE),
        UnitQuaternion::identity(),
    );
    let angles = leg_angles(
        &Feet {
            left: sole,
            right: sole,
        },
        0.5,
    );
    assert!(!angles.is_reached.left);
    assert!(
        pose_of(&angles)
            .to_array()
            .iter()
            .all(|angle| angle.is_finite())
    );
}

#[test]
fn the_published_standing_pose_is_found() {
    // Legs 0, 0, -17.2, 53.3, -34.4, 0 degrees put the left sole here, pitched by 1.7 degrees.
    let left = Isometry3::from_parts(
        Translation3::new(-0.03240, 0.05, -0.30884),
        UnitQuaternion::from_euler_angles(0.0, 0.02967, 0.0),
    );
    let right = Isometry3::from_parts(Translation3::new(-0.03240, -0.05, -0.30884), left.rotation);
    let angles = leg_angles::<f64>(&Feet { left, right }, 0.5);
    let expected: [f64; 5] = [0.0, -17.2, 53.3, -34.4, 0.0];
    for leg in [angles.legs.left, angles.legs.right] {
        let found = [
            leg.hip_roll,
            leg.hip_pitch,
            leg.knee_pitch,
            leg.ankle_pitch,
            leg.ankle_roll,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found.to_degrees() - expected).abs() < 0.05,
                "{found} {expected}"
            );
        }
    }
}
