//! Owns what the sonar says about what stands in front of the robot.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// Smoothed distances to what reflects, in m from the receivers; `None` where nothing does.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct SonarDistances {
    /// Ahead on the left.
    pub left: Option<f32>,
    /// Ahead on the right.
    pub right: Option<f32>,
}
