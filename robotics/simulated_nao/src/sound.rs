//! What the microphones hear on the simulated field: a crowd, its voices, loudspeakers, and whistles.
//!
//! In reading order: what can be chosen ([`SoundSettings`]), noise out of nothing but a number
//! ([`noise`]), the audience ([`crowd`], [`voices`]), the referee ([`whistle`]).
//!
//! Invariant: a block depends on settings, number and the whistles that were called alone. Blocks can be recorded in any order and
//! any number of times, fit together without a step, and are the same on every run.

mod crowd;
mod settings;
mod voices;
mod whistle;

#[cfg(test)]
mod hearing;

use types::audio::{AudioBlock, MICROPHONE_COUNT};

pub use self::settings::{SoundSettings, WhistleTruth};

use crate::noise::{SENSORS, hash, signed_parts};

/// Samples per second and channel, as the NAO's microphones are usually read.
pub(crate) const SAMPLE_RATE: u32 = 44_100;
/// Samples of a block: 46 ms.
pub(crate) const BLOCK_LENGTH: usize = 2048;

/// The longest way of sound between two microphones: 0.11 m, and a little more.
const GREATEST_DELAY: usize = 16;
/// What all microphones hear is computed once, for the earliest to the latest of them.
const HEARD_LENGTH: usize = BLOCK_LENGTH + GREATEST_DELAY;

/// No two microphones are equally sensitive.
const GAINS: [f32; MICROPHONE_COUNT] = [1.0, 0.93, 0.84, 0.9];
/// In samples of 7.8 mm; the audience sits in front of the robot, to the left.
const DELAYS: [usize; MICROPHONE_COUNT] = [0, 4, 7, 11];
/// Amplitude of each microphone's own noise, share of full scale.
const SENSOR_NOISE: f32 = 0.001;

/// The sound of a whole run.
pub(crate) struct Sound {
    settings: SoundSettings,
}

/// What sounds during one block, before it reaches the microphones.
struct Passage {
    seed: u64,
    /// Number of the first sample since the start of the run.
    start: u64,
    samples: [f32; HEARD_LENGTH],
}

impl Sound {
    pub(crate) fn new(settings: &SoundSettings) -> Self {
        Self {
            settings: settings.clone(),
        }
    }

    /// Block `number`, counted from 0; its last sample was taken at `(number + 1) * BLOCK_LENGTH` samples
    /// of [`SAMPLE_RATE`]. Allocates only while `block` has not had its size.
    /// `called` are whistles beside those of the settings: when each begins, s.
    pub(crate) fn record(&self, number: u64, called: &[f64], block: &mut AudioBlock) {
        let start = number * BLOCK_LENGTH as u64;
        let mut passage = Passage {
            seed: self.settings.seed,
            start,
            samples: [0.0; HEARD_LENGTH],
        };
        let noise_level = self.settings.noise_level as f32;
        crowd::add(&mut passage, noise_level);
        voices::add(&mut passage, noise_level);
        let (begin, end) = (passage.begin(), passage.end());
        let called = self.settings.called_between(called, begin, end);
        for truth in self.settings.whistles_between(begin, end).chain(called) {
            whistle::add(&mut passage, &truth);
        }

        let noises = std::array::from_fn::<_, BLOCK_LENGTH, _>(|index| {
            signed_parts(hash(passage.seed, SENSORS, start + index as u64))
        });
        block.sample_rate = SAMPLE_RATE;
        for (microphone, channel) in block.channels.iter_mut().enumerate() {
            channel.resize(BLOCK_LENGTH, 0.0);
            let heard = &passage.samples[GREATEST_DELAY - DELAYS[microphone]..];
            for ((sample, heard), noise) in channel.iter_mut().zip(heard).zip(&noises) {
                let sum = GAINS[microphone] * heard + SENSOR_NOISE * noise[microphone];
                *sample = sum.clamp(-1.0, 1.0);
            }
        }
    }
}

impl Passage {
    /// When the first sample sounds, s.
    fn begin(&self) -> f64 {
        self.start as f64 / f64::from(SAMPLE_RATE)
    }

    /// When the first sample after the passage sounds, s.
    fn end(&self) -> f64 {
        self.begin() + HEARD_LENGTH as f64 / f64::from(SAMPLE_RATE)
    }

    /// The samples of an event: the number of each, how long the event has sounded (s), and the sample
    /// to add to.
    fn during(
        &mut self,
        begins_at: f64,
        duration: f64,
    ) -> impl Iterator<Item = (u64, f64, &mut f32)> {
        let (start, offset) = (self.start, begins_at - self.begin());
        let rate = f64::from(SAMPLE_RATE);
        let index = |time: f64| (time * rate).ceil().clamp(0.0, HEARD_LENGTH as f64) as usize;
        let first = index(offset);
        let last = index(offset + duration).max(first);
        let samples = self.samples[first..last].iter_mut();
        (first..).zip(samples).map(move |(index, sample)| {
            let time = index as f64 / rate - offset;
            (start + index as u64, time, sample)
        })
    }
}

#[cfg(test)]
mod tests {
    use framework::math;

    use super::*;

    fn record(settings: &SoundSettings, number: u64) -> AudioBlock {
        let mut block = AudioBlock::default();
        Sound::new(settings).record(number, &[], &mut block);
        block
    }

    fn whistling() -> SoundSettings {
        SoundSettings {
            whistles: vec![0.5],
            ..SoundSettings::default()
        }
    }

    #[test]
    fn a_block_depends_on_seed_and_number_alone() {
        let settings = whistling();
        let sound = Sound::new(&settings);
        let mut block = AudioBlock::default();
        for number in [12, 3, 14, 12] {
            sound.record(number, &[], &mut block);
            assert_eq!(block, record(&settings, number), "block {number}");
        }
        let other = SoundSettings {
            seed: settings.seed + 1,
            ..settings.clone()
        };
        assert_ne!(record(&other, 12), record(&settings, 12));
    }

    #[test]
    fn a_block_has_its_size_and_stays_within_full_scale() {
        let loud = SoundSettings {
            noise_level: 1.0,
            whistle_level: 1.0,
            ..whistling()
        };
        for number in 0..200 {
            let block = record(&loud, number);
            assert_eq!(block.sample_rate, SAMPLE_RATE);
            for channel in block.channels {
                assert_eq!(channel.len(), BLOCK_LENGTH);
                assert!(channel.iter().all(|sample| sample.abs() <= 1.0));
            }
        }
    }

    #[test]
    fn a_block_with_its_size_keeps_its_heap() {
        let sound = Sound::new(&whistling());
        let mut block = AudioBlock::default();
        sound.record(0, &[], &mut block);
        let heap = |block: &AudioBlock| block.channels.each_ref().map(|channel| channel.as_ptr());
        let before = heap(&block);
        sound.record(1, &[], &mut block);
        assert_eq!(heap(&block), before);
    }

    #[test]
    fn blocks_fit_together_without_a_step() {
        // Without the microphones' own noise and what is white by nature, steps would stand out.
        let sound = Sound::new(&whistling());
        let (mut block, mut last) = (AudioBlock::default(), None);
        let (mut within, mut between) = (0.0_f64, 0.0_f64);
        let count = 2000;
        for number in 0..count {
            sound.record(number, &[], &mut block);
            let samples = &block.channels[0];
            if let Some(last) = last {
                between += math::powi(f64::from(samples[0] - last), 2);
            }
            last = samples.last().copied();
            let steps = samples
                .windows(2)
                .map(|pair| math::powi(f64::from(pair[1] - pair[0]), 2));
            within += steps.sum::<f64>() / (BLOCK_LENGTH - 1) as f64;
        }
        let ratio = between / within;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn the_noise_is_as_loud_as_chosen_and_each_microphone_hears_it_differently() {
        let settings = SoundSettings::default();
        let sound = Sound::new(&settings);
        let mut block = AudioBlock::default();
        let mut power = [0.0_f64; MICROPHONE_COUNT];
        let count = 1000;
        for number in 0..count {
            sound.record(number, &[], &mut block);
            for (power, channel) in power.iter_mut().zip(&block.channels) {
                let sum: f64 = channel
                    .iter()
                    .map(|&sample| math::powi(f64::from(sample), 2))
                    .sum();
                *power += sum / (BLOCK_LENGTH as u64 * count) as f64;
            }
            assert_ne!(block.channels[0], block.channels[1]);
        }
        let levels = power.map(f64::sqrt);
        println!(
            "root mean squares {levels:.3?} at level {}",
            settings.noise_level
        );
        let share = levels[0] / settings.noise_level;
        assert!((0.6..1.7).contains(&share), "{share}");
        assert!(levels[2] < levels[0]);
    }
}
