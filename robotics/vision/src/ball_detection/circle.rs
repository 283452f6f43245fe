//! Finds the circle that most of some points lie on.

use nalgebra::{Matrix3, Point2, Vector3};

/// A circle in an image, px.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    pub(super) center: Point2<f32>,
    pub(super) radius: f32,
}

impl Circle {
    fn distance(&self, point: &Point2<f32>) -> f32 {
        (nalgebra::distance(&self.center, point) - self.radius).abs()
    }

    fn tolerance(&self) -> f32 {
        (self.radius * 0.1).max(1.0)
    }

    /// How many of the points lie on it.
    pub(super) fn support(&self, points: &[Point2<f32>]) -> usize {
        points
            .iter()
            .filter(|point| self.distance(point) <= self.tolerance())
            .count()
    }
}

/// The circle with the most support among those whose radius is acceptable.
///
/// Points come in the order of their angle. Every third of them spans a circle, so that no chance is
/// needed; the best one is then fitted to all points that lie on it.
pub(super) fn find(points: &[Point2<f32>], radii: std::ops::Range<f32>) -> Option<Circle> {
    let third = points.len() / 3;
    let best = (0..third)
        .filter_map(|first| {
            let spanning = [
                points[first],
                points[first + third],
                points[first + 2 * third],
            ];
            fit(spanning.iter())
        })
        .filter(|circle| radii.contains(&circle.radius))
        .max_by_key(|circle| circle.support(points))?;
    let on_it = points
        .iter()
        .filter(|point| best.distance(point) <= best.tolerance());
    fit(on_it).filter(|circle| radii.contains(&circle.radius))
}

/// Least squares of x² + y² = 2 a x + 2 b y + c (Kåsa 1976), relative to the first point.
fn fit<'a>(points: impl Iterator<Item = &'a Point2<f32>> + Clone) -> Option<Circle> {
    let origin = *points.clone().next()?;
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for point in points {
        let point = point - origin;
        let row = point.push(1.0);
        normal += row * row.transpose();
        right += row * point.norm_squared();
    }
    let solution = normal.try_inverse()? * right;
    let center = solution.xy() / 2.0;
    let radius = (solution.z + center.norm_squared()).sqrt();
    radius.is_finite().then(|| Circle {
        center: origin + center,
        radius,
    })
}

#[cfg(test)]
mod tests {
    use framework::math;

    use super::*;

    fn on_circle(angle: f32) -> Point2<f32> {
        Point2::new(
            100.0 + 20.0 * math::cos(angle),
            50.0 + 20.0 * math::sin(angle),
        )
    }

    #[test]
    fn outliers_do_not_move_the_circle() {
        let mut points: Vec<_> = (0..32)
            .map(|index| on_circle(index as f32 * 0.196))
            .collect();
        for index in [3, 4, 5, 20] {
            points[index] = Point2::new(130.0, 50.0 + index as f32);
        }
        let circle = find(&points, 14.0..28.0).unwrap();
        assert!(
            (circle.center - Point2::new(100.0, 50.0)).norm() < 0.1,
            "{circle:?}"
        );
        assert!((circle.radius - 20.0).abs() < 0.1);
        assert_eq!(circle.support(&points), 28);
    }

    #[test]
    fn a_line_is_no_circle() {
        let points: Vec<_> = (0..32)
            .map(|index| Point2::new(index as f32, 5.0))
            .collect();
        assert!(find(&points, 5.0..20.0).is_none());
    }
}
