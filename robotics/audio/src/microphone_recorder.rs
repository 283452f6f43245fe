//! Waits for the next block of sound of all microphones.

use framework::pool::Leased;
use framework::{CaptureTime, HardwareInterface, MainOutput, Result, context};
use hardware::MicrophoneInterface;
use serde::{Deserialize, Serialize};
use types::audio::AudioBlock;

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct MicrophoneRecorder {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
}

#[context]
pub struct MainOutputs {
    /// When the last sample of the block was taken.
    captured_at: CaptureTime,
    /// The samples of all microphones, each of full scale; whoever keeps them keeps the handle.
    audio_block: MainOutput<Option<Leased<AudioBlock>>>,
}

impl MicrophoneRecorder {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The cycle is about the moment of the last sample.
    pub fn cycle(
        &mut self,
        context: CycleContext<impl MicrophoneInterface>,
    ) -> Result<MainOutputs> {
        let (captured_at, audio_block) = context.hardware_interface.read_audio()?;
        Ok(MainOutputs {
            captured_at: captured_at.into(),
            audio_block: Some(audio_block).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use framework::testing::at_millis;
    use framework::{NoEvent, Timestamp};

    use super::*;

    /// Microphones that hear a click, or nothing at all.
    struct Microphones {
        are_silent: bool,
    }

    impl MicrophoneInterface for Microphones {
        fn read_audio(&self) -> Result<(Timestamp, Leased<AudioBlock>)> {
            if self.are_silent {
                return Err(NoEvent("no sound came".to_owned()).into());
            }
            let mut block = AudioBlock {
                sample_rate: 44_100,
                ..AudioBlock::default()
            };
            block.channels[0].push(0.5);
            Ok((at_millis(46), Leased::of(block)))
        }
    }

    fn cycle(are_silent: bool) -> Result<MainOutputs> {
        MicrophoneRecorder::new(CreationContext {})?.cycle(CycleContext {
            hardware_interface: &Arc::new(Microphones { are_silent }),
        })
    }

    #[test]
    fn the_sound_comes_with_its_capture_time() {
        let outputs = cycle(false).unwrap();
        assert_eq!(outputs.captured_at.0, at_millis(46));
        assert_eq!(outputs.audio_block.value.unwrap().channels[0], [0.5]);
    }

    #[test]
    fn silent_microphones_are_no_event() {
        let error = cycle(true).err().unwrap();
        assert!(error.is_no_event());
    }
}
