//! What the background looks like: the floor and the walls of a hall, nowhere in the green of a field.

use nalgebra::{Point2, Vector2, Vector3};

use super::color::Color;

/// Half the size of the hall.
const SIZE: Vector2<f32> = Vector2::new(11.0, 8.0);
/// Boards of this height and width stand before the walls.
const BOARD: Vector2<f32> = Vector2::new(2.4, 0.9);
/// How much the boards differ in luminance.
const BOARD_LUMINANCE: f32 = 22.0;
/// What the walls gain in luminance per m of height, until they are this high.
const LIGHT: f32 = 9.0;
const HEIGHT: f32 = 6.0;

/// Whether a point of the floor lies in the hall.
pub(super) fn contains(point: Point2<f32>) -> bool {
    point.x.abs() < SIZE.x && point.y.abs() < SIZE.y
}

/// The floor at some distance.
pub(super) fn floor(distance: f32) -> Color {
    Color::FLOOR.mixed(Color::WALL, (distance / 40.0).min(0.6))
}

/// The wall that a ray from the origin meets.
pub(super) fn wall(origin: &Vector3<f32>, direction: &Vector3<f32>) -> Color {
    let by_x = (SIZE.x.copysign(direction.x) - origin.x) / direction.x;
    let by_y = (SIZE.y.copysign(direction.y) - origin.y) / direction.y;
    let (reach, along) = if by_x < by_y {
        (by_x, origin.y + by_x * direction.y)
    } else {
        (by_y, origin.x + by_y * direction.x)
    };
    let height = origin.z + reach * direction.z;
    if height < BOARD.y {
        let board = ((along + 100.0 * BOARD.x) * (1.0 / BOARD.x)) as i32;
        return Color::BOARD.brightened(BOARD_LUMINANCE * shade(board));
    }
    Color::WALL.brightened(LIGHT * height.min(HEIGHT))
}

/// A number between -1 and 1 for every board.
fn shade(board: i32) -> f32 {
    let hash = (board as u32).wrapping_mul(0x9e37_79b1);
    (hash >> 16) as f32 / 32_768.0 - 1.0
}
