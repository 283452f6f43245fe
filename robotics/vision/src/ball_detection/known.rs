//! Says what the rest of vision has explained already: no ball is there.

use nalgebra::{Point2, Vector2};
use types::ball::BallCandidate;
use types::field_features::{FieldBorder, LineSegment, PenaltyMark};

use super::view::View;
use crate::segments::Segment;

/// Border, lines and mark of one image.
pub(super) struct Known<'a> {
    pub(super) border: &'a FieldBorder,
    pub(super) lines: &'a [LineSegment],
    /// In m.
    pub(super) line_width: f32,
    pub(super) penalty_mark: Option<&'a PenaltyMark>,
}

impl Known<'_> {
    /// Whether a piece of a column is beyond the border or lies flat on a line from end to end.
    pub(super) fn explains(&self, view: &View<'_>, piece: &Segment) -> bool {
        let at = |row: u32| Point2::new(piece.column as f32, row as f32);
        if !self.border.is_inside(at(piece.end)) {
            return true;
        }
        let is_on_line = |row: u32| {
            let place = view.matrix.pixel_to_ground(at(row), 0.0);
            place.is_some_and(|place| {
                let is_on = |line: &LineSegment| line.distance_to(place) <= self.line_width;
                self.lines.iter().any(is_on)
            })
        };
        is_on_line(piece.start) && is_on_line(piece.end)
    }

    /// Whether a ball touches the ground beyond the border, or is the penalty mark.
    pub(super) fn refuses(&self, ball: &BallCandidate) -> bool {
        let foot = ball.center + Vector2::new(0.0, ball.radius);
        let is_mark =
            |mark: &PenaltyMark| nalgebra::distance(&mark.center, &ball.center) < ball.radius;
        !self.border.is_inside(foot) || self.penalty_mark.is_some_and(is_mark)
    }
}
