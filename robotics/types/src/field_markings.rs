//! Owns the field's plan: where its markings lie, in the field frame.
//!
//! The origin is the centre mark, x points to the opponents' goal, y to the left.

use framework::Reflect;
use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};

use crate::field_features::CornerKind;

/// How many straight lines there are on a field.
pub const LINE_COUNT: usize = 17;
/// How many corners they make.
pub const CORNER_COUNT: usize = 22;

/// Measures of the field between the middles of its lines, m.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FieldMarkings {
    /// Between the goal lines.
    #[reflect(unit = "m", range = 0.0..)]
    pub length: f32,
    /// Between the touch lines.
    #[reflect(unit = "m", range = 0.0..)]
    pub width: f32,
    /// How far the goal area reaches into the field.
    #[reflect(unit = "m", range = 0.0..)]
    pub goal_area_length: f32,
    /// Of the goal area along the goal line.
    #[reflect(unit = "m", range = 0.0..)]
    pub goal_area_width: f32,
    /// How far the penalty area reaches into the field.
    #[reflect(unit = "m", range = 0.0..)]
    pub penalty_area_length: f32,
    /// Of the penalty area along the goal line.
    #[reflect(unit = "m", range = 0.0..)]
    pub penalty_area_width: f32,
    /// Of a penalty mark from its goal line.
    #[reflect(unit = "m", range = 0.0..)]
    pub penalty_mark_distance: f32,
    /// Of the centre circle.
    #[reflect(unit = "m", range = 0.0..)]
    pub circle_radius: f32,
}

/// Which way a straight line of the field goes.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Course {
    /// From touch line to touch line: every point of it has the same x.
    Across,
    /// From goal to goal: every point of it has the same y.
    Along,
}

/// A straight line of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldLine {
    /// Which way it goes.
    pub course: Course,
    /// The coordinate that all its points have, m.
    pub at: f32,
    /// Least of the other coordinate, m.
    pub from: f32,
    /// Greatest of the other coordinate, m.
    pub to: f32,
}

/// A corner of straight lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldCorner {
    /// Which of its four arms are lines.
    pub kind: CornerKind,
    /// Where the middles of the lines cross, in the field frame, m.
    pub position: Point2<f32>,
    /// Which way it opens, of length 1: an L between its arms, a T along its stem.
    pub direction: Vector2<f32>,
}

impl FieldMarkings {
    /// Every straight line.
    pub fn lines(&self) -> [FieldLine; LINE_COUNT] {
        let (goal, touch) = (self.length / 2.0, self.width / 2.0);
        let across = |at: f32, reach: f32| FieldLine {
            course: Course::Across,
            at,
            from: -reach,
            to: reach,
        };
        let along = |at, from, to| FieldLine {
            course: Course::Along,
            at,
            from,
            to,
        };
        let [small, large] = self.areas().map(|(length, half)| {
            let front = goal - length;
            [
                across(front, half),
                across(-front, half),
                along(half, front, goal),
                along(-half, front, goal),
                along(half, -goal, -front),
                along(-half, -goal, -front),
            ]
        });
        let whole = [
            across(0.0, touch),
            across(goal, touch),
            across(-goal, touch),
            along(touch, -goal, goal),
            along(-touch, -goal, goal),
        ];
        let mut lines = [whole[0]; LINE_COUNT];
        let all = whole.into_iter().chain(small).chain(large);
        for (place, line) in lines.iter_mut().zip(all) {
            *place = line;
        }
        lines
    }

    /// How far goal area and penalty area reach into the field and to each side, m.
    fn areas(&self) -> [(f32, f32); 2] {
        [
            (self.goal_area_length, self.goal_area_width / 2.0),
            (self.penalty_area_length, self.penalty_area_width / 2.0),
        ]
    }

    /// Every corner of straight lines; none of them is an X.
    pub fn corners(&self) -> [FieldCorner; CORNER_COUNT] {
        let (goal, touch) = (self.length / 2.0, self.width / 2.0);
        let corner = |kind, x, y, direction: Vector2<f32>| FieldCorner {
            kind,
            position: Point2::new(x, y),
            direction: direction.normalize(),
        };
        let quarters = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
        let of_quarters = quarters.into_iter().flat_map(move |(x, y)| {
            let of_areas = self.areas().into_iter().flat_map(move |(length, half)| {
                let front = corner(
                    CornerKind::L,
                    x * (goal - length),
                    y * half,
                    Vector2::new(x, -y),
                );
                [
                    front,
                    corner(CornerKind::T, x * goal, y * half, -Vector2::x() * x),
                ]
            });
            let of_field = corner(CornerKind::L, x * goal, y * touch, Vector2::new(-x, -y));
            of_areas.chain([of_field])
        });
        let middle = [1.0, -1.0].map(|y| corner(CornerKind::T, 0.0, y * touch, -Vector2::y() * y));
        let mut corners = [middle[0]; CORNER_COUNT];
        for (place, corner) in corners.iter_mut().zip(of_quarters.chain(middle)) {
            *place = corner;
        }
        corners
    }

    /// The penalty marks, the one before the opponents' goal first.
    pub fn penalty_marks(&self) -> [Point2<f32>; 2] {
        let x = self.length / 2.0 - self.penalty_mark_distance;
        [Point2::new(x, 0.0), Point2::new(-x, 0.0)]
    }

    /// Whether a place lies on the field or at most `margin` m beside it.
    pub fn is_inside(&self, place: Point2<f32>, margin: f32) -> bool {
        place.x.abs() <= self.length / 2.0 + margin && place.y.abs() <= self.width / 2.0 + margin
    }
}

impl Course {
    /// Of the coordinate that is the same everywhere, and of the other one: 0 for x, 1 for y.
    pub fn axes(self) -> (usize, usize) {
        match self {
            Self::Across => (0, 1),
            Self::Along => (1, 0),
        }
    }

    /// Of length 1, the way it goes.
    pub fn direction(self) -> Vector2<f32> {
        match self {
            Self::Across => Vector2::y(),
            Self::Along => Vector2::x(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn markings() -> FieldMarkings {
        FieldMarkings {
            length: 9.0,
            width: 6.0,
            goal_area_length: 0.6,
            goal_area_width: 2.2,
            penalty_area_length: 1.65,
            penalty_area_width: 4.0,
            penalty_mark_distance: 1.3,
            circle_radius: 0.75,
        }
    }

    /// Whether a line leads away from there so.
    fn has_arm(lines: &[FieldLine], place: Point2<f32>, arm: Vector2<f32>) -> bool {
        let end = place + arm * 0.1;
        lines.iter().any(|line| {
            let (across, along) = line.course.axes();
            let is_on = |place: Point2<f32>| {
                (place[across] - line.at).abs() < 1e-4
                    && (line.from - 1e-4..=line.to + 1e-4).contains(&place[along])
            };
            is_on(place) && is_on(end)
        })
    }

    #[test]
    fn corners_are_where_lines_meet_and_open_as_they_lead_away() {
        let (lines, corners) = (markings().lines(), markings().corners());
        let mut places: Vec<Point2<f32>> = Vec::new();
        let across = lines.iter().filter(|line| line.course == Course::Across);
        for (one, other) in across.flat_map(|one| lines.iter().map(move |other| (one, other))) {
            let place = Point2::new(one.at, other.at);
            let meet = other.course == Course::Along
                && (one.from..=one.to).contains(&place.y)
                && (other.from..=other.to).contains(&place.x);
            if !meet
                || places
                    .iter()
                    .any(|known| nalgebra::distance(known, &place) < 1e-4)
            {
                continue;
            }
            places.push(place);
            let is_here =
                |corner: &&FieldCorner| nalgebra::distance(&corner.position, &place) < 1e-4;
            let corner = corners
                .iter()
                .find(is_here)
                .expect("lines meet in a corner");
            let arms = [Vector2::x(), -Vector2::x(), Vector2::y(), -Vector2::y()];
            let arms = arms.into_iter().filter(|arm| has_arm(&lines, place, *arm));
            let (count, sum) = arms.fold((0, Vector2::zeros()), |(count, sum), arm| {
                (count + 1, sum + arm)
            });
            assert_eq!(
                count,
                if corner.kind == CornerKind::L { 2 } else { 3 },
                "{corner:?}"
            );
            assert!(
                (sum.normalize() - corner.direction).norm() < 1e-4,
                "{corner:?}"
            );
        }
        assert_eq!(places.len(), CORNER_COUNT);
    }

    #[test]
    fn the_plan_looks_the_same_from_both_goals() {
        let markings = markings();
        let lines = markings.lines();
        for line in lines {
            assert!(line.from < line.to, "{line:?}");
            let turned = FieldLine {
                at: 0.0 - line.at,
                from: -line.to,
                to: -line.from,
                ..line
            };
            assert!(lines.contains(&turned), "{line:?}");
        }
        let expected = FieldLine {
            course: Course::Along,
            at: -1.1,
            from: 3.9,
            to: 4.5,
        };
        assert!(lines.contains(&expected), "{lines:?}");
        let [front, back] = markings.penalty_marks();
        assert_eq!((front.x, back.x), (3.2, -3.2));
    }
}
