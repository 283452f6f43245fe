//! Owns what the motors can do: their torque and their gears.

use types::joints::JointName;

/// The motor of one joint and its gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Torque at the joint with the motor at rest and a gear without losses, in N m.
    pub stall_torque: f64,
    /// Turns of the motor for one turn of the joint.
    pub gear_ratio: f64,
}

/// The motor of one joint (Aldebaran documentation: motors and gears of the H25; stall torques of the
/// NAO's model in Webots).
pub const fn of(joint: JointName) -> Motor {
    match joint {
        JointName::HeadYaw => motor(2.148861, 150.27),
        JointName::HeadPitch => motor(2.477046, 173.22),
        JointName::LeftShoulderPitch => motor(3.366048, 150.27),
        JointName::LeftShoulderRoll => motor(2.477046, 173.22),
        JointName::LeftElbowYaw => motor(2.148861, 150.27),
        JointName::LeftElbowRoll => motor(2.477046, 173.22),
        JointName::LeftWristYaw => motor(0.475734, 50.61),
        JointName::HipYawPitch => motor(13.0845, 201.3),
        JointName::LeftHipRoll => motor(13.0845, 201.3),
        JointName::LeftHipPitch => motor(8.50525, 130.85),
        JointName::LeftKneePitch => motor(8.50525, 130.85),
        JointName::LeftAnklePitch => motor(8.50525, 130.85),
        JointName::LeftAnkleRoll => motor(13.0845, 201.3),
        JointName::RightHipRoll => motor(13.0845, 201.3),
        JointName::RightHipPitch => motor(8.50525, 130.85),
        JointName::RightKneePitch => motor(8.50525, 130.85),
        JointName::RightAnklePitch => motor(8.50525, 130.85),
        JointName::RightAnkleRoll => motor(13.0845, 201.3),
        JointName::RightShoulderPitch => motor(3.366048, 150.27),
        JointName::RightShoulderRoll => motor(2.477046, 173.22),
        JointName::RightElbowYaw => motor(2.148861, 150.27),
        JointName::RightElbowRoll => motor(2.477046, 173.22),
        JointName::RightWristYaw => motor(0.475734, 50.61),
        JointName::LeftHand => motor(0.340656, 36.24),
        JointName::RightHand => motor(0.340656, 36.24),
    }
}

const fn motor(stall_torque: f64, gear_ratio: f64) -> Motor {
    Motor {
        stall_torque,
        gear_ratio,
    }
}
