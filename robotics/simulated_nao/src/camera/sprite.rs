//! Paints capsules: robots, limbs, goal posts. In the image each is two circles and their tangents.

use framework::math;
use nalgebra::{Isometry3, Point2, Point3, Vector2, Vector3};

use super::color::Color;
use super::figure::Capsule;
use super::row::{Row, Touch};
use super::{Exposure, HEIGHT, WIDTH};

/// What is nearer than this along the optical axis, m, is not drawn.
const NEAR: f32 = 0.02;
/// Light that reaches even the underside.
const AMBIENT: f32 = 0.62;

/// A capsule in the image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sprite {
    color: Color,
    /// Of the first circle, px.
    start: Vector2<f32>,
    /// To the second circle, of length 1.
    axis: Vector2<f32>,
    /// Between the circles, px.
    length: f32,
    /// Of the first circle, px.
    radius: f32,
    /// What the radius loses per px along the axis.
    taper: f32,
    /// Shift of the nearest point of the axis per px beside it.
    lean: f32,
    /// 1/m at the start, and its change per px along the axis.
    nearness: [f32; 2],
    /// How much shorter than a circle the ends are.
    flatness: f32,
    /// 1 where the ends are round and lit as such, else 0.
    roundness: f32,
    /// 1/px.
    per_focal: f32,
    /// Light from above by the normal's parts along the axis, beside it and towards the camera.
    light: [f32; 3],
    /// Where the tangents touch the circles, a little outside, px.
    corners: [Vector2<f32>; 4],
    /// The box around it, px.
    low: Vector2<f32>,
    high: Vector2<f32>,
}

/// The frame in which sprites are made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewpoint {
    field_to_camera: Isometry3<f32>,
    focal: f32,
    intrinsics: types::camera::Intrinsics,
    up: Vector3<f32>,
}

impl Viewpoint {
    pub(super) fn new(exposure: &Exposure) -> Self {
        let field_to_camera = exposure.camera_to_field.inverse();
        Self {
            field_to_camera,
            focal: exposure.intrinsics.focal.mean(),
            intrinsics: exposure.intrinsics,
            up: field_to_camera.rotation * Vector3::z(),
        }
    }

    /// How a capsule of the field frame appears; `None` where the image shows nothing of it.
    pub(super) fn sprite(&self, capsule: &Capsule) -> Option<Sprite> {
        let ends = capsule.ends.map(|end| self.field_to_camera * end);
        let (ends, radii) = cut(ends, capsule.radii)?;
        let sizes = [size(&ends[0], radii[0])?, size(&ends[1], radii[1])?];
        let pixel = |end: Point3<f32>| self.intrinsics.project(end).map(|pixel| pixel.coords);
        let (start, end) = (pixel(ends[0])?, pixel(ends[1])?);
        let [first, second] = sizes.map(|size| size * self.focal);
        let low = start.inf(&end).add_scalar(-first.max(second) - 1.0);
        let high = start.sup(&end).add_scalar(first.max(second) + 1.0);
        let is_in_view =
            low.x < WIDTH as f32 && low.y < HEIGHT as f32 && high.x >= 0.0 && high.y >= 0.0;
        if !is_in_view {
            return None;
        }
        let length = (end - start).norm();
        let taper = (first - second) / length;
        let nearness = ends.map(|end| end.z.recip());
        // One circle hides the other.
        let is_round = !(taper.abs() < 0.99 && length > 0.01);
        let (axis, length, taper) = if is_round {
            (Vector2::x(), 0.0, 0.0)
        } else {
            ((end - start) / length, length, taper)
        };
        let per_pixel = if is_round {
            0.0
        } else {
            (nearness[1] - nearness[0]) / length
        };
        let across = beside(axis) * (1.0 - taper * taper).sqrt();
        let corner = |from: Vector2<f32>, radius: f32, side: f32| {
            from + (axis * taper + across * side) * (radius + 1.0)
        };
        let toward = -nalgebra::center(&ends[0], &ends[1]).coords.normalize();
        let flatness = if capsule.is_flat {
            let lengthwise = (ends[1] - ends[0]).normalize();
            toward.dot(&lengthwise).abs().max(0.05).recip()
        } else {
            1.0
        };
        Some(Sprite {
            color: capsule.color,
            start: if is_round && second > first {
                end
            } else {
                start
            },
            axis,
            length,
            radius: if is_round { first.max(second) } else { first },
            taper,
            lean: taper / (1.0 - taper * taper).sqrt(),
            nearness: [nearness[0], per_pixel],
            flatness,
            roundness: if capsule.is_flat { 0.0 } else { 1.0 },
            per_focal: self.focal.recip(),
            light: [
                self.up.xy().dot(&axis),
                self.up.xy().dot(&beside(axis)),
                self.up.dot(&toward),
            ],
            corners: [
                corner(start, first, 1.0),
                corner(end, second, 1.0),
                corner(end, second, -1.0),
                corner(start, first, -1.0),
            ],
            low,
            high,
        })
    }
}

impl Sprite {
    /// 1/m of what is farthest of it.
    pub(super) fn nearness(&self) -> f32 {
        self.nearness[0] + self.nearness[1] * self.length / 2.0
    }

    /// Paints what of it lies in one row.
    pub(super) fn paint(&self, number: usize, row: &mut Row) {
        let y = number as f32;
        let Some((first, last)) = self.columns(y) else {
            return;
        };
        row.span(first..=last)
            .paint(self.color, |x| self.touch(x, y));
    }

    /// 1/m of it in a pixel; `None` where that shows something else.
    pub(super) fn nearness_at(&self, pixel: Point2<f32>) -> Option<f32> {
        let touch = self.touch(pixel.x, pixel.y);
        (touch.part > 0.5).then_some(touch.nearness)
    }

    /// The columns that it can touch in a row.
    fn columns(&self, y: f32) -> Option<(usize, usize)> {
        if y < self.low.y || y > self.high.y {
            return None;
        }
        let (mut low, mut high) = (f32::MAX, f32::MIN);
        let mut reach = |left: f32, right: f32| {
            low = low.min(left);
            high = high.max(right);
        };
        for at in [0.0, self.length] {
            let center = self.start + self.axis * at;
            let radius = self.radius - self.taper * at + 1.0;
            let square = radius * radius - (y - center.y) * (y - center.y);
            if square >= 0.0 {
                let half = square.sqrt();
                reach(center.x - half, center.x + half);
            }
        }
        for (index, start) in self.corners.iter().enumerate() {
            let end = self.corners[(index + 1) % 4];
            if (start.y <= y) != (end.y <= y) {
                let x = start.x + (end.x - start.x) * ((y - start.y) / (end.y - start.y));
                reach(x, x);
            }
        }
        let (low, high) = (low.max(0.0), high.min(WIDTH as f32 - 1.0));
        (low <= high).then_some((low as usize, high as usize))
    }

    #[inline(always)]
    fn touch(&self, x: f32, y: f32) -> Touch {
        let (dx, dy) = (x - self.start.x, y - self.start.y);
        let along = dx * self.axis.x + dy * self.axis.y;
        let across = dy * self.axis.x - dx * self.axis.y;
        let nearest = bounded(along - across.abs() * self.lean, 0.0, self.length);
        let radius = self.radius - self.taper * nearest;
        let ahead = along - nearest;
        let flattened = ahead * self.flatness;
        let distance = (across * across + flattened * flattened).sqrt();
        let ahead = ahead * self.roundness;
        // The normal of the surface: along the axis, beside it, towards the camera.
        let scale = 1.0 / radius;
        let (ahead, across) = (ahead * scale, across * scale);
        let facing = 1.0 - ahead * ahead - across * across;
        let facing = (if facing > 0.0 { facing } else { 0.0 }).sqrt();
        let [by_axis, by_side, by_front] = self.light;
        let from_above = by_axis * ahead + by_side * across + by_front * facing;
        let light = bounded(from_above * 0.6 + 0.5, 0.0, 1.0);
        Touch {
            part: bounded(radius - distance + 0.5, 0.0, 1.0),
            light: AMBIENT + (1.0 - AMBIENT) * light,
            nearness: (self.nearness[0] + self.nearness[1] * nearest)
                * (1.0 + radius * self.per_focal * facing),
        }
    }
}

/// A quarter turn clockwise in the image.
fn beside(axis: Vector2<f32>) -> Vector2<f32> {
    Vector2::new(-axis.y, axis.x)
}

/// As `clamp`, in a way that compilers vectorise.
fn bounded(value: f32, low: f32, high: f32) -> f32 {
    let value = if value > low { value } else { low };
    if value < high { value } else { high }
}

/// Radius of a ball's image on the plane one ahead of the camera; `None` where the camera is inside.
///
/// The image is an ellipse that points to the middle of the image. Far balls get its shorter half axis,
/// near ones what puts the edge that the image can show in the right place.
fn size(center: &Point3<f32>, radius: f32) -> Option<f32> {
    let share = radius / center.coords.norm();
    if share > 0.98 {
        return None;
    }
    let away = math::atan2(center.xy().coords.norm(), center.z);
    let inner = math::tan(away) - math::tan(away - math::asin(share));
    let depth = (center.z * center.z - radius * radius).max(1e-9).sqrt();
    Some(inner.min(radius / depth))
}

/// What of a capsule lies well in front of the camera.
fn cut(ends: [Point3<f32>; 2], radii: [f32; 2]) -> Option<([Point3<f32>; 2], [f32; 2])> {
    let depths = ends.map(|end| end.z - NEAR);
    if depths[0] < 0.0 && depths[1] < 0.0 {
        return None;
    }
    let cut = |index: usize| {
        let other = 1 - index;
        let part = if depths[index] < 0.0 {
            depths[index] / (depths[index] - depths[other])
        } else {
            0.0
        };
        (
            ends[index] + (ends[other] - ends[index]) * part,
            radii[index] + (radii[other] - radii[index]) * part,
        )
    };
    let (start, end) = (cut(0), cut(1));
    Some(([start.0, end.0], [start.1, end.1]))
}
