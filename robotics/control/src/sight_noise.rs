//! Owns how wrong a camera is about a place on the ground: its distance is known less well than its
//! direction.

use framework::math;
use nalgebra::{Matrix2, Unit, Vector2};

/// What grows with the distance, one standard deviation each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SightNoise {
    /// Just in front of the robot, in m.
    pub(crate) least: f32,
    /// By how much more per m of distance, along the line of sight.
    pub(crate) along: f32,
    /// By how much more per m² of distance, along the line of sight: what an error of the camera's tilt
    /// makes of it.
    pub(crate) tilt: f32,
    /// By how much more per m of distance, across the line of sight.
    pub(crate) across: f32,
}

impl SightNoise {
    /// Of a place that lies so from the robot (m), in the axes of that vector, in m².
    pub(crate) fn covariance(&self, sight: Vector2<f32>) -> Matrix2<f32> {
        let direction = Unit::try_new(sight, f32::EPSILON).unwrap_or(Vector2::x_axis());
        let distance = sight.norm();
        let along = math::powi(
            self.least + (self.along + self.tilt * distance) * distance,
            2,
        );
        let across = math::powi(self.least + self.across * distance, 2);
        let along_sight = direction.into_inner() * direction.transpose();
        along_sight * (along - across) + Matrix2::identity() * across
    }
}
