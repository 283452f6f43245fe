//! Decides what the robot does in the game: what the referee, people at its buttons, and whistles say.
//!
//! Buttons follow RoboCup SPL rules 2025, button interface: a robot sits limp until the chest is
//! pressed and again once the head is held, referee or not. While a referee's computer is heard, its
//! word counts; while none is, the chest penalizes and lets play.
//!
//! The referee whistles for the kick-off, but its computer says so 15 s later: a whistle in Set starts
//! the game at once, also where the computer has fallen silent. Where one is heard and has not followed by then, the whistle was
//! somebody else's.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use serde::{Deserialize, Serialize};
use types::audio::Whistle;
use types::buttons::Buttons;
use types::game::{GameControllerState, GameState, Penalty, PrimaryState};

/// What the robot did in the cycle before.
#[derive(Debug, Deserialize, Serialize)]
pub struct GameStateFilter {
    primary_state: PrimaryState,
    /// When the Set began that the referee's computer said last.
    set_since: Timestamp,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    buttons: Input<Buttons, "buttons">,
    whistle: Input<Whistle, "whistle">,
    cycle_time: CycleTime,

    /// How long after the whistle the referee's computer says that the game is on.
    #[reflect(unit = "s", range = 0.0..)]
    playing_delay: Parameter<f32, "game_state_filter.playing_delay">,
    /// How much longer the robot believes the whistle.
    #[reflect(unit = "s", range = 0.0..)]
    playing_margin: Parameter<f32, "game_state_filter.playing_margin">,
}

#[context]
pub struct MainOutputs {
    /// What this robot does in the game.
    primary_state: MainOutput<PrimaryState>,
}

impl GameStateFilter {
    /// Limp until somebody presses the chest.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            primary_state: PrimaryState::Unstiff,
            set_since: Timestamp::ZERO,
        })
    }

    /// The head before the chest, the chest before the referee.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let Buttons {
            is_chest_pressed,
            is_head_held,
            ..
        } = *context.buttons;
        let is_limp = self.primary_state == PrimaryState::Unstiff && !is_chest_pressed;
        self.primary_state = if is_head_held || is_limp {
            PrimaryState::Unstiff
        } else if let Some(referee) = context.game_controller_state {
            if referee.game_state == GameState::Set {
                self.set_since = referee.game_state_since;
            }
            said_by(referee, context.is_whistled_on(referee.game_state_since))
        } else if is_chest_pressed {
            after_press(self.primary_state)
        } else if self.primary_state == PrimaryState::Set && context.is_whistled_on(self.set_since)
        {
            PrimaryState::Playing
        } else {
            self.primary_state
        };
        Ok(MainOutputs {
            primary_state: self.primary_state.into(),
        })
    }
}

impl CycleContext<'_> {
    /// Whether a whistle began after Set did, so lately that the referee's computer may still follow.
    fn is_whistled_on(&self, set_since: Timestamp) -> bool {
        let patience = *self.playing_delay + *self.playing_margin;
        self.whistle.last_began_at.is_some_and(|began_at| {
            let age = self.cycle_time.start - began_at;
            began_at > set_since && age.as_secs_f32() <= patience
        })
    }
}

fn said_by(referee: &GameControllerState, is_whistled_on: bool) -> PrimaryState {
    if referee.penalty != Penalty::None {
        return PrimaryState::Penalized;
    }
    match referee.game_state {
        GameState::Initial => PrimaryState::Initial,
        GameState::Standby => PrimaryState::Standby,
        GameState::Ready => PrimaryState::Ready,
        GameState::Set if is_whistled_on => PrimaryState::Playing,
        GameState::Set => PrimaryState::Set,
        GameState::Playing => PrimaryState::Playing,
        GameState::Finished => PrimaryState::Finished,
    }
}

/// What a press of the chest means while no referee is heard.
fn after_press(primary_state: PrimaryState) -> PrimaryState {
    match primary_state {
        PrimaryState::Unstiff => PrimaryState::Initial,
        PrimaryState::Penalized => PrimaryState::Playing,
        PrimaryState::Initial
        | PrimaryState::Standby
        | PrimaryState::Ready
        | PrimaryState::Set
        | PrimaryState::Playing
        | PrimaryState::Finished => PrimaryState::Penalized,
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, cycle_time};

    use super::*;

    const NOTHING: Buttons = Buttons {
        is_chest_pressed: false,
        is_head_held: false,
        bumpers: types::feet::Feet {
            left: false,
            right: false,
        },
    };
    const CHEST: Buttons = Buttons {
        is_chest_pressed: true,
        ..NOTHING
    };
    const HEAD: Buttons = Buttons {
        is_head_held: true,
        ..NOTHING
    };

    fn limp() -> GameStateFilter {
        GameStateFilter::new(CreationContext {}).unwrap()
    }

    /// Somebody has pressed the chest.
    fn stiff() -> GameStateFilter {
        let mut node = limp();
        cycle(&mut node, 0, None, CHEST, None);
        node
    }

    fn referee(game_state: GameState, since: u64) -> Option<GameControllerState> {
        Some(GameControllerState {
            game_state,
            game_state_since: at_millis(since),
            ..GameControllerState::default()
        })
    }

    /// A cycle at `now` ms; a whistle began at `whistle` ms.
    fn cycle(
        node: &mut GameStateFilter,
        now: u64,
        referee: Option<GameControllerState>,
        buttons: Buttons,
        whistle: Option<u64>,
    ) -> PrimaryState {
        let context = CycleContext {
            game_controller_state: &referee,
            buttons: &buttons,
            whistle: &Whistle {
                is_heard: false,
                last_began_at: whistle.map(at_millis),
            },
            cycle_time: cycle_time(now, 12),
            playing_delay: &15.0,
            playing_margin: &2.0,
        };
        node.cycle(context).unwrap().primary_state.value
    }

    #[test]
    fn without_a_referee_the_buttons_lead_through_the_game() {
        let mut node = limp();
        let mut press = |buttons| cycle(&mut node, 12, None, buttons, Some(6));
        assert_eq!(press(NOTHING), PrimaryState::Unstiff);
        assert_eq!(press(CHEST), PrimaryState::Initial);
        assert_eq!(press(NOTHING), PrimaryState::Initial);
        assert_eq!(press(CHEST), PrimaryState::Penalized);
        assert_eq!(press(CHEST), PrimaryState::Playing);
        assert_eq!(press(CHEST), PrimaryState::Penalized);
        assert_eq!(press(HEAD), PrimaryState::Unstiff);
        assert_eq!(press(NOTHING), PrimaryState::Unstiff);
    }

    #[test]
    fn a_limp_robot_follows_the_referee_only_after_a_press() {
        let mut node = limp();
        let ready = referee(GameState::Ready, 0);
        assert_eq!(
            cycle(&mut node, 12, ready, NOTHING, None),
            PrimaryState::Unstiff
        );
        assert_eq!(
            cycle(&mut node, 24, ready, CHEST, None),
            PrimaryState::Ready
        );
        assert_eq!(
            cycle(&mut node, 36, ready, HEAD, None),
            PrimaryState::Unstiff
        );
    }

    #[test]
    fn the_referee_says_what_to_do() {
        for (said, done) in [
            (GameState::Initial, PrimaryState::Initial),
            (GameState::Standby, PrimaryState::Standby),
            (GameState::Ready, PrimaryState::Ready),
            (GameState::Set, PrimaryState::Set),
            (GameState::Playing, PrimaryState::Playing),
            (GameState::Finished, PrimaryState::Finished),
        ] {
            let mut node = stiff();
            assert_eq!(cycle(&mut node, 12, referee(said, 0), NOTHING, None), done);
            // Not even a press, which a fall may cause.
            assert_eq!(cycle(&mut node, 24, referee(said, 0), CHEST, None), done);
        }
    }

    #[test]
    fn a_penalty_counts_more_than_the_state_and_a_whistle() {
        let mut node = stiff();
        let mut set = referee(GameState::Set, 1000);
        set.as_mut().unwrap().penalty = Penalty::IllegalMotionInSet;
        let state = cycle(&mut node, 3000, set, NOTHING, Some(2000));
        assert_eq!(state, PrimaryState::Penalized);
    }

    #[test]
    fn a_whistle_in_set_starts_the_game_before_the_referees_computer_does() {
        let mut node = stiff();
        let (set, playing) = (
            referee(GameState::Set, 1000),
            referee(GameState::Playing, 17_000),
        );
        let mut at = |now, referee, whistle| cycle(&mut node, now, referee, NOTHING, whistle);
        assert_eq!(at(1012, set, None), PrimaryState::Set);
        assert_eq!(at(2012, set, Some(2000)), PrimaryState::Playing);
        assert_eq!(at(16_988, set, Some(2000)), PrimaryState::Playing);
        assert_eq!(at(17_000, playing, Some(2000)), PrimaryState::Playing);
        assert_eq!(at(60_000, playing, Some(2000)), PrimaryState::Playing);
    }

    #[test]
    fn a_whistle_in_set_starts_the_game_of_a_silent_referee() {
        let set = referee(GameState::Set, 1000);
        let mut node = stiff();
        let mut at = |now, referee, whistle| cycle(&mut node, now, referee, NOTHING, whistle);
        assert_eq!(at(1012, set, None), PrimaryState::Set);
        assert_eq!(at(6012, None, Some(900)), PrimaryState::Set, "before Set");
        assert_eq!(at(7012, None, Some(7000)), PrimaryState::Playing);
        assert_eq!(at(60_000, None, Some(7000)), PrimaryState::Playing);
    }

    #[test]
    fn a_whistle_from_before_set_starts_nothing() {
        let state = cycle(
            &mut stiff(),
            1012,
            referee(GameState::Set, 1000),
            NOTHING,
            Some(900),
        );
        assert_eq!(state, PrimaryState::Set);
    }

    #[test]
    fn a_whistle_that_the_referee_does_not_confirm_was_a_false_one() {
        let mut node = stiff();
        let set = referee(GameState::Set, 1000);
        let mut at = |now, referee, whistle| cycle(&mut node, now, referee, NOTHING, whistle);
        assert_eq!(at(19_000, set, Some(2000)), PrimaryState::Playing);
        assert_eq!(at(19_012, set, Some(2000)), PrimaryState::Set);
        assert_eq!(
            at(21_000, set, Some(20_500)),
            PrimaryState::Playing,
            "another whistle"
        );
        let again = referee(GameState::Set, 22_000);
        assert_eq!(at(22_000, again, Some(20_500)), PrimaryState::Set);
    }

    #[test]
    fn a_referee_who_falls_silent_changes_nothing() {
        let mut node = stiff();
        cycle(&mut node, 12, referee(GameState::Ready, 0), NOTHING, None);
        assert_eq!(
            cycle(&mut node, 24, None, NOTHING, None),
            PrimaryState::Ready
        );
        assert_eq!(
            cycle(&mut node, 36, None, CHEST, None),
            PrimaryState::Penalized
        );
    }
}
