//! Owns the field's plan: where its markings lie, in the field frame.
//!
//! The origin is the centre mark, x points to the opponents' goal, y to the left.

use framework::Reflect;
use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};

/// How many straight lines there are on a field.
pub const LINE_COUNT: usize = 17;

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
        let areas = [
            (self.goal_area_length, self.goal_area_width / 2.0),
            (self.penalty_area_length, self.penalty_area_width / 2.0),
        ];
        let [small, large] = areas.map(|(length, half)| {
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

    #[test]
    fn the_plan_looks_the_same_from_both_goals() {
        let markings = FieldMarkings {
            length: 9.0,
            width: 6.0,
            goal_area_length: 0.6,
            goal_area_width: 2.2,
            penalty_area_length: 1.65,
            penalty_area_width: 4.0,
            penalty_mark_distance: 1.3,
            circle_radius: 0.75,
        };
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
