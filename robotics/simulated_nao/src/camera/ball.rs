//! Paints the ball: a white sphere with twelve black patches, lit from above.

use std::ops::RangeInclusive;

use nalgebra::{Point3, Vector3};

use super::color::Color;
use super::row::{Row, Touch};
use super::{Exposure, HEIGHT, WIDTH};
use crate::field::BALL_RADIUS;

/// Luminance of a patch as a share of the white's.
const BLACK: f32 = 0.17;
/// Cosine of the angle that a patch spans around its centre: 0.33 rad.
const PATCH: f32 = 0.946;
/// Light that reaches even the underside.
const AMBIENT: f32 = 0.55;

/// The ball in the image.
pub(super) struct Ball {
    /// In the optical frame.
    center: Vector3<f32>,
    up: Vector3<f32>,
    patches: [Vector3<f32>; 12],
    /// Angle of a pixel.
    pixel: f32,
    columns: RangeInclusive<usize>,
    rows: RangeInclusive<usize>,
}

impl Ball {
    /// `center` is in the optical frame; `None` where the image shows nothing of it.
    pub(super) fn new(exposure: &Exposure, center: &Point3<f32>) -> Option<Self> {
        let (columns, rows) = bounds(exposure, center)?;
        let turn =
            |vector: Vector3<f32>| exposure.camera_to_field.inverse_transform_vector(&vector);
        Some(Self {
            center: center.coords,
            up: turn(Vector3::z()),
            patches: icosahedron().map(|patch| turn(exposure.ball_turn * patch)),
            pixel: exposure.intrinsics.focal.x.recip(),
            columns,
            rows,
        })
    }

    /// 1/m of its centre.
    pub(super) fn nearness(&self) -> f32 {
        self.center.z.recip()
    }

    /// Paints what of it lies in one row.
    pub(super) fn paint(&self, exposure: &Exposure, number: usize, row: &mut Row) {
        if !self.rows.contains(&number) {
            return;
        }
        let nearness = self.nearness();
        let first = exposure.ray(0, number);
        let right = exposure.intrinsics.focal.x.recip();
        row.span(self.columns.clone()).paint(Color::BALL, |x| {
            let (part, light) = self.look(&Vector3::new(first.x + right * x, first.y, first.z));
            Touch {
                part,
                light,
                nearness,
            }
        });
    }

    /// How much of the pixel the ball covers, and its light there.
    fn look(&self, ray: &Vector3<f32>) -> (f32, f32) {
        let ray = ray.normalize();
        let along = ray.dot(&self.center);
        let miss = (self.center - ray * along).norm();
        let pixel = self.pixel * along;
        let part = ((BALL_RADIUS - miss) / pixel + 0.5).clamp(0.0, 1.0);
        let depth = (BALL_RADIUS * BALL_RADIUS - miss * miss).max(0.0).sqrt();
        let normal = (ray * (along - depth) - self.center).normalize();
        let facing = -normal.dot(&ray);
        let blur = pixel / BALL_RADIUS / facing.max(0.2);
        let light = AMBIENT + (1.0 - AMBIENT) * (normal.dot(&self.up) * 0.6 + 0.6).clamp(0.0, 1.0);
        (
            part,
            light * (1.0 + (BLACK - 1.0) * self.blackness(&normal, blur)),
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
