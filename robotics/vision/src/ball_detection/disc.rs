//! Samples that cover a disc evenly.

use nalgebra::{Point2, Vector2};

use crate::nearest_pixel::nearest;

/// Samples from the middle to the rim.
const HALF: usize = 6;
/// How many of them a row has to either side, for each of its distances from the middle.
const WIDTHS: [usize; HALF + 1] = [6, 5, 5, 5, 4, 3, 0];

/// Visits 113 samples row by row: where they are from the middle, in px, and the pixel in which they lie, unless it is before the first.
///
/// Columns and rows are rounded once each, not for every sample: some hundred discs are looked at in an image.
#[inline]
pub(super) fn visit(
    center: Point2<f32>,
    radius: f32,
    mut visit: impl FnMut(Vector2<f32>, Option<(u32, u32)>),
) {
    let scale = radius / HALF as f32;
    let offset = |index: usize| (index as f32 - HALF as f32) * scale;
    let along = |middle: f32| -> [(f32, Option<u32>); 2 * HALF + 1] {
        std::array::from_fn(|index| (offset(index), nearest(middle + offset(index))))
    };
    let (columns, rows) = (along(center.x), along(center.y));
    for (index, (y, row)) in rows.into_iter().enumerate() {
        let width = WIDTHS[index.abs_diff(HALF)];
        for &(x, column) in &columns[HALF - width..=HALF + width] {
            visit(Vector2::new(x, y), column.zip(row));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nearest_pixel::nearest_pixel;

    #[test]
    fn it_is_covered_row_by_row_to_its_rim_and_not_beyond() {
        let center = Point2::new(4.3, 100.7);
        let mut samples = Vec::new();
        visit(center, 9.0, |offset, pixel| samples.push((offset, pixel)));
        assert_eq!(samples.len(), 113);
        assert!(samples.iter().all(|(offset, _)| offset.norm() < 9.01));
        assert!(samples.is_sorted_by_key(|(offset, _)| (offset.y, offset.x)));
        let sum: Vector2<f32> = samples.iter().map(|(offset, _)| offset).sum();
        assert!(sum.norm() < 1e-3, "{sum}");
        for (offset, pixel) in &samples {
            assert_eq!(*pixel, nearest_pixel(center + offset));
        }
        assert!(samples.iter().any(|(_, pixel)| pixel.is_none()));
    }
}
