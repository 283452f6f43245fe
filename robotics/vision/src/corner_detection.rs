//! Finds corners, where two lines of the field meet at a right angle.
//!
//! Four arms lead away from where they cross; lines go on along two, three or all of them. An arm on which nobody
//! would see a line decides nothing: then there is no corner.

use framework::pool::Leased;
use framework::{Input, MainOutput, Parameter, Reflect, RequiredInput, Result, context, math};
use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::camera::CameraMatrix;
use types::field_features::{CenterCircle, CornerKind, LineCorner, LineSegment};
use types::image::YuyvImage;
use types::limbs::LimbMask;
use types::projection_noise::ProjectionNoise;

/// What makes a corner.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CornerDetectionParameters {
    /// Shorter lines may be pieces of the centre circle.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_length: f32,
    /// How far the angle between two lines may be off a right one.
    #[reflect(unit = "rad", range = 0.0..)]
    pub angle_tolerance: f32,
    /// How far before the corner a line may end, and how far beside it others lie.
    #[reflect(unit = "m", range = 0.0..)]
    pub gap: f32,
    /// So far from the corner a line goes on that does.
    #[reflect(unit = "m", range = 0.0..)]
    pub arm: f32,
    /// Corners further away from the robot are left out.
    #[reflect(unit = "m", range = 0.0..)]
    pub greatest_distance: f32,
}

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct CornerDetection {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    image: RequiredInput<Option<Leased<YuyvImage>>, "image?">,
    lines: Input<Vec<LineSegment>, "lines">,
    center_circle: Input<Option<CenterCircle>, "center_circle?">,
    limb_mask: Input<LimbMask, "limb_mask">,
    camera_matrix: RequiredInput<Option<CameraMatrix>, "camera_matrix?">,
    radius: Parameter<f32, "field_dimensions.markings.circle_radius">,
    parameters: Parameter<CornerDetectionParameters, "corner_detection">,
    projection_noise: Parameter<ProjectionNoise, "projection_noise">,
    /// Corners of lines with the most points first.
    corners: MainOutput<Vec<LineCorner>>,
}

#[context]
pub struct MainOutputs {}

impl CornerDetection {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// The corners that are seen whole.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let view = View {
            size: Vector2::new(context.image.columns() as f32, context.image.rows() as f32),
            lines: context.lines,
            center_circle: context.center_circle,
            limb_mask: context.limb_mask,
            matrix: context.camera_matrix,
            radius: *context.radius,
            parameters: context.parameters,
            noise: context.projection_noise,
        };
        for (index, one) in view.lines.iter().enumerate() {
            for other in &view.lines[index + 1..] {
                let Some(corner) = view.corner(one, other) else {
                    continue;
                };
                // Pieces of one line meet another one at the same place.
                let is_same = |known: &LineCorner| {
                    nalgebra::distance(&known.position, &corner.position)
                        <= 2.0 * view.parameters.gap
                };
                if !context.corners.iter().any(is_same) {
                    context.corners.push(corner);
                }
            }
        }
        Ok(MainOutputs {})
    }
}

/// What one image shows.
struct View<'a> {
    /// Of the image, px.
    size: Vector2<f32>,
    lines: &'a [LineSegment],
    center_circle: Option<&'a CenterCircle>,
    limb_mask: &'a LimbMask,
    matrix: &'a CameraMatrix,
    radius: f32,
    parameters: &'a CornerDetectionParameters,
    noise: &'a ProjectionNoise,
}

impl View<'_> {
    fn corner(&self, one: &LineSegment, other: &LineSegment) -> Option<LineCorner> {
        let (ahead, aside) = (self.straight(one)?, self.straight(other)?);
        let off = ahead.dot(&aside).abs();
        if off > math::sin(self.parameters.angle_tolerance) {
            return None;
        }
        let along = (other.start - one.start).perp(&aside) / ahead.perp(&aside);
        let position = one.start + ahead * along;
        let is_near = |line: &LineSegment| line.distance_to(position) <= self.parameters.gap;
        let reach = position.coords.norm();
        if !(is_near(one) && is_near(other) && reach <= self.parameters.greatest_distance) {
            return None;
        }
        let mut opening = Vector2::zeros();
        let mut arms = 0;
        for arm in [ahead, -ahead, aside, -aside] {
            if self.goes_on(position, arm)? {
                opening += arm;
                arms += 1;
            }
        }
        let (kind, direction) = match arms {
            // Both on one line: the other one is shorter than an arm.
            2 if opening.norm() > 0.5 => (CornerKind::L, opening.normalize()),
            3 => (CornerKind::T, opening.normalize()),
            4 => (CornerKind::X, ahead),
            _ => return None,
        };
        Some(LineCorner {
            kind,
            center: self
                .matrix
                .ground_to_pixel(position.coords.push(0.0).into())?,
            position,
            direction,
            covariance: self.matrix.ground_covariance(position, 0.0, self.noise)?,
        })
    }

    /// The direction of a line that is no piece of the circle.
    fn straight(&self, line: &LineSegment) -> Option<Vector2<f32>> {
        let tolerance = 2.0 * self.parameters.gap;
        let is_chord = self
            .center_circle
            .is_some_and(|circle| circle.has_piece(line, self.radius, tolerance));
        let is_straight = line.length() >= self.parameters.least_length && !is_chord;
        line.direction().filter(|_| is_straight)
    }

    /// Whether a line leads away from the corner so; `None` where nobody would see one.
    fn goes_on(&self, position: Point2<f32>, arm: Vector2<f32>) -> Option<bool> {
        let end = position + arm * self.parameters.arm;
        let goes_on = self.lines.iter().any(|line| {
            let turned = line.direction().map_or(1.0, |along| along.perp(&arm).abs());
            turned <= math::sin(self.parameters.angle_tolerance)
                && line.distance_to(position) <= self.parameters.gap
                && line.distance_to(end) <= self.parameters.gap
        });
        (goes_on || self.is_seen(end)).then_some(goes_on)
    }

    fn is_seen(&self, place: Point2<f32>) -> bool {
        let pixel = self.matrix.ground_to_pixel(place.coords.push(0.0).into());
        pixel.is_some_and(|pixel| {
            (0.0..self.size.x).contains(&pixel.x)
                && (0.0..self.size.y).contains(&pixel.y)
                && !self.limb_mask.covers(pixel)
        })
    }
}

#[cfg(test)]
mod tests;
