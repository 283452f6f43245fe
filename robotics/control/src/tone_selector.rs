//! Chooses what lets people hear what the robot knows: a tone for a whistle, another one for a new state.
//!
//! No robot may take it for a whistle: none sounds in Set, where all robots listen for one, and none
//! has a frequency within the band of whistles.

use framework::{Input, MainOutput, Parameter, Result, context};
use serde::{Deserialize, Serialize};
use types::audio::{Tone, Whistle};
use types::game::PrimaryState;

/// What people know already.
#[derive(Debug, Deserialize, Serialize)]
pub struct ToneSelector {
    was_heard: bool,
    /// `None` before the first cycle.
    primary_state: Option<PrimaryState>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    whistle: Input<Whistle, "whistle">,
    primary_state: Input<PrimaryState, "primary_state">,

    /// When a whistle begins.
    whistle_tone: Parameter<Tone, "tone_selector.whistle_tone">,
    /// When the robot's state in the game changes.
    state_tone: Parameter<Tone, "tone_selector.state_tone">,
    /// In Hz: where the band of whistles begins.
    lowest_whistle: Parameter<f32, "whistle_detection.lowest_frequency">,
    /// In Hz: where it ends.
    highest_whistle: Parameter<f32, "whistle_detection.highest_frequency">,
}

#[context]
pub struct MainOutputs {
    /// What begins to sound in this cycle.
    tone: MainOutput<Option<Tone>>,
}

impl ToneSelector {
    /// Has told nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            was_heard: false,
            primary_state: None,
        })
    }

    /// At most one tone; of two pieces of news the whistle is the greater.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let primary_state = *context.primary_state;
        let before = self.primary_state.replace(primary_state);
        let has_changed = before.is_some_and(|before| before != primary_state);
        let was_heard = std::mem::replace(&mut self.was_heard, context.whistle.is_heard);

        let tone = if context.whistle.is_heard && !was_heard {
            Some(context.whistle_tone)
        } else {
            has_changed.then_some(context.state_tone)
        };
        let is_allowed = |tone: &&Tone| {
            primary_state != PrimaryState::Set
                && is_outside(tone, *context.lowest_whistle, *context.highest_whistle)
        };
        Ok(MainOutputs {
            tone: tone.filter(is_allowed).copied().into(),
        })
    }
}

/// Whether nobody takes the tone for a whistle; one that is no number is no tone.
fn is_outside(tone: &Tone, lowest: f32, highest: f32) -> bool {
    tone.frequency < lowest || tone.frequency > highest
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHISTLE: f32 = 1200.0;
    const STATE: f32 = 600.0;

    /// What is played in a sequence of cycles.
    fn played(whistle_frequency: f32, cycles: &[(bool, PrimaryState)]) -> Vec<f32> {
        let mut node = ToneSelector::new(CreationContext {}).unwrap();
        let mut played = Vec::new();
        let tone = |frequency| Tone {
            frequency,
            duration: 0.2,
            volume: 0.5,
        };
        for &(is_heard, primary_state) in cycles {
            let context = CycleContext {
                whistle: &Whistle {
                    is_heard,
                    last_began_at: None,
                },
                primary_state: &primary_state,
                whistle_tone: &tone(whistle_frequency),
                state_tone: &tone(STATE),
                lowest_whistle: &2000.0,
                highest_whistle: &4500.0,
            };
            let tone = node.cycle(context).unwrap().tone.value;
            played.extend(tone.map(|tone| tone.frequency));
        }
        played
    }

    #[test]
    fn news_are_told_once() {
        use PrimaryState::{Initial, Playing, Ready};
        let cycles = [
            (false, Initial),
            (false, Ready),
            (false, Ready),
            (false, Playing),
            (true, Playing),
            (true, Playing),
            (false, Playing),
            (true, Playing),
        ];
        assert_eq!(played(WHISTLE, &cycles), [STATE, STATE, WHISTLE, WHISTLE]);
    }

    #[test]
    fn nothing_sounds_in_set() {
        use PrimaryState::{Playing, Ready, Set};
        let cycles = [(false, Ready), (false, Set), (true, Set), (false, Set)];
        assert_eq!(played(WHISTLE, &cycles), [0.0; 0]);
        // The whistle ends Set in the same cycle: the robot may tell.
        assert_eq!(played(WHISTLE, &[(false, Set), (true, Playing)]), [WHISTLE]);
    }

    #[test]
    fn a_tone_that_might_be_a_whistle_is_not_played() {
        for frequency in [2000.0, 3000.0, 4500.0, f32::NAN] {
            let cycles = [
                (false, PrimaryState::Playing),
                (true, PrimaryState::Playing),
            ];
            assert_eq!(played(frequency, &cycles), [0.0; 0], "{frequency} Hz");
        }
    }
}
