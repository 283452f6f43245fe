//! Noise out of nothing but numbers: random access instead of a generator that must be run.
//!
//! A counter is hashed (SplitMix64's finaliser: Steele, Lea and Flood, "Fast Splittable Pseudorandom
//! Number Generators", 2014). Slow noise interpolates between hashes of a lattice (value noise).

use std::ops::Range;

/// What the random numbers are for: no two purposes share any. Lattices have the first 64.
pub(crate) const SENSORS: u64 = 64;
pub(crate) const CLAPS: u64 = 65;
pub(crate) const CLAP_NOISE: u64 = 66;
pub(crate) const SHOUTS: u64 = 67;
pub(crate) const CHANTS: u64 = 68;
pub(crate) const SQUEAKS: u64 = 69;
pub(crate) const ANNOUNCEMENTS: u64 = 70;
pub(crate) const WHISTLES: u64 = 71;
pub(crate) const BREATH: u64 = 72;
pub(crate) const SENSOR_NOISE: u64 = 73;
pub(crate) const SENSOR_BIAS: u64 = 74;

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// 64 random bits for each counter of each purpose.
pub(crate) fn hash(seed: u64, purpose: u64, counter: u64) -> u64 {
    let key = seed.wrapping_add(purpose.wrapping_mul(0xd1b5_4a32_d192_ed03));
    finalize(finalize(key).wrapping_add(counter.wrapping_mul(GOLDEN)))
}

fn finalize(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// Four random numbers from -1 to 1.
pub(crate) fn signed_parts(bits: u64) -> [f32; 4] {
    [0, 16, 32, 48].map(|shift| f32::from((bits >> shift) as i16) / 32_768.0)
}

/// One random number from -1 to 1.
pub(crate) fn signed(bits: u64) -> f32 {
    f32::from(bits as i16) / 32_768.0
}

/// About normal, with mean 0 and standard deviation 1: the sum of four even ones, up to 3.5.
pub(crate) fn normal(bits: u64) -> f32 {
    // The variance of a number that is even from -1 to 1 is a third.
    signed_parts(bits).iter().sum::<f32>() * (0.75_f32).sqrt()
}

/// Draws a few random numbers about one event.
pub(crate) struct Draw {
    state: u64,
}

impl Draw {
    pub(crate) fn new(seed: u64, purpose: u64, counter: u64) -> Self {
        Self {
            state: hash(seed, purpose, counter),
        }
    }

    /// Evenly from `range`.
    pub(crate) fn from(&mut self, range: Range<f64>) -> f64 {
        self.state = self.state.wrapping_add(GOLDEN);
        let share = (finalize(self.state) >> 11) as f64 / (1_u64 << 53) as f64;
        range.start + (range.end - range.start) * share
    }
}

/// Slow noise from -1 to 1: straight lines between random numbers, 2^`shift` samples apart.
///
/// Calls `line` for each piece with its part of 0..`length`, the value at its first sample and the
/// slope per sample.
pub(crate) fn for_each_line(
    seed: u64,
    shift: u32,
    start: u64,
    length: usize,
    mut line: impl FnMut(Range<usize>, f32, f32),
) {
    let spacing = 1_u64 << shift;
    let value = |cell: u64| signed(hash(seed, u64::from(shift), cell));
    let mut cell = start >> shift;
    let mut left = value(cell);
    let mut index = 0;
    while index < length {
        let right = value(cell + 1);
        let passed = start + index as u64 - (cell << shift);
        let end = length.min(index + (spacing - passed) as usize);
        let slope = (right - left) / spacing as f32;
        line(index..end, left + slope * passed as f32, slope);
        (left, cell, index) = (right, cell + 1, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn purposes_counters_and_seeds_share_no_numbers() {
        let mut seen = std::collections::BTreeSet::new();
        for seed in 0..10 {
            for purpose in 0..10 {
                for counter in 0..100 {
                    assert!(seen.insert(hash(seed, purpose, counter)));
                }
            }
        }
    }

    #[test]
    fn slow_noise_is_the_same_wherever_one_begins() {
        let samples = |start: u64, length: usize| {
            let mut samples = vec![0.0; length];
            for_each_line(7, 5, start, length, |range, first, slope| {
                for (step, sample) in samples[range].iter_mut().enumerate() {
                    *sample = first + slope * step as f32;
                }
            });
            samples
        };
        let whole = samples(0, 300);
        for (one, other) in samples(41, 200).iter().zip(&whole[41..]) {
            assert!((one - other).abs() < 1e-5);
        }
        let largest = whole.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        assert!(largest.fold(0.0, f32::max) <= 2.0 / 32.0 + 1e-6);
    }

    #[test]
    fn normal_numbers_have_mean_0_and_deviation_1() {
        let numbers: Vec<f32> = (0..10_000)
            .map(|it| normal(hash(3, SENSOR_NOISE, it)))
            .collect();
        let mean = numbers.iter().sum::<f32>() / 10_000.0;
        let variance = numbers.iter().map(|it| it * it).sum::<f32>() / 10_000.0;
        assert!(
            mean.abs() < 0.04 && (variance - 1.0).abs() < 0.05,
            "{mean} {variance}"
        );
    }

    #[test]
    fn drawn_numbers_fill_their_range() {
        let mut draw = Draw::new(1, SHOUTS, 2);
        let drawn: Vec<_> = (0..1000).map(|_| draw.from(2.0..4.0)).collect();
        assert!(drawn.iter().all(|number| (2.0..4.0).contains(number)));
        let mean = drawn.iter().sum::<f64>() / 1000.0;
        assert!((mean - 3.0).abs() < 0.1, "{mean}");
    }
}
