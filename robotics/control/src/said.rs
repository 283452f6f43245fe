//! Owns what the referee said last about whose the ball is, which holds on where its computer falls silent.

use framework::Timestamp;
use serde::{Deserialize, Serialize};
use types::game::{GameControllerState, GamePhase, KickingTeam, PrimaryState, SetPlay};

/// Whose the ball is, and what this robot did when that was said.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(crate) struct Said {
    primary_state: PrimaryState,
    pub(crate) game_phase: GamePhase,
    pub(crate) kicking_team: KickingTeam,
    pub(crate) set_play: SetPlay,
    /// Since when the ball has been theirs so, in this state.
    since: Timestamp,
}

impl Said {
    /// In the next cycle, of a robot that is in this state; a set play lasts so long (s) where nobody is heard to end it.
    pub(crate) fn next(
        self,
        referee: Option<&GameControllerState>,
        primary_state: PrimaryState,
        now: Timestamp,
        set_play_lasts: f32,
    ) -> Self {
        match referee {
            Some(referee) => self.after(referee, primary_state, now),
            None => self.in_silence(primary_state, now, set_play_lasts),
        }
    }

    /// Whose shot it is in a penalty shoot-out; `None` in any other part of the game.
    pub(crate) fn shot_of(&self) -> Option<KickingTeam> {
        (self.game_phase == GamePhase::PenaltyShootout).then_some(self.kicking_team)
    }

    /// Whether the others have a penalty kick.
    pub(crate) fn is_penalty_kick_of_others(&self) -> bool {
        self.set_play == SetPlay::PenaltyKick && self.kicking_team == KickingTeam::Opponent
    }

    fn after(
        self,
        referee: &GameControllerState,
        primary_state: PrimaryState,
        now: Timestamp,
    ) -> Self {
        let goes_on = self.primary_state == primary_state
            && self.kicking_team == referee.kicking_team
            && self.set_play == referee.set_play;
        Self {
            primary_state,
            game_phase: referee.game_phase,
            kicking_team: referee.kicking_team,
            set_play: referee.set_play,
            since: if goes_on { self.since } else { now },
        }
    }

    /// Until somebody takes the robot out of the game, or the set play's time is over.
    fn in_silence(self, primary_state: PrimaryState, now: Timestamp, set_play_lasts: f32) -> Self {
        if matches!(primary_state, PrimaryState::Unstiff | PrimaryState::Initial) {
            return Self {
                primary_state,
                since: now,
                ..Self::default()
            };
        }
        // By a whistle.
        let begins =
            self.primary_state == PrimaryState::Set && primary_state == PrimaryState::Playing;
        let since = if begins { now } else { self.since };
        let is_over = primary_state == PrimaryState::Playing
            && self.game_phase != GamePhase::PenaltyShootout
            && self.set_play != SetPlay::None
            && (now - since).as_secs_f32() > set_play_lasts;
        if is_over {
            return Self {
                primary_state,
                kicking_team: KickingTeam::Nobody,
                set_play: SetPlay::None,
                since: now,
                ..self
            };
        }
        Self {
            primary_state,
            since,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::at_millis;

    use super::*;

    type Words = (GamePhase, KickingTeam, SetPlay);

    const NOTHING: Words = (GamePhase::Normal, KickingTeam::Nobody, SetPlay::None);

    /// What holds at `now` ms.
    fn next(said: &mut Said, now: u64, primary_state: PrimaryState, words: Option<Words>) -> Words {
        let referee = words.map(|(game_phase, kicking_team, set_play)| GameControllerState {
            game_phase,
            kicking_team,
            set_play,
            ..GameControllerState::default()
        });
        *said = said.next(referee.as_ref(), primary_state, at_millis(now), 30.0);
        (said.game_phase, said.kicking_team, said.set_play)
    }

    #[test]
    fn who_has_never_heard_a_referee_knows_of_no_set_play() {
        let held = next(&mut Said::default(), 12, PrimaryState::Playing, None);
        assert_eq!(held, NOTHING);
    }

    #[test]
    fn a_free_kick_goes_on_in_silence_until_its_time_is_over() {
        let theirs = (
            GamePhase::Overtime,
            KickingTeam::Opponent,
            SetPlay::CornerKick,
        );
        let own = (GamePhase::Overtime, KickingTeam::Own, SetPlay::CornerKick);
        let over = (GamePhase::Overtime, KickingTeam::Nobody, SetPlay::None);
        let (mut said, playing) = (Said::default(), PrimaryState::Playing);
        next(&mut said, 1_000, playing, Some(own));
        next(&mut said, 2_000, playing, Some(theirs));
        assert_eq!(next(&mut said, 10_000, playing, Some(theirs)), theirs);
        assert_eq!(next(&mut said, 31_900, playing, None), theirs);
        assert_eq!(next(&mut said, 32_100, playing, None), over);
        // Whoever is heard knows better.
        assert_eq!(next(&mut said, 33_000, playing, Some(theirs)), theirs);
        assert_eq!(next(&mut said, 34_000, playing, Some(over)), over);
        assert_eq!(next(&mut said, 35_000, playing, None), over);
    }

    #[test]
    fn a_shot_of_the_shoot_out_goes_on_in_silence() {
        let shot = (
            GamePhase::PenaltyShootout,
            KickingTeam::Opponent,
            SetPlay::PenaltyKick,
        );
        let mut said = Said::default();
        next(&mut said, 1_000, PrimaryState::Set, Some(shot));
        assert_eq!(next(&mut said, 5_000, PrimaryState::Playing, None), shot);
        assert_eq!(next(&mut said, 65_000, PrimaryState::Playing, None), shot);
        assert_eq!(said.shot_of(), Some(KickingTeam::Opponent));
    }

    #[test]
    fn a_whistle_in_silence_lets_the_others_begin_and_somebody_at_the_buttons_ends_all() {
        let penalty_kick = (
            GamePhase::Normal,
            KickingTeam::Opponent,
            SetPlay::PenaltyKick,
        );
        let mut said = Said::default();
        next(&mut said, 1_000, PrimaryState::Set, Some(penalty_kick));
        let mut at = |now, state| next(&mut said, now, state, None);
        assert_eq!(at(39_000, PrimaryState::Set), penalty_kick);
        assert_eq!(at(40_000, PrimaryState::Playing), penalty_kick);
        assert_eq!(at(45_000, PrimaryState::Penalized), penalty_kick);
        assert_eq!(at(50_000, PrimaryState::Playing), penalty_kick);
        assert_eq!(at(70_100, PrimaryState::Playing), NOTHING);
        next(&mut said, 71_000, PrimaryState::Set, Some(penalty_kick));
        assert!(said.is_penalty_kick_of_others());
        let mut at = |now, state| next(&mut said, now, state, None);
        assert_eq!(at(72_000, PrimaryState::Unstiff), NOTHING);
        assert_eq!(at(73_000, PrimaryState::Initial), NOTHING);
    }
}
