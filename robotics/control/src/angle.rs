//! Owns angles that differ by whole turns and are the same.

use std::f32::consts::{PI, TAU};

/// The same direction from -π to π.
pub(crate) fn wrap(angle: f32) -> f32 {
    (angle + PI).rem_euclid(TAU) - PI
}
