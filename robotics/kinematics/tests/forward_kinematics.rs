//! Poses of the NAO against vectors computed independently from the same dimensions.

use std::f64::consts::{FRAC_PI_2, PI};

use kinematics::cameras::{camera_to_head, optical_to_camera};
use kinematics::links::LinkName;
use kinematics::{Poses, forward_kinematics};
use nalgebra::{Isometry3, Point3, Vector3};
use types::camera::CameraPosition;
use types::feet::Side;
use types::joints::{JointName, Joints};

fn degrees(angle: f64) -> f64 {
    angle * PI / 180.0
}

fn standing() -> Joints<f64> {
    let mut joints = Joints::filled(0.0);
    joints.left_shoulder_pitch = FRAC_PI_2;
    joints.right_shoulder_pitch = FRAC_PI_2;
    joints.left_shoulder_roll = degrees(11.5);
    joints.right_shoulder_roll = degrees(-11.5);
    joints.left_elbow_yaw = -FRAC_PI_2;
    joints.right_elbow_yaw = FRAC_PI_2;
    joints.left_hip_pitch = degrees(-17.2);
    joints.right_hip_pitch = degrees(-17.2);
    joints.left_knee_pitch = degrees(53.3);
    joints.right_knee_pitch = degrees(53.3);
    joints.left_ankle_pitch = degrees(-34.4);
    joints.right_ankle_pitch = degrees(-34.4);
    joints
}

fn mixed() -> Joints<f64> {
    Joints {
        head_yaw: 0.5,
        head_pitch: 0.3,
        hip_yaw_pitch: -0.4,
        left_hip_roll: 0.1,
        right_hip_roll: -0.2,
        left_hip_pitch: -0.5,
        right_hip_pitch: -0.3,
        left_knee_pitch: 0.9,
        right_knee_pitch: 0.7,
        left_ankle_pitch: -0.4,
        right_ankle_pitch: -0.35,
        left_ankle_roll: -0.1,
        right_ankle_roll: 0.15,
        left_shoulder_pitch: 1.2,
        left_shoulder_roll: 0.3,
        left_elbow_yaw: -1.0,
        left_elbow_roll: -0.7,
        left_wrist_yaw: 0.4,
        right_shoulder_pitch: 1.5,
        right_shoulder_roll: -0.2,
        right_elbow_yaw: 0.8,
        right_elbow_roll: 0.5,
        right_wrist_yaw: -0.3,
        left_hand: 0.0,
        right_hand: 0.0,
    }
}

fn camera(poses: &Poses<f64>, position: CameraPosition) -> Isometry3<f64> {
    poses.link(LinkName::Head) * camera_to_head(position)
}

fn assert_pose(pose: Isometry3<f64>, position: [f64; 3], roll_pitch_yaw: [f64; 3]) {
    assert_point(pose.translation.vector.into(), position);
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    for (angle, expected) in [roll, pitch, yaw].into_iter().zip(roll_pitch_yaw) {
        assert!(
            (angle - expected).abs() < 1e-5,
            "{roll} {pitch} {yaw}: {roll_pitch_yaw:?}"
        );
    }
}

fn assert_point(point: Point3<f64>, expected: [f64; 3]) {
    let error = (point - Point3::from(expected)).amax();
    assert!(error < 0.6e-5, "{point}: {expected:?}");
}

#[test]
fn the_robot_with_all_joints_at_zero_is_where_it_should_be() {
    let poses = forward_kinematics(&Joints::filled(0.0));
    assert_pose(poses.sole(Side::Left), [0.0, 0.05, -0.33309], [0.0; 3]);
    assert_pose(
        camera(&poses, CameraPosition::Top),
        [0.05871, 0.0, 0.19014],
        [0.0, 0.02094, 0.0],
    );
    let bottom = camera(&poses, CameraPosition::Bottom);
    assert_pose(bottom, [0.05071, 0.0, 0.14424], [0.0, 0.69290, 0.0]);
    assert_pose(
        poses.hand(Side::Left),
        [0.21870, 0.11300, 0.08769],
        [0.0; 3],
    );
    assert_point(poses.center_of_mass(), [0.02122, 0.00018, -0.03281]);
}

#[test]
fn the_standing_robot_is_where_it_should_be() {
    let poses = forward_kinematics(&standing());
    assert_pose(
        poses.sole(Side::Left),
        [-0.03240, 0.05, -0.30884],
        [0.0, 0.02967, 0.0],
    );
    assert_pose(
        poses.sole(Side::Right),
        [-0.03240, -0.05, -0.30884],
        [0.0, 0.02967, 0.0],
    );
    assert_point(poses.center_of_mass(), [-0.00049, 0.00018, -0.04850]);
}

#[test]
fn the_robot_with_every_joint_bent_is_where_it_should_be() {
    let poses = forward_kinematics(&mixed());
    assert_pose(
        poses.sole(Side::Left),
        [0.06469, 0.07862, -0.30141],
        [-0.04107, -0.27896, 0.29050],
    );
    assert_pose(
        poses.sole(Side::Right),
        [0.04100, -0.09410, -0.31255],
        [-0.00689, -0.22959, -0.29863],
    );
    assert_pose(
        camera(&poses, CameraPosition::Top),
        [0.06573, 0.03591, 0.16995],
        [0.0, 0.32094, 0.5],
    );
    assert_pose(
        poses.hand(Side::Left),
        [0.11982, 0.12494, -0.06353],
        [-0.61800, 0.61930, -0.13117],
    );
    assert_pose(
        poses.hand(Side::Right),
        [0.04328, -0.11042, -0.10566],
        [0.81655, 1.11931, 0.35832],
    );
    assert_point(poses.center_of_mass(), [0.02444, 0.00045, -0.04316]);
}

#[test]
fn single_precision_differs_by_less_than_a_micrometre() {
    let double = forward_kinematics(&mixed());
    let single = forward_kinematics(&mixed().map(|angle| angle as f32));
    for side in [Side::Left, Side::Right] {
        let difference = single.sole(side).cast::<f64>().translation.vector
            - double.sole(side).translation.vector;
        assert!(difference.norm() < 1e-6, "{difference}");
    }
}

#[test]
fn the_mirrored_robot_has_mirrored_feet() {
    let joints = mixed();
    let mirrored = Joints::from_fn(|joint| {
        let angle = joints[joint.mirrored()];
        let name = joint.manufacturer_name();
        let about_y = name.ends_with("Pitch") || name.ends_with("Hand");
        if about_y { angle } else { -angle }
    });
    assert_eq!(mirrored[JointName::HipYawPitch], joints.hip_yaw_pitch);
    let left = forward_kinematics(&joints)
        .sole(Side::Left)
        .translation
        .vector;
    let right = forward_kinematics(&mirrored)
        .sole(Side::Right)
        .translation
        .vector;
    assert!((left - Vector3::new(right.x, -right.y, right.z)).norm() < 1e-12);
}

#[test]
fn an_optical_axis_points_forward() {
    let optical_to_camera = optical_to_camera::<f64>();
    assert!((optical_to_camera * Vector3::z() - Vector3::x()).norm() < 1e-12);
    assert!((optical_to_camera * Vector3::x() + Vector3::y()).norm() < 1e-12);
    assert!((optical_to_camera * Vector3::y() + Vector3::z()).norm() < 1e-12);
}
