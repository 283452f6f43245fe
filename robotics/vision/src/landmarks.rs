//! Owns where a place on the floor lies among border and lines: those are no ball, mark or robot.

use nalgebra::Point2;
use types::camera::CameraMatrix;
use types::field_features::{FieldBorder, LineSegment};

/// Whether a place in the ground frame lies less than `least` m before or beyond the border in its
/// column, px; no place does where no border was found.
pub(crate) fn is_near_border(
    border: &FieldBorder,
    matrix: &CameraMatrix,
    column: f32,
    place: Point2<f32>,
    least: f32,
) -> bool {
    let border = border
        .row_at(column)
        .and_then(|row| matrix.pixel_to_ground(Point2::new(column, row), 0.0));
    border.is_some_and(|border| nalgebra::distance(&border, &place) < least)
}

/// Whether a place in the ground frame lies on one of the lines, which are so wide, m.
pub(crate) fn is_on_line(lines: &[LineSegment], line_width: f32, place: Point2<f32>) -> bool {
    lines
        .iter()
        .any(|line| line.distance_to(place) <= line_width)
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
        let distance = (far - near).norm();
        for (least, is_near) in [(distance - 1e-3, false), (distance + 1e-3, true)] {
            assert_eq!(
                is_near_border(&border, &matrix, column, near, least),
                is_near
            );
        }
        let none = FieldBorder::default();
        assert!(!is_near_border(&none, &matrix, column, near, f32::MAX));
    }

    #[test]
    fn a_place_on_any_line_is_on_a_line() {
        let line = |y: f32| LineSegment {
            start: Point2::new(1.0, y),
            end: Point2::new(2.0, y),
            ..LineSegment::default()
        };
        let lines = [line(0.0), line(1.0)];
        for (x, y, is_on) in [(1.5, 1.04, true), (1.5, 1.06, false), (2.04, 0.0, true)] {
            assert_eq!(is_on_line(&lines, 0.05, Point2::new(x, y)), is_on);
        }
    }
}
