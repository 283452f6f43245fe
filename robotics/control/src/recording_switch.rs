//! Chooses when the robot records: during the game, and around every fall.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use serde::{Deserialize, Serialize};
use types::fall_state::FallState;
use types::game::PrimaryState;

/// When the robot fell.
#[derive(Debug, Deserialize, Serialize)]
pub struct RecordingSwitch {
    was_lying: bool,
    fell_at: Option<Timestamp>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    fall_state: Input<FallState, "fall_state">,
    cycle_time: CycleTime,

    /// What the robot does while it records.
    states: Parameter<Vec<PrimaryState>, "recording_switch.states">,
    /// How long it records after it has fallen, whatever it does.
    #[reflect(unit = "s", range = 0.0..)]
    after_fall: Parameter<f32, "recording_switch.after_fall">,
}

#[context]
pub struct MainOutputs {
    /// Whether this cycle is worth recording.
    is_recording_wanted: MainOutput<bool>,
}

impl RecordingSwitch {
    /// A robot that begins on the ground was laid there.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            was_lying: true,
            fell_at: None,
        })
    }

    /// Falling counts, and so does lying where a moment ago the robot was not; staying there does not.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        let is_lying = matches!(context.fall_state, FallState::Lying(_));
        let is_falling = matches!(context.fall_state, FallState::Falling(_));
        if is_falling || (is_lying && !self.was_lying) {
            self.fell_at = Some(now);
        }
        self.was_lying = is_lying;

        let has_fallen_lately = self
            .fell_at
            .is_some_and(|fell_at| (now - fell_at).as_secs_f32() <= *context.after_fall);
        let is_in_the_game = context.states.contains(context.primary_state);
        Ok(MainOutputs {
            is_recording_wanted: (is_in_the_game || has_fallen_lately).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::cycle_time;
    use types::fall_state::{Facing, FallDirection};

    use super::*;

    const LYING: FallState = FallState::Lying(Facing::Down);
    const FALLING: FallState = FallState::Falling(FallDirection::Left);

    fn node() -> RecordingSwitch {
        RecordingSwitch::new(CreationContext {}).unwrap()
    }

    fn cycle(
        node: &mut RecordingSwitch,
        now: u64,
        primary_state: PrimaryState,
        fall_state: FallState,
    ) -> bool {
        let context = CycleContext {
            primary_state: &primary_state,
            fall_state: &fall_state,
            cycle_time: cycle_time(now, 12),
            states: &vec![
                PrimaryState::Ready,
                PrimaryState::Set,
                PrimaryState::Playing,
            ],
            after_fall: &10.0,
        };
        node.cycle(context).unwrap().is_recording_wanted.value
    }

    #[test]
    fn the_game_is_recorded_and_what_is_around_it_is_not() {
        for (state, is_wanted) in [
            (PrimaryState::Unstiff, false),
            (PrimaryState::Initial, false),
            (PrimaryState::Ready, true),
            (PrimaryState::Set, true),
            (PrimaryState::Playing, true),
            (PrimaryState::Penalized, false),
            (PrimaryState::Finished, false),
        ] {
            let found = cycle(&mut node(), 0, state, FallState::Upright);
            assert_eq!(found, is_wanted, "{state:?}");
        }
    }

    #[test]
    fn some_time_after_a_fall_is_recorded() {
        let mut node = node();
        let mut at = |now, fall_state| cycle(&mut node, now, PrimaryState::Initial, fall_state);
        assert!(!at(0, FallState::Upright));
        assert!(at(1000, FALLING));
        assert!(at(2000, LYING));
        assert!(at(12_000, LYING));
        assert!(!at(12_012, LYING));
        assert!(!at(13_000, FallState::Upright));
    }

    #[test]
    fn a_robot_that_was_laid_down_records_nothing() {
        let mut node = node();
        assert!(!cycle(&mut node, 0, PrimaryState::Unstiff, LYING));
        assert!(!cycle(&mut node, 12, PrimaryState::Unstiff, LYING));
    }
}
