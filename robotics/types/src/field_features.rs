//! Owns what an image shows of the field: its border, its lines, its centre circle, its corners, its
//! penalty marks.

use framework::{Clear, Reflect, math};
use nalgebra::{Matrix2, Point2, Vector2};
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

/// The centre circle, of which lines are pieces.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct CenterCircle {
    /// Its middle in the ground frame, m.
    pub position: Point2<f32>,
    /// Of that place, in m².
    pub covariance: Matrix2<f32>,
    /// How many pieces of it were seen.
    pub chords: u32,
}

/// Where two lines of the field meet at a right angle.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct LineCorner {
    /// Which of its four arms are lines.
    pub kind: CornerKind,
    /// Where the middles of the lines cross in the image, px.
    pub center: Point2<f32>,
    /// The same in the ground frame, m.
    pub position: Point2<f32>,
    /// Of that place, as of a single point that is seen there, in m².
    pub covariance: Matrix2<f32>,
    /// Which way it opens, of length 1, in the ground frame: an L between its arms, a T along its stem, an X along
    /// any of its arms.
    pub direction: Vector2<f32>,
}

/// Which of the four arms of a corner are lines.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Reflect, Serialize)]
pub enum CornerKind {
    /// Two: both lines end.
    #[default]
    L,
    /// Three: one line ends at the other one.
    T,
    /// All: both lines go on.
    X,
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

impl CenterCircle {
    /// Whether a line may be a piece of it: the middle of the circle of that radius (m) to which it belongs is at
    /// most `tolerance` m off.
    pub fn has_piece(&self, line: &LineSegment, radius: f32, tolerance: f32) -> bool {
        let centers = line.circle_centers(radius);
        centers.is_some_and(|centers| {
            let is_same = |center| nalgebra::distance(center, &self.position) <= tolerance;
            centers.iter().any(is_same)
        })
    }
}

impl LineSegment {
    /// In m.
    pub fn length(&self) -> f32 {
        nalgebra::distance(&self.start, &self.end)
    }

    /// From its start to its end, of length 1; `None` where it has no length.
    pub fn direction(&self) -> Option<Vector2<f32>> {
        (self.end - self.start).try_normalize(f32::EPSILON)
    }

    /// The middles of both circles of this radius (m) of which it may be a piece, in the ground frame, m.
    ///
    /// `None` where the segment has no length, or is longer than the circle.
    pub fn circle_centers(&self, radius: f32) -> Option<[Point2<f32>; 2]> {
        let along = self.direction()?;
        let length = self.length();
        let outward = Vector2::new(-along.y, along.x) * chord_distance(length, radius);
        let middle = nalgebra::center(&self.start, &self.end);
        (length <= 2.0 * radius).then(|| [middle + outward, middle - outward])
    }

    /// In m from the nearest point of the segment.
    pub fn distance_to(&self, point: Point2<f32>) -> f32 {
        let along = self.end - self.start;
        let part = (point - self.start).dot(&along) / along.norm_squared().max(f32::MIN_POSITIVE);
        nalgebra::distance(&(self.start + along * part.clamp(0.0, 1.0)), &point)
    }
}

/// How far from the middle of a circle a line lies that was fitted to an arc with a chord of this length, all in m.
pub fn chord_distance(length: f32, radius: f32) -> f32 {
    // The mean of the arc's distances along the normal.
    let half_angle = math::asin((length / (2.0 * radius)).min(1.0)).max(1e-3);
    radius * math::sin(half_angle) / half_angle
}
