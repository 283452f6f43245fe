//! The simulated game: who plays, and when the referee says what.

use framework::{Error, Result};
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::Error as ValueError;
use types::game::{GamePhase, GameState, KickingTeam, PLAYER_COUNT, Penalty, SetPlay};

use super::PlaySettings;
use crate::scene::Team;

/// How many of a team are on the field (RoboCup SPL rules 2025, Champions Cup).
pub(crate) const PLAYERS_PER_TEAM: u8 = 7;
/// Longer than any game, s.
const LONGEST: f64 = 1e6;

/// Who plays, and how the game goes.
#[derive(Clone, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GameSettings {
    /// Number of the own team.
    pub team: u8,
    /// Number of the other team.
    pub opponent: u8,
    /// Number of the robot's shirt.
    pub player_number: u8,
    /// Whether the robot is one of the other team, as a scenario says.
    #[serde(skip)]
    pub is_opponent: bool,
    /// The number of the shirt of a team mate of the own team that only speaks, where there is one.
    #[serde(skip)]
    pub mate: Option<u8>,
    /// Numbers of the goalkeepers' shirts, of the own and of the other team; 0 where there is none.
    pub goalkeepers: [u8; 2],
    /// How many messages a team may send (RoboCup SPL rules 2025: 1200 in a game).
    pub message_budget: u16,
    /// A referee plays a game in place of `schedule`.
    pub play: Option<PlaySettings>,
    /// What the referee's computer says, in the order of time.
    pub schedule: Vec<Announcement>,
}

/// What the referee's computer says from a time on.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Announcement {
    /// When, s since the start.
    pub at: f64,
    /// What robots may do.
    pub state: GameState,
    /// Why this robot may not play; left out: it may.
    #[serde(default)]
    pub penalty: Penalty,
    /// Which part of the game it is; left out: one of the halves.
    #[serde(default)]
    pub phase: GamePhase,
    /// Who kicks first; left out: the own team.
    #[serde(default = "own_team")]
    pub kicking_team: KickingTeam,
    /// How the game is resumed; left out: with a kick-off.
    #[serde(default)]
    pub set_play: SetPlay,
    /// Goals of the own and of the other team; left out: none.
    #[serde(default)]
    pub score: [u8; 2],
}

impl Announcement {
    /// Only a state.
    pub fn of(at: f64, state: GameState) -> Self {
        Self {
            at,
            state,
            penalty: Penalty::None,
            phase: GamePhase::Normal,
            kicking_team: own_team(),
            set_play: SetPlay::None,
            score: [0; 2],
        }
    }
}

impl Default for GameSettings {
    /// A kick-off. The whistle sounds at 12 s; the referee's computer says so 15 s later (RoboCup SPL
    /// rules 2025).
    fn default() -> Self {
        Self {
            team: 5,
            opponent: 6,
            player_number: 3,
            is_opponent: false,
            mate: None,
            goalkeepers: [1; 2],
            message_budget: 1200,
            play: None,
            schedule: vec![
                Announcement::of(0.0, GameState::Initial),
                Announcement::of(3.0, GameState::Ready),
                Announcement::of(8.0, GameState::Set),
                Announcement::of(27.0, GameState::Playing),
            ],
        }
    }
}

impl GameSettings {
    /// Holds one state for the whole run.
    pub(super) fn hold(&mut self, option: &str, state: &str) -> Result<()> {
        let state: Result<GameState, ValueError> =
            GameState::deserialize(IntoDeserializer::<ValueError>::into_deserializer(state));
        let state =
            state.map_err(|error| Error::from(error).context(format!("option `{option}`")))?;
        self.schedule = vec![Announcement::of(0.0, state)];
        self.play = None;
        Ok(())
    }

    /// The number of a team.
    pub(crate) fn team_of(&self, side: Team) -> u8 {
        match side {
            Team::Own => self.team,
            Team::Opponent => self.opponent,
        }
    }

    /// The number of the team mate's shirt.
    pub(crate) fn mate_number(&self) -> u8 {
        if self.player_number == 2 { 3 } else { 2 }
    }

    /// Refuses a game that cannot be.
    pub(super) fn check(&self) -> Result<()> {
        let wrong = |key: &str, reason: String| {
            Err(Error::new(format!(
                "hardware.simulated.game.{key}: {reason}"
            )))
        };
        if self.team == u8::MAX || self.opponent == u8::MAX {
            return wrong("team", "no team has number 255".to_owned());
        }
        if self.team == self.opponent {
            let number = self.team;
            return wrong("opponent", format!("both teams have number {number}"));
        }
        if !(1..=PLAYER_COUNT).contains(&self.player_number.into()) {
            let number = self.player_number;
            return wrong(
                "player_number",
                format!("shirts have numbers from 1 to {PLAYER_COUNT}, not {number}"),
            );
        }
        if let Some(number) = self
            .goalkeepers
            .iter()
            .find(|number| usize::from(**number) > PLAYER_COUNT)
        {
            return wrong(
                "goalkeepers",
                format!("shirts have numbers from 1 to {PLAYER_COUNT}, not {number}"),
            );
        }
        self.play.iter().try_for_each(PlaySettings::check)?;
        let mut before = 0.0;
        for Announcement { at, state, .. } in &self.schedule {
            if !(before..LONGEST).contains(at) {
                return wrong(
                    "schedule",
                    format!("{state:?} at {at} s does not come after {before} s"),
                );
            }
            before = *at;
        }
        Ok(())
    }
}

fn own_team() -> KickingTeam {
    KickingTeam::Own
}
