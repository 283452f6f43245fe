//! A joint that goes to and fro.

use std::f32::consts::TAU;

use framework::{CycleTime, Timestamp};

/// Where a swing is: starts at 0, without a jump.
pub(crate) fn swing(time: &CycleTime, amplitude: f32, period: f32) -> f32 {
    let seconds = (time.start - Timestamp::ZERO).as_secs_f32();
    amplitude * (seconds / period * TAU).sin()
}
