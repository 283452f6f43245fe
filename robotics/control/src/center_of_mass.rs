//! Computes from the joint angles where the robot's centre of mass is: over it the robot balances.
//!
//! It walks the chains a second time in a cycle, after `forward_kinematics`: `robot_kinematics` holds
//! only the links that others read, and not every link that has a mass. It is a node of its own so
//! that whoever replaces the mass model replaces one node.

use framework::{Input, MainOutput, Result, context};
use kinematics::forward_kinematics;
use nalgebra::Point3;
use serde::{Deserialize, Serialize};
use types::joints::Joints;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct CenterOfMass {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    positions: Input<Joints<f32>, "sensor_data.positions">,
}

#[context]
pub struct MainOutputs {
    /// Of the whole robot in the torso frame, in m.
    center_of_mass: MainOutput<Point3<f32>>,
}

impl CenterOfMass {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Weighs every link where it is.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let poses = forward_kinematics(context.positions);
        Ok(MainOutputs {
            center_of_mass: poses.center_of_mass().into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn center_of_mass(positions: &Joints<f32>) -> Point3<f32> {
        let mut node = CenterOfMass::new(CreationContext {}).unwrap();
        let outputs = node.cycle(CycleContext { positions }).unwrap();
        outputs.center_of_mass.value
    }

    #[test]
    fn with_all_joints_at_zero_it_is_where_the_masses_of_the_manufacturer_put_it() {
        let center = center_of_mass(&Joints::filled(0.0));
        let expected = Point3::new(0.02122, 0.00018, -0.03281);
        assert!((center - expected).norm() < 1e-5, "{center}");
    }

    #[test]
    fn arms_that_hang_move_it_back_and_down() {
        let mut positions = Joints::filled(0.0);
        let ahead = center_of_mass(&positions);
        positions.left_shoulder_pitch = 1.5;
        positions.right_shoulder_pitch = 1.5;
        let hanging = center_of_mass(&positions);
        assert!(hanging.x < ahead.x && hanging.z < ahead.z, "{hanging}");
    }
}
