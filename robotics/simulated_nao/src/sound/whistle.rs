//! The referee's whistle: pealess, with chambers that are not quite in tune, as Fox 40's.
//!
//! Two tones about 3 % apart beat against each other; each blow begins a little flat, trembles with
//! the breath, and has overtones and a hiss.

use std::f64::consts::TAU;

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
        let flat = ONSET_DEPTH * ONSET_TIME * ((-time / ONSET_TIME).exp() - 1.0);
        let turns = pitch * (time + flat);
        let angle = (TAU * turns.fract()) as f32;
        let other = (TAU * (turns * detuning).fract()) as f32;
        let breath = signed(hash(seed, BREATH, number));
        let tone = (1.0 - share) * angle.sin() + share * other.sin();
        let overtones = 0.08 * (2.0 * angle).sin() + 0.03 * (3.0 * angle).sin();
        let loudness = 0.85 + 0.15 * (tremble * time).sin() as f32;
        *sample += level
            * envelope(time, truth.duration, 0.02, 0.08)
            * (loudness * 0.9 * (tone + overtones) + 0.03 * breath);
    }
}
