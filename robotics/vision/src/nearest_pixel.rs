//! Owns which pixel a place in the image lies in.

use nalgebra::Point2;

/// Column and row; `None` left of or above the image. Right of and below it nobody has that pixel.
///
/// Asked some hundred thousand times for an image: without a call, as `f32::round` is one where the processor need not have SSE4.1.
#[inline]
pub(crate) fn nearest_pixel(point: Point2<f32>) -> Option<(u32, u32)> {
    nearest(point.x).zip(nearest(point.y))
}

/// Column or row; `None` before the first.
#[inline]
pub(crate) fn nearest(place: f32) -> Option<u32> {
    (place > -0.5).then_some((place + 0.5) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_rounded_and_has_no_pixel_before_the_first() {
        assert_eq!(nearest_pixel(Point2::new(1.4, 2.6)), Some((1, 3)));
        assert_eq!(nearest_pixel(Point2::new(-0.4, 0.0)), Some((0, 0)));
        assert_eq!(nearest_pixel(Point2::new(0.5, 639.49)), Some((1, 639)));
        for outside in [[-0.5, 1.0], [-0.6, 1.0], [1.0, -0.6], [f32::NAN, 1.0]] {
            assert_eq!(nearest_pixel(Point2::from(outside)), None);
        }
    }
}
