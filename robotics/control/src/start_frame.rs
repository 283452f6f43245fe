//! Moves what was perceived at one time to where it is at another, by odometry.
//!
//! Filters keep places in the start frame, the ground frame of the first cycle: what lies still has
//! the same coordinates there however the robot moves, and rounding cannot add up.

use framework::{HistoricInput, Timestamp};
use nalgebra::Isometry2;
use types::odometry::Odometry;

/// From the ground frame at that time to the start frame, m and rad.
///
/// Before the history begins its oldest value stands in. `None` where odometry is no number.
pub(crate) fn ground_to_start(
    odometry: &HistoricInput<'_, &Odometry>,
    timestamp: Timestamp,
) -> Option<Isometry2<f32>> {
    let oldest = || odometry.iter().next().map(|(_, odometry)| odometry);
    let pose = odometry.get(timestamp).or_else(oldest)?.ground_to_start;
    let is_finite = pose.translation.vector.norm().is_finite() && pose.rotation.angle().is_finite();
    is_finite.then_some(pose)
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, history};

    use super::*;

    fn at(x: f32) -> Odometry {
        Odometry {
            ground_to_start: Isometry2::translation(x, 0.0),
        }
    }

    #[test]
    fn the_pose_is_that_of_the_time_or_of_the_oldest_time() {
        let (first, second, now) = (at(1.0), at(2.0), at(3.0));
        let past = [(at_millis(10), &first), (at_millis(20), &second)];
        let odometry = history(&past, at_millis(30), &now);
        for (millis, x) in [(5, 1.0), (10, 1.0), (25, 2.0), (30, 3.0), (99, 3.0)] {
            let pose = ground_to_start(&odometry, at_millis(millis)).unwrap();
            assert_eq!(pose.translation.x, x, "at {millis} ms");
        }
    }

    #[test]
    fn odometry_that_is_no_number_is_no_pose() {
        let broken = at(f32::NAN);
        let odometry = history(&[], at_millis(30), &broken);
        assert_eq!(ground_to_start(&odometry, at_millis(30)), None);
    }
}
