//! How well the robot hears the whistles of the simulated sound, and nothing else.

use std::collections::VecDeque;
use std::time::Duration;

use audio::whistle_detection::{self, SpectralPeak, WhistleDetection, WhistleDetectionParameters};
use control::whistle_filter::{self, WhistleFilter};
use framework::testing::{AdditionalProbe, ParameterFile, perception};
use framework::{CycleTime, Leased, Timestamp};
use types::audio::{AudioBlock, MICROPHONE_COUNT};

use super::{BLOCK_LENGTH, SAMPLE_RATE, Sound, SoundSettings, WhistleTruth};

/// In s: so soon after its beginning every whistle is heard.
const LATEST: f64 = 0.5;
/// In s: so soon after its end none is.
const REST: f64 = 1.0;

/// In dB: the margin of what sweeps.
const UNSTEADY: f32 = -30.0;

/// The two nodes that lead from sound to a whistle.
struct Listener {
    thresholds: WhistleDetectionParameters,
    least_microphones: u32,
    least_blocks: u32,
    window: f32,
    detection: WhistleDetection,
    filter: WhistleFilter,
    /// The margins of the newest blocks.
    margins: VecDeque<f32>,
    /// The peaks of the block before.
    before: [SpectralPeak; MICROPHONE_COUNT],
}

/// What came of a run.
#[derive(Debug, Default)]
struct Report {
    /// In s after the beginning of each whistle that was heard.
    delays: Vec<f64>,
    whistles: usize,
    /// In s: when something was heard, though nobody whistled.
    false_alarms: Vec<f64>,
    /// In dB above (below: negative) the thresholds: each whistle within [`LATEST`].
    whistle_margins: Vec<f32>,
    /// The strongest of the noise.
    noise_margin: f32,
}

impl Listener {
    fn new() -> Self {
        let parameters = ParameterFile::new(include_str!("../../../parameters/default.toml"));
        Self {
            thresholds: parameters.get("whistle_detection"),
            least_microphones: parameters.get("whistle_filter.least_microphones"),
            least_blocks: parameters.get("whistle_filter.least_blocks"),
            window: parameters.get("whistle_filter.window"),
            detection: WhistleDetection::new(whistle_detection::CreationContext {}).unwrap(),
            filter: WhistleFilter::new(whistle_filter::CreationContext {}).unwrap(),
            margins: VecDeque::new(),
            before: Default::default(),
        }
    }

    /// Whether a whistle is heard with this block, and by how many dB what the votes need exceeds the
    /// thresholds.
    fn hear(&mut self, captured_at: Timestamp, block: &AudioBlock) -> (bool, f32) {
        let mut probe = AdditionalProbe::default();
        let context = whistle_detection::CycleContext {
            audio_block: &Leased::of(block.clone()),
            parameters: &self.thresholds,
            peaks: probe.output(),
        };
        let evidence = self
            .detection
            .cycle(context)
            .unwrap()
            .whistle_evidence
            .value;
        let margin = self.margin(*probe.value().unwrap());

        let settled = [(captured_at, &evidence)];
        let mut probe = AdditionalProbe::unsubscribed();
        let context = whistle_filter::CycleContext {
            whistle_evidence: perception(&settled, &[]),
            cycle_time: CycleTime {
                start: captured_at + Duration::from_millis(5),
                since_last: Duration::from_millis(12),
            },
            least_microphones: &self.least_microphones,
            least_blocks: &self.least_blocks,
            window: &self.window,
            votes: probe.output(),
        };
        (
            self.filter.cycle(context).unwrap().whistle.value.is_heard,
            margin,
        )
    }

    fn margin(&mut self, peaks: [SpectralPeak; MICROPHONE_COUNT]) -> f32 {
        let thresholds = &self.thresholds;
        let of_peak = |peak: SpectralPeak| {
            (peak.prominence - thresholds.least_prominence)
                .min(peak.dominance - thresholds.least_dominance)
        };
        let before = std::mem::replace(&mut self.before, peaks);
        let mut of_microphones = std::array::from_fn::<_, MICROPHONE_COUNT, _>(|microphone| {
            let (peak, before) = (peaks[microphone], before[microphone]);
            let drift = (peak.frequency - before.frequency).abs();
            if drift > thresholds.greatest_drift {
                return UNSTEADY;
            }
            of_peak(peak).min(of_peak(before))
        });
        let of_block = nth_largest(&mut of_microphones, self.least_microphones);
        self.margins.push_front(of_block);
        self.margins
            .truncate((self.window * SAMPLE_RATE as f32 / BLOCK_LENGTH as f32) as usize);
        let mut newest: Vec<_> = self.margins.iter().copied().collect();
        nth_largest(&mut newest, self.least_blocks)
    }
}

/// Counted from 1; the least where there are fewer.
fn nth_largest(values: &mut [f32], n: u32) -> f32 {
    values.sort_by(|one, other| other.total_cmp(one));
    values[(n as usize).min(values.len()) - 1]
}

fn listen(settings: &SoundSettings, duration: f64) -> Report {
    settings.check().unwrap();
    let (sound, mut listener, mut block) =
        (Sound::new(settings), Listener::new(), AudioBlock::default());
    let truths: Vec<_> = settings
        .whistles()
        .take_while(|truth| truth.begins_at + truth.duration < duration)
        .collect();
    let mut heard = vec![None; truths.len()];
    let mut report = Report {
        whistles: truths.len(),
        whistle_margins: vec![f32::NEG_INFINITY; truths.len()],
        noise_margin: f32::NEG_INFINITY,
        ..Report::default()
    };
    for number in 0..(duration * f64::from(SAMPLE_RATE) / BLOCK_LENGTH as f64) as u64 {
        sound.record(number, &[], &mut block);
        let time = (number + 1) as f64 * BLOCK_LENGTH as f64 / f64::from(SAMPLE_RATE);
        let captured_at = Timestamp::ZERO + Duration::from_secs_f64(time);
        let (is_heard, margin) = listener.hear(captured_at, &block);
        match truths.iter().position(|truth| is_around(truth, time)) {
            Some(whistle) => {
                let delay = time - truths[whistle].begins_at;
                if is_heard {
                    heard[whistle].get_or_insert(delay);
                }
                if delay <= LATEST {
                    let best = &mut report.whistle_margins[whistle];
                    *best = best.max(margin);
                }
            }
            None => {
                if is_heard {
                    report.false_alarms.push(time);
                }
                report.noise_margin = report.noise_margin.max(margin);
            }
        }
    }
    report.delays = heard.into_iter().flatten().collect();
    report
}

fn is_around(truth: &WhistleTruth, time: f64) -> bool {
    (truth.begins_at..truth.begins_at + truth.duration + REST).contains(&time)
}

impl Report {
    fn check(&self, what: &str) {
        let latest = self.delays.iter().copied().fold(0.0, f64::max);
        let weakest = self
            .whistle_margins
            .iter()
            .copied()
            .fold(f32::INFINITY, f32::min);
        println!(
            "{what}: {} of {} whistles heard, the latest after {latest:.3} s; {} false alarms; the \
             weakest whistle {weakest:+.1} dB, the strongest noise {:+.1} dB from the thresholds",
            self.delays.len(),
            self.whistles,
            self.false_alarms.len(),
            self.noise_margin,
        );
        assert_eq!(self.delays.len(), self.whistles, "{what}");
        assert!(latest <= LATEST, "{what}: {latest} s");
        assert_eq!(self.false_alarms, [0.0; 0], "{what}");
    }
}

#[test]
fn in_ten_minutes_every_whistle_is_heard_at_once_and_nothing_else() {
    // At a different place in its block each.
    let whistles = (0..50)
        .map(|number| 5.0 + 11.7 * f64::from(number))
        .collect();
    let settings = SoundSettings {
        whistles,
        ..SoundSettings::default()
    };
    listen(&settings, 600.0).check("ten minutes");
}

#[test]
fn whistles_are_heard_near_and_far_short_and_long() {
    for (seed, (whistle_level, whistle_duration)) in
        [(0.2, 1.0), (0.3, 0.5), (0.4, 1.0), (0.5, 0.7), (1.0, 0.5)]
            .into_iter()
            .enumerate()
    {
        let settings = SoundSettings {
            seed: 10 + seed as u64,
            whistle_level,
            whistle_duration,
            whistle_every: Some(2.83),
            ..SoundSettings::default()
        };
        listen(&settings, 58.0).check(&format!("whistles at {whistle_level}"));
    }
}

#[test]
fn no_crowd_is_taken_for_a_whistle() {
    for (seed, noise_level) in [0.0, 0.01, 0.05, 0.05, 0.1, 0.3, 1.0]
        .into_iter()
        .enumerate()
    {
        let settings = SoundSettings {
            seed: 20 + seed as u64,
            noise_level,
            ..SoundSettings::default()
        };
        listen(&settings, 100.0).check(&format!("crowd at {noise_level}"));
    }
}
