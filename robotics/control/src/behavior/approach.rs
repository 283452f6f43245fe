//! Owns how the robot walks to the ball: turns to it, then goes ahead, and stops before it.

use framework::Reflect;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::motion::Step;

/// How far behind the end of its way the robot aims, in m: shorter steps do not get it there.
const LAST_STEP: f32 = 0.01;

/// How to walk to the ball.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Approach {
    /// In m: a ball that is nearer has been reached.
    pub arrived: f32,
    /// In m: a robot that stands follows a ball that is further away.
    pub depart: f32,
    /// In rad: a ball further aside is turned to before anything else.
    pub ahead: f32,
    /// The longest step, in m.
    pub forward: f32,
    /// The greatest turn of a step, in rad.
    pub turn: f32,
}

/// The next step to a ball in the ground frame; `None` where the robot may stand.
pub(super) fn step_towards(
    ball: Point2<f32>,
    is_on_its_way: bool,
    approach: &Approach,
) -> Option<Step> {
    let reached = if is_on_its_way {
        approach.arrived
    } else {
        approach.depart
    };
    let (distance, aside) = (ball.coords.norm(), ball.y.atan2(ball.x));
    let faces_ball = aside.abs() <= approach.ahead;
    if !distance.is_finite() || (distance <= reached && faces_ball) {
        return None;
    }
    let forward = if faces_ball {
        // The nearer, the shorter: nobody runs over the ball.
        (distance - approach.arrived + LAST_STEP).clamp(0.0, approach.forward)
    } else {
        0.0
    };
    Some(Step {
        forward,
        left: 0.0,
        turn: aside.clamp(-approach.turn.abs(), approach.turn.abs()),
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::behavior) const APPROACH: Approach = Approach {
        arrived: 0.2,
        depart: 0.3,
        ahead: 0.5,
        forward: 0.06,
        turn: 0.4,
    };

    fn step(x: f32, y: f32, is_on_its_way: bool) -> Option<Step> {
        step_towards(Point2::new(x, y), is_on_its_way, &APPROACH)
    }

    #[test]
    fn it_turns_to_a_ball_aside_and_goes_to_one_ahead() {
        let turn = step(0.0, 1.0, false).unwrap();
        assert_eq!((turn.forward, turn.turn), (0.0, 0.4));
        let ahead = step(2.0, 0.0, false).unwrap();
        assert_eq!((ahead.forward, ahead.turn), (0.06, 0.0));
        let right = step(2.0, -0.2, false).unwrap();
        assert!(right.forward > 0.0 && right.turn < 0.0);
    }

    #[test]
    fn it_stops_before_the_ball_and_does_not_dither() {
        assert_eq!(step(0.19, 0.0, true), None);
        assert!(step(0.25, 0.0, true).is_some());
        assert_eq!(step(0.25, 0.0, false), None);
        assert!(step(0.22, 0.0, true).unwrap().forward < 0.03);
        // One that lies beside the robot is turned to however near it is.
        assert!(step(0.0, 0.15, false).is_some());
    }

    #[test]
    fn a_ball_that_is_nowhere_is_not_followed() {
        assert_eq!(step(f32::NAN, 0.0, true), None);
        assert_eq!(step(f32::INFINITY, 0.0, true), None);
    }

    #[test]
    fn whoever_walks_so_arrives() {
        for (mut x, mut y) in [(2.0_f32, 1.0_f32), (-1.0, 0.1), (0.3, -0.6)] {
            let mut steps = 0;
            while let Some(step) = step(x, y, true) {
                (x, y) = (x - step.forward, y);
                let (sin, cos) = (-step.turn).sin_cos();
                (x, y) = (cos * x - sin * y, sin * x + cos * y);
                steps += 1;
                assert!(steps < 200, "still at {x} {y}");
            }
            assert!((0.1..0.21).contains(&x.hypot(y)), "{x} {y}");
        }
    }
}
