//! Owns balls: as an image shows them, and as the robot remembers them.

use framework::{Clear, Reflect, Timestamp};
use nalgebra::{Matrix2, Point2, Vector2};
use serde::{Deserialize, Serialize};

use crate::camera::CameraMatrix;

/// A circle in an image that looks like a ball.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct BallCandidate {
    /// Centre of the circle in px, x to the right, y down.
    pub center: Point2<f32>,
    /// Radius of the circle in px.
    pub radius: f32,
    /// Where it lies in the ground frame in m; `None` where the camera's pose is not known.
    pub position: Option<Point2<f32>>,
    /// Of that place, along the axes of the ground frame, in m²; there where the place is.
    pub covariance: Option<Matrix2<f32>>,
}

/// In which part of the world an image was searched for balls.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct BallView {
    /// Where the camera was in the ground frame of the image, when it was exposed.
    pub camera_matrix: CameraMatrix,
    /// Width and height of the image in px.
    pub size: Vector2<f32>,
    /// Smaller balls were not looked for, radius in px.
    pub least_radius: f32,
    /// Of a ball in m.
    pub ball_radius: f32,
}

/// An image whose candidates a filter has learnt.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub struct LearntImage {
    /// When it was exposed.
    pub captured_at: Timestamp,
    /// How many candidates it had.
    pub candidates: usize,
}

/// The ball as the robot remembers it.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Ball {
    /// Where it lies in the ground frame of this cycle in m: x forward, y left of the robot.
    pub position: Point2<f32>,
    /// How it rolls over the ground, along the axes of that frame, m/s; zero while it rests.
    pub velocity: Vector2<f32>,
    /// When a camera saw it last.
    pub seen_at: Timestamp,
}
