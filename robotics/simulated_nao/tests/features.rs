//! How well vision finds lines, border and penalty marks in images of the simulated cameras, and
//! nothing in the way but robots and goal posts.

#[path = "support/field.rs"]
mod field;
#[path = "support/scene.rs"]
mod scene;

use field::{
    distance_to_line, edge, is_border, is_wide, on_field, points_between, posts, shows_feet,
    straight_lines, to_ground,
};
use framework::math;
use nalgebra::Point2;
use scene::{Look, Vision, looks};
use simulated_nao::ground_truth::ImageTruth;
use types::camera::CameraPosition;
use types::obstacles::ObstacleCandidate;

/// Up to here every segment must be right, m.
const REACH: f32 = 4.0;

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
                let ground = to_ground(&exposure, point);
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

#[test]
fn the_border_lies_where_the_carpet_ends() {
    let mut vision = Vision::new();
    let (mut images, mut shown, mut right) = (0, 0, 0);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let truth = ImageTruth::from(&exposure);
        let border = vision.see(&look, &exposure).border;
        let edge = edge(&truth);
        if edge.is_empty() {
            assert_eq!(border.lines, [], "{look:?}");
            continue;
        }
        if !is_wide(&edge) {
            continue;
        }
        images += 1;
        shown += edge.len();
        let is_right = |pixel: &&Point2<f32>| is_border(&border, pixel);
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
        let marks = ImageTruth::penalty_marks().map(|mark| to_ground(&exposure, mark.xy()));
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
