//! The strongest tone within the band of whistles, and how it compares to everything else.

use std::ops::Range;

use framework::{Reflect, math};
use serde::{Deserialize, Serialize};

use super::WhistleDetectionParameters;
use super::spectrum::{BIN_COUNT, WINDOW_LENGTH};

/// The loudest overtones of voices and loudspeakers are lower.
const GREATEST_DIVISOR: u32 = 16;

/// A tone that a microphone hears.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct SpectralPeak {
    /// In Hz.
    pub frequency: f32,
    /// Mean power of the tone over that of the rest of the band, dB.
    pub prominence: f32,
    /// Power of the tone's strongest bin over that of the strongest rival's, dB.
    pub dominance: f32,
    /// Root mean square of the tone, share of full scale.
    pub level: f32,
}

/// The strongest peak within the band. `None` where the parameters name no band of this spectrum or
/// leave nothing to compare with, and where the spectrum is empty.
pub(super) fn strongest_peak(
    power: &[f32],
    sample_rate: u32,
    parameters: &WhistleDetectionParameters,
) -> Option<SpectralPeak> {
    let bin_width = sample_rate as f32 / WINDOW_LENGTH as f32;
    let bin = |frequency: f32| {
        let bin = (frequency / bin_width).round();
        (0.0..BIN_COUNT as f32)
            .contains(&bin)
            .then_some(bin as usize)
    };
    let band = bin(parameters.lowest_frequency)?..bin(parameters.highest_frequency)?;
    let half_width = bin(parameters.half_width)?;

    let center = strongest(power, band.clone())?;
    let tone = center.saturating_sub(half_width)..(center + half_width + 1).min(BIN_COUNT);
    let below = band.start..tone.start.max(band.start);
    let above = tone.end.min(band.end)..band.end;

    let rest = mean([&power[below.clone()], &power[above.clone()]])?;
    let tone_power: f32 = power[tone.clone()].iter().sum();
    let frequency = center as f32 * bin_width;
    // A band that ends above the highest rival frequency of a low tone is compared all the same.
    let highest_rival = bin(parameters.highest_rival * frequency)?.max(tone.end);
    let nearby = [
        bin(parameters.lowest_rival)?..tone.start,
        tone.end..highest_rival,
    ];
    let off = (parameters.divisor_tolerance as usize).min(BIN_COUNT);
    let fundamentals = (2..=parameters.greatest_divisor.min(GREATEST_DIVISOR)).map(|divisor| {
        let fundamental = (center as f32 / divisor as f32).round() as usize;
        fundamental.saturating_sub(off)..(fundamental + off + 1).min(tone.start)
    });
    let rival = nearby
        .into_iter()
        .chain(fundamentals)
        .filter_map(|range| strongest(power, range))
        .map(|rival| power[rival])
        .fold(f32::MIN_POSITIVE, f32::max);
    Some(SpectralPeak {
        frequency,
        prominence: decibels(tone_power / tone.len() as f32 / rest.max(f32::MIN_POSITIVE)),
        dominance: decibels(power[center] / rival),
        level: tone_power.sqrt(),
    })
}

/// The first of the strongest bins; `None` in an empty range.
fn strongest(power: &[f32], range: Range<usize>) -> Option<usize> {
    let mut strongest = None;
    let mut most = f32::NEG_INFINITY;
    for (bin, &power) in power.get(range.clone())?.iter().enumerate() {
        if power > most {
            most = power;
            strongest = Some(range.start + bin);
        }
    }
    strongest
}

/// `None` of nothing.
fn mean(parts: [&[f32]; 2]) -> Option<f32> {
    let count = parts[0].len() + parts[1].len();
    let sum: f32 = parts.into_iter().flatten().sum();
    (count > 0).then(|| sum / count as f32)
}

/// At most 100 dB to both sides, so that silence has a number too.
fn decibels(ratio: f32) -> f32 {
    10.0 * math::log10(ratio.clamp(1e-10, 1e10))
}
