//! How often a foot has come to the ball.

use nalgebra::Point2;

use crate::referee::TOUCH;

/// Farther away, m, it has been left.
const LEFT: f64 = 0.25;

/// The contacts of one robot.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Contacts {
    is_near: bool,
    count: u64,
}

impl Contacts {
    /// Where the ball and the middles of the soles are now, m.
    pub(super) fn look(&mut self, ball: Option<Point2<f64>>, soles: [Point2<f64>; 2]) {
        let distance = ball.map_or(f64::INFINITY, |ball| {
            let [left, right] = soles.map(|sole| (sole - ball).norm());
            left.min(right)
        });
        let was_near = self.is_near;
        self.is_near = distance < if was_near { LEFT } else { TOUCH };
        self.count += u64::from(self.is_near && !was_near);
    }

    pub(super) fn count(&self) -> u64 {
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_that_stays_at_the_feet_is_one_contact() {
        let mut contacts = Contacts::default();
        let soles = [Point2::new(0.0, 0.05), Point2::new(0.0, -0.05)];
        for (ahead, count) in [(0.5, 0), (0.14, 1), (0.2, 1), (0.14, 1), (0.3, 1), (0.1, 2)] {
            contacts.look(Some(Point2::new(ahead, 0.05)), soles);
            assert_eq!(contacts.count(), count, "{ahead}");
        }
        contacts.look(None, soles);
        assert_eq!(contacts.count(), 2);
    }
}
