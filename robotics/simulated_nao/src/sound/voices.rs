//! Single sounds out of the crowd that might be taken for a whistle: shouts, chants, squeaking
//! shoes, and the public address.

use std::f64::consts::TAU;

use framework::math;

use super::Passage;
use crate::noise::{ANNOUNCEMENTS, CHANTS, Draw, SHOUTS, SQUEAKS};

/// How many overtones of a voice are heard, with the fundamental.
const OVERTONES: usize = 14;

/// One of many sounds of a kind.
pub(super) struct Event {
    /// In s since the start of the run.
    pub(super) begins_at: f64,
    /// What else is to be drawn about it.
    pub(super) draw: Draw,
}

/// Somebody who shouts or sings one syllable.
struct Syllable {
    begins_at: f64,
    duration: f64,
    /// Fundamental in Hz at the beginning.
    pitch: f64,
    /// By which share the pitch has changed at the end.
    glide: f64,
    level: f32,
}

/// The events that sound within the passage: in each `slot` of so many seconds one begins with this
/// `probability`, and lasts at most `longest` seconds.
pub(super) fn events(
    passage: &Passage,
    purpose: u64,
    slot: f64,
    probability: f64,
    longest: f64,
) -> impl Iterator<Item = Event> + use<> {
    let (seed, end) = (passage.seed, passage.end());
    let first = ((passage.begin() - longest) / slot).floor().max(0.0) as u64;
    let last = (end / slot) as u64;
    (first..=last).filter_map(move |number| {
        let mut draw = Draw::new(seed, purpose, number);
        let happens = draw.from(0.0..1.0) < probability;
        let begins_at = (number as f64 + draw.from(0.0..1.0)) * slot;
        (happens && begins_at < end).then_some(Event { begins_at, draw })
    })
}

/// Adds all of them to a crowd of this level.
pub(super) fn add(passage: &mut Passage, level: f32) {
    for mut shout in events(passage, SHOUTS, 2.0, 0.6, 1.2) {
        let syllable = Syllable {
            begins_at: shout.begins_at,
            duration: shout.draw.from(0.2..1.2),
            // Most are men's and women's voices, a few shriek: 1.4 kHz.
            pitch: 200.0 * math::powf(7_f64, math::powi(shout.draw.from(0.0..1.0), 2)),
            glide: shout.draw.from(-0.4..0.4),
            level: level * shout.draw.from(0.3..2.0) as f32,
        };
        sing(passage, &syllable);
    }
    for mut chant in events(passage, CHANTS, 30.0, 0.6, 8.0) {
        add_chant(passage, &mut chant, level);
    }
    for mut squeak in events(passage, SQUEAKS, 3.0, 0.3, 0.12) {
        let level = level * squeak.draw.from(0.3..2.0) as f32;
        add_squeak(passage, &mut squeak, level);
    }
    for mut announcement in events(passage, ANNOUNCEMENTS, 40.0, 0.5, 0.8) {
        let level = level * announcement.draw.from(0.5..3.0) as f32;
        add_beep(passage, &mut announcement, level);
    }
}

/// The same few notes again and again, by three groups that do not quite meet them.
fn add_chant(passage: &mut Passage, chant: &mut Event, level: f32) {
    let pitch = chant.draw.from(220.0..420.0);
    let beat = chant.draw.from(0.35..0.6);
    let steps: [f64; 4] = std::array::from_fn(|_| chant.draw.from(-3.0..5.0).round() / 12.0);
    let level = level * chant.draw.from(0.3..1.0) as f32;
    for note in 0..12 {
        for detuning in [0.985, 1.0, 1.02] {
            let syllable = Syllable {
                begins_at: chant.begins_at + beat * f64::from(note),
                duration: beat * 0.9,
                pitch: pitch * detuning * math::exp2(steps[note as usize % steps.len()]),
                glide: 0.02,
                level,
            };
            sing(passage, &syllable);
        }
    }
}

/// A voice: overtones of a pitch that glides and trembles, louder where the mouth resonates.
fn sing(passage: &mut Passage, syllable: &Syllable) {
    let &Syllable {
        begins_at,
        duration,
        pitch,
        glide,
        level,
    } = syllable;
    // Another block: the loudnesses need not be known.
    if begins_at + duration < passage.begin() || begins_at > passage.end() {
        return;
    }
    let loudnesses = loudnesses(pitch * (1.0 + glide / 2.0));
    // 5.5 trembles a second by 1.5 % of the pitch.
    let (tremble, depth) = (TAU * 5.5, 0.015 / (TAU * 5.5));
    for (_, time, sample) in passage.during(begins_at, duration) {
        let turns = pitch
            * (time + glide * time * time / (2.0 * duration) + depth * math::sin(tremble * time));
        let (sine, cosine) = math::sin_cos((TAU * turns.fract()) as f32);
        // sin(n x) = 2 cos(x) sin((n - 1) x) - sin((n - 2) x)
        let (mut overtone, mut before, mut sum) = (sine, 0.0, 0.0);
        for loudness in loudnesses {
            sum += loudness * overtone;
            (overtone, before) = (2.0 * cosine * overtone - before, overtone);
        }
        *sample += level * envelope(time, duration, 0.04, 0.1) * sum;
    }
}

/// Of a voice's overtones: falling, with the resonances of an open mouth, the last of them where
/// whistles are (Sundberg, "The Science of the Singing Voice", 1987: the singer's formant).
fn loudnesses(pitch: f64) -> [f32; OVERTONES] {
    std::array::from_fn(|index| {
        let number = (index + 1) as f64;
        let resonances = [
            (700.0, 200.0, 1.0),
            (1250.0, 250.0, 0.8),
            (2950.0, 350.0, 1.2),
        ];
        let resonance = resonances.iter().map(|(center, width, gain)| {
            gain / (1.0 + math::powi((number * pitch - center) / width, 2))
        });
        ((0.3 + resonance.sum::<f64>()) / number) as f32
    })
}

/// A shoe on the floor: one tone that sweeps through the band of whistles.
fn add_squeak(passage: &mut Passage, squeak: &mut Event, level: f32) {
    let duration = squeak.draw.from(0.03..0.12);
    let (from, to) = (
        squeak.draw.from(1800.0..4200.0),
        squeak.draw.from(1800.0..4200.0),
    );
    for (_, time, sample) in passage.during(squeak.begins_at, duration) {
        let turns = from * time + (to - from) * time * time / (2.0 * duration);
        *sample += level * envelope(time, duration, 0.01, 0.02) * math::sin(TAU * turns) as f32;
    }
}

/// A loudspeaker that distorts: one tone and a little of its second and third overtone.
fn add_beep(passage: &mut Passage, beep: &mut Event, level: f32) {
    let duration = beep.draw.from(0.15..0.8);
    let rotation = TAU * beep.draw.from(600.0..1600.0);
    for (_, time, sample) in passage.during(beep.begins_at, duration) {
        let tone = math::sin(rotation * time)
            + 0.05 * math::sin(2.0 * rotation * time)
            + 0.1 * math::sin(3.0 * rotation * time);
        *sample += level * envelope(time, duration, 0.005, 0.005) * tone as f32;
    }
}

/// From 0 to 1 within `attack` s and back within `release` s.
pub(super) fn envelope(time: f64, duration: f64, attack: f64, release: f64) -> f32 {
    (time / attack)
        .min((duration - time) / release)
        .clamp(0.0, 1.0) as f32
}
