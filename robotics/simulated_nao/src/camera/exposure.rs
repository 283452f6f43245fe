//! Everything an image depends on, taken at one moment.

use framework::Timestamp;
use nalgebra::{Isometry3, Point2, Point3, Vector3};
use types::camera::Intrinsics;

/// What a camera sees at one moment.
#[derive(Clone, Debug)]
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
