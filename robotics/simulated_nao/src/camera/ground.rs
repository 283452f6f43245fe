//! Paints the plane of the field and what lies behind it, by rays through the pixels.
//!
//! A row is painted in blocks: most of them show plain carpet, which costs one division and one
//! hash a pixel. In others those pixels that are near a marking, an edge of the carpet or the ball
//! are filtered over their footprint, so that distant lines do not flicker.

use framework::math;
use nalgebra::{Point2, Vector2, Vector3};

use super::color::{Color, to_bits};
use super::row::Row;
use super::{Exposure, WIDTH, hall};
use crate::field::{self, BALL_RADIUS, Field};

const BLOCK: usize = 16;
/// Rays that fall less than this a metre are taken as the horizon: they hit 200 m away.
const FLATTEST: f32 = -0.003;
/// Edge of the blotches of the carpet.
const BLOTCH: f32 = 0.01;
const BLOTCH_LUMINANCE: f32 = 7.0;
/// Reach of the ball's shadow around its foot.
const SHADOW: f32 = 3.0 * BALL_RADIUS;

/// Paints one row over whatever was there.
pub(super) fn paint(exposure: &Exposure, field: &Field, number: usize, row: &mut Row) {
    row.nearness.fill(0.0);
    let rays = Rays::new(exposure, number);
    for block in (0..WIDTH).step_by(BLOCK) {
        rays.paint(field, block, row);
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
    carpet: Color,
}

/// Where a ray meets the ground.
struct Footprint {
    point: Point2<f32>,
    to_right: Vector2<f32>,
    down: Vector2<f32>,
}

/// What the pixels of a block have in common.
struct Block {
    /// What is left of the carpet's blotches.
    blotches: f32,
    /// Of a footprint, m.
    size: f32,
    /// The ball, if its shadow can be here.
    ball: Option<Point2<f32>>,
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
            carpet: Color::from_rgb(exposure.images.carpet),
        }
    }

    fn direction(&self, column: usize) -> Vector3<f32> {
        self.first + self.right * column as u32 as i32 as f32
    }

    /// Paints the pixels of a block that begins in this column.
    fn paint(&self, field: &Field, column: usize, row: &mut Row) {
        let first = self.direction(column);
        let last = self.direction(column + BLOCK - 1);
        if first.z > FLATTEST && last.z > FLATTEST {
            for column in column..column + BLOCK {
                row.set(column, hall::wall(&self.origin, &self.direction(column)));
            }
            return;
        }
        if first.z > FLATTEST || last.z > FLATTEST {
            for column in column..column + BLOCK {
                let direction = self.direction(column);
                let color = if direction.z > FLATTEST {
                    hall::wall(&self.origin, &direction)
                } else {
                    let footprint = self.footprint(&direction);
                    self.pixel(field, &direction, &Block::new(&footprint, self.ball))
                };
                row.set(column, color);
            }
            return;
        }
        let ends = [self.footprint(&first), self.footprint(&last)];
        let middle = nalgebra::center(&ends[0].point, &ends[1].point);
        let pixel = ends[0].size() + ends[1].size();
        let reach = nalgebra::distance(&ends[0].point, &ends[1].point) / 2.0 + pixel;
        let is_near = |ball: &Point2<f32>| nalgebra::distance(ball, &middle) <= reach + SHADOW;
        let ball = self.ball.filter(is_near);
        let block = Block::new(&ends[0], ball);
        let is_plain = ball.is_none()
            && field::depth_in_carpet(middle) > reach
            && field.distance_to_marking(middle) > reach;
        if is_plain {
            self.paint_carpet(first, &block, column, row);
            return;
        }
        self.paint_details(field, &block, column, row);
    }

    /// Carpet with whatever lies on it, and what lies behind it.
    fn paint_details(&self, field: &Field, block: &Block, column: usize, row: &mut Row) {
        // What every pixel needs is vectorised, and most need no more.
        let mut points = [Point2::origin(); BLOCK];
        let mut carpet = [0.0; BLOCK];
        let mut on_carpet = [0.0; BLOCK];
        for index in 0..BLOCK {
            let point = self.meet(&self.direction(column + index));
            points[index] = point;
            carpet[index] = self.carpet.luminance + block.blotches * blotch(point.x, point.y);
            on_carpet[index] = block.on_carpet(point);
        }
        for index in 0..BLOCK {
            let (column, point) = (column + index, points[index]);
            let is_plain = block.ball.is_none()
                && on_carpet[index] >= 1.0
                && field.distance_to_marking(point) > block.size;
            let color = match is_plain {
                true => Color {
                    luminance: carpet[index],
                    ..self.carpet
                },
                false => self.pixel(field, &self.direction(column), block),
            };
            row.set(column, color);
        }
    }

    /// Nothing but carpet.
    fn paint_carpet(&self, first: Vector3<f32>, block: &Block, column: usize, row: &mut Row) {
        let columns = column..column + BLOCK;
        let luminances = &mut row.luminance[columns.clone()];
        for (index, luminance) in luminances.iter_mut().enumerate() {
            let index = index as u32 as i32 as f32;
            let scale = -self.origin.z / (first.z + self.right.z * index);
            let x = self.origin.x + scale * (first.x + self.right.x * index);
            let y = self.origin.y + scale * (first.y + self.right.y * index);
            *luminance = self.carpet.luminance + block.blotches * blotch(x, y);
        }
        row.blue[columns.clone()].fill(self.carpet.blue);
        row.red[columns].fill(self.carpet.red);
    }

    /// Where a ray that falls meets the ground.
    #[inline(always)]
    fn meet(&self, direction: &Vector3<f32>) -> Point2<f32> {
        let scale = -self.origin.z / direction.z;
        Point2::from(self.origin.xy() + direction.xy() * scale)
    }

    fn footprint(&self, direction: &Vector3<f32>) -> Footprint {
        let scale = -self.origin.z / direction.z;
        let movement =
            |step: &Vector3<f32>| (step.xy() - direction.xy() * (step.z / direction.z)) * scale;
        Footprint {
            point: self.meet(direction),
            to_right: movement(&self.right),
            down: movement(&self.down),
        }
    }

    fn pixel(&self, field: &Field, direction: &Vector3<f32>, block: &Block) -> Color {
        let point = self.meet(direction);
        let on_carpet = block.on_carpet(point);
        let mut color = self.carpet;
        if on_carpet > 0.0 {
            color = color.brightened(block.blotches * blotch(point.x, point.y));
            if field.distance_to_marking(point) <= block.size {
                let Footprint { to_right, down, .. } = self.footprint(direction);
                color = color.mixed(Color::LINE, field.whiteness(point, to_right, down));
            }
        }
        if on_carpet < 1.0 {
            let behind = if hall::contains(point) {
                hall::floor(nalgebra::distance(&point, &self.origin.xy().into()))
            } else {
                hall::wall(&self.origin, direction)
            };
            color = behind.mixed(color, on_carpet);
        }
        match block.ball {
            Some(ball) => color.shaded(light(&ball, &point)),
            None => color,
        }
    }
}

impl Footprint {
    fn size(&self) -> f32 {
        self.to_right.norm() + self.down.norm()
    }
}

impl Block {
    fn new(footprint: &Footprint, ball: Option<Point2<f32>>) -> Self {
        // Blotches smaller than a pixel blend.
        let pixel = footprint.to_right.norm().max(footprint.down.norm());
        Self {
            blotches: BLOTCH_LUMINANCE * (BLOTCH / pixel).min(1.0),
            size: footprint.size(),
            ball,
        }
    }

    /// How much of a pixel around this point shows the carpet.
    #[inline(always)]
    fn on_carpet(&self, point: Point2<f32>) -> f32 {
        (field::depth_in_carpet(point) / self.size + 0.5).clamp(0.0, 1.0)
    }
}

/// What the ball leaves of the light on the carpet around it.
fn light(ball: &Point2<f32>, point: &Point2<f32>) -> f32 {
    let distance = nalgebra::distance_squared(ball, point);
    if distance > SHADOW * SHADOW {
        return 1.0;
    }
    1.0 - 0.5 * math::exp(-distance / (BALL_RADIUS * BALL_RADIUS))
}

/// A number between -1 and 1 for every blotch.
fn blotch(x: f32, y: f32) -> f32 {
    let (column, row) = (to_bits(x * (1.0 / BLOTCH)), to_bits(y * (1.0 / BLOTCH)));
    let mut hash = column.wrapping_mul(0x9e37_79b1) ^ row.wrapping_mul(0x85eb_ca77);
    hash ^= hash >> 15;
    hash = hash.wrapping_mul(0x2c1b_3c6d);
    (hash >> 16) as i32 as f32 / 32_768.0 - 1.0
}
