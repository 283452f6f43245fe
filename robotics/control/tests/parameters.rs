//! The parameters are ones that a robot survives.

use kinematics::{cameras, forward_kinematics, limits};
use nalgebra::{Point2, Vector3};
use serde::Deserialize;
use types::camera::CameraCalibration;
use types::feet::Side;
use types::head::HeadAngles;
use types::joints::Joints;

#[derive(Deserialize)]
struct Parameters {
    cameras: Cameras,
    head_scan: HeadScan,
    ready_pose: ReadyPose,
}

#[derive(Deserialize)]
struct Cameras {
    top: CameraCalibration,
    bottom: CameraCalibration,
}

#[derive(Deserialize)]
struct HeadScan {
    velocity: f32,
    way_points: Vec<HeadAngles>,
}

#[derive(Deserialize)]
struct ReadyPose {
    positions: Joints<f32>,
}

fn parameters() -> Parameters {
    toml::from_str(include_str!("../../parameters/default.toml")).unwrap()
}

#[test]
fn every_joint_can_take_the_ready_pose() {
    for (joint, angle) in parameters().ready_pose.positions.iter() {
        assert_eq!(limits::clamp(joint, *angle), *angle, "{joint:?}");
    }
}

#[test]
fn in_the_ready_pose_both_soles_are_flat_and_the_robot_does_not_fall() {
    let poses = forward_kinematics(&parameters().ready_pose.positions);
    let (left, right) = (poses.sole(Side::Left), poses.sole(Side::Right));
    assert!(left.rotation.angle_to(&right.rotation) < 1e-6);
    // The sole is level on the ground, so the torso leans by what the sole is pitched against it.
    let torso_to_world = left.rotation.inverse();
    let (roll, pitch, yaw) = torso_to_world.euler_angles();
    assert!(
        roll.abs() < 1e-3 && pitch.abs() < 0.05 && yaw.abs() < 1e-3,
        "{roll} {pitch} {yaw}"
    );

    let from_left = left.inverse() * poses.center_of_mass();
    let from_right = right.inverse() * poses.center_of_mass();
    // Within the soles' extent along x with a margin, and between their middles.
    assert!((-0.03..0.07).contains(&from_left.x), "{from_left}");
    assert!(from_left.y < 0.0 && from_right.y > 0.0);
    assert!((torso_to_world * Vector3::z()).z > 0.99);
}

#[test]
fn the_head_reaches_all_way_points_without_touching_the_shoulders() {
    let head_scan = parameters().head_scan;
    assert!(head_scan.way_points.len() > 1);
    for way_point in head_scan.way_points {
        assert_eq!(limits::clamp_head(way_point), way_point);
    }
}

#[test]
fn the_head_is_slow_enough_for_images_to_fit_their_angles() {
    // One sample of 12 ms between image and angles, at 608 px of focal length.
    let pixels = parameters().head_scan.velocity * 0.012 * 608.0;
    assert!(pixels < 5.0, "{pixels} px");
}

#[test]
fn uncalibrated_cameras_see_as_the_manufacturer_says() {
    let Cameras { top, bottom } = parameters().cameras;
    for calibration in [top, bottom] {
        let [width, height] = cameras::IMAGE_SIZE;
        assert_eq!(
            (calibration.width, calibration.height),
            (width as f32, height as f32)
        );
        let expected = cameras::FOCAL_LENGTH.map(|focal| focal as f32);
        assert_eq!([calibration.focal_x, calibration.focal_y], expected);
        let center = Point2::from(calibration.intrinsics().center);
        assert_eq!(center, Point2::new(320.0, 240.0));
    }
}
