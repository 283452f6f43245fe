//! The markings of the field and where they lie, in metres of the field frame.
//!
//! The origin is the centre mark, x points to one goal, y to the left of it. Dimensions are those
//! of the RoboCup Standard Platform League rules 2023 to 2025, measured between line centres.

use std::f32::consts::FRAC_1_SQRT_2;

use nalgebra::{Point2, Vector2};

/// Length of the field along x.
pub const LENGTH: f32 = 9.0;
/// Width of the field along y.
pub const WIDTH: f32 = 6.0;
/// Width of every line.
pub const LINE_WIDTH: f32 = 0.05;
/// Distance of the penalty mark from the goal line.
pub const PENALTY_MARK_DISTANCE: f32 = 1.3;
/// Radius of the ball.
pub const BALL_RADIUS: f32 = 0.05;
/// Radius of the posts and of the crossbar of a goal.
pub const GOAL_POST_RADIUS: f32 = 0.05;
/// Height of the middle of the crossbar: 0.8 m are free below it.
pub const CROSSBAR_HEIGHT: f32 = 0.85;
/// How far the net reaches behind the posts.
pub const GOAL_DEPTH: f32 = 0.5;

/// Between the middles of the posts of a goal, which are 1.5 m apart.
pub(crate) const GOAL_WIDTH: f32 = 1.6;

const PENALTY_MARK_SIZE: f32 = 0.1;
/// How far it reaches into the field, and how wide it is.
pub(crate) const GOAL_AREA: Vector2<f32> = Vector2::new(0.6, 2.2);
const PENALTY_AREA: Vector2<f32> = Vector2::new(1.65, 4.0);
/// Of the circle in the middle.
pub(crate) const CIRCLE_RADIUS: f32 = 0.75;
const BORDER: f32 = 0.7;

/// Half the size of the carpet.
pub(crate) const CARPET: Vector2<f32> = Vector2::new(LENGTH / 2.0 + BORDER, WIDTH / 2.0 + BORDER);
/// Edge of a cell of the distance table.
const CELL: f32 = 0.02;

/// A white rectangle in the quadrant of positive x and y; the other three mirror it.
#[derive(Clone, Copy, Debug)]
struct Stripe {
    low: Vector2<f32>,
    high: Vector2<f32>,
}

impl Stripe {
    const fn new(x: [f32; 2], y: [f32; 2]) -> Self {
        Self {
            low: Vector2::new(x[0], y[0]),
            high: Vector2::new(x[1], y[1]),
        }
    }

    fn distance(&self, point: Point2<f32>) -> f32 {
        let outside = (self.low - point.coords).sup(&(point.coords - self.high));
        outside.sup(&Vector2::zeros()).norm()
    }
}

/// How many stripes are looked at together.
const LANES: usize = 4;

/// Some stripes side by side; what is left over is empty.
#[derive(Clone, Copy, Debug)]
struct Stripes {
    low: [[f32; LANES]; 2],
    high: [[f32; LANES]; 2],
}

impl Stripes {
    fn new(stripes: &[Stripe]) -> Self {
        let side = |of: fn(&Stripe) -> f32, empty: f32| {
            std::array::from_fn(|lane| stripes.get(lane).map_or(empty, of))
        };
        Self {
            low: [
                side(|stripe| stripe.low.x, f32::MAX),
                side(|stripe| stripe.low.y, f32::MAX),
            ],
            high: [
                side(|stripe| stripe.high.x, f32::MIN),
                side(|stripe| stripe.high.y, f32::MIN),
            ],
        }
    }

    /// How much of the box of these half extents around the point each of them covers, m².
    #[inline(always)]
    fn overlap(&self, point: Point2<f32>, half: Vector2<f32>) -> [f32; LANES] {
        let inside = |axis: usize, lane: usize| {
            let end = smaller(point[axis] + half[axis], self.high[axis][lane]);
            let start = larger(point[axis] - half[axis], self.low[axis][lane]);
            larger(end - start, 0.0)
        };
        std::array::from_fn(|lane| inside(0, lane) * inside(1, lane))
    }
}

/// As `min` of numbers, in a way that compilers vectorise.
fn smaller(one: f32, other: f32) -> f32 {
    if one < other { one } else { other }
}

/// As `max` of numbers, in a way that compilers vectorise.
fn larger(one: f32, other: f32) -> f32 {
    if one > other { one } else { other }
}

/// Part of `center ± half` that lies between `low` and `high`.
fn overlap(center: f32, half: f32, low: f32, high: f32) -> f32 {
    let inside = (center + half).min(high) - (center - half).max(low);
    (inside / (2.0 * half)).clamp(0.0, 1.0)
}

/// The markings, with a table that says how far the next one is.
#[derive(Debug)]
pub struct Field {
    stripes: Vec<Stripes>,
    distances: Vec<f32>,
    columns: usize,
}

impl Default for Field {
    fn default() -> Self {
        let stripes = stripes();
        let columns = cells(CARPET.x);
        let rows = cells(CARPET.y);
        let distances = (0..rows * columns)
            .map(|index| {
                let cell = Vector2::new((index % columns) as f32, (index / columns) as f32);
                let center = Point2::from((cell + Vector2::repeat(0.5)) * CELL);
                // From anywhere in the cell the marking is at least this far away.
                distance(&stripes, center) - FRAC_1_SQRT_2 * CELL
            })
            .collect();
        Self {
            stripes: stripes.chunks(LANES).map(Stripes::new).collect(),
            distances,
            columns,
        }
    }
}

impl Field {
    /// A lower bound of the distance to the next marking, zero or less near one.
    #[inline]
    pub(crate) fn distance_to_marking(&self, point: Point2<f32>) -> f32 {
        let column = (point.x.abs() / CELL) as usize;
        let row = (point.y.abs() / CELL) as usize;
        if column >= self.columns {
            return 0.0;
        }
        self.distances
            .get(row * self.columns + column)
            .copied()
            .unwrap_or(0.0)
    }

    /// Part of a pixel's footprint that is white: it lies around `point` and is spanned by the
    /// movements of the point to the next column and to the next row of the image.
    pub(crate) fn whiteness(
        &self,
        point: Point2<f32>,
        to_right: Vector2<f32>,
        down: Vector2<f32>,
    ) -> f32 {
        let half = (to_right.abs() + down.abs()) / 2.0;
        let share = 0.25 / (half.x * half.y);
        let mirrored = Point2::new(point.x.abs(), point.y.abs());
        let radius = point.coords.norm();
        let outward = point.coords / radius.max(1e-6);
        let radial = (to_right.dot(&outward).abs() + down.dot(&outward).abs()) / 2.0;
        let circle = overlap(
            radius,
            radial,
            CIRCLE_RADIUS - LINE_WIDTH / 2.0,
            CIRCLE_RADIUS + LINE_WIDTH / 2.0,
        );
        let mut most = [0.0; LANES];
        for stripes in &self.stripes {
            for (most, overlap) in most.iter_mut().zip(stripes.overlap(mirrored, half)) {
                *most = larger(overlap, *most);
            }
        }
        circle.max(most.into_iter().fold(0.0, f32::max) * share)
    }
}

/// Where the posts stand: their fronts are flush with the front edge of the goal line. First the goal
/// at positive x, its left post first.
pub fn goal_posts() -> [Point2<f32>; 4] {
    let x = LENGTH / 2.0 - LINE_WIDTH / 2.0 + GOAL_POST_RADIUS;
    [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(goal, side)| Point2::new(goal * x, side * GOAL_WIDTH / 2.0))
}

/// How far the point lies inside the carpet, negative outside.
pub(crate) fn depth_in_carpet(point: Point2<f32>) -> f32 {
    (CARPET.x - point.x.abs()).min(CARPET.y - point.y.abs())
}

fn cells(length: f32) -> usize {
    (length / CELL).ceil() as usize
}

fn distance(stripes: &[Stripe], point: Point2<f32>) -> f32 {
    let circle = (point.coords.norm() - CIRCLE_RADIUS).abs() - LINE_WIDTH / 2.0;
    stripes
        .iter()
        .map(|stripe| stripe.distance(point))
        .fold(circle, f32::min)
}

fn stripes() -> Vec<Stripe> {
    let line = LINE_WIDTH / 2.0;
    let mark = PENALTY_MARK_SIZE / 2.0;
    let goal_line = LENGTH / 2.0;
    let touch_line = WIDTH / 2.0;
    let mark_x = goal_line - PENALTY_MARK_DISTANCE;
    let across = |x: f32, end: f32| Stripe::new([x - line, x + line], [-end - line, end + line]);
    let along =
        |start: f32, y: f32| Stripe::new([start - line, goal_line + line], [y - line, y + line]);
    let mut stripes = vec![
        across(0.0, touch_line),
        across(goal_line, touch_line),
        along(-goal_line, touch_line),
        Stripe::new([mark_x - mark, mark_x + mark], [-line, line]),
        Stripe::new([mark_x - line, mark_x + line], [-mark, mark]),
        Stripe::new([-mark, mark], [-line, line]),
    ];
    for area in [GOAL_AREA, PENALTY_AREA] {
        stripes.push(across(goal_line - area.x, area.y / 2.0));
        stripes.push(along(goal_line - area.x, area.y / 2.0));
    }
    stripes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whiteness(x: f32, y: f32) -> f32 {
        let step = 0.001;
        Field::default().whiteness(
            Point2::new(x, y),
            Vector2::new(0.0, -step),
            Vector2::new(-step, 0.0),
        )
    }

    #[test]
    fn markings_are_white_and_the_rest_is_not() {
        for (x, y) in [
            (0.0, 1.0),
            (4.5, -2.0),
            (-4.5, 0.5),
            (1.0, 3.0),
            (3.2, 0.0),
            (-3.2, 0.04),
        ] {
            assert!(whiteness(x, y) > 0.999, "({x}, {y})");
        }
        for (x, y) in [
            (0.75, 0.0),
            (0.0, -0.75),
            (2.85, 1.0),
            (-3.9, 1.1),
            (4.2, -2.0),
        ] {
            assert!(whiteness(x, y) > 0.999, "({x}, {y})");
        }
        for (x, y) in [(1.0, 1.0), (3.2, 0.1), (-2.0, -2.0), (4.8, 0.0), (0.3, 0.3)] {
            assert_eq!(whiteness(x, y), 0.0, "({x}, {y})");
        }
    }

    #[test]
    fn the_table_never_overestimates_the_distance() {
        let field = Field::default();
        let stripes = stripes();
        for index in 0..10_000 {
            let point = Point2::new((index % 100) as f32 * 0.051, (index / 100) as f32 * 0.036);
            let truth = distance(&stripes, point).max(0.0);
            assert!(field.distance_to_marking(point) <= truth, "{point}");
        }
    }

    #[test]
    fn stripes_side_by_side_cover_what_each_of_them_covers() {
        let field = Field::default();
        let half = Vector2::new(0.03, 0.02);
        let mut white = 0;
        for index in 0..10_000 {
            let point = Point2::new((index % 100) as f32 * 0.051, (index / 100) as f32 * 0.036);
            let part = |at: f32, half: f32, low: f32, high: f32| {
                ((at + half).min(high) - (at - half).max(low)).max(0.0)
            };
            let covered = stripes().into_iter().map(|stripe| {
                part(point.x, half.x, stripe.low.x, stripe.high.x)
                    * part(point.y, half.y, stripe.low.y, stripe.high.y)
            });
            let most = covered.fold(0.0, f32::max) * (0.25 / (half.x * half.y));
            let found = field.whiteness(
                point,
                Vector2::new(0.0, -2.0 * half.y),
                Vector2::new(-2.0 * half.x, 0.0),
            );
            white += u32::from(most > 0.0);
            let is_circle = (point.coords.norm() - CIRCLE_RADIUS).abs() < 0.1;
            assert!(
                found == most || is_circle && found > most,
                "{point}: {found}, {most}"
            );
        }
        assert!(white > 500, "{white}");
    }

    #[test]
    fn a_pixel_half_on_a_line_is_half_white() {
        let half = Field::default().whiteness(
            Point2::new(0.025, 2.0),
            Vector2::new(0.0, -0.01),
            Vector2::new(-0.01, 0.0),
        );
        assert!((half - 0.5).abs() < 1e-4, "{half}");
    }
}
