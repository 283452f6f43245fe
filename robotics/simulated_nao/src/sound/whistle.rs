//! The referee's whistle: pealess, with chambers that are not quite in tune, as Fox 40's.
//!
//! Two tones about 3 % apart beat against each other; each blow begins a little flat, trembles with
//! the breath, and has overtones and a hiss.

use std::f64::consts::TAU;

use framework::math;

use super::Passage;
use super::settings::WhistleTruth;
use super::voices::envelope;
use crate::noise::{BREATH, Draw, WHISTLES, hash, signed};

/// The tone begins lower by this share ...
const ONSET_DEPTH: f64 = 0.06;
/// ... and comes up in this time, s.
const ONSET_TIME: f64 = 0.015;

/// Adds what of the whistle sounds in the passage.
pub(super) fn add(passage: &mut Passage, truth: &WhistleTruth) {
    let seed = passage.seed;
    let mut draw = Draw::new(seed, WHISTLES, truth.number);
    let pitch = draw.from(2600.0..3900.0);
    let detuning = draw.from(1.015..1.035);
    let share = draw.from(0.3..0.45) as f32;
    let tremble = TAU * draw.from(20.0..45.0);
    let level = truth.level as f32;
    for (number, time, sample) in passage.during(truth.begins_at, truth.duration) {
        let flat = ONSET_DEPTH * ONSET_TIME * (math::exp(-time / ONSET_TIME) - 1.0);
        let turns = pitch * (time + flat);
        let angle = (TAU * turns.fract()) as f32;
        let other = (TAU * (turns * detuning).fract()) as f32;
        let breath = signed(hash(seed, BREATH, number));
        let tone = (1.0 - share) * math::sin(angle) + share * math::sin(other);
        let overtones = 0.08 * math::sin(2.0 * angle) + 0.03 * math::sin(3.0 * angle);
        let loudness = 0.85 + 0.15 * math::sin(tremble * time) as f32;
        *sample += level
            * envelope(time, truth.duration, 0.02, 0.08)
            * (loudness * 0.9 * (tone + overtones) + 0.03 * breath);
    }
}
