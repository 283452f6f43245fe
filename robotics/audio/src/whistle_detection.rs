//! Hears the referee's whistle: one tone that stands out of the crowd, stays where it is, and is no
//! overtone of a voice.
//!
//! Each microphone alone, on the spectrum of the newest window (Hann's, as in Harris, "On the Use of
//! Windows for Harmonic Analysis", 1978). The strongest peak within the band must stand out of the
//! rest of the band (*prominence*: noise does not), be stronger than every peak near to it and than
//! every tone whose overtone it might be (*dominance*: voices and loudspeakers are not), and be at
//! the same frequency as in the block before (clicks and sweeps are not).

mod peak;
mod spectrum;

use framework::pool::Leased;
use framework::{AdditionalOutput, MainOutput, Parameter, Reflect, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};
use types::audio::{AudioBlock, MICROPHONE_COUNT, WhistleEvidence};

pub use self::peak::SpectralPeak;
pub use self::spectrum::WINDOW_LENGTH;

use self::peak::strongest_peak;
use self::spectrum::Spectrum;

/// What makes a tone a whistle.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WhistleDetectionParameters {
    /// Whistles are not lower.
    #[reflect(unit = "Hz", range = 0.0..)]
    pub lowest_frequency: f32,
    /// Nor higher.
    #[reflect(unit = "Hz", range = 0.0..)]
    pub highest_frequency: f32,
    /// A tone reaches so far to both sides of its peak.
    #[reflect(unit = "Hz", range = 0.0..)]
    pub half_width: f32,
    /// Rivals are all peaks from this frequency on, Hz, ...
    pub lowest_rival: f32,
    /// ... up to this multiple of the tone's own frequency; its overtones begin at 2. And ...
    pub highest_rival: f32,
    /// ... those at the tone's frequency divided by 2 and so on up to this number.
    pub greatest_divisor: u32,
    /// So many bins of 21.5 Hz beside those as well: a gliding voice is not quite where its overtone says.
    #[reflect(range = 0..=16)]
    pub divisor_tolerance: u32,
    /// Least mean power of the tone over that of the rest of the band.
    #[reflect(unit = "dB")]
    pub least_prominence: f32,
    /// Least power of the tone over the strongest rival.
    #[reflect(unit = "dB")]
    pub least_dominance: f32,
    /// How far the tone may move from block to block.
    #[reflect(unit = "Hz", range = 0.0..)]
    pub greatest_drift: f32,
    /// Least root mean square of the tone, share of full scale: a dead microphone hears less.
    pub least_level: f32,
}

/// Where the tones of the block before were.
#[derive(Debug, Deserialize, Serialize)]
pub struct WhistleDetection {
    /// In Hz; `None` where there was none.
    tones: [Option<f32>; MICROPHONE_COUNT],
    /// The same in every cycle, rebuilt by `restore`.
    #[serde(skip)]
    spectrum: Spectrum,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    audio_block: RequiredInput<Option<Leased<AudioBlock>>, "audio_block?">,
    parameters: Parameter<WhistleDetectionParameters, "whistle_detection">,
    /// The strongest peak of each microphone, whistle or not; zeros where its samples are unusable.
    peaks: AdditionalOutput<[SpectralPeak; MICROPHONE_COUNT], "whistle_detection.peaks">,
}

#[context]
pub struct MainOutputs {
    /// Which microphones hear a whistle in this block.
    whistle_evidence: MainOutput<WhistleEvidence>,
}

impl WhistleDetection {
    /// Plans the spectrum.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            tones: [None; MICROPHONE_COUNT],
            spectrum: Spectrum::planned(),
        })
    }

    /// Plans the spectrum again.
    pub fn restore(&mut self, _context: CreationContext) -> Result<()> {
        self.spectrum = Spectrum::planned();
        Ok(())
    }

    /// Judges each microphone alone.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let parameters = context.parameters;
        let block = context.audio_block;
        let mut evidence = WhistleEvidence::default();
        let mut peaks = [SpectralPeak::default(); MICROPHONE_COUNT];
        for (microphone, samples) in block.channels.iter().enumerate() {
            let peak = self
                .spectrum
                .power(samples)
                .and_then(|power| strongest_peak(power, block.sample_rate, parameters));
            let tone = peak
                .filter(|peak| parameters.admits(peak))
                .map(|peak| peak.frequency);
            let before = std::mem::replace(&mut self.tones[microphone], tone);
            evidence.is_heard[microphone] = tone
                .zip(before)
                .is_some_and(|(tone, before)| (tone - before).abs() <= parameters.greatest_drift);
            peaks[microphone] = peak.unwrap_or_default();
        }
        context.peaks.fill_if_subscribed(|| peaks);
        Ok(MainOutputs {
            whistle_evidence: evidence.into(),
        })
    }
}

impl WhistleDetectionParameters {
    /// Whether a peak is the tone of a whistle; a parameter that is no number admits none.
    fn admits(&self, peak: &SpectralPeak) -> bool {
        peak.prominence >= self.least_prominence
            && peak.dominance >= self.least_dominance
            && peak.level >= self.least_level
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use framework::math;
    use framework::testing::{AdditionalProbe, parameter};

    use super::*;

    const SAMPLE_RATE: u32 = 44_100;

    fn parameters() -> WhistleDetectionParameters {
        parameter(
            "lowest_frequency = 2000.0
             highest_frequency = 4500.0
             half_width = 150.0
             lowest_rival = 1500.0
             highest_rival = 1.7
             greatest_divisor = 5
             divisor_tolerance = 2
             least_prominence = 12.0
             least_dominance = 3.0
             greatest_drift = 150.0
             least_level = 0.001",
        )
    }

    fn node() -> WhistleDetection {
        WhistleDetection::new(CreationContext {}).unwrap()
    }

    /// Tones (Hz, amplitude) over a noise that needs no generator.
    fn samples(tones: &[(f32, f32)]) -> Vec<f32> {
        let sample = |index: usize| {
            let time = index as f32 / SAMPLE_RATE as f32;
            let noise = (index * 7919 % 257) as f32 / 257.0 - 0.5;
            let tone = |&(frequency, amplitude): &(f32, f32)| {
                amplitude * math::sin(TAU * frequency * time)
            };
            tones.iter().map(tone).sum::<f32>() + 0.01 * noise
        };
        (0..WINDOW_LENGTH).map(sample).collect()
    }

    fn block(tones: &[(f32, f32)]) -> AudioBlock {
        AudioBlock {
            sample_rate: SAMPLE_RATE,
            channels: std::array::from_fn(|_| samples(tones)),
        }
    }

    fn cycle_with(
        node: &mut WhistleDetection,
        block: &AudioBlock,
        parameters: &WhistleDetectionParameters,
    ) -> ([bool; MICROPHONE_COUNT], [SpectralPeak; MICROPHONE_COUNT]) {
        let mut probe = AdditionalProbe::default();
        let context = CycleContext {
            audio_block: &Leased::of(block.clone()),
            parameters,
            peaks: probe.output(),
        };
        let evidence = node.cycle(context).unwrap().whistle_evidence.value;
        (evidence.is_heard, *probe.value().unwrap())
    }

    fn cycle(node: &mut WhistleDetection, block: &AudioBlock) -> [bool; MICROPHONE_COUNT] {
        cycle_with(node, block, &parameters()).0
    }

    #[test]
    fn a_steady_tone_in_the_band_is_a_whistle_from_the_second_block_on() {
        let mut node = node();
        let whistle = block(&[(3100.0, 0.2), (3190.0, 0.15), (6200.0, 0.05)]);
        assert_eq!(cycle(&mut node, &whistle), [false; 4]);
        assert_eq!(cycle(&mut node, &whistle), [true; 4]);
        assert_eq!(cycle(&mut node, &block(&[])), [false; 4]);
        assert_eq!(cycle(&mut node, &whistle), [false; 4]);
    }

    #[test]
    fn the_peak_says_where_the_tone_is_and_how_loud() {
        let (_, peaks) = cycle_with(&mut node(), &block(&[(3100.0, 0.2)]), &parameters());
        for peak in peaks {
            assert!((peak.frequency - 3100.0).abs() < 11.0, "{peak:?}");
            assert!((peak.level - 0.2 / 2_f32.sqrt()).abs() < 0.005, "{peak:?}");
            assert!(peak.prominence > 30.0 && peak.dominance > 30.0, "{peak:?}");
        }
    }

    #[test]
    fn overtones_of_a_voice_tones_outside_the_band_and_noise_are_no_whistle() {
        let voice: Vec<_> = (1..12)
            .map(|overtone| (450.0 * overtone as f32, 0.1))
            .collect();
        let loud_voice_with_one_overtone = [(1000.0, 0.2), (3000.0, 0.1)];
        for tones in [
            &voice[..],
            &loud_voice_with_one_overtone,
            &[(1000.0, 0.5)],
            &[(6000.0, 0.5)],
            &[],
        ] {
            let (mut node, block) = (node(), block(tones));
            cycle(&mut node, &block);
            assert_eq!(cycle(&mut node, &block), [false; 4], "{tones:?}");
        }
    }

    #[test]
    fn a_sweep_is_no_whistle() {
        let mut node = node();
        for frequency in [2200.0, 2500.0, 2800.0, 3100.0, 3400.0] {
            assert_eq!(cycle(&mut node, &block(&[(frequency, 0.2)])), [false; 4]);
        }
    }

    #[test]
    fn each_microphone_answers_for_itself_whatever_it_delivers() {
        let mut node = node();
        let mut block = block(&[(3100.0, 0.2)]);
        block.channels[0][100] = f32::NAN;
        block.channels[1].clear();
        block.channels[2].truncate(WINDOW_LENGTH - 1);
        cycle(&mut node, &block);
        assert_eq!(cycle(&mut node, &block), [false, false, false, true]);
        block.channels[0][100] = f32::MAX;
        cycle(&mut node, &block);
        assert_eq!(cycle(&mut node, &block), [false, false, false, true]);
        for sample_rate in [0, 1, 4_000, u32::MAX] {
            block.sample_rate = sample_rate;
            cycle(&mut node, &block);
            assert_eq!(cycle(&mut node, &block), [false; 4], "{sample_rate} Hz");
        }
    }

    #[test]
    fn silence_is_no_whistle() {
        let mut node = node();
        let silence = AudioBlock {
            sample_rate: SAMPLE_RATE,
            channels: std::array::from_fn(|_| vec![0.0; WINDOW_LENGTH]),
        };
        cycle(&mut node, &silence);
        assert_eq!(cycle(&mut node, &silence), [false; 4]);
    }

    #[test]
    fn parameters_that_are_no_numbers_admit_nothing() {
        let (whistle, nan) = (block(&[(3100.0, 0.2)]), f32::NAN);
        let ruin: [fn(&mut WhistleDetectionParameters, f32); 9] = [
            |parameters, value| parameters.lowest_frequency = value,
            |parameters, value| parameters.highest_frequency = value,
            |parameters, value| parameters.half_width = value,
            |parameters, value| parameters.lowest_rival = value,
            |parameters, value| parameters.highest_rival = value,
            |parameters, value| parameters.least_prominence = value,
            |parameters, value| parameters.least_dominance = value,
            |parameters, value| parameters.greatest_drift = value,
            |parameters, value| parameters.least_level = value,
        ];
        for (index, ruin) in ruin.into_iter().enumerate() {
            let (mut node, mut parameters) = (node(), parameters());
            ruin(&mut parameters, nan);
            cycle_with(&mut node, &whistle, &parameters);
            let (heard, _) = cycle_with(&mut node, &whistle, &parameters);
            assert_eq!(heard, [false; 4], "parameter {index}");
            for value in [f32::INFINITY, f32::NEG_INFINITY, -1.0, 1e30] {
                ruin(&mut parameters, value);
                cycle_with(&mut node, &whistle, &parameters);
            }
        }
    }

    #[test]
    fn a_restored_node_hears_as_the_recorded_one() {
        let mut node = node();
        let whistle = block(&[(3100.0, 0.2)]);
        cycle(&mut node, &whistle);
        let recorded = serde_json::to_string(&node).unwrap();
        let mut restored: WhistleDetection = serde_json::from_str(&recorded).unwrap();
        restored.restore(CreationContext {}).unwrap();
        assert_eq!(cycle(&mut restored, &whistle), cycle(&mut node, &whistle));
        assert_eq!(restored.tones, node.tones);
    }
}
