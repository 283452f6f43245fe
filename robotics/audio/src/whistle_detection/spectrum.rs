//! The power spectrum of the newest samples of a microphone.

use std::f64::consts::TAU;
use std::fmt;

use framework::math;
use nalgebra::Complex;

/// How many samples a spectrum is about: 46 ms at 44.1 kHz, 21.5 Hz from bin to bin.
pub const WINDOW_LENGTH: usize = 2048;

/// A spectrum's frequencies, up to half the sample rate.
pub(super) const BIN_COUNT: usize = WINDOW_LENGTH / 2;

/// What a Fourier transform needs and the memory that it works in; not planned by default.
///
/// Invariant: computes the same bits on every machine.
#[derive(Default)]
pub(super) struct Spectrum {
    /// Hann's.
    window: Vec<f32>,
    /// exp(-iτk / `WINDOW_LENGTH`) for the first half of all k.
    turns: Vec<Complex<f32>>,
    samples: Vec<Complex<f32>>,
    power: Vec<f32>,
}

impl Spectrum {
    pub(super) fn planned() -> Self {
        let angle = |index: usize| TAU * index as f64 / WINDOW_LENGTH as f64;
        let hann = |index| (0.5 - 0.5 * math::cos(angle(index))) as f32;
        let turn = |index| {
            let (sine, cosine) = math::sin_cos(angle(index));
            Complex::new(cosine as f32, -sine as f32)
        };
        Self {
            window: (0..WINDOW_LENGTH).map(hann).collect(),
            turns: (0..WINDOW_LENGTH / 2).map(turn).collect(),
            samples: vec![Complex::default(); WINDOW_LENGTH],
            power: vec![0.0; BIN_COUNT],
        }
    }

    /// The power in each bin, so scaled that the bins of a sine add up to the square of its root mean
    /// square. `None` where there are too few samples, or one that is no number or far from any.
    pub(super) fn power(&mut self, samples: &[f32]) -> Option<&[f32]> {
        let newest = samples.last_chunk::<WINDOW_LENGTH>()?;
        // Full scale is 1; this also refuses what would overflow, and NaN.
        if !newest.iter().all(|sample| sample.abs() <= 16.0) {
            return None;
        }
        for ((complex, sample), weight) in self.samples.iter_mut().zip(newest).zip(&self.window) {
            *complex = Complex::new(sample * weight, 0.0);
        }
        if self.turns.is_empty() {
            return None;
        }
        transform(&mut self.samples, &self.turns);
        // Parseval: half of the power lies in the negative frequencies, 3/8 passes the window.
        let scale = 2.0 / (0.375 * (WINDOW_LENGTH * WINDOW_LENGTH) as f32);
        for (power, complex) in self.power.iter_mut().zip(&self.samples) {
            *power = complex.norm_sqr() * scale;
        }
        Some(&self.power)
    }
}

/// The Fourier transform in place, of as many samples as twice the turns: a power of two.
///
/// Cooley and Tukey, "An Algorithm for the Machine Calculation of Complex Fourier Series", 1965. The usual crates choose
/// their code, or the functions behind their tables, by the processor.
fn transform(samples: &mut [Complex<f32>], turns: &[Complex<f32>]) {
    let unused_bits = usize::BITS - samples.len().trailing_zeros();
    for index in 0..samples.len() {
        let reversed = index.reverse_bits() >> unused_bits;
        if index < reversed {
            samples.swap(index, reversed);
        }
    }
    let mut half = 1;
    while half < samples.len() {
        let stride = turns.len() / half;
        for block in samples.chunks_exact_mut(2 * half) {
            let (even, odd) = block.split_at_mut(half);
            let turns = turns.iter().step_by(stride);
            for ((even, odd), turn) in even.iter_mut().zip(odd).zip(turns) {
                let turned = *odd * turn;
                *odd = *even - turned;
                *even += turned;
            }
        }
        half *= 2;
    }
}

impl fmt::Debug for Spectrum {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Spectrum")
            .field("is_planned", &!self.turns.is_empty())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_transform_is_the_sum_of_its_definition() {
        let count = 64;
        let angle = |index: usize| TAU * index as f64 / count as f64;
        let turns: Vec<_> = (0..count / 2)
            .map(|index| {
                Complex::new(
                    math::cos(angle(index)) as f32,
                    -math::sin(angle(index)) as f32,
                )
            })
            .collect();
        let samples: Vec<_> = (0..count)
            .map(|index| {
                let index = index as f32;
                Complex::new(math::sin(index * index), math::cos(3.0 * index))
            })
            .collect();
        let mut found = samples.clone();
        transform(&mut found, &turns);
        for (bin, found) in found.iter().enumerate() {
            let expected: Complex<f64> = samples
                .iter()
                .enumerate()
                .map(|(index, sample)| {
                    let turn = angle(bin * index % count);
                    Complex::new(f64::from(sample.re), f64::from(sample.im))
                        * Complex::new(math::cos(turn), -math::sin(turn))
                })
                .sum();
            let away = (f64::from(found.re) - expected.re).abs()
                + (f64::from(found.im) - expected.im).abs();
            assert!(away < 1e-5, "bin {bin}: {found}, expected {expected}");
        }
    }
}
