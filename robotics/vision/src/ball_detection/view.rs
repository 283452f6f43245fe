//! The image with the knowledge of what is field and how large a ball would be where.

use nalgebra::Point2;
use types::camera::CameraMatrix;
use types::image::YuyvImage;
use types::projection_noise::ProjectionNoise;

use crate::field_color::FieldColor;
use crate::nearest_pixel::nearest_pixel;

/// An image, and what is known about it before anything is looked for.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) image: &'a YuyvImage,
    pub(super) matrix: &'a CameraMatrix,
    pub(super) field_color: &'a FieldColor,
    /// In m.
    pub(super) ball_radius: f32,
    pub(super) noise: &'a ProjectionNoise,
}

impl View<'_> {
    /// Whether the nearest pixel shows the field; `None` outside of the image.
    pub(super) fn is_field(&self, point: Point2<f32>) -> Option<bool> {
        let (x, y) = nearest_pixel(point)?;
        self.image
            .yuv(x, y)
            .map(|color| self.field_color.matches(color))
    }

    /// Luminance of the nearest pixel; `None` outside of the image.
    pub(super) fn luminance(&self, point: Point2<f32>) -> Option<f32> {
        let (x, y) = nearest_pixel(point)?;
        self.image.luminance(x, y).map(f32::from)
    }

    /// Radius in px of a ball on the floor whose centre is seen there; `None` above the horizon.
    pub(super) fn expected_radius(&self, center: Point2<f32>) -> Option<f32> {
        let ground = self.matrix.pixel_to_ground(center, self.ball_radius)?;
        let center = nalgebra::Point3::new(ground.x, ground.y, self.ball_radius);
        self.matrix.pixel_radius(center, self.ball_radius)
    }
}
