//! The power spectrum of the newest samples of a microphone.

use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlannerScalar};

/// How many samples a spectrum is about: 46 ms at 44.1 kHz, 21.5 Hz from bin to bin.
pub const WINDOW_LENGTH: usize = 2048;

/// A spectrum's frequencies, up to half the sample rate.
pub(super) const BIN_COUNT: usize = WINDOW_LENGTH / 2;

/// A planned Fourier transform and the memory that it works in; not planned by default.
///
/// Invariant: computes the same bits on every machine of an architecture, for the planner does not
/// look for vector units.
#[derive(Default)]
pub(super) struct Spectrum {
    plan: Option<Arc<dyn Fft<f32>>>,
    /// Hann's.
    window: Vec<f32>,
    samples: Vec<Complex<f32>>,
    scratch: Vec<Complex<f32>>,
    power: Vec<f32>,
}

impl Spectrum {
    pub(super) fn planned() -> Self {
        let plan = FftPlannerScalar::new().plan_fft_forward(WINDOW_LENGTH);
        let hann = |index: usize| {
            let share = index as f64 / WINDOW_LENGTH as f64;
            (0.5 - 0.5 * (TAU * share).cos()) as f32
        };
        Self {
            window: (0..WINDOW_LENGTH).map(hann).collect(),
            samples: vec![Complex::default(); WINDOW_LENGTH],
            scratch: vec![Complex::default(); plan.get_inplace_scratch_len()],
            power: vec![0.0; BIN_COUNT],
            plan: Some(plan),
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
        self.plan
            .as_ref()?
            .process_with_scratch(&mut self.samples, &mut self.scratch);
        // Parseval: half of the power lies in the negative frequencies, 3/8 passes the window.
        let scale = 2.0 / (0.375 * (WINDOW_LENGTH * WINDOW_LENGTH) as f32);
        for (power, complex) in self.power.iter_mut().zip(&self.samples) {
            *power = complex.norm_sqr() * scale;
        }
        Some(&self.power)
    }
}

impl fmt::Debug for Spectrum {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Spectrum")
            .field("is_planned", &self.plan.is_some())
            .finish_non_exhaustive()
    }
}
