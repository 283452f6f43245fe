//! The robot's microphones and loudspeakers.

use std::sync::PoisonError;
use std::time::{Duration, Instant};

use framework::{Leased, NoEvent, Result, Timestamp, blocking};
use hardware::{MicrophoneInterface, SpeakerInterface};
use types::audio::{AudioBlock, Tone};

use super::{Hardware, PATIENCE, lock};
use crate::simulation::block_time;

/// Blocks come every 46 ms; after so long the caller hears about it.
const SILENCE: Duration = Duration::from_secs(1);

impl MicrophoneInterface for Hardware {
    fn read_audio(&self) -> Result<(Timestamp, Leased<AudioBlock>)> {
        // Making sound stands for the microphones' own work, so it counts as waiting for the hardware.
        blocking(|| {
            let number = self.next_block()?;
            let called = self.shared.stage.lock().world.whistles().to_vec();
            let mut blocks = lock(&self.blocks);
            let mut block = blocks.free()?;
            self.shared.sound.record(number, &called, &mut block);
            Ok((block_time(number), block.lease()))
        })
    }
}

impl SpeakerInterface for Hardware {
    fn play_tone(&self, tone: &Tone) -> Result<()> {
        self.shared.lock().play(self.clock.now(), *tone);
        Ok(())
    }
}

impl Hardware {
    fn next_block(&self) -> Result<u64> {
        let begun = Instant::now();
        let mut simulation = self.shared.lock();
        loop {
            self.stop.check()?;
            if let Some((number, is_behind)) = simulation.take_block(self.clock.now()) {
                if is_behind {
                    simulation.is_behind.insert("Audio");
                }
                return Ok(number);
            }
            if self.thread.is_none() || begun.elapsed() > SILENCE {
                return Err(NoEvent("no sound has come since the last".to_owned()).into());
            }
            let waited = self.shared.stepped.wait_timeout(simulation, PATIENCE);
            simulation = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}
