//! Decides of a piece of a column or a row whether it crosses a line, and how that one runs.

use framework::Clear;
use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::FieldBorder;
use types::image::YuyvImage;

use super::LineDetectionParameters;
use crate::landmarks::is_near_border;
use crate::segments::ImageSegments;

/// What is known before anything is looked for.
pub(super) struct View<'a> {
    pub(super) image: &'a YuyvImage,
    pub(super) matrix: &'a CameraMatrix,
    pub(super) border: &'a FieldBorder,
    /// In m.
    pub(super) line_width: f32,
    pub(super) parameters: &'a LineDetectionParameters,
}

/// A place on a line.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub(super) struct LinePoint {
    /// In the image, px.
    pub(super) pixel: Point2<f32>,
    /// In the ground frame, m.
    pub(super) position: Point2<f32>,
    /// Of the edges on the ground, a unit vector.
    pub(super) direction: Vector2<f32>,
    /// How far it may be off its line, m.
    pub(super) tolerance: f32,
}

/// Points on the pieces between two pieces of field in the scanned columns.
pub(super) fn in_columns<'a>(
    view: &'a View<'a>,
    image_segments: &'a ImageSegments,
) -> impl Iterator<Item = LinePoint> + 'a {
    image_segments.enclosed().filter_map(|piece| {
        let at = |row: u32| Point2::new(piece.column as f32, row as f32);
        view.inspect(at(piece.start), at(piece.end - 1), Vector2::y())
    })
}

/// The point on a piece of a row, from its first to its last pixel.
pub(super) fn in_row(view: &View<'_>, start: Point2<f32>, end: Point2<f32>) -> Option<LinePoint> {
    view.inspect(start, end, Vector2::x())
}

impl View<'_> {
    fn inspect(
        &self,
        start: Point2<f32>,
        end: Point2<f32>,
        along: Vector2<f32>,
    ) -> Option<LinePoint> {
        let pixel = nalgebra::center(&start, &end);
        let position = self.ground(pixel)?;
        let distance = position.coords.norm();
        let before_border = self.parameters.before_border;
        let is_at_border =
            is_near_border(self.border, self.matrix, pixel.x, position, before_border);
        if distance > self.parameters.greatest_distance
            || is_at_border
            || !self.border.is_inside(pixel)
        {
            return None;
        }
        let across = self.direction_across(start - along, end + along)?;
        let step = Vector2::new(-across.y, across.x) * 2.0;
        let direction = self.ground(pixel + step)? - self.ground(pixel - step)?;
        let direction = direction.try_normalize(f32::MIN_POSITIVE)?;
        let edges = self.ground(end + along * 0.5)? - self.ground(start - along * 0.5)?;
        let width = direction.perp(&edges).abs();
        let one_pixel = width / ((end - start).dot(&along) + 1.0);
        let tolerance = self.line_width * self.parameters.width_tolerance + one_pixel;
        ((width - self.line_width).abs() <= tolerance).then_some(LinePoint {
            pixel,
            position,
            direction,
            tolerance: self.parameters.tolerance + self.parameters.tolerance_per_metre * distance,
        })
    }

    /// Across the line in the image, if the edges outside of it face each other.
    fn direction_across(&self, before: Point2<f32>, behind: Point2<f32>) -> Option<Vector2<f32>> {
        let least = self.parameters.least_gradient;
        let rising = self.gradient(before)?.try_normalize(least)?;
        let falling = self.gradient(behind)?.try_normalize(least)?;
        let is_facing = rising.dot(&falling) <= -self.parameters.least_opposition
            && rising.dot(&(behind - before)) > 0.0;
        is_facing.then(|| (rising - falling).normalize())
    }

    /// Luminance per px by Sobel's operator, towards the brighter side.
    fn gradient(&self, pixel: Point2<f32>) -> Option<Vector2<f32>> {
        // Negative becomes 0, and without a neighbour on the left or above there is no gradient.
        let column = (pixel.x as u32).checked_sub(1)?;
        let row = (pixel.y as u32).checked_sub(1)?;
        let at = |x: u32, y: u32| self.image.luminance(column + x, row + y).map(f32::from);
        let (left, right) = (
            at(0, 0)? + 2.0 * at(0, 1)? + at(0, 2)?,
            at(2, 0)? + 2.0 * at(2, 1)? + at(2, 2)?,
        );
        let (above, below) = (
            at(0, 0)? + 2.0 * at(1, 0)? + at(2, 0)?,
            at(0, 2)? + 2.0 * at(1, 2)? + at(2, 2)?,
        );
        Some(Vector2::new(right - left, below - above) / 8.0)
    }

    fn ground(&self, pixel: Point2<f32>) -> Option<Point2<f32>> {
        self.matrix.pixel_to_ground(pixel, 0.0)
    }
}
