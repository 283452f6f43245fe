//! Says where the robot's own limbs cover the image: a white shin is no robot and no line.
//!
//! Each limb is a chain of balls around bones, the feet are their soles with a height. What the balls
//! cover is widened by a margin for the shell and for what the head turned since the exposure.

mod outline;
mod parts;

use framework::pool::Leased;
use framework::{LatestInput, MainOutput, Parameter, Reflect, RequiredInput, Result, context};
use kinematics::cameras::optical_to_head;
use serde::{Deserialize, Serialize};
use types::camera::{CameraCalibration, CameraPosition};
use types::image::YuyvImage;
use types::limbs::LimbMask;
use types::robot_kinematics::RobotKinematics;

use self::outline::{Projection, outline};
use self::parts::parts;

/// How thick the limbs are, in m.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LimbProjectorParameters {
    /// Radius around the bone between hip and knee.
    pub thigh_radius: f32,
    /// Radius around the bone between knee and ankle.
    pub shin_radius: f32,
    /// Radius around the bones of the arm.
    pub arm_radius: f32,
    /// From the centre of the hand to the tips of the fingers.
    pub finger_length: f32,
    /// Height of the foot's shell above the sole.
    pub foot_height: f32,
    /// How far the chest reaches forward of the torso's origin.
    pub chest_depth: f32,
    /// Half the width of the chest.
    pub chest_half_width: f32,
    /// The height in the torso frame where the chest reaches furthest.
    pub chest_height: f32,
    /// Added to every radius.
    pub margin: f32,
}

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct LimbProjector {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    robot_kinematics: LatestInput<RobotKinematics, "Control", "robot_kinematics">,
    camera_position: Parameter<CameraPosition, "$cycler_instance.camera_position">,
    top: Parameter<CameraCalibration, "cameras.top">,
    bottom: Parameter<CameraCalibration, "cameras.bottom">,
    parameters: Parameter<LimbProjectorParameters, "limb_projector">,
    /// Only limbs that are in the image.
    limb_mask: MainOutput<LimbMask>,
}

#[context]
pub struct MainOutputs {}

impl LimbProjector {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Covers nothing before Control has told where the limbs are.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let Some(kinematics) = context.robot_kinematics.map(|latest| latest.value) else {
            return Ok(MainOutputs {});
        };
        let calibration = match context.camera_position {
            CameraPosition::Top => context.top,
            CameraPosition::Bottom => context.bottom,
        };
        let head_to_camera = optical_to_head(*context.camera_position, calibration).inverse();
        let projection = Projection {
            torso_to_camera: head_to_camera * kinematics.head_to_torso.inverse(),
            intrinsics: calibration.intrinsics(),
            width: context.image.columns() as f32,
            height: context.image.rows() as f32,
        };
        let outlines = parts(kinematics, context.parameters)
            .filter_map(|part| outline(&projection, &part, context.parameters.margin));
        context.limb_mask.limbs.extend(outlines);
        Ok(MainOutputs {})
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, latest, parameter};
    use kinematics::forward_kinematics;
    use kinematics::links::LinkName;
    use nalgebra::{Isometry3, Point2, Point3, Vector3};
    use types::joints::Joints;

    use super::*;

    const CALIBRATION: CameraCalibration = CameraCalibration {
        focal_x: 0.95,
        focal_y: 1.27,
        center_x: 0.5,
        center_y: 0.5,
        width: 640.0,
        height: 480.0,
        roll: 0.0,
        pitch: 0.0,
        yaw: 0.0,
    };

    fn parameters() -> LimbProjectorParameters {
        parameter(
            "{ thigh_radius = 0.055, shin_radius = 0.05, arm_radius = 0.04, finger_length = 0.06, \
             foot_height = 0.05, chest_depth = 0.06, chest_half_width = 0.08, chest_height = 0.03, \
             margin = 0.01 }",
        )
    }

    fn mask(camera: CameraPosition, joints: &Joints<f32>) -> LimbMask {
        let kinematics = RobotKinematics::from(&forward_kinematics(joints));
        project(camera, Some(&kinematics), &parameters())
    }

    fn project(
        camera: CameraPosition,
        kinematics: Option<&RobotKinematics>,
        parameters: &LimbProjectorParameters,
    ) -> LimbMask {
        let mut limb_mask = LimbMask::default();
        LimbProjector::new(CreationContext {})
            .unwrap()
            .cycle(CycleContext {
                image: &Leased::of(YuyvImage::new(640, 480)),
                robot_kinematics: kinematics
                    .and_then(|value| latest(at_millis(5), value, at_millis(9))),
                camera_position: &camera,
                top: &CALIBRATION,
                bottom: &CALIBRATION,
                parameters,
                limb_mask: &mut limb_mask,
            })
            .unwrap();
        limb_mask
    }

    /// Knees bent, arms hanging, looking down as far as possible.
    fn looking_down() -> Joints<f32> {
        Joints {
            head_pitch: 0.5,
            left_hip_pitch: -0.3,
            right_hip_pitch: -0.3,
            left_knee_pitch: 0.93,
            right_knee_pitch: 0.93,
            left_ankle_pitch: -0.6,
            right_ankle_pitch: -0.6,
            left_shoulder_pitch: 1.57,
            right_shoulder_pitch: 1.57,
            ..Joints::filled(0.0)
        }
    }

    /// Where the bottom camera sees a point of a link, from the numbers of the NAO V6 URDF alone.
    fn seen(joints: &Joints<f32>, link: LinkName, point: Point3<f32>) -> Point2<f32> {
        let poses = forward_kinematics(joints);
        let mount = Vector3::new(0.05071, 0.0, 0.01774);
        let camera_to_head = Isometry3::new(mount, Vector3::y() * 0.692_895_7);
        let camera_to_torso = poses.link(LinkName::Head) * camera_to_head;
        let seen = camera_to_torso.inverse() * poses.link(link) * point;
        // x leads away, y to the left, z up; 0.95 widths and 1.27 heights of focal length.
        let (left, up) = (seen.y / seen.x, seen.z / seen.x);
        Point2::new(320.0 - 608.0 * left, 240.0 - 609.6 * up)
    }

    #[test]
    fn looking_down_the_knees_and_the_toes_are_covered() {
        let joints = looking_down();
        let mask = mask(CameraPosition::Bottom, &joints);
        let toe = Point3::new(0.1, 0.0, -0.03);
        for (link, point) in [
            (LinkName::LeftTibia, Point3::origin()),
            (LinkName::RightTibia, Point3::origin()),
            (LinkName::LeftFoot, toe),
            (LinkName::RightFoot, toe),
        ] {
            let pixel = seen(&joints, link, point);
            assert!(mask.covers(pixel), "{link:?} at {pixel}: {mask:?}");
        }
    }

    #[test]
    fn the_floor_in_front_of_the_toes_is_free() {
        let joints = looking_down();
        let mask = mask(CameraPosition::Bottom, &joints);
        let ahead = Point3::new(0.2, 0.0, -0.045);
        let pixel = seen(&joints, LinkName::LeftFoot, ahead);
        assert!(!mask.covers(pixel), "{pixel}: {mask:?}");
        assert!(!mask.covers(Point2::new(320.0, 100.0)));
    }

    #[test]
    fn looking_ahead_the_top_camera_sees_no_limbs() {
        let joints = Joints {
            head_pitch: 0.0,
            ..looking_down()
        };
        assert_eq!(mask(CameraPosition::Top, &joints), LimbMask::default());
    }

    #[test]
    fn an_arm_held_in_front_of_the_camera_is_covered() {
        let joints = Joints {
            left_shoulder_pitch: 0.2,
            left_shoulder_roll: -0.2,
            ..Joints::filled(0.0)
        };
        let mask = mask(CameraPosition::Bottom, &joints);
        let pixel = seen(&joints, LinkName::LeftHand, Point3::new(0.05, 0.0, -0.01));
        assert!(mask.covers(pixel), "{pixel}: {mask:?}");
    }

    #[test]
    fn before_control_has_told_nothing_is_covered() {
        let mask = project(CameraPosition::Bottom, None, &parameters());
        assert_eq!(mask, LimbMask::default());
    }

    #[test]
    fn sizes_that_are_no_numbers_are_no_limbs() {
        let parameters = LimbProjectorParameters {
            margin: f32::NAN,
            ..parameters()
        };
        let kinematics = RobotKinematics::from(&forward_kinematics(&looking_down()));
        let mask = project(CameraPosition::Bottom, Some(&kinematics), &parameters);
        assert_eq!(mask, LimbMask::default());
    }
}
