//! How far a robot has gone: swaying over its feet is no way, so places are a second apart.

use std::time::Duration;

use framework::Timestamp;
use nalgebra::Point2;

/// Between two places of the way.
const INTERVAL: Duration = Duration::from_secs(1);

/// The way of one robot over the floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    last: (Timestamp, Point2<f64>),
    length: f64,
}

impl Way {
    /// Begins at a place in the field frame, m.
    pub(super) fn new(place: Point2<f64>) -> Self {
        Self {
            last: (Timestamp::ZERO, place),
            length: 0.0,
        }
    }

    /// The robot is there now.
    pub(super) fn go(&mut self, now: Timestamp, place: Point2<f64>) {
        let (then, from) = self.last;
        if now - then >= INTERVAL {
            self.length += (place - from).norm();
            self.last = (now, place);
        }
    }

    /// Goes on from there: carried is not walked.
    pub(super) fn carry(&mut self, place: Point2<f64>) {
        self.last.1 = place;
    }

    /// m.
    pub(super) fn length(&self) -> f64 {
        self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swaying_is_no_way_and_carrying_neither() {
        let mut way = Way::new(Point2::origin());
        for cycle in 1..=1000 {
            let now = Timestamp::ZERO + Duration::from_millis(10 * cycle);
            // 0.2 m/s, swaying by 5 cm twice a second.
            let seconds = 0.01 * cycle as f64;
            let sway = 0.05 * (std::f64::consts::TAU * 2.0 * seconds).sin();
            way.go(now, Point2::new(0.2 * seconds, sway));
        }
        assert!((way.length() - 2.0).abs() < 1e-9, "{}", way.length());
        way.carry(Point2::new(7.0, 0.0));
        way.go(
            Timestamp::ZERO + Duration::from_secs(11),
            Point2::new(7.2, 0.0),
        );
        assert!((way.length() - 2.2).abs() < 1e-9, "{}", way.length());
    }
}
