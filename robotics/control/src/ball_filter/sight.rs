//! Says whether an image would have shown a ball that lies where one is believed to.
//!
//! How far from there it may be does not count: one that is elsewhere is not there either.
//!
//! What nobody could have seen says nothing: beyond the image, behind the own limbs, behind somebody else, or so far away
//! that vision misses many.

use nalgebra::{Isometry2, Point2, Vector2};
use types::ball::BallView;
use types::limbs::LimbMask;
use types::obstacles::ObstacleCandidate;

use super::BallFilterParameters;
use super::hypothesis::Hypothesis;
use crate::places::Hypothesis as _;

/// What one image was able to show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'a> {
    /// Where balls were looked for.
    pub(super) view: &'a BallView,
    /// What the robot's own body hides.
    pub(super) limbs: &'a LimbMask,
    /// Who hides what is behind them.
    pub(super) obstacles: &'a [ObstacleCandidate],
    /// From the start frame to the ground frame of the image.
    pub(super) start_to_ground: Isometry2<f32>,
}

impl Sight<'_> {
    /// Whether this ball would have been found, if it lay there.
    pub(super) fn would_show(&self, ball: &Hypothesis, parameters: &BallFilterParameters) -> bool {
        let BallView {
            camera_matrix,
            size,
            least_radius,
            ball_radius,
        } = *self.view;
        let place = self.start_to_ground * ball.position();
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

        is_inside(pixel.coords)
            && radius >= least_radius
            && place.coords.norm() <= parameters.missed_within
            && !self.limbs.covers(pixel + Vector2::new(0.0, margin.y))
            && !self.is_behind_somebody(place, parameters)
    }

    /// Whether somebody stands between the camera and the ball, or right beside it.
    fn is_behind_somebody(&self, ball: Point2<f32>, parameters: &BallFilterParameters) -> bool {
        let camera = self.view.camera_matrix.position().xy();
        let way = ball - camera;
        let hides = |obstacle: &ObstacleCandidate| {
            let along = (obstacle.position - camera).dot(&way) / way.norm_squared();
            let nearest = camera + way * along.clamp(0.0, 1.0);
            nalgebra::distance(&nearest, &obstacle.position) <= parameters.hidden_beside
        };
        self.obstacles.iter().any(hides)
    }
}
