//! Owns what robots of one team tell each other.

use framework::{Clear, Reflect, Timestamp};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};

/// What one robot tells its team.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct TeamMessage {
    /// Number of the sender's shirt.
    pub player_number: u8,
    /// Whether the sender lies on the ground.
    pub is_fallen: bool,
    /// Whether it is the one that plays the ball, as far as the sender knows.
    pub plays_ball: bool,
    /// From the sender's ground frame to the field frame, m and rad; `None` where it does not know.
    pub ground_to_field: Option<Isometry2<f32>>,
    /// The ball as the sender knows it.
    pub ball: Option<TeamBall>,
}

/// A ball as another robot knows it.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct TeamBall {
    /// In the sender's ground frame, m.
    pub position: Point2<f32>,
    /// Seconds since the sender saw it.
    pub age: f32,
}

/// A robot of the own team, as its messages say.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Teammate {
    /// What it said last.
    pub message: TeamMessage,
    /// When that came.
    pub heard_at: Timestamp,
}
