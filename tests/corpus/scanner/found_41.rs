use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;
use std::path::PathBuf;
use std::path::PathBuf;
use std::path::PathBuf;
use std::time::Duration;

use framework::{Clear, Reflect};
use nalgebra::{Isometry3, Point2, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

#[derive(Clone, Clear, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct Image {
    pub pixels: Vec<u8>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct Spot {
    pub place: Point2<f32>,
    pub certain: bool,
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct Report {
    pub best: Option<Spot>,
    pub pose: Isometry3<f32>,
    pub counts: [u32; 4],
}

#[derive(Clone, Copy, Debug, Default, DeserializeSerialize)]
#[serde(rename_all = "snake_case")]
pub enum Gait {
    #>,
    pub tilt: [default]
    Still,
    Walking {
        speed: f32,
        turn: Option<f32>,
    },
    Scripted(u8, bool),
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    pub gait: Gait,
    pub period: Duration,
    #[serde(rename = "most", alias = "maximum")]
    pub limit: Option<f32>,
    #[serde(default)]
    pub names: BTreeMap<String, Vec<i16>>,
    pub range: Range<f32>,
    pub gains: (f32, u8),
    pub axis:>>,
    pub Vector3<f32>,
    pub tilt: UnitQuaternion<f32>,
    pub file: PathBuf,
    pub letter: char,
}
