//! The parameter tree; each field names the nodes that read it.
//!
//! Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.

use framework::Reflect;
use serde::Deserialize;
use serde::Serialize;
use zoo_nodes::types::Camera;

/// Everything that the parameter files say to nodes.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    pub a: A,
    pub a_b: AB2,
    pub exposure: Exposure,
    pub gait: Gait,
    pub option: Option2,
    pub self_: Self2,
    pub spot_finder: SpotFinder,
    pub vec: Vec2,
    pub vision_bottom: VisionInstance,
    pub vision_top: VisionInstance,
    /// zoo_nodes::control::gait
    pub walking_speed: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct A {
    pub b: AB,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct AB {
    pub reflexes: ABReflexesInstance,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ABReflexesInstance {
    /// zoo_nodes::reflexes::create
    pub x: u8,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct AB2 {
    pub reflexes: ABReflexesInstance2,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ABReflexesInstance2 {
    /// zoo_nodes::reflexes::create
    pub y: u8,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Exposure {
    /// zoo_nodes::vision::exposure
    pub vision_bottom: f32,
    /// zoo_nodes::vision::exposure
    pub vision_top: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Gait {
    /// zoo_nodes::control::gait
    #[reflect(creation_only)]
    pub period: f32,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Option2 {
    /// zoo_nodes::reflexes::create
    pub text: Option<String>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Self2 {
    /// zoo_nodes::reflexes::create
    pub x: u8,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SpotFinder {
    /// zoo_nodes::vision::spot_finder
    #[reflect(creation_only)]
    pub brightest: usize,
    /// zoo_nodes::vision::spot_finder
    pub threshold: u8,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Vec2 {
    /// zoo_nodes::reflexes::create
    pub numbers: Vec<u8>,
}

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct VisionInstance {
    /// zoo_nodes::vision::eye
    #[reflect(creation_only)]
    pub camera: Camera,
    /// zoo_nodes::vision::spot_finder
    pub gain: f32,
}
