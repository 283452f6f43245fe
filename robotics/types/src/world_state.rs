//! Owns everything that the behaviour decides on.

use framework::{Clear, Reflect};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};

use crate::ball::Ball;
use crate::behavior::Role;
use crate::fall_state::FallState;
use crate::game::{GamePhase, KickingTeam, PrimaryState, SetPlay};
use crate::obstacles::Obstacle;
use crate::team::Teammate;

/// The robot and what is around it, in the ground frame of this cycle.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct WorldState {
    /// What this robot does in the game.
    pub primary_state: PrimaryState,
    /// Which part of the game it is.
    pub game_phase: GamePhase,
    /// Who kicks first.
    pub kicking_team: KickingTeam,
    /// How the game was resumed.
    pub set_play: SetPlay,
    /// What this robot is for its team; `None` while it may not play.
    pub role: Option<Role>,
    /// Number of the own goalkeeper's shirt; no robot has it where there is none.
    pub goalkeeper: u8,
    /// Whether the robot stands, falls, or lies.
    pub fall_state: FallState,
    /// Whether its soles carry it.
    pub has_ground_contact: bool,
    /// From the ground frame to the field frame, m and rad; `None` while the robot does not know where it is.
    pub ground_to_field: Option<Isometry2<f32>>,
    /// The ball; `None` where nobody has seen it lately.
    pub ball: Option<Ball>,
    /// Where the team sees the ball, m; `None` where nobody has seen it lately, or the own pose is not known.
    pub team_ball: Option<Point2<f32>>,
    /// What stands in the way, nearest first.
    pub obstacles: Vec<Obstacle>,
    /// The robots of the own team that were heard lately and may play, by their number.
    pub teammates: Vec<Teammate>,
}
