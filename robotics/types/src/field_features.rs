//! Owns what an image shows of the field: its border, its lines, its penalty marks.

use framework::{Clear, Reflect};
use nalgebra::{Matrix2, Point2};
use serde::{Deserialize, Serialize};

/// Where the field ends in an image: above it nothing belongs to the game.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct FieldBorder {
    /// At most two straight pieces, from left to right; none where no border was found.
    pub lines: Vec<ImageLine>,
}

/// A straight line in an image: `y = at_left + slope * x` in px.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct ImageLine {
    /// Row in px at x = 0.
    pub at_left: f32,
    /// Rows per column.
    pub slope: f32,
}

/// A piece of a white line on the field.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct LineSegment {
    /// One end, in the ground frame, m.
    pub start: Point2<f32>,
    /// The other end, in the ground frame, m.
    pub end: Point2<f32>,
    /// Of the start, as of a single point that is seen there, in m².
    pub start_covariance: Matrix2<f32>,
    /// The same of the other end.
    pub end_covariance: Matrix2<f32>,
}

/// A penalty mark.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct PenaltyMark {
    /// Its middle in the image, px.
    pub center: Point2<f32>,
    /// Its middle in the ground frame, m.
    pub position: Point2<f32>,
    /// Of that place, in m².
    pub covariance: Matrix2<f32>,
}

impl FieldBorder {
    /// The row of the border in this column, px; `None` where no border was found.
    ///
    /// A corner of the field is the lower of its two lines.
    pub fn row_at(&self, column: f32) -> Option<f32> {
        let rows = self.lines.iter().map(|line| line.row_at(column));
        rows.reduce(f32::max)
    }

    /// Whether a pixel lies on the field; everything does where no border was found.
    pub fn is_inside(&self, pixel: Point2<f32>) -> bool {
        self.row_at(pixel.x).is_none_or(|row| pixel.y >= row)
    }
}

impl ImageLine {
    /// The row of the line in this column, px.
    pub fn row_at(&self, column: f32) -> f32 {
        self.at_left + self.slope * column
    }
}

impl LineSegment {
    /// In m.
    pub fn length(&self) -> f32 {
        nalgebra::distance(&self.start, &self.end)
    }

    /// In m from the nearest point of the segment.
    pub fn distance_to(&self, point: Point2<f32>) -> f32 {
        let along = self.end - self.start;
        let part = (point - self.start).dot(&along) / along.norm_squared().max(f32::MIN_POSITIVE);
        nalgebra::distance(&(self.start + along * part.clamp(0.0, 1.0)), &point)
    }
}
