//! Computes for both cameras where they are above the ground, so that pixels become places.
//!
//! The ground frame lies on the floor midway between the soles, level, with x along the torso's
//! heading. While the robot does not stand, the floor could be anywhere: there are no matrices. Nor are there while
//! it gets up: its torso swings, and what it leans is known too late.
//!
//! What is level says the body's own estimate of roll and pitch, as teams of the league use it: feet that
//! hit the floor mislead a filter over accelerations by several hundredths of a rad while the robot
//! walks, and one hundredth at 3 m is 0.2 m.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use kinematics::cameras::optical_to_head;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use types::camera::{CameraCalibration, CameraMatrices, CameraMatrix, CameraPosition};
use types::fall_state::FallState;
use types::feet::Side;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::InertialMeasurement;

/// Knows how long the robot has been up.
#[derive(Debug, Deserialize, Serialize)]
pub struct CameraMatricesProvider {
    /// When it fell, lay or sat last.
    down_at: Option<Timestamp>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    support_side: Input<Option<Side>, "support_side?">,
    fall_state: Input<FallState, "fall_state">,
    cycle_time: CycleTime,
    robot_kinematics: Input<RobotKinematics, "robot_kinematics">,
    inertial: Input<InertialMeasurement, "sensor_data.inertial">,

    /// How the top camera of this robot sees.
    top: Parameter<CameraCalibration, "cameras.top">,
    /// How the bottom camera of this robot sees.
    bottom: Parameter<CameraCalibration, "cameras.bottom">,
    /// A robot that has been up for so long swings no more.
    #[reflect(unit = "s", range = 0.0..)]
    steady_after: Parameter<f32, "cameras.steady_after">,
}

#[context]
pub struct MainOutputs {
    /// Of both cameras at the time of this cycle; `None` while the robot does not stand, or only just.
    camera_matrices: MainOutput<Option<CameraMatrices>>,
}

impl CameraMatricesProvider {
    /// Has not been down.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { down_at: None })
    }

    /// From the ground through the supporting sole, torso, and head to the cameras.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let camera_matrices = self.torso_to_ground(&context).map(|torso_to_ground| {
            let head_to_ground = torso_to_ground * context.robot_kinematics.head_to_torso;
            matrices(&head_to_ground, &context)
        });
        Ok(MainOutputs {
            camera_matrices: camera_matrices.into(),
        })
    }

    /// `None` where nobody knows it well enough to see.
    fn torso_to_ground(&mut self, context: &CycleContext<'_>) -> Option<Isometry3<f32>> {
        let now = context.cycle_time.start;
        if *context.fall_state != FallState::Upright {
            self.down_at = Some(now);
        }
        let is_steady = self
            .down_at
            .is_none_or(|down_at| (now - down_at).as_secs_f32() > *context.steady_after);
        let support_side = context.support_side.filter(|_| is_steady)?;
        let pose = torso_to_ground(*support_side, context.robot_kinematics, context.inertial);
        // A body that does not know how it leans sees nothing.
        pose.rotation.angle().is_finite().then_some(pose)
    }
}

fn matrices(head_to_ground: &Isometry3<f32>, context: &CycleContext<'_>) -> CameraMatrices {
    let matrix = |position, calibration: &CameraCalibration| CameraMatrix {
        ground_to_camera: (head_to_ground * optical_to_head(position, calibration)).inverse(),
        intrinsics: calibration.intrinsics(),
    };
    CameraMatrices {
        top: matrix(CameraPosition::Top, context.top),
        bottom: matrix(CameraPosition::Bottom, context.bottom),
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
    use framework::testing::cycle_time;
    use kinematics::forward_kinematics;
    use nalgebra::{Point2, Point3};
    use types::fall_state::Facing;
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
        let inertial = InertialMeasurement {
            pitch,
            ..InertialMeasurement::default()
        };
        let mut node = CameraMatricesProvider::new(CreationContext {}).unwrap();
        seen(
            &mut node,
            (0, FallState::Upright, Some(support_side)),
            positions,
            &inertial,
        )
        .unwrap()
    }

    /// In a cycle that begins after so many ms.
    fn seen(
        node: &mut CameraMatricesProvider,
        (start, fall_state, support_side): (u64, FallState, Option<Side>),
        positions: &Joints<f32>,
        inertial: &InertialMeasurement,
    ) -> Option<CameraMatrices> {
        let context = CycleContext {
            support_side: support_side.as_ref(),
            fall_state: &fall_state,
            cycle_time: cycle_time(start, 12),
            robot_kinematics: &RobotKinematics::from(&forward_kinematics(positions)),
            inertial,
            top: &calibration(),
            bottom: &calibration(),
            steady_after: &1.0,
        };
        node.cycle(context).unwrap().camera_matrices.value
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
        let inertial = InertialMeasurement {
            roll: f32::NAN,
            ..InertialMeasurement::default()
        };
        let mut node = CameraMatricesProvider::new(CreationContext {}).unwrap();
        let upright = (0, FallState::Upright, Some(Side::Left));
        let seen = seen(&mut node, upright, &Joints::filled(0.0), &inertial);
        assert_eq!(seen, None);
    }

    #[test]
    fn a_robot_that_has_just_got_up_sees_nothing_yet() {
        let mut node = CameraMatricesProvider::new(CreationContext {}).unwrap();
        let lying = FallState::Lying(Facing::Down);
        let (on_feet, up) = (Some(Side::Left), FallState::Upright);
        for (start, fall_state, support_side, sees) in [
            // One that stands from the beginning has not swung.
            (0, up, on_feet, true),
            (12, lying, on_feet, false),
            (4000, lying, None, false),
            (4012, up, on_feet, false),
            (4500, up, None, false),
            (4988, up, on_feet, false),
            (5012, up, on_feet, true),
            (5024, up, None, false),
            (5036, up, on_feet, true),
        ] {
            let cycle = (start, fall_state, support_side);
            let joints = Joints::filled(0.0);
            let seen = seen(&mut node, cycle, &joints, &InertialMeasurement::default());
            assert_eq!(seen.is_some(), sees, "after {start} ms");
        }
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
