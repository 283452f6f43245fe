//! Finds the straight lines that most of some points agree on.

use framework::math;
use nalgebra::{Matrix2, Point2, SymmetricEigen, Vector2};
use serde::{Deserialize, Serialize};
use types::field_features::LineSegment;

use super::LineDetectionParameters;
use super::points::LinePoint;
use crate::sampler::{self, Sampler};

/// After so many proposals without a line there is none; as many as ten lines may take.
const MOST_FAILED_PROPOSALS: u32 = 20;

/// Heap for what is sorted; empty between cycles.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(super) struct Fit {
    /// Points on a line by their place along it.
    supporters: Vec<(f32, LinePoint)>,
}

/// A line without ends on the ground.
#[derive(Clone, Copy, Debug)]
struct Ray {
    through: Point2<f32>,
    /// A unit vector.
    direction: Vector2<f32>,
}

impl Ray {
    fn distance(&self, point: &LinePoint) -> f32 {
        self.direction.perp(&(point.position - self.through)).abs()
    }

    fn along(&self, point: &LinePoint) -> f32 {
        self.direction.dot(&(point.position - self.through))
    }

    fn at(&self, along: f32) -> Point2<f32> {
        self.through + self.direction * along
    }
}

impl Fit {
    /// Moves points into `lines` until no more lines are found.
    pub(super) fn find(
        &mut self,
        points: &mut Vec<LinePoint>,
        parameters: &LineDetectionParameters,
        lines: &mut Vec<LineSegment>,
    ) {
        let mut sampler = Sampler::new();
        let needed = parameters.least_points.max(2) as usize;
        let mut failed = 0;
        // What turns out to be too short counts as well, so that this ends.
        for _ in 0..parameters.most_lines.saturating_mul(2) {
            if points.len() < needed || lines.len() >= parameters.most_lines as usize {
                break;
            }
            let Some(rough) = propose(points, parameters, &mut sampler) else {
                failed += 1;
                if failed == MOST_FAILED_PROPOSALS {
                    break;
                }
                continue;
            };
            let (group, line) = self.refine(&rough, points, parameters);
            remove(points, &rough, &group, parameters);
            let is_long = |line: &LineSegment| line.length() >= parameters.least_length;
            let enough = self.supporters.len() >= needed;
            lines.extend(line.filter(|line| enough && is_long(line)));
        }
        self.supporters.clear();
    }

    /// The part of the line with the most points, its range along `rough` and its segment.
    fn refine(
        &mut self,
        rough: &Ray,
        points: &[LinePoint],
        parameters: &LineDetectionParameters,
    ) -> (std::ops::RangeInclusive<f32>, Option<LineSegment>) {
        self.supporters.clear();
        let near = points
            .iter()
            .filter(|point| support(rough, point, parameters) > 0.0);
        self.supporters
            .extend(near.map(|point| (rough.along(point), *point)));
        self.supporters
            .sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let is_joined =
            |one: &(f32, _), other: &(f32, _)| other.0 - one.0 <= parameters.largest_gap;
        let (mut start, mut best) = (0, 0..0);
        for group in self.supporters.chunk_by(is_joined) {
            if group.len() > best.len() {
                best = start..start + group.len();
            }
            start += group.len();
        }
        self.supporters.truncate(best.end);
        self.supporters.drain(..best.start);
        let (Some((first, _)), Some((last, _))) = (self.supporters.first(), self.supporters.last())
        else {
            return (0.0..=0.0, None);
        };
        (*first..=*last, segment(&self.supporters))
    }
}

/// The line through two points that has the most support.
fn propose(
    points: &[LinePoint],
    parameters: &LineDetectionParameters,
    sampler: &mut Sampler,
) -> Option<Ray> {
    let rays = sampler::attempts(parameters.attempts).filter_map(|_| {
        let (one, other) = sampler.pair(points.len());
        let (one, other) = (&points[one], &points[other]);
        let direction = (other.position - one.position).try_normalize(parameters.least_apart)?;
        let ray = Ray {
            through: one.position,
            direction,
        };
        let is_on = |point| support(&ray, point, parameters) > 0.0;
        (is_on(one) && is_on(other)).then(|| {
            let support = points.iter().map(|point| support(&ray, point, parameters));
            (support.sum::<f32>(), ray)
        })
    });
    let best = rays.max_by(|(one, _), (other, _)| one.total_cmp(other));
    best.map(|(_, ray)| ray)
}

/// 1 for a point in the middle of the line, 0 for one that does not belong to it.
fn support(ray: &Ray, point: &LinePoint, parameters: &LineDetectionParameters) -> f32 {
    let off = ray.distance(point) / point.tolerance;
    let turned = ray.direction.perp(&point.direction).abs();
    if off < 1.0 && turned <= parameters.direction_tolerance {
        1.0 - off
    } else {
        0.0
    }
}

/// Leaves out what belongs to the line or is too near to it to be another one.
fn remove(
    points: &mut Vec<LinePoint>,
    ray: &Ray,
    group: &std::ops::RangeInclusive<f32>,
    parameters: &LineDetectionParameters,
) {
    points.retain(|point| {
        let turned = ray.direction.perp(&point.direction).abs();
        ray.distance(point) > parameters.taken * point.tolerance
            || turned > parameters.direction_tolerance
            || !group.contains(&ray.along(point))
    });
}

/// Least squares of the distances, near points count more (they are more precise).
fn segment(supporters: &[(f32, LinePoint)]) -> Option<LineSegment> {
    let weighted = || {
        supporters
            .iter()
            .map(|(_, point)| (math::powi(point.tolerance, -2), point))
    };
    let (sum, total) = weighted().fold((Vector2::zeros(), 0.0), |(sum, total), (weight, point)| {
        (sum + point.position.coords * weight, total + weight)
    });
    let middle = Point2::from(sum / total);
    let spread = weighted().fold(Matrix2::zeros(), |spread, (weight, point)| {
        let offset = point.position - middle;
        spread + offset * offset.transpose() * weight
    });
    if !spread.iter().all(|value| value.is_finite()) {
        return None;
    }
    let eigen = SymmetricEigen::new(spread);
    let ray = Ray {
        through: middle,
        direction: eigen.eigenvectors.column(eigen.eigenvalues.imax()).into(),
    };
    let ends = supporters.iter().map(|(_, point)| ray.along(point));
    let start = ends.clone().reduce(f32::min)?;
    let end = ends.reduce(f32::max)?;
    Some(LineSegment {
        start: ray.at(start),
        end: ray.at(end),
        ..LineSegment::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(most_lines: u32) -> LineDetectionParameters {
        LineDetectionParameters {
            attempts: 40,
            least_apart: 0.05,
            direction_tolerance: 0.3,
            taken: 2.0,
            largest_gap: 0.4,
            least_points: 8,
            least_length: 0.3,
            most_lines,
            ..LineDetectionParameters::default()
        }
    }

    /// Points every 0.1 m ahead, with edges that run along `direction`.
    fn points_ahead(direction: Vector2<f32>) -> Vec<LinePoint> {
        let point = |index: u8| LinePoint {
            position: Point2::new(1.0 + 0.1 * f32::from(index), 0.0),
            direction,
            tolerance: 0.02,
            ..LinePoint::default()
        };
        (0..20).map(point).collect()
    }

    fn lines(mut points: Vec<LinePoint>, most_lines: u32) -> Vec<LineSegment> {
        let mut lines = Vec::new();
        Fit::default().find(&mut points, &parameters(most_lines), &mut lines);
        lines
    }

    #[test]
    fn however_many_attempts_are_wanted_the_search_ends() {
        let parameters = LineDetectionParameters {
            attempts: u32::MAX,
            ..parameters(10)
        };
        let (mut points, mut lines) = (points_ahead(Vector2::x()), Vec::new());
        Fit::default().find(&mut points, &parameters, &mut lines);
        assert_eq!(lines.len(), 1);
    }

    #[test]
    fn however_many_lines_there_may_be_the_search_ends() {
        for most_lines in [u32::MAX / 2, u32::MAX] {
            assert_eq!(lines(points_ahead(Vector2::y()), most_lines), []);
            assert_eq!(lines(points_ahead(Vector2::x()), most_lines).len(), 1);
        }
    }
}
