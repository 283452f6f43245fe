//! Owns what is asked of the motors, and how far the robot has risen.

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

/// How far the robot has got on its way to its ready pose.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum MotionPhase {
    /// On the way from wherever it was.
    #[default]
    Rising,
    /// In the ready pose.
    Ready,
}
