//! The image with the knowledge of what is field and how large a ball would be where.

use nalgebra::{Point2, Vector2};
use types::camera::CameraMatrix;
use types::image::YuyvImage;
use types::projection_noise::ProjectionNoise;

use super::disc;
use super::field_mask::FieldMask;
use crate::nearest_pixel::nearest_pixel;

/// An image, and what is known about it before anything is looked for.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) image: &'a YuyvImage,
    pub(super) matrix: &'a CameraMatrix,
    pub(super) field: &'a FieldMask<'a>,
    /// In m.
    pub(super) ball_radius: f32,
    pub(super) noise: &'a ProjectionNoise,
}

impl View<'_> {
    /// Whether the nearest pixel shows the field; `None` outside of the image.
    pub(super) fn is_field(&self, point: Point2<f32>) -> Option<bool> {
        let (x, y) = nearest_pixel(point)?;
        self.field.is_field(x, y)
    }

    /// Visits the samples of a disc: where they are from its middle, in px, and whether the pixel shows the field; `None` outside of the image.
    #[inline]
    pub(super) fn visit_disc(
        &self,
        center: Point2<f32>,
        radius: f32,
        mut visit: impl FnMut(Vector2<f32>, Option<bool>),
    ) {
        disc::visit(center, radius, |offset, pixel| {
            visit(offset, pixel.and_then(|(x, y)| self.field.is_field(x, y)));
        });
    }

    /// The luminances of what of a disc is in the image.
    pub(super) fn luminances(&self, center: Point2<f32>, radius: f32) -> Vec<f32> {
        let mut luminances = Vec::new();
        disc::visit(center, radius, |_, pixel| {
            let luminance = pixel.and_then(|(x, y)| self.image.luminance(x, y));
            luminances.extend(luminance.map(f32::from));
        });
        luminances
    }

    /// Radius in px of a ball on the floor whose centre is seen there; `None` above the horizon.
    pub(super) fn expected_radius(&self, center: Point2<f32>) -> Option<f32> {
        let ground = self.matrix.pixel_to_ground(center, self.ball_radius)?;
        let center = nalgebra::Point3::new(ground.x, ground.y, self.ball_radius);
        self.matrix.pixel_radius(center, self.ball_radius)
    }
}
