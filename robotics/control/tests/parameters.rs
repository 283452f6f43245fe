//! The parameters are ones that a robot survives.

use control::localization::FieldPose;
use framework::testing::ParameterFile;
use kinematics::{cameras, forward_kinematics, limits};
use nalgebra::{Point2, Vector3};
use serde::Deserialize;
use types::camera::CameraCalibration;
use types::feet::Side;
use types::head::HeadAngles;
use types::joints::Joints;

fn parameters() -> ParameterFile {
    ParameterFile::new(include_str!("../../parameters/default.toml"))
}

/// Stand, penalised, crouch, sitting.
fn poses() -> [Joints<f32>; 4] {
    let parameters = parameters();
    [
        "stand.positions",
        "penalized_pose.positions",
        "sit_down.crouch",
        "sit_down.sitting",
    ]
    .map(|path| parameters.get(path))
}

#[test]
fn every_joint_can_take_every_pose() {
    for pose in poses() {
        for (joint, angle) in pose.iter() {
            assert_eq!(limits::clamp(joint, *angle), *angle, "{joint:?}");
        }
    }
}

#[test]
fn in_every_pose_and_between_them_both_soles_are_flat_and_the_robot_does_not_fall() {
    let poses = poses();
    for (from, to) in [(0, 1), (0, 2), (1, 2), (2, 3), (3, 0), (3, 1)] {
        for step in 0..=10_u8 {
            let share = f32::from(step) / 10.0;
            let pose = Joints::from_fn(|joint| {
                poses[from][joint] * (1.0 - share) + poses[to][joint] * share
            });
            assert_stable(&pose, &format!("{share} from {from} to {to}"));
        }
    }
}

fn assert_stable(pose: &Joints<f32>, place: &str) {
    let poses = forward_kinematics(pose);
    let (left, right) = (poses.sole(Side::Left), poses.sole(Side::Right));
    assert!(left.rotation.angle_to(&right.rotation) < 1e-3, "{place}");
    // The sole is level on the ground, so the torso leans by what the sole is pitched against it.
    let torso_to_world = left.rotation.inverse();
    let (roll, pitch, yaw) = torso_to_world.euler_angles();
    assert!(
        roll.abs() < 1e-3 && pitch.abs() < 0.06 && yaw.abs() < 1e-3,
        "{place}: {roll} {pitch} {yaw}"
    );

    let from_left = left.inverse() * poses.center_of_mass();
    let from_right = right.inverse() * poses.center_of_mass();
    // Within the soles' extent along x with a margin, and between their middles.
    assert!((-0.03..0.07).contains(&from_left.x), "{place}: {from_left}");
    assert!(from_left.y < 0.0 && from_right.y > 0.0, "{place}");
    assert!((torso_to_world * Vector3::z()).z > 0.99, "{place}");
}

#[test]
fn the_head_reaches_all_way_points_without_touching_the_shoulders() {
    let way_points: Vec<HeadAngles> = parameters().get("look_around.way_points");
    assert!(way_points.len() > 1);
    for way_point in way_points {
        assert_eq!(limits::clamp_head(way_point), way_point);
    }
}

#[test]
fn the_head_is_slow_enough_for_images_to_fit_their_angles() {
    // One sample of 12 ms between image and angles, at 608 px of focal length.
    let pixels = parameters().get::<f32>("head_motion.velocity") * 0.012 * 608.0;
    assert!(pixels < 5.0, "{pixels} px");
}

#[test]
fn uncalibrated_cameras_see_as_the_manufacturer_says() {
    for path in ["cameras.top", "cameras.bottom"] {
        let calibration: CameraCalibration = parameters().get(path);
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

/// A robot of a scenario, m, m and rad.
#[derive(Deserialize)]
struct Placed {
    number: usize,
    pose: [f32; 3],
}

#[test]
fn the_scenario_that_walks_in_starts_where_the_robot_believes_to_start() {
    let file = include_str!("../../scenarios/walk_in_from_the_touch_line.toml");
    let scenario = ParameterFile::new(file);
    let start_poses: Vec<FieldPose> = parameters().get("localization.start_poses");
    let of_scenario: Vec<FieldPose> = scenario.get("parameters.localization.start_poses");
    assert_eq!(start_poses, of_scenario);
    for Placed { number, pose } in scenario.get::<Vec<Placed>>("robot") {
        let start = start_poses[number - 1];
        assert_eq!(pose, [start.x, start.y, start.heading], "{number}");
    }
}
