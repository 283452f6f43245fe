//! Owns `Line` and `Corner`: of what was seen that which says where the robot is, small enough to be remembered.

use nalgebra::{Isometry2, Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::field_features::{CornerKind, LineCorner, LineSegment};

/// A piece of a white line, in m; its ends have no order.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Line {
    pub(super) start: Point2<f32>,
    pub(super) end: Point2<f32>,
}

/// Where two lines of the field meet.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Corner {
    pub(super) kind: CornerKind,
    /// In m.
    pub(super) position: Point2<f32>,
    /// Which way it opens, of length 1.
    pub(super) direction: Vector2<f32>,
}

impl Line {
    /// In m.
    pub(super) fn length(&self) -> f32 {
        nalgebra::distance(&self.start, &self.end)
    }

    /// In the frame to which `by` leads.
    pub(super) fn moved(&self, by: &Isometry2<f32>) -> Self {
        Self {
            start: by * self.start,
            end: by * self.end,
        }
    }
}

impl From<&LineSegment> for Line {
    fn from(seen: &LineSegment) -> Self {
        Self {
            start: seen.start,
            end: seen.end,
        }
    }
}

impl Corner {
    /// In the frame to which `by` leads.
    pub(super) fn moved(&self, by: &Isometry2<f32>) -> Self {
        Self {
            position: by * self.position,
            direction: by * self.direction,
            ..*self
        }
    }

    /// Straight lines of the field cross in no X.
    pub(super) fn is_on_field(&self) -> bool {
        self.kind != CornerKind::X
    }
}

impl From<&LineCorner> for Corner {
    fn from(seen: &LineCorner) -> Self {
        Self {
            kind: seen.kind,
            position: seen.position,
            direction: seen.direction,
        }
    }
}
