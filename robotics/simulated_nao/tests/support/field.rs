//! Where lines, border, goal posts and robots really are, for tests of what vision makes of them.

use nalgebra::{Point2, Point3, Vector2};
use simulated_nao::camera::Exposure;
use simulated_nao::field::{LENGTH, WIDTH, goal_posts};
use simulated_nao::ground_truth::{ImageTruth, RobotTruth};
use types::field_features::{FieldBorder, LineSegment};

/// From the border to the lines around the field, and the areas in front of the goals, m.
const BORDER: f32 = 0.7;
const AREAS: [[f32; 2]; 2] = [[0.6, 2.2], [1.65, 4.0]];
const CIRCLE_RADIUS: f32 = 0.75;

/// Every straight line of the field: both ends in the field frame, m.
pub(crate) fn straight_lines() -> Vec<[Point2<f32>; 2]> {
    let (x, y) = (LENGTH / 2.0, WIDTH / 2.0);
    let mut lines = vec![[Point2::new(0.0, -y), Point2::new(0.0, y)]];
    for side in [-1.0, 1.0] {
        let goal_line = side * x;
        lines.push([Point2::new(-x, side * y), Point2::new(x, side * y)]);
        lines.push([Point2::new(goal_line, -y), Point2::new(goal_line, y)]);
        for [length, width] in AREAS {
            let (front, half) = (goal_line - side * length, width / 2.0);
            lines.push([Point2::new(front, -half), Point2::new(front, half)]);
            for y in [-half, half] {
                lines.push([Point2::new(front, y), Point2::new(goal_line, y)]);
            }
        }
    }
    lines
}

/// From a point of the field frame to the next line, m.
pub(crate) fn distance_to_line(point: Point2<f32>) -> f32 {
    let circle = (point.coords.norm() - CIRCLE_RADIUS).abs();
    let distances = straight_lines().into_iter().map(|[start, end]| {
        let line = LineSegment {
            start,
            end,
            ..Default::default()
        };
        line.distance_to(point)
    });
    distances.fold(circle, f32::min)
}

/// A point of the ground frame in the field frame.
pub(crate) fn on_field(exposure: &Exposure, point: Point2<f32>) -> Point2<f32> {
    (exposure.ground_to_field * Point3::new(point.x, point.y, 0.0)).xy()
}

/// From end to end, at most 5 cm apart.
pub(crate) fn points_between(
    start: Point2<f32>,
    end: Point2<f32>,
) -> impl Iterator<Item = Point2<f32>> {
    let count = (nalgebra::distance(&start, &end) / 0.05).ceil().max(1.0) as usize;
    (0..=count).map(move |index| start + (end - start) * (index as f32 / count as f32))
}

/// A point of the floor from the field frame to the ground frame.
pub(crate) fn to_ground(exposure: &Exposure, point: Point2<f32>) -> Point2<f32> {
    let point = Point3::new(point.x, point.y, 0.0);
    exposure
        .ground_to_field
        .inverse_transform_point(&point)
        .xy()
}

/// The edge of the carpet from corner to corner, in the field frame.
fn carpet() -> impl Iterator<Item = Point3<f32>> {
    let half = Vector2::new(LENGTH / 2.0 + BORDER, WIDTH / 2.0 + BORDER);
    let corner = move |x: f32, y: f32| Point2::new(x * half.x, y * half.y);
    let edges = [
        [corner(-1.0, -1.0), corner(1.0, -1.0)],
        [corner(1.0, -1.0), corner(1.0, 1.0)],
        [corner(1.0, 1.0), corner(-1.0, 1.0)],
        [corner(-1.0, 1.0), corner(-1.0, -1.0)],
    ];
    let points = edges.map(|[start, end]| points_between(start, end));
    points
        .into_iter()
        .flatten()
        .map(|point| point.coords.push(0.0).into())
}

/// Where the image shows the edge of the carpet, or would if nothing stood in front of it.
pub(crate) fn edge(truth: &ImageTruth) -> Vec<Point2<f32>> {
    carpet().filter_map(|point| truth.project(point)).collect()
}

/// Whether the edge goes through enough columns to be seen as a line.
pub(crate) fn is_wide(edge: &[Point2<f32>]) -> bool {
    let columns = edge.iter().map(|pixel| pixel.x);
    columns.clone().fold(0.0, f32::max) - columns.fold(640.0, f32::min) >= 200.0
}

/// Whether the border goes through a pixel of the edge, but for 4 px.
pub(crate) fn is_border(border: &FieldBorder, pixel: &Point2<f32>) -> bool {
    (border.row_at(pixel.x)).is_some_and(|row| (row - pixel.y).abs() <= 4.0)
}

/// Where the goal posts stand, in the ground frame.
pub(crate) fn posts(exposure: &Exposure) -> [Point2<f32>; 4] {
    goal_posts().map(|post| to_ground(exposure, post))
}

/// Whether both feet are in the image, not cut by its edge, and no other robot can hide them.
pub(crate) fn shows_feet(robot: &RobotTruth, others: &[RobotTruth]) -> bool {
    let is_clear = |foot: Option<Point2<f32>>| {
        foot.is_some_and(|pixel| {
            (30.0..610.0).contains(&pixel.x) && (30.0..450.0).contains(&pixel.y)
        })
    };
    let away = robot.position.coords.norm();
    let hides = |other: &RobotTruth| {
        let other = other.position.coords;
        let ahead = robot.position.coords / away;
        other.norm() < away && other.dot(&ahead) > 0.0 && other.perp(&ahead).abs() < 0.4
    };
    is_clear(robot.feet.left) && is_clear(robot.feet.right) && !others.iter().any(hides)
}
