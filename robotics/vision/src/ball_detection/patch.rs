//! Cuts out of an image what the network looks at: a square around a circle, in shades of grey.

use framework::math;
use nalgebra::Vector2;
use types::image::YuyvImage;

use super::circle::Circle;

/// Pixels along each side.
pub const SIDE: usize = 16;
/// Half of a side in radii of the circle.
const REACH: f32 = 1.5;
/// What differs less than this is as flat as carpet, luminances of 255.
const LEAST_DEVIATION: f32 = 6.0;

/// Luminances, row by row.
pub type Patch = [u8; SIDE * SIDE];

/// What is seen around a circle; beyond the image as at its edge.
pub(super) fn cut(image: &YuyvImage, circle: &Circle) -> Patch {
    let step = 2.0 * REACH * circle.radius / SIDE as f32;
    let corner = circle.center.coords - Vector2::repeat(REACH * circle.radius);
    std::array::from_fn(|index| {
        let cell = Vector2::new((index % SIDE) as f32, (index / SIDE) as f32);
        // The mean of four places, since a cell of a near ball has many pixels.
        let sum = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)].map(|(x, y)| {
            let place = corner + (cell + Vector2::new(x, y)) * step;
            u16::from(luminance(image, place))
        });
        (sum.iter().sum::<u16>() / 4) as u8
    })
}

/// With mean 0 and deviation 1, so that light and contrast do not matter.
pub fn normalized(patch: &Patch) -> [f32; SIDE * SIDE] {
    let values = patch.map(f32::from);
    let count = values.len() as f32;
    let mean = values.iter().sum::<f32>() / count;
    let variance = values
        .iter()
        .map(|value| math::powi(value - mean, 2))
        .sum::<f32>()
        / count;
    let scale = variance.sqrt().max(LEAST_DEVIATION).recip();
    values.map(|value| (value - mean) * scale)
}

fn luminance(image: &YuyvImage, place: Vector2<f32>) -> u8 {
    // `as` saturates at 0.
    let column = (place.x.round() as u32).min(image.columns().saturating_sub(1));
    let row = (place.y.round() as u32).min(image.rows().saturating_sub(1));
    image.luminance(column, row).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use nalgebra::Point2;

    use super::*;

    /// Columns get brighter by one each.
    fn ramp() -> YuyvImage {
        let mut image = YuyvImage::new(200, 100);
        for (index, luminance) in image.data.iter_mut().step_by(2).enumerate() {
            *luminance = (index % 200) as u8;
        }
        image
    }

    #[test]
    fn the_circle_is_in_the_middle_and_edges_go_on() {
        let circle = Circle {
            center: Point2::new(100.0, 50.0),
            radius: 16.0,
        };
        let patch = cut(&ramp(), &circle);
        let row = &patch[8 * SIDE..9 * SIDE];
        assert!(
            row.is_sorted() && row[0].abs_diff(77) <= 2 && row[15].abs_diff(122) <= 2,
            "{row:?}"
        );
        let outside = Circle {
            center: Point2::new(-40.0, 50.0),
            radius: 16.0,
        };
        assert_eq!(cut(&ramp(), &outside), [0; SIDE * SIDE]);
        assert_eq!(cut(&YuyvImage::default(), &circle), [0; SIDE * SIDE]);
    }

    #[test]
    fn neither_light_nor_contrast_matters() {
        let patch: Patch = std::array::from_fn(|index| (index % SIDE * 10) as u8);
        let bright = patch.map(|value| value / 2 + 100);
        for (one, other) in normalized(&patch).into_iter().zip(normalized(&bright)) {
            assert!((one - other).abs() < 0.02, "{one} {other}");
        }
        assert_eq!(normalized(&[90; SIDE * SIDE]), [0.0; SIDE * SIDE]);
    }
}
