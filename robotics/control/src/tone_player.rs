//! Plays the tone that this cycle's choice begins; the loudspeakers go on by themselves.

use framework::{HardwareInterface, RequiredInput, Result, context};
use hardware::SpeakerInterface;
use serde::{Deserialize, Serialize};
use types::audio::Tone;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct TonePlayer {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    tone: RequiredInput<Option<Tone>, "tone?">,
}

#[context]
pub struct MainOutputs {}

impl TonePlayer {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Called only where a tone begins.
    pub fn cycle(&mut self, context: CycleContext<impl SpeakerInterface>) -> Result<MainOutputs> {
        context.hardware_interface.play_tone(context.tone)?;
        Ok(MainOutputs {})
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;

    #[derive(Default)]
    struct Speaker {
        tones: Mutex<Vec<Tone>>,
    }

    impl SpeakerInterface for Speaker {
        fn play_tone(&self, tone: &Tone) -> Result<()> {
            self.tones.lock().unwrap().push(*tone);
            Ok(())
        }
    }

    #[test]
    fn a_tone_is_played_as_it_was_chosen() {
        let speaker = Arc::new(Speaker::default());
        let tone = Tone {
            frequency: 600.0,
            duration: 0.2,
            volume: 0.5,
        };
        let context = CycleContext {
            hardware_interface: &speaker,
            tone: &tone,
        };
        let mut node = TonePlayer::new(CreationContext {}).unwrap();
        node.cycle(context).unwrap();
        assert_eq!(*speaker.tones.lock().unwrap(), [tone]);
    }
}
