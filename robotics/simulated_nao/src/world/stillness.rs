//! For how long a robot has stood still: whoever walks or turns leaves a small place within a second.

use framework::{Timestamp, math};
use nalgebra::Point2;

use crate::physics::{Body, heading};

/// Who has got farther, m, has moved; a robot that stands sways by millimetres.
const FAR: f64 = 0.05;
/// Who has turned further, rad, has moved as well.
const TURNED: f64 = 0.15;

/// Since when a robot has been at a place.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stillness {
    place: Point2<f64>,
    heading: f64,
    since: Timestamp,
    now: Timestamp,
}

impl Stillness {
    /// The body is where it is now.
    pub(super) fn go(&mut self, now: Timestamp, body: &Body) {
        let place = body.ground_to_field().translation.vector.xy();
        self.go_to(now, place.into(), heading(&body.torso_to_field));
    }

    fn go_to(&mut self, now: Timestamp, place: Point2<f64>, heading: f64) {
        let turned = heading - self.heading;
        let turned = math::atan2(math::sin(turned), math::cos(turned));
        self.now = now;
        if (place - self.place).norm() > FAR || turned.abs() > TURNED {
            *self = Self {
                place,
                heading,
                since: now,
                now,
            };
        }
    }

    /// s.
    pub(super) fn seconds(&self) -> f64 {
        (self.now - self.since).as_secs_f64()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    /// For how long it has stood still after 5 s at that speed (m/s), turning (rad/s), and 2 s that it only sways.
    fn still(speed: f64, turn: f64) -> [f64; 2] {
        let mut stillness = Stillness::default();
        [0..500, 500..700].map(|cycles| {
            for cycle in cycles {
                let seconds = 0.01 * f64::from(cycle);
                let moved = seconds.min(5.0);
                let sway = 0.01 * math::sin(std::f64::consts::TAU * 2.0 * seconds);
                let now = Timestamp::ZERO + Duration::from_secs_f64(seconds);
                stillness.go_to(now, Point2::new(speed * moved, sway), turn * moved);
            }
            stillness.seconds()
        })
    }

    #[test]
    fn who_walks_or_turns_is_not_still_and_who_sways_is() {
        for (speed, turn) in [(0.1, 0.0), (-0.1, 0.0), (0.0, 0.5), (0.0, -2.0)] {
            let [moving, stood] = still(speed, turn);
            assert!(moving < 0.7, "{speed} {turn}: {moving} s");
            assert!((1.9..2.7).contains(&stood), "{speed} {turn}: {stood} s");
        }
        assert!(still(0.0, 0.0)[0] > 4.9);
    }
}
