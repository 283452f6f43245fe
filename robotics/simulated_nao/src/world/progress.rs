//! For how long a robot has been stuck: it lies, or its legs move, and it gets nowhere.

use std::time::Duration;

use framework::{Timestamp, math};
use nalgebra::Point2;

use crate::physics::{Body, heading};

/// Between two looks.
const INTERVAL: Duration = Duration::from_secs(1);
/// Who has got farther, m, is not stuck.
const FAR: f64 = 0.3;
/// Who has turned further, rad, is not stuck either.
const TURNED: f64 = 0.5;
/// Knees that move less within a second, rad, stand: somebody who waits is not stuck.
const STILL: f64 = 0.3;
/// A torso that leans more, rad, lies.
const LYING: f64 = 1.0;

/// Where a robot was when it was last not stuck.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    free: Option<Stance>,
    looked: Timestamp,
    stuck: Duration,
    knees: [f64; 2],
    /// How far the knees have moved since the last look, rad.
    moved: f64,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Stance {
    place: Point2<f64>,
    heading: f64,
    tilt: f64,
}

impl Progress {
    /// The body is where it is now.
    pub(super) fn go(&mut self, now: Timestamp, body: &Body) {
        let stance = Stance {
            place: body.ground_to_field().translation.vector.xy().into(),
            heading: heading(&body.torso_to_field),
            tilt: body.tilt(),
        };
        let knees = [body.joints.left_knee_pitch, body.joints.right_knee_pitch];
        self.go_on(now, stance, knees);
    }

    fn go_on(&mut self, now: Timestamp, stance: Stance, knees: [f64; 2]) {
        let moved = knees
            .iter()
            .zip(self.knees)
            .map(|(new, old)| (new - old).abs());
        self.moved += moved.sum::<f64>();
        self.knees = knees;
        let passed = now - self.looked;
        if passed < INTERVAL {
            return;
        }
        let waits = self.moved < STILL && stance.tilt < LYING;
        if waits || self.free.is_none_or(|free| free.has_been_left(&stance)) {
            self.free = Some(stance);
            self.stuck = Duration::ZERO;
        } else {
            self.stuck += passed;
        }
        self.looked = now;
        self.moved = 0.0;
    }

    /// s.
    pub(super) fn stuck(&self) -> f64 {
        self.stuck.as_secs_f64()
    }
}

impl Stance {
    fn has_been_left(&self, now: &Self) -> bool {
        let turned = math::atan2(
            math::sin(now.heading - self.heading),
            math::cos(now.heading - self.heading),
        );
        // Who lies may be dragged along, but is not free before it stands.
        now.tilt < LYING && ((now.place - self.place).norm() > FAR || turned.abs() > TURNED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 30 s at that speed (m/s), turning (rad/s), leaning (rad), with knees that move or not.
    fn stuck(speed: f64, turn: f64, tilt: f64, walks: bool) -> f64 {
        let mut progress = Progress::default();
        for cycle in 1..=3000 {
            let seconds = 0.01 * f64::from(cycle);
            let stance = Stance {
                place: Point2::new(speed * seconds, 0.0),
                heading: turn * seconds,
                tilt,
            };
            let knee = if walks {
                math::sin(10.0 * seconds)
            } else {
                0.9
            };
            let now = Timestamp::ZERO + Duration::from_secs_f64(seconds);
            progress.go_on(now, stance, [knee; 2]);
        }
        progress.stuck()
    }

    #[test]
    fn who_gets_nowhere_with_its_legs_or_lies_is_stuck() {
        for (speed, turn, tilt, walks, is_stuck) in [
            (0.0, 0.0, 0.0, false, false),
            (0.2, 0.0, 0.1, true, false),
            (0.0, 0.2, 0.1, true, false),
            (0.0, 0.0, 0.1, true, true),
            (0.0, 0.0, 1.5, false, true),
            (0.1, 0.0, 1.5, true, true),
        ] {
            let seconds = stuck(speed, turn, tilt, walks);
            assert_eq!(
                seconds > 20.0,
                is_stuck,
                "{speed} {turn} {tilt} {walks}: {seconds} s"
            );
        }
    }
}
