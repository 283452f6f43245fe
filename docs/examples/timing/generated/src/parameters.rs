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
    pub position_detection: PositionDetection,
    pub position_filter: PositionFilter,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PositionDetection {
    /// timing_nodes::position_detection
    pub effort: f32,
    /// timing_nodes::position_detection
    pub mark: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PositionFilter {
    /// timing_nodes::position_filter
    pub trust: f32,
}
