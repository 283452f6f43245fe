//! Owns the names of the joints and what follows from a name alone.

use framework::Reflect;
use serde::{Deserialize, Serialize};

use super::JOINT_COUNT;

/// A joint of the NAO; `as usize` is its place in LoLA's arrays.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    Deserialize,
    Eq,
    Hash,
    Ord,
    PartialEq,
    PartialOrd,
    Reflect,
    Serialize,
)]
pub enum JointName {
    #[default]
    /// Turns the head, positive to the left.
    HeadYaw,
    /// Tilts the head, positive looks down.
    HeadPitch,
    /// Swings the left arm, 0 points forward, positive down.
    LeftShoulderPitch,
    /// Spreads the left arm, positive to the left.
    LeftShoulderRoll,
    /// Turns the left upper arm about its length.
    LeftElbowYaw,
    /// Bends the left elbow, 0 is stretched.
    LeftElbowRoll,
    /// Turns the left hand about the forearm.
    LeftWristYaw,
    /// The one motor that turns both legs about their diagonal hip axes, negative turns the toes out.
    HipYawPitch,
    /// Swings the left leg sideways, positive to the left.
    LeftHipRoll,
    /// Swings the left leg, negative forward.
    LeftHipPitch,
    /// Bends the left knee, positive is bent.
    LeftKneePitch,
    /// Tilts the left foot, negative lifts the toes.
    LeftAnklePitch,
    /// Tilts the left foot about its length.
    LeftAnkleRoll,
    /// Swings the right leg sideways, positive to the left.
    RightHipRoll,
    /// Swings the right leg, negative forward.
    RightHipPitch,
    /// Bends the right knee, positive is bent.
    RightKneePitch,
    /// Tilts the right foot, negative lifts the toes.
    RightAnklePitch,
    /// Tilts the right foot about its length.
    RightAnkleRoll,
    /// Swings the right arm, 0 points forward, positive down.
    RightShoulderPitch,
    /// Spreads the right arm, positive to the left.
    RightShoulderRoll,
    /// Turns the right upper arm about its length.
    RightElbowYaw,
    /// Bends the right elbow, 0 is stretched.
    RightElbowRoll,
    /// Turns the right hand about the forearm.
    RightWristYaw,
    /// Opens the left hand: 0 closed, 1 open (no angle).
    LeftHand,
    /// Opens the right hand: 0 closed, 1 open (no angle).
    RightHand,
}

impl JointName {
    /// Whether it moves a leg.
    pub const fn is_of_leg(self) -> bool {
        let joint = self as usize;
        Self::HipYawPitch as usize <= joint && joint <= Self::RightAnkleRoll as usize
    }

    /// All joints in LoLA's order.
    pub const ALL: [Self; JOINT_COUNT] = [
        Self::HeadYaw,
        Self::HeadPitch,
        Self::LeftShoulderPitch,
        Self::LeftShoulderRoll,
        Self::LeftElbowYaw,
        Self::LeftElbowRoll,
        Self::LeftWristYaw,
        Self::HipYawPitch,
        Self::LeftHipRoll,
        Self::LeftHipPitch,
        Self::LeftKneePitch,
        Self::LeftAnklePitch,
        Self::LeftAnkleRoll,
        Self::RightHipRoll,
        Self::RightHipPitch,
        Self::RightKneePitch,
        Self::RightAnklePitch,
        Self::RightAnkleRoll,
        Self::RightShoulderPitch,
        Self::RightShoulderRoll,
        Self::RightElbowYaw,
        Self::RightElbowRoll,
        Self::RightWristYaw,
        Self::LeftHand,
        Self::RightHand,
    ];

    /// The name in the Aldebaran documentation, for example `LShoulderPitch`.
    pub const fn manufacturer_name(self) -> &'static str {
        match self {
            Self::HeadYaw => "HeadYaw",
            Self::HeadPitch => "HeadPitch",
            Self::LeftShoulderPitch => "LShoulderPitch",
            Self::LeftShoulderRoll => "LShoulderRoll",
            Self::LeftElbowYaw => "LElbowYaw",
            Self::LeftElbowRoll => "LElbowRoll",
            Self::LeftWristYaw => "LWristYaw",
            Self::HipYawPitch => "LHipYawPitch",
            Self::LeftHipRoll => "LHipRoll",
            Self::LeftHipPitch => "LHipPitch",
            Self::LeftKneePitch => "LKneePitch",
            Self::LeftAnklePitch => "LAnklePitch",
            Self::LeftAnkleRoll => "LAnkleRoll",
            Self::RightHipRoll => "RHipRoll",
            Self::RightHipPitch => "RHipPitch",
            Self::RightKneePitch => "RKneePitch",
            Self::RightAnklePitch => "RAnklePitch",
            Self::RightAnkleRoll => "RAnkleRoll",
            Self::RightShoulderPitch => "RShoulderPitch",
            Self::RightShoulderRoll => "RShoulderRoll",
            Self::RightElbowYaw => "RElbowYaw",
            Self::RightElbowRoll => "RElbowRoll",
            Self::RightWristYaw => "RWristYaw",
            Self::LeftHand => "LHand",
            Self::RightHand => "RHand",
        }
    }

    /// The joint on the other side; joints in the middle are their own.
    pub const fn mirrored(self) -> Self {
        match self {
            Self::HeadYaw | Self::HeadPitch | Self::HipYawPitch => self,
            Self::LeftShoulderPitch => Self::RightShoulderPitch,
            Self::LeftShoulderRoll => Self::RightShoulderRoll,
            Self::LeftElbowYaw => Self::RightElbowYaw,
            Self::LeftElbowRoll => Self::RightElbowRoll,
            Self::LeftWristYaw => Self::RightWristYaw,
            Self::LeftHipRoll => Self::RightHipRoll,
            Self::LeftHipPitch => Self::RightHipPitch,
            Self::LeftKneePitch => Self::RightKneePitch,
            Self::LeftAnklePitch => Self::RightAnklePitch,
            Self::LeftAnkleRoll => Self::RightAnkleRoll,
            Self::RightHipRoll => Self::LeftHipRoll,
            Self::RightHipPitch => Self::LeftHipPitch,
            Self::RightKneePitch => Self::LeftKneePitch,
            Self::RightAnklePitch => Self::LeftAnklePitch,
            Self::RightAnkleRoll => Self::LeftAnkleRoll,
            Self::RightShoulderPitch => Self::LeftShoulderPitch,
            Self::RightShoulderRoll => Self::LeftShoulderRoll,
            Self::RightElbowYaw => Self::LeftElbowYaw,
            Self::RightElbowRoll => Self::LeftElbowRoll,
            Self::RightWristYaw => Self::LeftWristYaw,
            Self::LeftHand => Self::RightHand,
            Self::RightHand => Self::LeftHand,
        }
    }

    /// Whether the joint is one of the two of the head.
    pub const fn is_head(self) -> bool {
        matches!(self, Self::HeadYaw | Self::HeadPitch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirroring_twice_gives_the_same_joint() {
        for joint in JointName::ALL {
            assert_eq!(joint.mirrored().mirrored(), joint);
        }
        assert_eq!(JointName::LeftElbowYaw.mirrored(), JointName::RightElbowYaw);
    }
}
