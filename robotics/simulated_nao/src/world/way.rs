//! How far a robot has gone: swaying over its feet is no way, so places are a second apart.

use std::time::Duration;

use framework::Timestamp;
use nalgebra::Point2;

use crate::physics::Body;

/// Between two places of the way.
const INTERVAL: Duration = Duration::from_secs(1);

/// The way of one robot over the floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    last: (Timestamp, Point2<f64>),
    length: f64,
}

impl Way {
    /// Begins where the body is.
    pub(super) fn new(body: &Body) -> Self {
        Self::from(place(body))
    }

    fn from(place: Point2<f64>) -> Self {
        Self {
            last: (Timestamp::ZERO, place),
            length: 0.0,
        }
    }

    /// The body is where it is now.
    pub(super) fn go(&mut self, now: Timestamp, body: &Body) {
        self.go_to(now, place(body));
    }

    fn go_to(&mut self, now: Timestamp, place: Point2<f64>) {
        let (then, from) = self.last;
        if now - then >= INTERVAL {
            self.length += (place - from).norm();
            self.last = (now, place);
        }
    }

    /// Goes on from where the body is: carried is not walked.
    pub(super) fn carry(&mut self, body: &Body) {
        self.carry_to(place(body));
    }

    fn carry_to(&mut self, place: Point2<f64>) {
        self.last.1 = place;
    }

    /// m.
    pub(super) fn length(&self) -> f64 {
        self.length
    }
}

/// Midway between its soles, in the field frame, m.
fn place(body: &Body) -> Point2<f64> {
    body.ground_to_field().translation.vector.xy().into()
}

#[cfg(test)]
mod tests {
    use framework::math;

    use super::*;

    #[test]
    fn swaying_is_no_way_and_carrying_neither() {
        let mut way = Way::from(Point2::origin());
        for cycle in 1..=1000 {
            let now = Timestamp::ZERO + Duration::from_millis(10 * cycle);
            // 0.2 m/s, swaying by 5 cm twice a second.
            let seconds = 0.01 * cycle as f64;
            let sway = 0.05 * math::sin(std::f64::consts::TAU * 2.0 * seconds);
            way.go_to(now, Point2::new(0.2 * seconds, sway));
        }
        assert!((way.length() - 2.0).abs() < 1e-9, "{}", way.length());
        way.carry_to(Point2::new(7.0, 0.0));
        way.go_to(
            Timestamp::ZERO + Duration::from_secs(11),
            Point2::new(7.2, 0.0),
        );
        assert!((way.length() - 2.2).abs() < 1e-9, "{}", way.length());
    }
}
