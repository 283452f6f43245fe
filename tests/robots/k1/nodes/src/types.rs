//! What the motors say and are told.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

use crate::joints::COUNT;

/// Angles of all joints, rad, in the order of [`crate::joints`].
pub type Angles = [f32; COUNT];

/// One sample of the body.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Body {
    /// rad.
    pub positions: [f32; COUNT],
    /// rad/s.
    pub velocities: [f32; COUNT],
    /// Nm, as the motors estimate them.
    pub torques: [f32; COUNT],
    /// Roll, pitch and yaw of the trunk, rad.
    pub attitude: [f32; 3],
}

/// What all motors shall do: torque = stiffness * (position - measured) - damping * measured velocity.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct MotorCommands {
    /// rad.
    pub positions: [f32; COUNT],
    /// Nm/rad.
    pub stiffnesses: [f32; COUNT],
    /// Nm s/rad.
    pub dampings: [f32; COUNT],
}

/// How hard a kind of motor holds its position.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Gains {
    /// Nm/rad.
    pub stiffness: f32,
    /// Nm s/rad.
    pub damping: f32,
}
