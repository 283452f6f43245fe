//! Owns what is asked of the motors.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

use crate::joints::Joints;

/// A command for every motor.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct MotorCommands {
    /// Angles to reach in rad; hands from 0 (closed) to 1 (open).
    pub positions: Joints<f32>,
    /// Share of the motors' torque that may be used, 0 (limp) to 1.
    pub stiffnesses: Joints<f32>,
}

impl MotorCommands {
    /// Holds a pose, all joints equally stiff.
    pub fn holding(positions: Joints<f32>, stiffness: f32) -> Self {
        Self {
            positions,
            stiffnesses: Joints::filled(stiffness),
        }
    }
}
