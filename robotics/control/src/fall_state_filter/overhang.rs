//! Owns how far the centre of mass hangs over the outline of the soles.

use std::f32::consts::TAU;

use framework::math;
use kinematics::feet::sole_outline;
use nalgebra::{Point3, UnitQuaternion, Vector2};
use types::fall_state::FallDirection;
use types::feet::Side;
use types::robot_kinematics::RobotKinematics;

use crate::level::torso_to_level;

/// From so many directions the outline is looked at; what lies between two is seen 0.5 % too short.
const DIRECTIONS: u8 = 32;

/// How far the centre of mass is outside of the convex outline of both soles, seen along gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Overhang {
    /// In m; negative inside.
    pub(super) distance: f32,
    /// Across the edge, in a level frame with x along the robot's heading; a unit vector.
    pub(super) outward: Vector2<f32>,
}

impl Overhang {
    /// Over which edge.
    pub(super) fn direction(&self) -> FallDirection {
        let [x, y] = self.outward.into();
        match x.abs() >= y.abs() {
            true if x >= 0.0 => FallDirection::Forward,
            true => FallDirection::Backward,
            false if y >= 0.0 => FallDirection::Left,
            false => FallDirection::Right,
        }
    }
}

/// Looks for the edge beyond which the centre of mass is farthest, or to which it is nearest.
pub(super) fn overhang(
    torso_to_world: &UnitQuaternion<f32>,
    kinematics: &RobotKinematics,
    center_of_mass: &Point3<f32>,
) -> Overhang {
    let level = torso_to_level(torso_to_world);
    let center = (level * center_of_mass).xy();
    let soles = [Side::Left, Side::Right].map(|side| {
        let sole_to_level = level * kinematics.soles_to_torso.on(side);
        sole_outline(side).map(|corner| (sole_to_level * corner).xy() - center)
    });
    let farthest = (0..DIRECTIONS)
        .map(|index| {
            let angle = TAU * f32::from(index) / f32::from(DIRECTIONS);
            let outward = Vector2::new(math::cos(angle), math::sin(angle));
            let corners = soles.as_flattened().iter();
            let edge = corners.map(|corner| corner.dot(&outward));
            (-edge.fold(f32::NEG_INFINITY, f32::max), outward)
        })
        .max_by(|(one, _), (other, _)| one.total_cmp(other));
    let (distance, outward) = farthest.expect("there is more than one direction");
    Overhang { distance, outward }
}

#[cfg(test)]
mod tests {
    use kinematics::forward_kinematics;
    use types::joints::Joints;

    use super::*;

    fn overhang_at(roll: f32, pitch: f32, center_of_mass: Point3<f32>) -> Overhang {
        let poses = forward_kinematics(&Joints::filled(0.0));
        let orientation = UnitQuaternion::from_euler_angles(roll, pitch, 1.0);
        overhang(
            &orientation,
            &RobotKinematics::from(&poses),
            &center_of_mass,
        )
    }

    #[test]
    fn every_edge_of_the_soles_is_where_the_manufacturer_put_it() {
        let over = |x, y| overhang_at(0.0, 0.0, Point3::new(x, y, 0.0));
        let edges = [
            (over(0.2, 0.0), 0.1, FallDirection::Forward),
            (over(-0.2, 0.0), 0.15, FallDirection::Backward),
            (over(0.0, 0.2), 0.1, FallDirection::Left),
            (over(0.0, -0.2), 0.1, FallDirection::Right),
        ];
        for (overhang, distance, direction) in edges {
            assert!((overhang.distance - distance).abs() < 3e-3, "{overhang:?}");
            assert_eq!(overhang.direction(), direction);
        }
    }

    #[test]
    fn between_the_feet_is_inside() {
        let inside = overhang_at(0.0, 0.0, Point3::new(0.02, 0.0, 0.0));
        assert!(inside.distance < -0.05, "{inside:?}");
    }

    #[test]
    fn a_robot_that_leans_far_enough_hangs_over_whatever_its_heading_is() {
        let center = Point3::new(0.02, 0.0, -0.03);
        let ahead = overhang_at(0.0, 0.4, center);
        assert_eq!(ahead.direction(), FallDirection::Forward);
        assert!(ahead.distance > 0.02, "{ahead:?}");
        let right = overhang_at(0.6, 0.0, center);
        assert_eq!(right.direction(), FallDirection::Right);
        assert!(right.distance > 0.02, "{right:?}");
    }

    #[test]
    fn what_is_no_number_is_survived() {
        overhang_at(f32::NAN, 0.0, Point3::new(f32::NAN, 0.0, 0.0));
    }
}
