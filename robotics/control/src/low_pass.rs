//! Owns the low pass: a value that follows what is measured slowly, however long a cycle takes.
//!
//! Invariant: a measurement that is no number changes nothing, so it spoils nothing that follows.

use std::ops::{Add, Mul, Sub};

use framework::math;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// What can be smoothed.
pub trait Measurement:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<f32, Output = Self>
{
    /// Whether every component is a finite number.
    fn is_number(&self) -> bool;
}

impl Measurement for f32 {
    fn is_number(&self) -> bool {
        self.is_finite()
    }
}

impl Measurement for Vector3<f32> {
    fn is_number(&self) -> bool {
        self.iter().all(|component| component.is_finite())
    }
}

/// A value that follows what is measured; by default it starts at the first measurement.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct LowPass<T> {
    value: Option<T>,
}

impl<T: Measurement> LowPass<T> {
    /// Starts at a value that nobody measured.
    pub fn starting_at(value: T) -> Self {
        Self { value: Some(value) }
    }

    /// The smoothed value `step` seconds after the one before: after `time` seconds, a third of a
    /// difference is left.
    pub fn update(&mut self, measured: T, step: f32, time: f32) -> T {
        if measured.is_number() {
            let last = self.value.unwrap_or(measured);
            self.value = Some(last + (measured - last) * share(step, time));
        }
        self.value.unwrap_or_default()
    }
}

/// How much of a difference vanishes in `step` seconds, so that a third is left after `time`
/// seconds; everything where `time` is no positive number.
pub fn share(step: f32, time: f32) -> f32 {
    1.0 - left(step, time)
}

/// How much of a difference is left after `step` seconds: the rest of [`share`].
pub fn left(step: f32, time: f32) -> f32 {
    math::exp(-step / time.max(f32::EPSILON))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_of_a_difference_is_left_after_the_time_however_long_the_steps_are() {
        for (steps, step) in [(100, 0.01), (10, 0.1), (1, 1.0)] {
            let mut low_pass = LowPass::starting_at(1.0);
            for _ in 0..steps {
                low_pass.update(0.0, step, 1.0);
            }
            let left = low_pass.update(0.0, 0.0, 1.0);
            assert!((left - math::exp(-1.0_f32)).abs() < 1e-4, "{left}");
        }
    }

    #[test]
    fn the_first_measurement_is_taken_as_it_is() {
        let mut low_pass = LowPass::default();
        let gravity = Vector3::new(0.0, 0.0, 9.8);
        assert_eq!(low_pass.update(gravity, 0.0, 1.0), gravity);
    }

    #[test]
    fn what_is_no_number_changes_nothing() {
        let mut low_pass = LowPass::default();
        assert_eq!(low_pass.update(f32::NAN, 0.01, 1.0), 0.0);
        low_pass.update(2.0, 0.01, 1.0);
        assert_eq!(low_pass.update(f32::INFINITY, 0.01, 1.0), 2.0);
        assert_eq!(low_pass.update(3.0, 0.01, f32::NAN), 3.0);
    }
}
