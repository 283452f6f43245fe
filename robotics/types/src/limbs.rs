//! Owns where the robot's own limbs cover an image.

use framework::{Clear, Reflect};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// What the robot's own body covers in an image.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct LimbMask {
    /// The upper edge of each limb from left to right, px; everything below it is the limb.
    pub limbs: Vec<LimbOutline>,
}

/// The upper edge of one limb in an image.
#[derive(Clear, Clone, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct LimbOutline {
    /// Corners from left to right, px.
    pub corners: Vec<Point2<f32>>,
}

impl LimbMask {
    /// The first row in px that a limb covers in this column; `None` where none does.
    pub fn first_row(&self, column: f32) -> Option<f32> {
        let rows = self.limbs.iter().filter_map(|limb| limb.row_at(column));
        rows.reduce(f32::min)
    }

    /// Whether a limb covers this pixel.
    pub fn covers(&self, pixel: Point2<f32>) -> bool {
        self.first_row(pixel.x).is_some_and(|row| pixel.y >= row)
    }
}

impl LimbOutline {
    /// The row in px of the edge in this column; `None` beside the limb.
    pub fn row_at(&self, column: f32) -> Option<f32> {
        let pieces = self.corners.windows(2);
        let rows = pieces.filter_map(|piece| {
            let (left, right) = (piece[0], piece[1]);
            let is_above = left.x <= column && column <= right.x;
            let width = (right.x - left.x).max(f32::MIN_POSITIVE);
            is_above.then(|| left.y + (right.y - left.y) * (column - left.x) / width)
        });
        rows.reduce(f32::min)
    }
}
