//! Computes from the joint angles where head, soles, knees, elbows, and hands are.

use framework::{Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::robot_kinematics::RobotKinematics;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct ForwardKinematics {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    positions: Input<Joints<f32>, "sensor_data.positions">,
}

#[context]
pub struct MainOutputs {
    /// Poses in the torso frame.
    robot_kinematics: MainOutput<RobotKinematics>,
}

impl ForwardKinematics {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Follows every chain from the torso outwards.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let poses = kinematics::forward_kinematics(context.positions);
        Ok(MainOutputs {
            robot_kinematics: RobotKinematics::from(&poses).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::math;
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn a_robot_with_straight_legs_has_its_soles_below_its_hips() {
        let mut node = ForwardKinematics::new(CreationContext {}).unwrap();
        let positions = &Joints::filled(0.0);
        let outputs = node.cycle(CycleContext { positions }).unwrap();
        let left = outputs
            .robot_kinematics
            .value
            .soles_to_torso
            .left
            .translation
            .vector;
        assert!(
            (left - Vector3::new(0.0, 0.05, -0.33309)).norm() < 1e-6,
            "{left}"
        );
    }

    #[test]
    fn looking_left_turns_the_head_and_not_the_feet() {
        let mut node = ForwardKinematics::new(CreationContext {}).unwrap();
        let mut positions = Joints::filled(0.0);
        positions.head_yaw = 0.5;
        let context = CycleContext {
            positions: &positions,
        };
        let kinematics = node.cycle(context).unwrap().robot_kinematics.value;
        let ahead = kinematics.head_to_torso * Vector3::x();
        assert!((ahead.y - math::sin(0.5_f32)).abs() < 1e-6);
        assert!(kinematics.soles_to_torso.left.rotation.angle() < 1e-6);
    }

    #[test]
    fn elbows_and_knees_are_where_arms_and_legs_bend() {
        let mut node = ForwardKinematics::new(CreationContext {}).unwrap();
        let mut positions = Joints::filled(0.0);
        positions.left_elbow_roll = -1.0;
        positions.right_knee_pitch = 1.0;
        let context = CycleContext {
            positions: &positions,
        };
        let kinematics = node.cycle(context).unwrap().robot_kinematics.value;
        let elbow = kinematics.elbows_to_torso.left;
        let knee = kinematics.knees_to_torso.right;
        // Lengths of upper arm and thigh, Aldebaran documentation.
        let expected = Vector3::new(0.105, 0.113, 0.1);
        assert!((elbow.translation.vector - expected).norm() < 1e-6);
        assert!(((elbow * Vector3::x()).y + math::sin(1.0_f32)).abs() < 1e-6);
        let expected = Vector3::new(0.0, -0.05, -0.185);
        assert!((knee.translation.vector - expected).norm() < 1e-6);
        assert!(((knee * Vector3::z()).x - math::sin(1.0_f32)).abs() < 1e-6);
    }
}
