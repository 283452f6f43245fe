//! Says which marking of the field a seen one is, and what that tells about the robot's pose.
//!
//! A seen line becomes two numbers: for a straight marking how far each of its ends is off, for the
//! centre circle how far the chord is off the middle and how far it is shifted along itself.
//! Nearest neighbour with a gate (Bar-Shalom and Li 1995); what two markings explain equally well
//! says that the robot may be here, but not where exactly.

use framework::math;
use nalgebra::{Isometry2, Matrix2, Point2, RowVector3, Unit, Vector2};
use types::field_features::chord_distance;
use types::field_markings::{FieldCorner, FieldLine, FieldMarkings};

use super::LocalizationParameters;
use super::estimate::{Estimate, Innovation};
use super::features::{Corner, Line};
use crate::sight_noise::SightNoise;

/// The field and what is believed of those who look at it.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    pub(super) markings: &'a FieldMarkings,
    pub(super) parameters: &'a LocalizationParameters,
}

/// The marking that something seen most likely is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Match {
    pub(super) innovations: [Innovation; 2],
    /// In standard deviations squared.
    pub(super) deviation: f32,
    /// Whether no other marking explains it nearly as well.
    pub(super) is_clear: bool,
}

impl View<'_> {
    /// Which line of the field this one is, seen from there; `None` where none explains it.
    pub(super) fn line(&self, estimate: &Estimate, seen: &Line) -> Option<Match> {
        let pose = estimate.pose();
        let straight = self.markings.lines().into_iter();
        let straight = straight.filter_map(|line| self.straight(&pose, seen, &line));
        let candidates = straight.chain(self.chord(&pose, seen));
        self.nearest(estimate, candidates)
    }

    /// Which penalty mark this is, seen from there; `None` where it is too far from both.
    pub(super) fn mark(&self, estimate: &Estimate, seen: Point2<f32>) -> Option<Match> {
        self.place(estimate, seen, self.markings.penalty_marks().into_iter())
    }

    /// Whether the centre circle may have its middle there; `None` where it is too far from that of the field.
    pub(super) fn circle(&self, estimate: &Estimate, seen: Point2<f32>) -> Option<Match> {
        self.place(estimate, seen, [Point2::origin()].into_iter())
    }

    /// Which of the field's corners this is, seen from there; `None` where none of its kind opens that way near it.
    pub(super) fn corner(
        &self,
        estimate: &Estimate,
        seen: &Corner,
        known: &[FieldCorner],
    ) -> Option<Match> {
        let direction = estimate.pose().rotation * seen.direction;
        let least = self.parameters.same_opening;
        let same = known
            .iter()
            .filter(|corner| corner.kind == seen.kind && corner.direction.dot(&direction) >= least);
        self.place(estimate, seen.position, same.map(|corner| corner.position))
    }

    /// Which of these places was seen; `None` where it is too far from all.
    fn place(
        &self,
        estimate: &Estimate,
        seen: Point2<f32>,
        places: impl Iterator<Item = Point2<f32>>,
    ) -> Option<Match> {
        let pose = estimate.pose();
        let noise = self.noise(&pose, seen);
        let turned = pose.rotation * seen.coords;
        let candidates = places.map(|place| {
            let residual = place - pose * seen;
            let innovation = |axis: usize, turn: f32| {
                let mut gradient = RowVector3::zeros();
                gradient[axis] = 1.0;
                gradient[2] = turn;
                Innovation {
                    residual: residual[axis],
                    gradient,
                    variance: noise[(axis, axis)],
                }
            };
            [innovation(0, -turned.y), innovation(1, turned.x)]
        });
        self.nearest(estimate, candidates)
    }

    fn nearest(
        &self,
        estimate: &Estimate,
        candidates: impl Iterator<Item = [Innovation; 2]>,
    ) -> Option<Match> {
        let mut best: Option<([Innovation; 2], f32)> = None;
        let mut second = f32::INFINITY;
        for innovations in candidates {
            let Some(deviation) = estimate.deviation(&innovations) else {
                continue;
            };
            match best {
                Some((_, least)) if deviation >= least => second = second.min(deviation),
                _ => {
                    second = best.map_or(second, |(_, least)| least);
                    best = Some((innovations, deviation));
                }
            }
        }
        let (innovations, deviation) = best?;
        (deviation <= math::powi(self.parameters.gate, 2)).then_some(Match {
            innovations,
            deviation,
            is_clear: second - deviation >= math::powi(self.parameters.clear_by, 2),
        })
    }

    /// How far both ends are beside the line; `None` where they lie beyond its ends.
    fn straight(
        &self,
        pose: &Isometry2<f32>,
        seen: &Line,
        line: &FieldLine,
    ) -> Option<[Innovation; 2]> {
        let (across, along) = line.course.axes();
        let innovation = |end: Point2<f32>| {
            let place = pose * end;
            let beyond = (line.from - place[along]).max(place[along] - line.to);
            let turned = pose.rotation * end.coords;
            let mut gradient = RowVector3::zeros();
            gradient[across] = 1.0;
            gradient[2] = [-turned.y, turned.x][across];
            let innovation = Innovation {
                residual: line.at - place[across],
                gradient,
                variance: self.noise(pose, end)[(across, across)],
            };
            (beyond <= self.parameters.end_tolerance).then_some(innovation)
        };
        Some([innovation(seen.start)?, innovation(seen.end)?])
    }

    /// As a piece of the centre circle; `None` where it is too long for one.
    fn chord(&self, pose: &Isometry2<f32>, seen: &Line) -> Option<[Innovation; 2]> {
        let radius = self.markings.circle_radius;
        let length = seen.length();
        if length > self.parameters.longest_chord * radius {
            return None;
        }
        let middle = nalgebra::center(&seen.start, &seen.end);
        let place = (pose * middle).coords;
        let along = Unit::try_new(pose.rotation * (seen.end - seen.start), f32::EPSILON)?;
        let along = along.into_inner();
        let outward = Vector2::new(along.y, -along.x);
        let outward = if outward.dot(&place) < 0.0 {
            -outward
        } else {
            outward
        };
        let distance = chord_distance(length, radius);
        let noise = self.noise(pose, middle);
        let position = pose.translation.vector;
        let turned = |direction: Vector2<f32>| Vector2::new(-direction.y, direction.x);
        let innovation = |direction: Vector2<f32>, expected: f32, more: f32| Innovation {
            residual: expected - direction.dot(&place),
            gradient: RowVector3::new(direction.x, direction.y, turned(direction).dot(&position)),
            variance: direction.dot(&(noise * direction)) + more,
        };
        // Nobody sees where on the circle the chord ends.
        let unsure = math::powi(length / 4.0, 2);
        Some([
            innovation(outward, distance, 0.0),
            innovation(along, 0.0, unsure),
        ])
    }

    /// Covariance of a seen place in the axes of the field.
    fn noise(&self, pose: &Isometry2<f32>, seen: Point2<f32>) -> Matrix2<f32> {
        let noise = SightNoise {
            least: self.parameters.least_noise,
            along: self.parameters.noise_along,
            tilt: self.parameters.noise_by_tilt,
            across: self.parameters.noise_across,
        };
        noise.covariance(pose.rotation * seen.coords)
    }
}
