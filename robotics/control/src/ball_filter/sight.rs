//! Says whether an image would have shown a ball that lies where one is believed to.
//!
//! How far from there it may be does not count: one that is elsewhere is not there either. What nobody could have seen
//! says nothing: beyond the image or the border of the field, behind the own limbs, behind somebody else, or so far away
//! that vision misses many.

use framework::Timestamp;
use nalgebra::{Isometry2, Point2, Vector2};
use types::ball::BallView;
use types::field_features::FieldBorder;
use types::limbs::LimbMask;

use super::BallFilterParameters;
use super::hypothesis::Hypothesis;
use crate::places::Hypothesis as _;

/// What one image was able to show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'a, Hiding> {
    /// When it was exposed.
    pub(super) taken_at: Timestamp,
    /// Where balls were looked for.
    pub(super) view: &'a BallView,
    /// Beyond it none is.
    pub(super) border: &'a FieldBorder,
    /// What the robot's own body hides.
    pub(super) limbs: &'a LimbMask,
    /// Where somebody stands who hides what is behind, in the start frame, m.
    pub(super) hiding: Hiding,
    /// From the ground frame of the image to the start frame.
    pub(super) ground_to_start: Isometry2<f32>,
}

impl<Hiding: Iterator<Item = Point2<f32>> + Clone> Sight<'_, Hiding> {
    /// Whether this ball would have been found, if it lay there.
    pub(super) fn would_show(&self, ball: &Hypothesis, parameters: &BallFilterParameters) -> bool {
        let BallView {
            camera_matrix,
            size,
            least_radius,
            ball_radius,
        } = *self.view;
        let place = self.ground_to_start.inverse() * ball.position();
        let center = place.coords.push(ball_radius).into();
        let Some((pixel, radius)) = camera_matrix
            .ground_to_pixel(center)
            .zip(camera_matrix.pixel_radius(center, ball_radius))
        else {
            return false;
        };
        let edge = camera_matrix.intrinsics.focal * parameters.missed_edge;
        let margin = edge.add_scalar(radius);
        let is_inside = |pixel: Vector2<f32>| pixel >= margin && size - pixel >= margin;
        let is_before_border = self.border.is_inside(pixel - Vector2::new(0.0, edge.y));
        let below = [-margin.x, 0.0, margin.x].map(|x| pixel + Vector2::new(x, margin.y));

        is_inside(pixel.coords)
            && radius >= least_radius
            && place.coords.norm() <= parameters.missed_within
            && is_before_border
            && !below.into_iter().any(|pixel| self.limbs.covers(pixel))
            && !self.is_hidden(ball.position(), parameters)
    }

    /// Whether somebody stands between the camera and the ball, or right beside it.
    fn is_hidden(&self, ball: Point2<f32>, parameters: &BallFilterParameters) -> bool {
        let camera = self.ground_to_start * self.view.camera_matrix.position().xy();
        let way = ball - camera;
        let hides = |somebody: Point2<f32>| {
            let along = (somebody - camera).dot(&way) / way.norm_squared();
            let nearest = camera + way * along.clamp(0.0, 1.0);
            nalgebra::distance(&nearest, &somebody) <= parameters.hidden_beside
        };
        self.hiding.clone().any(hides)
    }
}
