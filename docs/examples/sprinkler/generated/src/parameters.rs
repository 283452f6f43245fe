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
    pub rain_mean: RainMean,
    pub thirst: Thirst,
    pub valve_choice: ValveChoice,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RainMean {
    /// sprinkler_nodes::rain_mean
    pub share: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Thirst {
    /// sprinkler_nodes::thirst
    pub enough_rain: f32,
    /// sprinkler_nodes::thirst
    pub wanted: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ValveChoice {
    /// sprinkler_nodes::valve_choice
    pub closes: f32,
    /// sprinkler_nodes::valve_choice
    pub opens: f32,
}
