//! What the sonars hear: the nearest thing in front of each receiver.

use std::f64::consts::FRAC_PI_6;

use framework::math;
use nalgebra::{Isometry3, Point2, Point3, Vector3};
use types::sensor_data::Sonar;

/// What the sonars report where nothing reflects, m.
pub(crate) const NO_ECHO: f32 = 5.0;
/// Where the left receiver sits in the torso frame, m, and where it points, rad; the right one is its
/// mirror image (Aldebaran's model of the V6).
const PLACE: [f64; 3] = [0.00558, 0.01921, 0.06239];
const YAW: f64 = 0.3924;
/// Half the cone that is heard, rad (Aldebaran documentation: 60° together).
const HALF_CONE: f64 = FRAC_PI_6;
/// The greatest distance with an echo, m (Aldebaran documentation).
const GREATEST: f64 = 2.55;
/// Steps of distances, m (Aldebaran documentation: 1 cm).
const STEP: f64 = 0.01;

/// What both receivers of a torso hear of these obstacles: their middles in the field frame and their
/// radii, m.
pub(super) fn echoes(
    torso_to_field: &Isometry3<f64>,
    obstacles: impl Iterator<Item = (Point2<f64>, f64)> + Clone,
) -> Sonar {
    let receiver = |mirror: f64| {
        let [x, y, z] = PLACE;
        let place = torso_to_field * Point3::new(x, mirror * y, z);
        let yaw = mirror * YAW;
        let direction = torso_to_field.rotation * Vector3::new(math::cos(yaw), math::sin(yaw), 0.0);
        // Who leans too far hears the floor or nothing.
        if direction.z.abs() > math::sin(HALF_CONE) {
            return NO_ECHO;
        }
        let heading = math::atan2(direction.y, direction.x);
        let nearest = obstacles
            .clone()
            .filter_map(|obstacle| distance(place.xy(), heading, obstacle))
            .fold(f64::INFINITY, f64::min);
        if nearest > GREATEST {
            NO_ECHO
        } else {
            ((nearest / STEP).round() * STEP) as f32
        }
    };
    Sonar {
        left: receiver(1.0),
        right: receiver(-1.0),
    }
}

/// The distance to the part of an obstacle that is in the cone, if one is.
fn distance(from: Point2<f64>, heading: f64, (center, radius): (Point2<f64>, f64)) -> Option<f64> {
    let offset = center - from;
    let distance = offset.norm();
    if distance <= radius {
        return Some(0.0);
    }
    let half_width = math::asin(radius / distance);
    let bearing = math::atan2(offset.y, offset.x) - heading;
    let off_axis = math::atan2(math::sin(bearing), math::cos(bearing)).abs();
    (off_axis - half_width <= HALF_CONE).then_some(distance - radius)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    /// What a robot at (1, 2) hears that looks along y.
    fn hear(forward: f64, left: f64, pitch: f64) -> Sonar {
        let turn = nalgebra::UnitQuaternion::from_euler_angles(0.0, pitch, FRAC_PI_2);
        let torso = Isometry3::from_parts(nalgebra::Translation3::new(1.0, 2.0, 0.3), turn);
        let obstacle = (Point2::new(1.0 - left, 2.0 + forward), 0.1);
        echoes(&torso, std::iter::once(obstacle))
    }

    #[test]
    fn what_stands_ahead_is_heard_on_both_sides() {
        let sonar = hear(0.6, 0.0, 0.0);
        for distance in [sonar.left, sonar.right] {
            assert!((distance - 0.5).abs() < 0.011, "{distance}");
        }
    }

    #[test]
    fn what_stands_on_the_left_is_heard_on_the_left() {
        let sonar = hear(0.6, 0.5, 0.0);
        assert!((sonar.left - 0.67).abs() < 0.02, "{}", sonar.left);
        assert_eq!(sonar.right, NO_ECHO);
    }

    #[test]
    fn nothing_behind_or_far_away_is_heard_nor_anything_while_lying() {
        for (forward, left, pitch) in [(-0.6, 0.0, 0.0), (2.9, 0.0, 0.0), (0.6, 0.0, 1.5)] {
            let sonar = hear(forward, left, pitch);
            assert_eq!((sonar.left, sonar.right), (NO_ECHO, NO_ECHO));
        }
    }
}
