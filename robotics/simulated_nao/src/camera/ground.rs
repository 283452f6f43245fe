//! Paints the plane of the field and what lies behind it, by rays through the pixels.
//!
//! A row is painted in blocks: most of them show plain carpet, which costs one division and one
//! hash a pixel. Blocks near a marking, an edge of the carpet or the ball are painted pixel by
//! pixel, filtered over the footprint of each pixel so that distant lines do not flicker.

use nalgebra::{Point2, Vector2, Vector3};

use super::Exposure;
use super::color::{Color, Grain, to_bits, to_byte};
use crate::field::{self, BALL_RADIUS, Field};

const BLOCK: usize = 16;
/// Rays that fall less than this a metre are taken as the horizon: they hit 200 m away.
const FLATTEST: f32 = -0.003;
/// Edge of the blotches of the carpet.
const BLOTCH: f32 = 0.01;
const BLOTCH_LUMINANCE: f32 = 7.0;
/// Reach of the ball's shadow around its foot.
const SHADOW: f32 = 3.0 * BALL_RADIUS;

/// Paints one row of a YUYV image.
pub(super) fn paint_row(exposure: &Exposure, field: &Field, row: usize, bytes: &mut [u8]) {
    let rays = Rays::new(exposure, row);
    let mut grain = Grain::new(exposure.number, row);
    for (block, bytes) in bytes.chunks_exact_mut(2 * BLOCK).enumerate() {
        let pixels = rays.block(field, block * BLOCK);
        write(&pixels, &mut grain, bytes);
    }
}

/// The rays of one row, in the field frame.
struct Rays {
    origin: Vector3<f32>,
    first: Vector3<f32>,
    /// To the next column.
    right: Vector3<f32>,
    /// To the next row.
    down: Vector3<f32>,
    ball: Option<Point2<f32>>,
}

/// Where a ray meets the ground.
struct Footprint {
    point: Point2<f32>,
    to_right: Vector2<f32>,
    down: Vector2<f32>,
}

impl Rays {
    fn new(exposure: &Exposure, row: usize) -> Self {
        let rotation = exposure.camera_to_field.rotation;
        let focal = exposure.intrinsics.focal;
        Self {
            origin: exposure.camera_to_field.translation.vector,
            first: rotation * exposure.ray(0, row),
            right: rotation * Vector3::new(1.0 / focal.x, 0.0, 0.0),
            down: rotation * Vector3::new(0.0, 1.0 / focal.y, 0.0),
            ball: exposure.ball.map(|ball| ball.xy()),
        }
    }

    fn direction(&self, column: usize) -> Vector3<f32> {
        self.first + self.right * column as f32
    }

    fn block(&self, field: &Field, column: usize) -> [Color; BLOCK] {
        let first = self.direction(column);
        let last = self.direction(column + BLOCK - 1);
        if first.z > FLATTEST && last.z > FLATTEST {
            return std::array::from_fn(|index| background(&self.direction(column + index)));
        }
        if first.z <= FLATTEST && last.z <= FLATTEST && self.is_plain(field, &first, &last) {
            return self.plain(first);
        }
        std::array::from_fn(|index| self.pixel(field, &self.direction(column + index)))
    }

    /// Whether there is nothing but carpet between two rays.
    fn is_plain(&self, field: &Field, first: &Vector3<f32>, last: &Vector3<f32>) -> bool {
        let first = self.footprint(first);
        let last = self.footprint(last);
        let middle = nalgebra::center(&first.point, &last.point);
        let pixel =
            first.to_right.norm() + first.down.norm() + last.to_right.norm() + last.down.norm();
        let reach = nalgebra::distance(&first.point, &last.point) / 2.0 + pixel;
        field::depth_in_carpet(middle) > reach
            && field.distance_to_marking(middle) > reach
            && self
                .ball
                .is_none_or(|ball| nalgebra::distance(&ball, &middle) > reach + SHADOW)
    }

    fn plain(&self, first: Vector3<f32>) -> [Color; BLOCK] {
        let fade = blotch_luminance(&self.footprint(&first));
        let mut luminances = [0.0; BLOCK];
        for (index, luminance) in luminances.iter_mut().enumerate() {
            let index = index as f32;
            let scale = -self.origin.z / (first.z + self.right.z * index);
            let x = self.origin.x + scale * (first.x + self.right.x * index);
            let y = self.origin.y + scale * (first.y + self.right.y * index);
            *luminance = fade * blotch(x, y);
        }
        luminances.map(|luminance| Color::CARPET.brightened(luminance))
    }

    fn footprint(&self, direction: &Vector3<f32>) -> Footprint {
        let scale = -self.origin.z / direction.z;
        let movement =
            |step: &Vector3<f32>| (step.xy() - direction.xy() * (step.z / direction.z)) * scale;
        Footprint {
            point: Point2::from(self.origin.xy() + direction.xy() * scale),
            to_right: movement(&self.right),
            down: movement(&self.down),
        }
    }

    fn pixel(&self, field: &Field, direction: &Vector3<f32>) -> Color {
        if direction.z > FLATTEST {
            return background(direction);
        }
        let footprint = self.footprint(direction);
        let depth = field::depth_in_carpet(footprint.point);
        let size = footprint.to_right.norm() + footprint.down.norm();
        let on_carpet = (depth / size + 0.5).clamp(0.0, 1.0);
        let floor = floor(nalgebra::distance(
            &footprint.point,
            &Point2::from(self.origin.xy()),
        ));
        if on_carpet == 0.0 {
            return floor;
        }
        let white = if field.distance_to_marking(footprint.point) > size {
            0.0
        } else {
            field.whiteness(footprint.point, footprint.to_right, footprint.down)
        };
        let carpet = Color::CARPET.brightened(
            blotch_luminance(&footprint) * blotch(footprint.point.x, footprint.point.y),
        );
        let color = floor.mixed(carpet.mixed(Color::LINE, white), on_carpet);
        color.shaded(self.light(&footprint.point))
    }

    /// What the ball leaves of the light on the carpet around it.
    fn light(&self, point: &Point2<f32>) -> f32 {
        self.ball.map_or(1.0, |ball| {
            let distance = nalgebra::distance_squared(&ball, point);
            if distance > SHADOW * SHADOW {
                return 1.0;
            }
            1.0 - 0.5 * (-distance / (BALL_RADIUS * BALL_RADIUS)).exp()
        })
    }
}

/// A number between -1 and 1 for every blotch.
fn blotch(x: f32, y: f32) -> f32 {
    let (column, row) = (to_bits(x * (1.0 / BLOTCH)), to_bits(y * (1.0 / BLOTCH)));
    let mut hash = column.wrapping_mul(0x9e37_79b1) ^ row.wrapping_mul(0x85eb_ca77);
    hash ^= hash >> 15;
    hash = hash.wrapping_mul(0x2c1b_3c6d);
    (hash >> 16) as i32 as f32 / 32_768.0 - 1.0
}

/// Blotches smaller than a pixel blend.
fn blotch_luminance(footprint: &Footprint) -> f32 {
    let size = footprint.to_right.norm().max(footprint.down.norm());
    BLOTCH_LUMINANCE * (BLOTCH / size).min(1.0)
}

fn floor(distance: f32) -> Color {
    Color::FLOOR.mixed(Color::HORIZON, (distance / 40.0).min(1.0))
}

fn background(direction: &Vector3<f32>) -> Color {
    let slope = direction.z / direction.xy().norm();
    Color::HORIZON.brightened(40.0 * slope.clamp(0.0, 1.0))
}

fn write(pixels: &[Color; BLOCK], grain: &mut Grain, bytes: &mut [u8]) {
    for (pair, bytes) in pixels.chunks_exact(2).zip(bytes.chunks_exact_mut(4)) {
        let noise = grain.next();
        bytes[0] = to_byte(pair[0].luminance + noise[0]);
        bytes[1] = to_byte(128.0 + (pair[0].blue + pair[1].blue + noise[1]) / 2.0);
        bytes[2] = to_byte(pair[1].luminance + noise[2]);
        bytes[3] = to_byte(128.0 + (pair[0].red + pair[1].red + noise[3]) / 2.0);
    }
}
