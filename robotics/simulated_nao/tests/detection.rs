//! How well vision finds the ball in images of the simulated cameras, with the true camera pose.

#[path = "support/scene.rs"]
mod scene;

use framework::math;
use nalgebra::{Point2, Point3};
use scene::{Look, Vision, looks};
use simulated_nao::ground_truth::{ImageTruth, RobotTruth};
use types::ball::BallCandidate;

/// A ball at these places in front of the robot, in its ground frame.
fn balls(look: &Look) -> Vec<Point3<f32>> {
    let mut balls = Vec::new();
    for distance in [0.5, 0.8, 1.2, 1.7, 2.3, 3.0_f64] {
        for bearing in [-0.9, -0.5, -0.2, 0.0, 0.1, 0.4, 0.7_f64] {
            let [x, y, heading] = look.robot;
            let angle = heading + bearing;
            let at = [
                x + distance * math::cos(angle),
                y + distance * math::sin(angle),
            ];
            balls.push(Point3::new(at[0] as f32, at[1] as f32, 0.05));
        }
    }
    balls
}

/// Within 5 cm and a tenth of the distance.
fn is_at(ball: &BallCandidate, place: Point2<f32>) -> bool {
    let tolerance = 0.05 + 0.1 * place.coords.norm();
    let is_near = |position| nalgebra::distance(&position, &place) <= tolerance;
    ball.position.is_some_and(is_near)
}

#[test]
fn a_whole_ball_is_found_where_it_is() {
    let mut vision = Vision::new();
    let (mut shown, mut found, mut wrong, mut displaced) = (0, 0, 0, 0);
    for look in looks() {
        for (number, ball) in balls(&look).into_iter().enumerate() {
            let exposure = look.expose(number as u64, Some(ball));
            let place = exposure.ground_to_field.inverse_transform_point(&ball).xy();
            let Some(truth) = ImageTruth::from(&exposure)
                .ball
                .filter(|ball| ball.is_whole)
            else {
                continue;
            };
            shown += 1;
            let balls = vision.see(&look, &exposure).balls;
            let is_right = |ball: &&BallCandidate| (ball.center - truth.center).norm() <= 15.0;
            let right = balls.iter().find(is_right);
            found += usize::from(right.is_some());
            displaced += usize::from(right.is_some_and(|ball| !is_at(ball, place)));
            wrong += balls.iter().filter(|ball| !is_right(ball)).count();
            if right.is_none() {
                println!("{look:?}: {balls:?} instead of {truth:?}");
            }
        }
    }
    println!("{found} of {shown} balls found, {displaced} too far off, {wrong} in the wrong place");
    assert!(shown > 300, "{shown}");
    assert!(found * 10 >= shown * 9, "{found} of {shown}");
    assert_eq!(displaced, 0);
    assert!(wrong * 100 <= shown, "{wrong} of {shown}");
}

#[test]
fn without_a_ball_none_is_found() {
    let mut vision = Vision::new();
    for (number, look) in looks().enumerate() {
        for turn in [0.0, 0.13, 0.37, 0.71] {
            let look = Look {
                yaw: look.yaw + turn,
                ..look
            };
            let balls = vision.see(&look, &look.expose(number as u64, None)).balls;
            assert_eq!(balls, [], "{look:?}");
        }
    }
}

#[test]
fn robots_goals_and_limbs_are_no_balls() {
    let mut vision = Vision::new();
    let (mut images, mut wrong) = (0, 0);
    let turned = looks().flat_map(|look| {
        [0.0, 0.29].map(|turn| Look {
            yaw: look.yaw + turn,
            ..look
        })
    });
    for look in turned {
        for (number, robots) in look.crowds().enumerate() {
            let exposure = look.expose_among(number as u64, None, &robots);
            let truth = ImageTruth::from(&exposure);
            let is_shown = |robot: RobotTruth| robot.feet.left.or(robot.feet.right).is_some();
            if !truth.robots().any(is_shown) {
                continue;
            }
            images += 1;
            let balls = vision.see(&look, &exposure).balls;
            wrong += usize::from(!balls.is_empty());
            if !balls.is_empty() {
                println!("{balls:?} in {look:?} with crowd {number}");
            }
        }
    }
    println!("a ball in {wrong} of {images} images without one");
    assert!(images >= 300, "{images}");
    assert!(wrong * 100 <= images, "{wrong} of {images}");
}

#[test]
fn a_whole_ball_among_robots_is_found_where_it_is() {
    let mut vision = Vision::new();
    let (mut shown, mut found, mut displaced, mut wrong) = (0, 0, 0, 0);
    for look in looks() {
        let places = balls(&look).into_iter().enumerate().step_by(2);
        for ((number, ball), robots) in places.zip(look.crowds().chain(look.crowds())) {
            let exposure = look.expose_among(number as u64, Some(ball), &robots);
            let place = exposure.ground_to_field.inverse_transform_point(&ball).xy();
            let truth = ImageTruth::from(&exposure).ball;
            let Some(truth) = truth.filter(|ball| ball.is_whole) else {
                continue;
            };
            shown += 1;
            let balls = vision.see(&look, &exposure).balls;
            let is_right = |ball: &&BallCandidate| (ball.center - truth.center).norm() <= 15.0;
            let right = balls.iter().find(is_right);
            found += usize::from(right.is_some());
            displaced += usize::from(right.is_some_and(|ball| !is_at(ball, place)));
            wrong += balls.iter().filter(|ball| !is_right(ball)).count();
        }
    }
    println!("{found} of {shown} balls found, {displaced} too far off, {wrong} in the wrong place");
    assert!(shown > 70, "{shown}");
    assert!(found * 10 >= shown * 8, "{found} of {shown}");
    assert_eq!(displaced, 0);
    assert!(wrong * 100 <= shown, "{wrong} of {shown}");
}
