//! Owns the next step on the way to a pose: turn and go ahead while it is far, go in all directions once it is near.

use framework::math;
use nalgebra::{Isometry2, Point2};
use types::motion::Step;

use super::parameters::WalkParameters;

/// The next step to a pose of the ground frame, by a way point that is the pose's own place where the way is straight;
/// `None` where the robot may stand.
pub(super) fn step_to(
    target: &Isometry2<f32>,
    way_point: Point2<f32>,
    is_walking: bool,
    parameters: &WalkParameters,
) -> Option<Step> {
    let place = target.translation.vector;
    let (distance, heading) = (place.norm(), target.rotation.angle());
    let factor = if is_walking { 1.0 } else { parameters.depart };
    let has_arrived =
        distance <= factor * parameters.arrived && heading.abs() <= factor * parameters.turned;
    if !(distance.is_finite() && heading.is_finite()) || has_arrived {
        return None;
    }
    let is_straight = way_point.coords == place;
    if is_straight && distance <= parameters.near {
        return Some(straight(target, parameters));
    }
    let bearing = math::atan2(way_point.y, way_point.x);
    let faces_it = bearing.abs() <= parameters.ahead;
    Some(Step {
        forward: match faces_it {
            true => parameters.forward,
            false => 0.0,
        },
        left: 0.0,
        turn: within(bearing, parameters.turn),
    })
}

/// The next step to a pose of the ground frame that is near: in all directions.
pub(super) fn straight(target: &Isometry2<f32>, parameters: &WalkParameters) -> Step {
    Step {
        forward: within(target.translation.x, parameters.forward),
        left: within(target.translation.y, parameters.left),
        turn: within(target.rotation.angle(), parameters.turn),
    }
}

/// Cut to a range on both sides of 0.
pub(super) fn within(number: f32, limit: f32) -> f32 {
    number.clamp(-limit.abs(), limit.abs())
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::behavior::tests::parameters;

    fn step(x: f32, y: f32, heading: f32, is_walking: bool) -> Option<Step> {
        let target = Isometry2::new(Vector2::new(x, y), heading);
        step_to(&target, Point2::new(x, y), is_walking, &parameters().walk)
    }

    #[test]
    fn it_turns_to_what_is_aside_and_goes_to_what_is_ahead() {
        let walk = parameters().walk;
        let turn = step(0.0, 2.0, 0.0, false).unwrap();
        assert_eq!((turn.forward, turn.turn), (0.0, walk.turn));
        let ahead = step(2.0, 0.0, 1.0, false).unwrap();
        assert_eq!((ahead.forward, ahead.turn), (walk.forward, 0.0));
    }

    #[test]
    fn near_its_place_it_takes_its_heading_and_goes_in_all_directions() {
        let step = step(0.1, -0.2, 0.1, true).unwrap();
        assert!(step.forward > 0.0 && step.left < 0.0 && step.turn > 0.0);
    }

    #[test]
    fn it_stops_there_and_does_not_dither() {
        let WalkParameters {
            arrived,
            turned,
            depart,
            ..
        } = parameters().walk;
        assert_eq!(step(0.9 * arrived, 0.0, 0.9 * turned, true), None);
        assert_eq!(step(0.9 * depart * arrived, 0.0, 0.0, false), None);
        assert!(step(0.9 * depart * arrived, 0.0, 0.0, true).is_some());
        assert!(step(0.0, 0.0, 1.1 * depart * turned, false).is_some());
    }

    #[test]
    fn a_place_that_is_nowhere_is_not_walked_to() {
        assert_eq!(step(f32::NAN, 0.0, 0.0, false), None);
        assert_eq!(step(1.0, f32::INFINITY, 0.0, false), None);
    }

    #[test]
    fn whoever_walks_so_arrives() {
        for mut pose in [
            Isometry2::new(Vector2::new(2.0, 1.0), 0.5),
            Isometry2::new(Vector2::new(-1.0, 0.1), -3.0),
            Isometry2::new(Vector2::new(0.3, -0.6), 1.5),
        ] {
            let mut steps = 0;
            while let Some(step) = step_to(
                &pose,
                pose.translation.vector.into(),
                true,
                &parameters().walk,
            ) {
                let moved = Isometry2::new(Vector2::new(step.forward, step.left), step.turn);
                pose = moved.inverse() * pose;
                steps += 1;
                assert!(steps < 200, "still at {pose}");
            }
        }
    }
}
