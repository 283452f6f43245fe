//! Owns what is left of an orientation where the heading of the robot stays ahead.

use nalgebra::UnitQuaternion;

/// From the torso frame to a level frame whose x axis is the torso's heading: roll and pitch alone.
pub(crate) fn torso_to_level(torso_to_world: &UnitQuaternion<f32>) -> UnitQuaternion<f32> {
    let (roll, pitch, _) = torso_to_world.euler_angles();
    UnitQuaternion::from_euler_angles(roll, pitch, 0.0)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn the_heading_is_gone_and_what_is_up_stays_up() {
        let torso_to_world = UnitQuaternion::from_euler_angles(0.3, -0.4, 2.0);
        let level = torso_to_level(&torso_to_world);
        let (roll, pitch, yaw) = level.euler_angles();
        assert!((roll - 0.3).abs() < 1e-5 && (pitch + 0.4).abs() < 1e-5);
        assert!(yaw.abs() < 1e-5, "{yaw}");
        let up = torso_to_world.inverse() * Vector3::z();
        assert!((level * up - Vector3::z()).norm() < 1e-5);
    }
}
