//! The audience as a whole: rumble, babble that swells and ebbs, and claps.

use framework::math;

use super::voices::events;
use super::{HEARD_LENGTH, Passage};
use crate::noise::{CLAP_NOISE, CLAPS, Draw, for_each_line, hash, signed};

/// Amplitudes of noise that changes every 2^shift samples: most power lies below 700 Hz, as with
/// many voices and steps, and falls by about 10 dB per octave above.
const OCTAVES: [(u32, f32); 9] = [
    (10, 0.9),
    (9, 0.9),
    (7, 1.0),
    (6, 1.0),
    (5, 0.8),
    (4, 0.4),
    (3, 0.17),
    (2, 0.1),
    (1, 0.08),
];
/// From here on the babble goes with the syllables.
const FIRST_OF_BABBLE: usize = 2;
/// 2^12 samples: 11 syllables a second, many people at once.
const SYLLABLES: u32 = 12;
/// 2^17 samples: 3 s.
const SWELLS: u32 = 17;

/// Adds the audience, whose root mean square is about `level`.
pub(super) fn add(passage: &mut Passage, level: f32) {
    let (rumble, babble) = OCTAVES.split_at(FIRST_OF_BABBLE);
    add_octaves(passage, babble, level);
    scale(passage, SYLLABLES, 0.35);
    add_octaves(passage, rumble, level);
    scale(passage, SWELLS, 0.5);
    for mut clap in events(passage, CLAPS, 0.15, 0.6, CLAP_DURATION) {
        let strength = level * clap.draw.from(0.2..2.5) as f32;
        add_clap(passage, clap.begins_at, &mut clap.draw, strength);
    }
}

fn add_octaves(passage: &mut Passage, octaves: &[(u32, f32)], level: f32) {
    for &(shift, amplitude) in octaves {
        let amplitude = amplitude * level;
        let samples = &mut passage.samples;
        for_each_line(
            passage.seed,
            shift,
            passage.start,
            HEARD_LENGTH,
            |range, first, slope| {
                let (mut value, slope) = (first * amplitude, slope * amplitude);
                for sample in &mut samples[range] {
                    *sample += value;
                    value += slope;
                }
            },
        );
    }
}

/// Makes what there is so far louder and quieter by up to `depth`.
fn scale(passage: &mut Passage, shift: u32, depth: f32) {
    let samples = &mut passage.samples;
    for_each_line(
        passage.seed,
        shift,
        passage.start,
        HEARD_LENGTH,
        |range, first, slope| {
            for (step, sample) in samples[range].iter_mut().enumerate() {
                *sample *= 1.0 + depth * (first + slope * step as f32);
            }
        },
    );
}

/// In s: after this a clap is not heard any more.
const CLAP_DURATION: f64 = 0.04;
/// In s: in this time a clap falls to 37 %.
const CLAP_DECAY: f64 = 0.006;

/// Two hands: a burst of noise, and the hollow between them, which rings.
fn add_clap(passage: &mut Passage, begins_at: f64, draw: &mut Draw, strength: f32) {
    let rotation = std::f64::consts::TAU * draw.from(900.0..3200.0);
    let seed = passage.seed;
    for (number, time, sample) in passage.during(begins_at, CLAP_DURATION) {
        let noise = signed(hash(seed, CLAP_NOISE, number));
        let ring = math::sin(rotation * time) as f32;
        *sample += strength * math::exp(-time / CLAP_DECAY) as f32 * (noise + ring);
    }
}
