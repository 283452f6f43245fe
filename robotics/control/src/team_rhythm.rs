//! Owns how often a robot talks to its team where all of the team share what is left of their messages.

use framework::Reflect;
use serde::{Deserialize, Serialize};
use types::game::{GameControllerState, Penalty};

/// How the team shares its messages.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct TeamRhythm {
    /// How much time passes between two messages of a robot at least.
    #[reflect(unit = "s", range = 0.0..)]
    pub interval: f32,
    /// How many messages of the team's budget are never sent.
    pub reserve: u16,
    /// How long a half lasts.
    #[reflect(unit = "s", range = 0.0..)]
    pub half: f32,
}

impl TeamRhythm {
    /// How many messages the team may still send.
    pub(crate) fn left(&self, referee: &GameControllerState) -> u16 {
        referee.message_budget.saturating_sub(self.reserve)
    }

    /// So much time passes between two messages of a robot, s, so that they last until the end of the game.
    ///
    /// Who has been taken out comes back; substitutes do not talk.
    pub(crate) fn interval(&self, referee: &GameControllerState) -> f32 {
        let second_half = if referee.is_first_half {
            self.half
        } else {
            0.0
        };
        let time = f32::from(referee.seconds_remaining.max(0)) + second_half;
        let penalties = referee.own_penalties.iter();
        let players = penalties.filter(|penalty| **penalty != Penalty::Substitute);
        let fair = players.count() as f32 * time / f32::from(self.left(referee).max(1));
        fair.max(self.interval)
    }

    /// How many times as long that is as it would be with enough messages, 1 or more.
    pub(crate) fn slowness(&self, referee: &GameControllerState) -> f32 {
        let slowness = self.interval(referee) / self.interval;
        if slowness.is_finite() { slowness } else { 1.0 }
    }
}
