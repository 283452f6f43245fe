//! Knows whose the ball is, also where the referee's computer falls silent: a free kick has not ended because the network has.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use serde::{Deserialize, Serialize};
use types::game::{GameControllerState, GamePhase, KickingTeam, PrimaryState, SetPlay, WhoseBall};

/// What the referee said last, and what this robot did when that was said.
#[derive(Debug, Deserialize, Serialize)]
pub struct WhoseBallFilter {
    whose_ball: WhoseBall,
    primary_state: PrimaryState,
    /// Since when the ball has been theirs so, in this state.
    since: Timestamp,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    cycle_time: CycleTime,

    /// The ball is free so long after a set play began, also where no referee is heard to say so.
    #[reflect(unit = "s", range = 0.0..)]
    set_play_lasts: Parameter<f32, "whose_ball_filter.set_play_lasts">,
}

#[context]
pub struct MainOutputs {
    /// Whose the ball is.
    whose_ball: MainOutput<WhoseBall>,
}

impl WhoseBallFilter {
    /// Has heard nothing: nobody kicks first, and the game is in one of its halves.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            whose_ball: WhoseBall::default(),
            primary_state: PrimaryState::default(),
            since: Timestamp::ZERO,
        })
    }

    /// The referee's word; in silence, the last one until its time is over.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let (state, now) = (*context.primary_state, context.cycle_time.start);
        let before = self.whose_ball;
        match context.game_controller_state {
            Some(referee) => {
                self.whose_ball = referee.whose_ball();
                let goes_on = self.primary_state == state
                    && self.whose_ball.kicking_team == before.kicking_team
                    && self.whose_ball.set_play == before.set_play;
                if !goes_on {
                    self.since = now;
                }
            }
            None => self.in_silence(state, now, *context.set_play_lasts),
        }
        self.primary_state = state;
        Ok(MainOutputs {
            whose_ball: self.whose_ball.into(),
        })
    }

    /// Until somebody takes the robot out of the game, or the set play's time is over.
    fn in_silence(&mut self, state: PrimaryState, now: Timestamp, set_play_lasts: f32) {
        if matches!(state, PrimaryState::Unstiff | PrimaryState::Initial) {
            self.whose_ball = WhoseBall::default();
            self.since = now;
            return;
        }
        // By a whistle.
        if self.primary_state == PrimaryState::Set && state == PrimaryState::Playing {
            self.since = now;
        }
        let is_over = state == PrimaryState::Playing
            && self.whose_ball.game_phase != GamePhase::PenaltyShootout
            && self.whose_ball.set_play != SetPlay::None
            && (now - self.since).as_secs_f32() > set_play_lasts;
        if is_over {
            self.whose_ball.kicking_team = KickingTeam::Nobody;
            self.whose_ball.set_play = SetPlay::None;
            self.since = now;
        }
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::cycle_time;

    use super::*;

    type Words = (GamePhase, KickingTeam, SetPlay);

    const NOTHING: Words = (GamePhase::Normal, KickingTeam::Nobody, SetPlay::None);

    fn node() -> WhoseBallFilter {
        WhoseBallFilter::new(CreationContext {}).unwrap()
    }

    /// What holds at `now` ms.
    fn next(
        node: &mut WhoseBallFilter,
        now: u64,
        primary_state: PrimaryState,
        words: Option<Words>,
    ) -> Words {
        let referee = words.map(|(game_phase, kicking_team, set_play)| GameControllerState {
            game_phase,
            kicking_team,
            set_play,
            ..GameControllerState::default()
        });
        let context = CycleContext {
            primary_state: &primary_state,
            game_controller_state: &referee,
            cycle_time: cycle_time(now, 12),
            set_play_lasts: &30.0,
        };
        let held = node.cycle(context).unwrap().whose_ball.value;
        (held.game_phase, held.kicking_team, held.set_play)
    }

    #[test]
    fn who_has_never_heard_a_referee_knows_of_no_set_play() {
        let held = next(&mut node(), 12, PrimaryState::Playing, None);
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
        let (mut node, playing) = (node(), PrimaryState::Playing);
        next(&mut node, 1_000, playing, Some(own));
        next(&mut node, 2_000, playing, Some(theirs));
        assert_eq!(next(&mut node, 10_000, playing, Some(theirs)), theirs);
        assert_eq!(next(&mut node, 31_900, playing, None), theirs);
        assert_eq!(next(&mut node, 32_100, playing, None), over);
        // Whoever is heard knows better.
        assert_eq!(next(&mut node, 33_000, playing, Some(theirs)), theirs);
        assert_eq!(next(&mut node, 34_000, playing, Some(over)), over);
        assert_eq!(next(&mut node, 35_000, playing, None), over);
    }

    #[test]
    fn a_shot_of_the_shoot_out_goes_on_in_silence() {
        let shot = (
            GamePhase::PenaltyShootout,
            KickingTeam::Opponent,
            SetPlay::PenaltyKick,
        );
        let mut node = node();
        next(&mut node, 1_000, PrimaryState::Set, Some(shot));
        assert_eq!(next(&mut node, 5_000, PrimaryState::Playing, None), shot);
        assert_eq!(next(&mut node, 65_000, PrimaryState::Playing, None), shot);
    }

    #[test]
    fn a_whistle_in_silence_lets_the_others_begin_and_somebody_at_the_buttons_ends_all() {
        let penalty_kick = (
            GamePhase::Normal,
            KickingTeam::Opponent,
            SetPlay::PenaltyKick,
        );
        let mut node = node();
        next(&mut node, 1_000, PrimaryState::Set, Some(penalty_kick));
        let mut at = |now, state| next(&mut node, now, state, None);
        assert_eq!(at(39_000, PrimaryState::Set), penalty_kick);
        assert_eq!(at(40_000, PrimaryState::Playing), penalty_kick);
        assert_eq!(at(45_000, PrimaryState::Penalized), penalty_kick);
        assert_eq!(at(50_000, PrimaryState::Playing), penalty_kick);
        assert_eq!(at(70_100, PrimaryState::Playing), NOTHING);
        next(&mut node, 71_000, PrimaryState::Set, Some(penalty_kick));
        let mut at = |now, state| next(&mut node, now, state, None);
        assert_eq!(at(72_000, PrimaryState::Unstiff), NOTHING);
        assert_eq!(at(73_000, PrimaryState::Initial), NOTHING);
    }
}
