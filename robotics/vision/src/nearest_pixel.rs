//! Owns which pixel a place in the image lies in.

use nalgebra::Point2;

/// Column and row; `None` left of or above the image. Right of and below it nobody has that pixel.
pub(crate) fn nearest_pixel(point: Point2<f32>) -> Option<(u32, u32)> {
    let pixel = point.coords.map(f32::round);
    (pixel.x >= 0.0 && pixel.y >= 0.0).then_some((pixel.x as u32, pixel.y as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_rounded_and_has_no_pixel_before_the_first() {
        assert_eq!(nearest_pixel(Point2::new(1.4, 2.6)), Some((1, 3)));
        assert_eq!(nearest_pixel(Point2::new(-0.4, 0.0)), Some((0, 0)));
        for outside in [[-0.6, 1.0], [1.0, -0.6], [f32::NAN, 1.0]] {
            assert_eq!(nearest_pixel(Point2::from(outside)), None);
        }
    }
}
