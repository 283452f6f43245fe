//! What the zoo's nodes exchange.

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

/// Which eye an instance of `Vision` looks through.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Reflect, Serialize)]
pub enum Camera {
    #[default]
    Top,
    Bottom,
}

/// What an eye sees.
#[derive(Clear, Clone, Debug, Default, Deserialize, Reflect, Serialize)]
#[reflect(image = "gray")]
pub struct Image {
    pub width: usize,
    pub height: usize,
    pub data: Vec<u8>,
}

/// Something bright in an image.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Spot {
    pub x: f32,
    pub brightness: f32,
}

/// A place on the ground.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Point {
    pub x: f32,
    pub y: f32,
}

/// Where the body is, if it knows.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Pose {
    pub position: Option<Point>,
    pub heading: f32,
}

/// Options in options.
#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct Report {
    pub best: Option<Spot>,
    pub nested: Option<Nested>,
    pub certainty: f32,
}

#[derive(Clone, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct Nested {
    pub deep: Option<f32>,
    pub plain: f32,
}

/// A whistle that was heard.
#[derive(Clone, Copy, Debug, Default, Deserialize, Reflect, Serialize)]
pub struct Whistle {
    pub loudness: f32,
}

/// What a client may ask of the gait.
#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
pub struct Walk {
    pub speed: f32,
}
