//! Projects a cloud of balls into the image and keeps its upper edge.

use std::f32::consts::TAU;

use framework::math;
use nalgebra::{Isometry3, Point2, Vector3};
use types::camera::Intrinsics;
use types::limbs::LimbOutline;

use super::parts::{FOOT_CORNERS, Part};

/// Corners of the polygon that stands for a ball.
const CORNERS: usize = 12;
/// What is nearer to the focal point than this is left out, m: no limb gets there.
const NEAREST: f32 = 0.03;

/// How the torso becomes pixels.
pub(super) struct Projection {
    pub(super) torso_to_camera: Isometry3<f32>,
    pub(super) intrinsics: Intrinsics,
    /// Of the image, px.
    pub(super) width: f32,
    /// Of the image, px.
    pub(super) height: f32,
}

/// The upper edge of the convex hull; `None` where the image shows nothing of it.
pub(super) fn outline(projection: &Projection, part: &Part, margin: f32) -> Option<LimbOutline> {
    let radius = part.radius + margin;
    let mut points = [Point2::origin(); CORNERS * FOOT_CORNERS];
    let mut count = 0;
    for ball in part.balls() {
        let center = projection.torso_to_camera * ball;
        if center.z < NEAREST {
            continue;
        }
        for corner in 0..CORNERS {
            let (sine, cosine) = math::sin_cos(corner as f32 * TAU / CORNERS as f32);
            let rim = center + Vector3::new(cosine, sine, 0.0) * radius;
            if let Some(pixel) = projection.intrinsics.project(rim) {
                points[count] = pixel;
                count += 1;
            }
        }
    }
    let points = &mut points[..count];
    let is_seen = points.iter().any(|point| point.y < projection.height)
        && points.iter().any(|point| point.x >= 0.0)
        && points.iter().any(|point| point.x < projection.width);
    is_seen.then(|| upper_hull(points))
}

/// Andrew's monotone chain (1979), the half that has the smaller rows.
fn upper_hull(points: &mut [Point2<f32>]) -> LimbOutline {
    points.sort_unstable_by(|one, other| one.x.total_cmp(&other.x).then(one.y.total_cmp(&other.y)));
    let mut kept = 0;
    for index in 0..points.len() {
        let point = points[index];
        while kept >= 2 && !is_above(&points[kept - 1], &points[kept - 2], &point) {
            kept -= 1;
        }
        points[kept] = point;
        kept += 1;
    }
    LimbOutline {
        corners: points[..kept].to_vec(),
    }
}

/// Whether `middle` lies above the line between the two others.
fn is_above(middle: &Point2<f32>, left: &Point2<f32>, right: &Point2<f32>) -> bool {
    let (to_middle, to_right) = (middle - left, right - left);
    to_right.x * to_middle.y < to_right.y * to_middle.x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_upper_edge_goes_from_left_to_right_over_the_top() {
        let mut points = [
            Point2::new(3.0, 9.0),
            Point2::new(1.0, 5.0),
            Point2::new(5.0, 6.0),
            Point2::new(3.0, 2.0),
            Point2::new(2.0, 4.5),
        ];
        let outline = upper_hull(&mut points);
        assert_eq!(
            outline.corners,
            [
                Point2::new(1.0, 5.0),
                Point2::new(3.0, 2.0),
                Point2::new(5.0, 6.0)
            ]
        );
        assert_eq!(outline.row_at(2.0), Some(3.5));
    }
}
