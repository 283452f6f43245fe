//! Paints the ball: a white sphere with twelve black patches, lit from above.

use std::ops::RangeInclusive;

use nalgebra::{Point3, Vector3};

use super::color::to_byte;
use super::{BYTES_PER_PIXEL, Exposure, HEIGHT, WIDTH};
use crate::field::BALL_RADIUS;

const WHITE: f32 = 225.0;
const BLACK: f32 = 38.0;
/// Cosine of the angle that a patch spans around its centre: 0.33 rad.
const PATCH: f32 = 0.946;
/// Light that reaches even the underside.
const AMBIENT: f32 = 0.55;

/// Paints the ball over the image; `center` is in the optical frame.
pub(super) fn paint(exposure: &Exposure, center: &Point3<f32>, image: &mut [u8]) {
    let Some((columns, rows)) = bounds(exposure, center) else {
        return;
    };
    let up = exposure
        .camera_to_field
        .inverse_transform_vector(&Vector3::z());
    let patches =
        icosahedron().map(|patch| exposure.camera_to_field.inverse_transform_vector(&patch));
    let ball = Ball {
        center: center.coords,
        up,
        patches,
        pixel: exposure.intrinsics.focal.x.recip(),
    };
    for row in rows {
        // Pairs of pixels share their chromaticity.
        for pair in columns.start() / 2..=columns.end() / 2 {
            let offset = (row * WIDTH + 2 * pair) * BYTES_PER_PIXEL;
            let bytes = &mut image[offset..offset + 2 * BYTES_PER_PIXEL];
            let covered = [0, 1].map(|side| {
                let (covered, luminance) = ball.look(&exposure.ray(2 * pair + side, row));
                mix(&mut bytes[2 * side], luminance, covered);
                covered
            });
            let covered = (covered[0] + covered[1]) / 2.0;
            mix(&mut bytes[1], 128.0, covered);
            mix(&mut bytes[3], 128.0, covered);
        }
    }
}

struct Ball {
    center: Vector3<f32>,
    up: Vector3<f32>,
    patches: [Vector3<f32>; 12],
    /// Angle of a pixel.
    pixel: f32,
}

impl Ball {
    /// How much of the pixel the ball covers, and its luminance there.
    fn look(&self, ray: &Vector3<f32>) -> (f32, f32) {
        let ray = ray.normalize();
        let along = ray.dot(&self.center);
        let miss = (self.center - ray * along).norm();
        let pixel = self.pixel * along;
        let covered = ((BALL_RADIUS - miss) / pixel + 0.5).clamp(0.0, 1.0);
        let depth = (BALL_RADIUS * BALL_RADIUS - miss * miss).max(0.0).sqrt();
        let normal = (ray * (along - depth) - self.center).normalize();
        let facing = -normal.dot(&ray);
        let blur = pixel / BALL_RADIUS / facing.max(0.2);
        let light = AMBIENT + (1.0 - AMBIENT) * (normal.dot(&self.up) * 0.6 + 0.6).clamp(0.0, 1.0);
        (
            covered,
            light * (WHITE + (BLACK - WHITE) * self.blackness(&normal, blur)),
        )
    }

    fn blackness(&self, normal: &Vector3<f32>, blur: f32) -> f32 {
        let nearest = self
            .patches
            .iter()
            .map(|patch| patch.dot(normal))
            .fold(-1.0, f32::max);
        // The derivative of the cosine at the rim of a patch is the sine of its angle: 0.32.
        ((nearest - PATCH) / (0.32 * blur) + 0.5).clamp(0.0, 1.0)
    }
}

fn mix(byte: &mut u8, value: f32, part: f32) {
    *byte = to_byte(f32::from(*byte) * (1.0 - part) + value * part);
}

/// Columns and rows that the ball can touch; none if it is behind the camera or beside the image.
fn bounds(
    exposure: &Exposure,
    center: &Point3<f32>,
) -> Option<(RangeInclusive<usize>, RangeInclusive<usize>)> {
    if center.z < 2.0 * BALL_RADIUS {
        return None;
    }
    let middle = exposure.intrinsics.project(*center)?;
    // A sphere beside the optical axis appears as an ellipse; half as much again holds all of it.
    let reach = 1.5 * exposure.intrinsics.focal * BALL_RADIUS / (center.z - BALL_RADIUS);
    let range = |middle: f32, reach: f32, size: usize| {
        let low = (middle - reach).max(0.0);
        let high = (middle + reach).min(size as f32 - 1.0);
        (low <= high).then_some(low as usize..=high as usize)
    };
    Some((
        range(middle.x, reach.x, WIDTH)?,
        range(middle.y, reach.y, HEIGHT)?,
    ))
}

/// Unit vectors to the corners of an icosahedron, turned so that none points straight up.
fn icosahedron() -> [Vector3<f32>; 12] {
    let golden = f32::midpoint(1.0, 5.0_f32.sqrt());
    std::array::from_fn(|index| {
        let one = if index & 1 == 0 { 1.0 } else { -1.0 };
        let long = if index & 2 == 0 { golden } else { -golden };
        let corner = match index / 4 {
            0 => Vector3::new(0.0, one, long),
            1 => Vector3::new(one, long, 0.0),
            _ => Vector3::new(long, 0.0, one),
        };
        nalgebra::Rotation3::from_euler_angles(0.3, 0.5, 0.2) * corner.normalize()
    })
}
