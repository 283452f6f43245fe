//! Owns how the torso stands or lies.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// Whether the robot stands, falls, or lies.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum FallState {
    /// On its feet, torso up.
    #[default]
    Upright,
    /// On its bottom, torso leaning back.
    Sitting,
    /// On its way down.
    Falling(FallDirection),
    /// On the ground.
    Lying(Facing),
}

/// Where the torso tips to.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum FallDirection {
    /// Towards its face.
    #[default]
    Forward,
    /// Towards its back.
    Backward,
    /// Towards its left arm.
    Left,
    /// Towards its right arm.
    Right,
}

/// Where the face of a lying robot points.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Facing {
    /// To the ground.
    #[default]
    Down,
    /// To the ceiling.
    Up,
}
