//! The parameter tree; each field names the nodes that read it.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use k1_nodes::types::Gains;
use serde::Deserialize;
use serde::Serialize;

/// Everything that the parameter files say to nodes.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    pub look_around: LookAround,
    pub motor_sender: MotorSender,
    pub prepare: Prepare,
    pub wave: Wave,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LookAround {
    /// k1_nodes::look_around
    #[reflect(unit = "rad")]
    pub amplitude: f32,
    /// k1_nodes::look_around
    #[reflect(unit = "s", range = 0.1..)]
    pub period: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MotorSender {
    /// k1_nodes::motor_sender
    pub ankle: Gains,
    /// k1_nodes::motor_sender
    pub arm: Gains,
    /// k1_nodes::motor_sender
    pub head: Gains,
    /// k1_nodes::motor_sender
    pub leg: Gains,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Prepare {
    /// k1_nodes::prepare
    #[reflect(unit = "s", range = 0.1..)]
    pub duration: f32,
    /// k1_nodes::prepare
    #[reflect(unit = "rad")]
    pub pose: Vec<f32>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Wave {
    /// k1_nodes::wave
    #[reflect(unit = "rad")]
    pub amplitude: f32,
    /// k1_nodes::wave
    #[reflect(unit = "s", range = 0.1..)]
    pub period: f32,
}
