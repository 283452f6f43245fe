//! The parameter tree; each field names the nodes that read it.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use serde::Deserialize;
use serde::Serialize;

/// Everything that the parameter files say to nodes.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    pub freeway_detection: FreewayDetection,
    pub odometry: Odometry,
    pub steering: Steering,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FreewayDetection {
    /// rover_nodes::lidar::freeway_detection
    #[reflect(range = 1..= 720)]
    pub directions: u32,
    /// rover_nodes::lidar::freeway_detection
    #[reflect(unit = "m", range = 0..)]
    pub half_width: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Odometry {
    /// rover_nodes::drive::odometry
    #[reflect(unit = "m", range = 0.01..)]
    pub track: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Steering {
    /// rover_nodes::drive::steering
    #[reflect(unit = "m/s", range = 0..= 1)]
    pub cruising: f32,
    /// rover_nodes::drive::steering
    #[reflect(unit = "rad/s", range = 0..)]
    pub fastest_turn: f32,
    /// rover_nodes::drive::steering
    #[reflect(unit = "1/s", range = 0..)]
    pub gain: f32,
    /// rover_nodes::drive::steering
    pub goals: Vec<[f32; 2]>,
    /// rover_nodes::drive::steering
    #[reflect(unit = "m", range = 0..)]
    pub look_ahead: f32,
    /// rover_nodes::drive::steering
    #[reflect(unit = "m", range = 0..)]
    pub tolerance: f32,
}
