//! Computes for both cameras where they are above the ground, so that pixels become places.
//!
//! The ground frame lies on the floor midway between the soles, level, with x along the torso's
//! heading. While the robot does not stand, the floor could be anywhere: there are no matrices.
//!
//! What is level says the body's own estimate of roll and pitch, as teams of the league use it: feet that
//! hit the floor mislead a filter over accelerations by several hundredths of a rad while the robot
//! walks, and one hundredth at 3 m is 0.2 m.

use framework::{Input, MainOutput, Parameter, RequiredInput, Result, context};
use kinematics::cameras::optical_to_head;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use types::camera::{CameraCalibration, CameraMatrices, CameraMatrix, CameraPosition};
use types::feet::Side;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::InertialMeasurement;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct CameraMatricesProvider {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    support_side: RequiredInput<Option<Side>, "support_side?">,
    robot_kinematics: Input<RobotKinematics, "robot_kinematics">,
    inertial: Input<InertialMeasurement, "sensor_data.inertial">,

    /// How the top camera of this robot sees.
    top: Parameter<CameraCalibration, "cameras.top">,
    /// How the bottom camera of this robot sees.
    bottom: Parameter<CameraCalibration, "cameras.bottom">,
}

#[context]
pub struct MainOutputs {
    /// Of both cameras at the time of this cycle; `None` while the robot does not stand.
    camera_matrices: MainOutput<Option<CameraMatrices>>,
}

impl CameraMatricesProvider {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// From the ground through the supporting sole, torso, and head to the cameras.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let torso_to_ground = torso_to_ground(
            *context.support_side,
            context.robot_kinematics,
            context.inertial,
        );
        // A body that does not know how it leans sees nothing.
        if !torso_to_ground.rotation.angle().is_finite() {
            return Ok(MainOutputs {
                camera_matrices: None.into(),
            });
        }
        let head_to_ground = torso_to_ground * context.robot_kinematics.head_to_torso;
        let matrix = |position, calibration: &CameraCalibration| CameraMatrix {
            ground_to_camera: (head_to_ground * optical_to_head(position, calibration)).inverse(),
            intrinsics: calibration.intrinsics(),
        };
        let camera_matrices = CameraMatrices {
            top: matrix(CameraPosition::Top, context.top),
            bottom: matrix(CameraPosition::Bottom, context.bottom),
        };
        Ok(MainOutputs {
            camera_matrices: Some(camera_matrices).into(),
        })
    }
}

fn torso_to_ground(
    support_side: Side,
    kinematics: &RobotKinematics,
    inertial: &InertialMeasurement,
) -> Isometry3<f32> {
    // The ground frame turns with the robot.
    let level = UnitQuaternion::from_euler_angles(inertial.roll, inertial.pitch, 0.0);
    let soles = kinematics
        .soles_to_torso
        .map(|sole| level * sole.translation.vector);
    let middle = (soles.left + soles.right) / 2.0;
    let origin = Vector3::new(middle.x, middle.y, soles.on(support_side).z);
    Isometry3::from_parts(Translation3::from(-origin), level)
}

#[cfg(test)]
mod tests {
    use framework::math;
    use kinematics::forward_kinematics;
    use nalgebra::{Point2, Point3};
    use types::joints::Joints;

    use super::*;

    fn calibration() -> CameraCalibration {
        CameraCalibration {
            focal_x: 0.95,
            focal_y: 1.27,
            center_x: 0.5,
            center_y: 0.5,
            width: 640.0,
            height: 480.0,
            ..CameraCalibration::default()
        }
    }

    fn matrices(positions: &Joints<f32>, pitch: f32) -> CameraMatrices {
        matrices_on(Side::Left, positions, pitch)
    }

    /// While that sole supports the robot.
    fn matrices_on(support_side: Side, positions: &Joints<f32>, pitch: f32) -> CameraMatrices {
        let mut node = CameraMatricesProvider::new(CreationContext {}).unwrap();
        let context = CycleContext {
            support_side: &support_side,
            robot_kinematics: &RobotKinematics::from(&forward_kinematics(positions)),
            inertial: &InertialMeasurement {
                pitch,
                ..InertialMeasurement::default()
            },
            top: &calibration(),
            bottom: &calibration(),
        };
        node.cycle(context).unwrap().camera_matrices.value.unwrap()
    }

    #[test]
    fn upright_the_top_camera_is_as_high_as_the_robot() {
        let top = matrices(&Joints::filled(0.0), 0.0).top;
        let expected = Point3::new(0.05871, 0.0, 0.33309 + 0.19014);
        assert!(
            (top.position() - expected).norm() < 1e-5,
            "{}",
            top.position()
        );
    }

    #[test]
    fn the_floor_is_below_the_supporting_foot_however_high_the_other_one_is() {
        let straight = matrices(&Joints::filled(0.0), 0.0).top;
        let mut raised = Joints::filled(0.0);
        // A right knee so bent lifts its sole by some centimetres.
        raised.right_hip_pitch = -0.5;
        raised.right_knee_pitch = 1.0;
        raised.right_ankle_pitch = -0.5;
        let height = |side| {
            let top = matrices_on(side, &raised, 0.0).top;
            top.position().z
        };
        assert!((height(Side::Left) - straight.position().z).abs() < 1e-5);
        let soles = RobotKinematics::from(&forward_kinematics(&raised)).soles_to_torso;
        let lifted = soles.right.translation.z - soles.left.translation.z;
        assert!(lifted > 0.02, "{lifted} m");
        let error = height(Side::Left) - height(Side::Right) - lifted;
        assert!(error.abs() < 1e-5, "{error} m");
    }

    #[test]
    fn the_optical_axis_of_the_bottom_camera_meets_the_floor_in_front_of_the_feet() {
        let bottom = matrices(&Joints::filled(0.0), 0.0).bottom;
        let center = Point2::from(bottom.intrinsics.center);
        let point = bottom.pixel_to_ground(center, 0.0).unwrap();
        let expected = 0.05071 + (0.33309 + 0.14424) / math::tan(0.692_895_7_f32);
        assert!((point.x - expected).abs() < 1e-4, "{point}");
        assert!(point.y.abs() < 1e-5);
    }

    #[test]
    fn a_body_that_does_not_know_how_it_leans_sees_nothing() {
        let mut node = CameraMatricesProvider::new(CreationContext {}).unwrap();
        let context = CycleContext {
            support_side: &Side::Left,
            robot_kinematics: &RobotKinematics::from(&forward_kinematics(&Joints::filled(0.0))),
            inertial: &InertialMeasurement {
                roll: f32::NAN,
                ..InertialMeasurement::default()
            },
            top: &calibration(),
            bottom: &calibration(),
        };
        let outputs = node.cycle(context).unwrap();
        assert_eq!(outputs.camera_matrices.value, None);
    }

    #[test]
    fn leaning_forward_looks_nearer() {
        let leaning = 0.2;
        let center = Point2::new(320.0, 240.0);
        let positions = Joints::filled(0.0);
        let upright = matrices(&positions, 0.0).bottom;
        let leaning = matrices(&positions, leaning).bottom;
        let reach = |matrix: &CameraMatrix| matrix.pixel_to_ground(center, 0.0).unwrap().x;
        assert!(reach(&leaning) < reach(&upright));
    }

    #[test]
    fn a_head_turned_left_sees_the_left() {
        let mut positions = Joints::filled(0.0);
        positions.head_yaw = 0.5;
        let top = matrices(&positions, 0.0).top;
        let point = top.pixel_to_ground(Point2::new(320.0, 400.0), 0.0).unwrap();
        assert!(
            (point.y / point.x - math::tan(0.5_f32)).abs() < 1e-3,
            "{point}"
        );
    }
}
