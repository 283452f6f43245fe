//! Owns what stands in the way.

use framework::{Clear, Reflect, Timestamp};
use nalgebra::{Matrix2, Point2};
use serde::{Deserialize, Serialize};

/// Something in an image that stands on the field.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct ObstacleCandidate {
    /// Where it touches the ground, or where the edge is that cuts it, px.
    pub foot: Point2<f32>,
    /// That place of the ground frame, m.
    pub position: Point2<f32>,
    /// Of that place, in m².
    pub covariance: Matrix2<f32>,
}

/// Something that the robot must not run into.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Obstacle {
    /// Its middle in the ground frame of this cycle, m.
    pub position: Point2<f32>,
    /// In m.
    pub radius: f32,
    /// What it is.
    pub kind: ObstacleKind,
    /// When it was perceived last.
    pub seen_at: Timestamp,
}

/// What an obstacle is.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum ObstacleKind {
    /// Something.
    #[default]
    Unknown,
    /// Another robot.
    Robot,
}
