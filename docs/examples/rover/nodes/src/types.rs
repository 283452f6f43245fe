//! What nodes exchange. Frames: x forward, y left, angles counter-clockwise.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// One turn of the lidar.
#[derive(Clone, Clear, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Scan {
    /// Metres to what is there, counter-clockwise from straight ahead, all around at equal steps; infinite where nothing is.
    pub ranges: Vec<f32>,
}

/// A direction into which the rover could drive.
#[derive(Clone, Copy, Clear, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Freeway {
    /// Radians from straight ahead.
    pub direction: f32,
    /// Metres that it could drive, as broad as it is.
    pub distance: f32,
}

/// How far each wheel rolled since the last sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Rolled {
    /// Metres forward.
    pub left: f32,
    /// Metres forward.
    pub right: f32,
}

/// Where the rover is, seen from its start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Pose {
    /// x and y, metres.
    pub position: [f32; 2],
    /// Radians, between -π and π.
    pub heading: f32,
}

/// What the rover shall do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Reflect, Serialize)]
pub struct Speeds {
    /// Metres per second.
    pub forward: f32,
    /// Radians per second.
    pub turn: f32,
}

/// The same angle between -π and π.
pub fn wrapped(angle: f32) -> f32 {
    angle.sin().atan2(angle.cos())
}
