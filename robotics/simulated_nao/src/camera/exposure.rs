//! Everything an image depends on, taken at one moment.

use std::sync::Arc;

use framework::Timestamp;
use nalgebra::{Isometry3, Point2, Point3, UnitQuaternion, Vector3};
use types::camera::Intrinsics;
use types::joints::Joints;

use crate::scene::{ImageSettings, Robot};

/// What a camera sees at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exposure {
    /// Counts the exposures of this camera from 0.
    pub number: u64,
    /// When it was taken.
    pub captured_at: Timestamp,
    /// When the image is there for the reader.
    pub ready_at: Timestamp,
    /// Optical frame (x right, y down, z forward) in the field frame.
    pub camera_to_field: Isometry3<f32>,
    /// The robot's ground frame in the field frame.
    pub ground_to_field: Isometry3<f32>,
    /// How directions become pixels.
    pub intrinsics: Intrinsics,
    /// Centre in the field frame.
    pub ball: Option<Point3<f32>>,
    /// How it has rolled.
    pub ball_turn: UnitQuaternion<f32>,
    /// The other robots.
    pub robots: Arc<[Robot]>,
    /// The robot itself, which may stand in its own view; `None` leaves it out.
    pub body: Option<OwnBody>,
    /// How the camera takes it.
    pub images: ImageSettings,
}

/// The robot that carries the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnBody {
    /// Angles in rad.
    pub joints: Joints<f32>,
    /// From the torso frame to the field frame.
    pub torso_to_field: Isometry3<f32>,
}

impl Exposure {
    pub(crate) fn ball_in_camera(&self) -> Option<Point3<f32>> {
        self.ball
            .map(|ball| self.camera_to_field.inverse_transform_point(&ball))
    }

    /// Direction of a pixel's centre, one ahead of the camera, in the optical frame.
    pub(crate) fn ray(&self, column: usize, row: usize) -> Vector3<f32> {
        self.intrinsics.ray(Point2::new(column as f32, row as f32))
    }
}
