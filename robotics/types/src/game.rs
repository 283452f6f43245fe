//! Owns the game: what the referee's computer says about it, and what it means for this robot.
//!
//! Words and numbers as in the RoboCup Standard Platform League's rules and GameController of 2024
//! and 2025 (control data version 18).

use framework::{Clear, Reflect, Timestamp};
use serde::{Deserialize, Serialize};

use crate::network::Endpoint;

/// How many players the referee's computer knows of each team.
pub const PLAYER_COUNT: usize = 20;

/// Everything that one packet of the referee's computer says.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct GameControllerMessage {
    /// Counts packets, begins again after 255.
    pub packet_number: u8,
    /// How many players a team may have on the field.
    pub players_per_team: u8,
    /// What comes after this game.
    pub competition_phase: CompetitionPhase,
    /// What counts in this game.
    pub competition_type: CompetitionType,
    /// Which part of the game it is.
    pub game_phase: GamePhase,
    /// What robots may do.
    pub game_state: GameState,
    /// How the game was resumed.
    pub set_play: SetPlay,
    /// Whether it is the first half.
    pub is_first_half: bool,
    /// Number of the team that kicks first; `None` where nobody does or it is hidden.
    pub kicking_team: Option<u8>,
    /// Seconds until the end of the half, negative after it.
    pub seconds_remaining: i16,
    /// Seconds of whatever else runs: the Ready state, the time until the ball is free, a break.
    pub secondary_seconds: i16,
    /// The teams; the first defends the left goal as the referee sees it.
    pub teams: [TeamState; 2],
}

/// A packet of the referee's computer and where it came from.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct GameControllerPacket {
    /// What it says.
    pub message: GameControllerMessage,
    /// Who sent it: where answers go.
    pub sender: Endpoint,
}

/// What the referee's computer knows of a team.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct TeamState {
    /// The team's number.
    pub number: u8,
    /// Colour of the field players' shirts.
    pub field_player_color: TeamColor,
    /// Colour of the goalkeeper's shirt.
    pub goalkeeper_color: TeamColor,
    /// Number of the goalkeeper's shirt.
    pub goalkeeper: u8,
    /// Goals.
    pub score: u8,
    /// Counts penalty shots.
    pub penalty_shot: u8,
    /// Bit i: shot i was a goal.
    pub single_shots: u16,
    /// How many messages the team may still send.
    pub message_budget: u16,
    /// The players by the number of their shirt, 1 first.
    pub players: [PlayerState; PLAYER_COUNT],
}

/// What the referee's computer knows of a player.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct PlayerState {
    /// Why the player may not play.
    pub penalty: Penalty,
    /// Seconds until it may again.
    pub seconds_till_unpenalized: u8,
}

/// What comes after this game.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum CompetitionPhase {
    /// A round robin.
    #[default]
    RoundRobin,
    /// A play-off.
    Playoff,
}

/// What counts in this game.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum CompetitionType {
    /// Goals.
    #[default]
    Normal,
    /// Passes.
    MostPasses,
}

/// Which part of the game it is.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum GamePhase {
    /// One of the halves.
    #[default]
    Normal,
    /// The penalty shoot-out.
    PenaltyShootout,
    /// Extra time.
    Overtime,
    /// A time-out.
    Timeout,
}

/// What the referee's computer lets robots do.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum GameState {
    /// Before the game.
    #[default]
    Initial,
    /// Walk to the own place.
    Ready,
    /// Stand and wait for the whistle.
    Set,
    /// Play.
    Playing,
    /// After the half.
    Finished,
    /// Stand and wait for the referee's gesture.
    Standby,
}

/// How the game was resumed.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum SetPlay {
    /// With a kick-off, or not at all.
    #[default]
    None,
    /// Goal kick.
    GoalKick,
    /// Free kick after pushing.
    PushingFreeKick,
    /// Corner kick.
    CornerKick,
    /// Kick-in.
    KickIn,
    /// Penalty kick.
    PenaltyKick,
}

/// Why a player may not play.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum Penalty {
    /// It may.
    #[default]
    None,
    /// Held the ball or touched it with a hand.
    IllegalBallContact,
    /// Pushed.
    PlayerPushing,
    /// Moved in Set.
    IllegalMotionInSet,
    /// Lay or stood still.
    InactivePlayer,
    /// Stood where it must not.
    IllegalPosition,
    /// Left the field.
    LeavingTheField,
    /// Its team asked for it.
    RequestForPickup,
    /// The game was stuck around it.
    LocalGameStuck,
    /// Stood in Set where it must not.
    IllegalPositionInSet,
    /// Stood with its legs too far apart.
    PlayerStance,
    /// Moved in Standby.
    IllegalMotionInStandby,
    /// Is a substitute.
    Substitute,
    /// The referee took it out.
    Manual,
}

/// Colour of a shirt.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub enum TeamColor {
    #[default]
    Blue,
    Red,
    Yellow,
    Black,
    White,
    Green,
    Orange,
    Purple,
    Brown,
    Gray,
}

/// Who this robot is in the game.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Player {
    /// Number of the shirt, from 1 to 20.
    pub number: u8,
    /// Number of the team.
    pub team: u8,
}

/// What the referee's computer said last, as this robot sees it.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct GameControllerState {
    /// Which part of the game it is.
    pub game_phase: GamePhase,
    /// What robots may do.
    pub game_state: GameState,
    /// When it became that, as far as this robot knows.
    pub game_state_since: Timestamp,
    /// How the game was resumed; a shot of the penalty shoot-out is a penalty kick.
    pub set_play: SetPlay,
    /// Who kicks first.
    pub kicking_team: KickingTeam,
    /// Whether it is the first half.
    pub is_first_half: bool,
    /// Seconds until the end of the half, negative after it.
    pub seconds_remaining: i16,
    /// Why this robot may not play.
    pub penalty: Penalty,
    /// Number of the own goalkeeper's shirt; 0, or that of a substitute, where there is none.
    pub goalkeeper: u8,
    /// Why players of the own team may not play, by the number of their shirt, 1 first.
    pub own_penalties: [Penalty; PLAYER_COUNT],
    /// Goals of the own team.
    pub own_score: u8,
    /// Goals of the other team.
    pub opponent_score: u8,
    /// How many messages the own team may still send.
    pub message_budget: u16,
    /// When the packet came.
    pub received_at: Timestamp,
    /// Who sent it: where answers go.
    pub sender: Endpoint,
}

impl GameControllerState {
    /// Whose the ball is.
    pub fn whose_ball(&self) -> WhoseBall {
        WhoseBall {
            game_phase: self.game_phase,
            kicking_team: self.kicking_team,
            set_play: self.set_play,
        }
    }

    /// Why a player of the own team may not play; one that the referee's computer does not know may.
    pub fn penalty_of(&self, number: u8) -> Penalty {
        let index = usize::from(number).checked_sub(1);
        let penalty = index.and_then(|index| self.own_penalties.get(index));
        penalty.copied().unwrap_or_default()
    }
}

/// Who kicks first.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum KickingTeam {
    /// Nobody, or the referee hides it.
    #[default]
    Nobody,
    /// The own team.
    Own,
    /// The other team.
    Opponent,
}

/// Whose the ball is, by what the referee said last.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct WhoseBall {
    /// Which part of the game it is.
    pub game_phase: GamePhase,
    /// Who kicks first.
    pub kicking_team: KickingTeam,
    /// How the game was resumed; a shot of the penalty shoot-out is a penalty kick.
    pub set_play: SetPlay,
}

impl WhoseBall {
    /// Whose shot it is in a penalty shoot-out; `None` in any other part of the game.
    pub fn shot_of(&self) -> Option<KickingTeam> {
        (self.game_phase == GamePhase::PenaltyShootout).then_some(self.kicking_team)
    }

    /// Whether the others have a penalty kick.
    pub fn is_penalty_kick_of_others(&self) -> bool {
        self.set_play == SetPlay::PenaltyKick && self.kicking_team == KickingTeam::Opponent
    }
}

/// What this robot does in the game: the referee's state, penalties, buttons and whistles together.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum PrimaryState {
    /// Sit limp.
    #[default]
    Unstiff,
    /// Stand before the game.
    Initial,
    /// Stand and wait for the referee's gesture.
    Standby,
    /// Walk to the own place.
    Ready,
    /// Stand and wait for the whistle.
    Set,
    /// Play.
    Playing,
    /// Stand still beside the field.
    Penalized,
    /// Stand after the game.
    Finished,
}
