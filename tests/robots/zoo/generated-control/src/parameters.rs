//! The parameter tree; each field names the nodes that read it.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use serde::Deserialize;
use serde::Serialize;

/// Everything that the parameter files say to nodes.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
pub struct Parameters {
    pub gait: Gait,
    /// zoo_nodes::control::gait
    pub walking_speed: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Gait {
    /// zoo_nodes::control::gait
    #[reflect(creation_only)]
    pub period: f32,
}
