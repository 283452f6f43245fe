//! How far something on the floor lies before the border of the field: what is beyond is no part of the game.

use nalgebra::Point2;
use types::camera::CameraMatrix;
use types::field_features::FieldBorder;

/// In m from a place in the ground frame to the border in its column, px; `None` where no border was found there.
pub(crate) fn border_distance(
    border: &FieldBorder,
    matrix: &CameraMatrix,
    column: f32,
    place: Point2<f32>,
) -> Option<f32> {
    let row = border.row_at(column)?;
    let border = matrix.pixel_to_ground(Point2::new(column, row), 0.0)?;
    Some(nalgebra::distance(&border, &place))
}

#[cfg(test)]
mod tests {
    use types::field_features::ImageLine;

    use super::*;
    use crate::painting::camera_matrix;

    #[test]
    fn the_distance_is_that_to_the_border_in_the_same_column() {
        let matrix = camera_matrix(0.3);
        let column = matrix.intrinsics.center.x;
        let ground = |row| matrix.pixel_to_ground(Point2::new(column, row), 0.0);
        let (far, near) = (ground(200.0).unwrap(), ground(300.0).unwrap());
        let border = FieldBorder {
            lines: vec![ImageLine {
                at_left: 200.0,
                slope: 0.0,
            }],
        };
        let distance = border_distance(&border, &matrix, column, near).unwrap();
        assert!((distance - (far - near).norm()).abs() < 1e-4, "{distance}");
        let none = border_distance(&FieldBorder::default(), &matrix, column, near);
        assert_eq!(none, None);
    }
}
