//! Owns how the robot has moved over the ground.

use framework::{Clear, Reflect};
use nalgebra::Isometry2;
use serde::{Deserialize, Serialize};

/// Movement of the ground frame, from the legs and the inertial measurement unit.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Odometry {
    /// From the ground frame of this cycle to the ground frame of the first cycle, m and rad.
    pub ground_to_start: Isometry2<f32>,
}
