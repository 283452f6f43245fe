//! Paints the nets of the goals: light threads that one can look through.

use nalgebra::{Matrix3, Point3, Vector2, Vector3};

use super::color::Color;
use super::row::{Row, Touch};
use super::{Exposure, HEIGHT, WIDTH};
use crate::field::{CROSSBAR_HEIGHT, GOAL_DEPTH, goal_posts};

/// A back and two sides for each goal.
pub(super) const PANELS: usize = 6;
/// Between two threads, m.
const MESH: f32 = 0.1;
/// Of a thread, m.
const THREAD: f32 = 0.006;
/// Closer to the camera than this, m, a panel is not drawn.
const NEAR: f32 = 0.1;

/// A piece of net: from the origin `size.x` along `right` and `size.y` along `up`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    origin: Point3<f32>,
    right: Vector3<f32>,
    up: Vector3<f32>,
    size: Vector2<f32>,
    /// What the height loses per m to the right.
    slant: f32,
}

/// A panel in the image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Net {
    /// Place on the panel times nearness, and nearness, of column 0 in row 0.
    start: Vector3<f32>,
    per_column: Vector3<f32>,
    per_row: Vector3<f32>,
    size: Vector2<f32>,
    slant: f32,
    focal: f32,
    low: Vector2<f32>,
    high: Vector2<f32>,
}

/// The nets of both goals in the field frame: they hang from the frame and end on the ground behind.
pub(super) fn panels() -> [Panel; PANELS] {
    let posts = goal_posts();
    std::array::from_fn(|index| {
        let goal = index / 3 * 2;
        let outward = Vector3::x() * posts[goal].x.signum();
        let foot = |post: usize| Point3::new(posts[post].x, posts[post].y, 0.0);
        let across = foot(goal + 1) - foot(goal);
        if index % 3 < 2 {
            return Panel {
                origin: foot(goal + index % 3),
                right: outward,
                up: Vector3::z(),
                size: Vector2::new(GOAL_DEPTH, CROSSBAR_HEIGHT),
                slant: CROSSBAR_HEIGHT / GOAL_DEPTH,
            };
        }
        let back = Vector3::z() * CROSSBAR_HEIGHT - outward * GOAL_DEPTH;
        Panel {
            origin: foot(goal) + outward * GOAL_DEPTH,
            right: across.normalize(),
            up: back.normalize(),
            size: Vector2::new(across.norm(), back.norm()),
            slant: 0.0,
        }
    })
}

impl Net {
    /// `None` where the image shows nothing of it.
    pub(super) fn new(exposure: &Exposure, panel: &Panel) -> Option<Self> {
        let field_to_camera = exposure.camera_to_field.inverse();
        let corner = |x: f32, y: f32| {
            field_to_camera
                * (panel.origin + panel.right * (x * panel.size.x) + panel.up * (y * panel.size.y))
        };
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(x, y)| corner(x, y));
        if corners.iter().all(|corner| corner.z < NEAR) {
            return None;
        }
        let mut low = Vector2::zeros();
        let mut high = Vector2::new(WIDTH as f32 - 1.0, HEIGHT as f32 - 1.0);
        if corners.iter().all(|corner| corner.z >= NEAR) {
            let pixels = corners.map(|corner| exposure.intrinsics.project(corner));
            let pixels = || pixels.iter().flatten().map(|pixel| pixel.coords);
            low = low.sup(&pixels().fold(Vector2::repeat(f32::MAX), |low, at| low.inf(&at)));
            high = high.inf(&pixels().fold(Vector2::repeat(f32::MIN), |high, at| high.sup(&at)));
        }
        if low.x > high.x || low.y > high.y {
            return None;
        }
        // ray * depth = right * x + up * y + origin, so that the inverse gives (x, y, 1) / depth.
        let ray_to_panel = Matrix3::from_columns(&[
            field_to_camera.rotation * panel.right,
            field_to_camera.rotation * panel.up,
            (field_to_camera * panel.origin).coords,
        ])
        .try_inverse()?;
        let focal = exposure.intrinsics.focal;
        Some(Self {
            start: ray_to_panel * exposure.ray(0, 0),
            per_column: ray_to_panel.column(0) / focal.x,
            per_row: ray_to_panel.column(1) / focal.y,
            size: panel.size,
            slant: panel.slant,
            focal: focal.mean(),
            low,
            high,
        })
    }

    /// Paints what of it lies in one row.
    pub(super) fn paint(&self, number: usize, row: &mut Row) {
        let y = number as f32;
        if y < self.low.y || y > self.high.y {
            return;
        }
        let start = self.start + self.per_row * y;
        row.span(self.low.x as usize..=self.high.x as usize)
            .veil(Color::NET, |x| {
                let at = start + self.per_column * x;
                let depth = 1.0 / at.z;
                let (right, up) = (at.x * depth, at.y * depth);
                let is_on = at.z > 0.0
                    && right >= 0.0
                    && right <= self.size.x
                    && up >= 0.0
                    && up <= self.size.y - right * self.slant;
                let pixel = depth / self.focal;
                let (one, other) = (thread(right, pixel), thread(up, pixel));
                Touch {
                    part: if is_on {
                        one + other - one * other
                    } else {
                        0.0
                    },
                    light: 1.0,
                    nearness: at.z,
                }
            });
    }
}

/// How much of a pixel of this size, m, the next thread covers.
fn thread(place: f32, pixel: f32) -> f32 {
    let cell = place * (1.0 / MESH);
    let distance = (cell - (cell + 0.5) as i32 as f32).abs() * MESH;
    let overlap = (THREAD + pixel) / 2.0 - distance;
    let most = if THREAD < pixel { THREAD } else { pixel };
    let overlap = if overlap < most { overlap } else { most };
    if overlap > 0.0 { overlap / pixel } else { 0.0 }
}
