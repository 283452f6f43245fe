//! How well vision finds lines, border and penalty marks in images of the simulated cameras, and
//! nothing in the way but robots and goal posts.

#[path = "support/scene.rs"]
mod scene;

use framework::math;
use nalgebra::{Point2, Point3, Vector2};
use scene::{Look, Vision, looks};
use simulated_nao::camera::Exposure;
use simulated_nao::field::{LENGTH, WIDTH, goal_posts};
use simulated_nao::ground_truth::{ImageTruth, RobotTruth};
use types::camera::CameraPosition;
use types::obstacles::ObstacleCandidate;

/// Up to here every segment must be right, m.
const REACH: f32 = 4.0;

/// From the border to the lines around the field, and the areas in front of the goals, m.
const BORDER: f32 = 0.7;
const AREAS: [[f32; 2]; 2] = [[0.6, 2.2], [1.65, 4.0]];
const CIRCLE_RADIUS: f32 = 0.75;

/// Every straight line of the field: both ends in the field frame, m.
fn straight_lines() -> Vec<[Point2<f32>; 2]> {
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
fn distance_to_line(point: Point2<f32>) -> f32 {
    let circle = (point.coords.norm() - CIRCLE_RADIUS).abs();
    let distances = straight_lines().into_iter().map(|[start, end]| {
        let line = types::field_features::LineSegment {
            start,
            end,
            ..Default::default()
        };
        line.distance_to(point)
    });
    distances.fold(circle, f32::min)
}

/// A point of the ground frame in the field frame.
fn on_field(exposure: &Exposure, point: Point2<f32>) -> Point2<f32> {
    (exposure.ground_to_field * Point3::new(point.x, point.y, 0.0)).xy()
}

fn points_between(start: Point2<f32>, end: Point2<f32>) -> impl Iterator<Item = Point2<f32>> {
    let count = (nalgebra::distance(&start, &end) / 0.05).ceil().max(1.0) as usize;
    (0..=count).map(move |index| start + (end - start) * (index as f32 / count as f32))
}

fn looks_around() -> impl Iterator<Item = (u64, Look)> {
    let turned = looks().flat_map(|look| {
        [0.0, 0.29].map(|turn| Look {
            yaw: look.yaw + turn,
            ..look
        })
    });
    (0..).zip(turned)
}

#[test]
fn every_segment_lies_on_a_line_of_the_field() {
    let mut vision = Vision::new();
    let (mut seen, mut worst) = (0, 0.0_f32);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        for line in vision.see(&look, &exposure).lines {
            seen += 1;
            for point in points_between(line.start, line.end) {
                let distance = point.coords.norm();
                if distance > REACH {
                    continue;
                }
                let off = distance_to_line(on_field(&exposure, point));
                worst = worst.max(off / (0.05 + 0.05 * distance));
                assert!(
                    off <= 0.05 + 0.05 * distance,
                    "{off} m off at {distance} m: {line:?} in {look:?}"
                );
            }
        }
    }
    println!("{seen} segments, at most {worst} of what is allowed off");
    assert!(seen > 100, "{seen}");
}

#[test]
fn most_of_the_straight_lines_within_three_metres_are_found() {
    let mut vision = Vision::new();
    let (mut shown, mut found) = ([0, 0], [0, 0]);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let truth = ImageTruth::from(&exposure);
        let lines = vision.see(&look, &exposure).lines;
        for [start, end] in straight_lines() {
            for point in points_between(start, end) {
                let ground = exposure
                    .ground_to_field
                    .inverse_transform_point(&point.coords.push(0.0).into())
                    .xy();
                let is_seen = truth.project(point.coords.push(0.0).into()).is_some();
                if !is_seen || ground.coords.norm() > 3.0 {
                    continue;
                }
                let camera = usize::from(look.camera == CameraPosition::Bottom);
                shown[camera] += 1;
                let tolerance = 0.05 + 0.05 * ground.coords.norm();
                let is_found = lines
                    .iter()
                    .any(|line| line.distance_to(ground) <= tolerance);
                found[camera] += usize::from(is_found);
            }
        }
    }
    println!("pieces of 5 cm found, top and bottom: {found:?} of {shown:?}");
    for camera in 0..2 {
        assert!(shown[camera] > 500, "{shown:?}");
        assert!(
            found[camera] * 10 >= shown[camera] * 8,
            "{found:?} of {shown:?}"
        );
    }
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

#[test]
fn the_border_lies_where_the_carpet_ends() {
    let mut vision = Vision::new();
    let (mut images, mut shown, mut right) = (0, 0, 0);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let truth = ImageTruth::from(&exposure);
        let border = vision.see(&look, &exposure).border;
        let edge: Vec<_> = carpet().filter_map(|point| truth.project(point)).collect();
        if edge.is_empty() {
            assert_eq!(border.lines, [], "{look:?}");
            continue;
        }
        let columns = edge.iter().map(|pixel| pixel.x);
        let width = columns.clone().fold(0.0, f32::max) - columns.fold(640.0, f32::min);
        if width < 200.0 {
            continue;
        }
        images += 1;
        shown += edge.len();
        let is_right = |pixel: &&Point2<f32>| {
            border
                .row_at(pixel.x)
                .is_some_and(|row| (row - pixel.y).abs() <= 4.0)
        };
        let count = edge.iter().filter(is_right).count();
        right += count;
        if count * 10 < edge.len() * 8 {
            println!("{count} of {}: {border:?} in {look:?}", edge.len());
        }
    }
    println!("{right} of {shown} places of the border in {images} images");
    assert!(images > 20, "{images}");
    assert!(right * 100 >= shown * 95, "{right} of {shown}");
}

#[test]
fn the_penalty_mark_is_found_where_it_is_and_nowhere_else() {
    let mut vision = Vision::new();
    let (mut shown, mut found, mut worst) = (0, 0, 0.0_f32);
    let to_mark = (0..24).map(|index| {
        let bearing = index as f64 * 0.7;
        let distance = 0.4 + 0.1 * index as f64;
        let robot = [
            3.2 - distance * math::cos(bearing),
            -distance * math::sin(bearing),
            bearing,
        ];
        let yaw = 0.4 * math::sin(index as f64);
        [CameraPosition::Top, CameraPosition::Bottom].map(|camera| Look {
            robot,
            yaw,
            pitch: 0.2,
            camera,
        })
    });
    // Behind a goal the robot sees the field through its net.
    let is_before_goals = |look: &Look| look.robot[0].abs() <= 4.5;
    let looks = looks_around()
        .map(|(_, look)| look)
        .chain(to_mark.flatten())
        .filter(is_before_goals);
    for (number, look) in (0..).zip(looks) {
        let exposure = look.expose(number, None);
        let truth = ImageTruth::from(&exposure);
        let to_ground = exposure.ground_to_field.inverse();
        let marks = ImageTruth::penalty_marks().map(|mark| (to_ground * mark).xy());
        let is_shown = |mark: &Point2<f32>| {
            let pixel = truth
                .camera_matrix
                .ground_to_pixel(mark.coords.push(0.0).into());
            mark.coords.norm() < 2.5
                && pixel.is_some_and(|pixel| {
                    (60.0..580.0).contains(&pixel.x) && (40.0..420.0).contains(&pixel.y)
                })
        };
        let is_expected = marks.iter().any(is_shown);
        shown += usize::from(is_expected);
        let Some(mark) = vision.see(&look, &exposure).penalty_mark else {
            if is_expected {
                println!("not found: {marks:?} in {look:?}");
            }
            continue;
        };
        found += usize::from(is_expected);
        let off = marks.map(|truth| {
            let tolerance = 0.05 + 0.1 * truth.coords.norm();
            nalgebra::distance(&truth, &mark.position) / tolerance
        });
        let off = off[0].min(off[1]);
        worst = worst.max(off);
        assert!(off <= 1.0, "{mark:?} instead of {marks:?} in {look:?}");
    }
    println!("{found} of {shown} marks found, at most {worst} of what is allowed off");
    assert!(shown > 15, "{shown}");
    assert!(found * 10 >= shown * 9, "{found} of {shown}");
}

/// Where the goal posts stand, in the ground frame.
fn posts(exposure: &Exposure) -> [Point2<f32>; 4] {
    let to_ground = exposure.ground_to_field.inverse();
    goal_posts().map(|post| (to_ground * Point3::new(post.x, post.y, 0.0)).xy())
}

#[test]
fn on_an_empty_field_only_goal_posts_are_in_the_way() {
    let mut vision = Vision::new();
    let (mut seen, mut wrong) = (0, 0);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let posts = posts(&exposure);
        for obstacle in vision.see(&look, &exposure).obstacles {
            let off = posts.map(|post| nalgebra::distance(&post, &obstacle.position));
            seen += 1;
            if off.into_iter().fold(f32::MAX, f32::min) > 0.3 {
                wrong += 1;
                println!("{obstacle:?} in {look:?}");
            }
        }
    }
    println!("{seen} obstacles, {wrong} of them no goal posts");
    assert!(seen >= 10, "{seen}");
    assert_eq!(wrong, 0);
}

/// Whether both feet are in the image, not cut by its edge, and no other robot can hide them.
fn shows_feet(robot: &RobotTruth, others: &[RobotTruth]) -> bool {
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

#[test]
fn robots_are_found_at_their_feet_and_nothing_else_but_goal_posts() {
    let mut vision = Vision::new();
    let (mut shown, mut found, mut images, mut wrong) = (0, 0, 0, 0);
    for (number, look) in looks_around() {
        for robots in look.crowds() {
            let exposure = look.expose_among(number, None, &robots);
            let truth = ImageTruth::from(&exposure);
            let posts = posts(&exposure);
            let robots: Vec<_> = truth.robots().collect();
            let obstacles = vision.see(&look, &exposure).obstacles;
            images += 1;
            for robot in &robots {
                let distance = robot.position.coords.norm();
                if distance > 3.5 || !shows_feet(robot, &robots) {
                    continue;
                }
                shown += 1;
                let allowed = 0.2 + 0.1 * distance;
                let is_right = |obstacle: &ObstacleCandidate| {
                    nalgebra::distance(&obstacle.position, &robot.position) <= allowed
                };
                let is_found = obstacles.iter().any(is_right);
                found += usize::from(is_found);
                if !is_found {
                    println!("not found: {robot:?}: {obstacles:?} in {look:?}");
                }
            }
            let is_wrong = |obstacle: &&ObstacleCandidate| {
                let robots = robots.iter().map(|robot| robot.position);
                let mut real = robots.chain(posts);
                obstacle.position.coords.norm() <= 4.0
                    && !real.any(|real| nalgebra::distance(&real, &obstacle.position) <= 0.5)
            };
            let false_ones: Vec<_> = obstacles.iter().filter(is_wrong).collect();
            wrong += usize::from(!false_ones.is_empty());
            if !false_ones.is_empty() {
                println!("{false_ones:?} beside {robots:?} in {look:?}");
            }
        }
    }
    println!("{found} of {shown} robots found, something wrong in {wrong} of {images} images");
    assert!(shown > 300, "{shown}");
    assert!(found * 10 >= shown * 8, "{found} of {shown}");
    assert!(wrong * 100 <= images * 2, "{wrong} of {images}");
}
