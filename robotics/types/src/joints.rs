//! Owns the names of the NAO's joints and `Joints`, one value for each.
//!
//! 25 joints, 26 axes: the legs share the motor of `HipYawPitch`. Order and names as in the
//! Aldebaran documentation of the NAO V6 (H25); all angles in radians, right-handed about the axes
//! x forward, y left, z up.

use std::ops::{Index, IndexMut};

use framework::{Clear, Reflect};
use serde::{Deserialize, Serialize};

pub use self::name::JointName;

mod name;

/// How many joints the robot has.
pub const JOINT_COUNT: usize = 25;

/// One value per joint, for example its angle in radians.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Joints<T> {
    /// Turns the head, positive to the left.
    pub head_yaw: T,
    /// Tilts the head, positive looks down.
    pub head_pitch: T,
    /// Swings the left arm, 0 points forward, positive down.
    pub left_shoulder_pitch: T,
    /// Spreads the left arm, positive to the left.
    pub left_shoulder_roll: T,
    /// Turns the left upper arm about its length.
    pub left_elbow_yaw: T,
    /// Bends the left elbow, 0 is stretched.
    pub left_elbow_roll: T,
    /// Turns the left hand about the forearm.
    pub left_wrist_yaw: T,
    /// The one motor that turns both legs about their diagonal hip axes, negative turns the toes out.
    pub hip_yaw_pitch: T,
    /// Swings the left leg sideways, positive to the left.
    pub left_hip_roll: T,
    /// Swings the left leg, negative forward.
    pub left_hip_pitch: T,
    /// Bends the left knee, positive is bent.
    pub left_knee_pitch: T,
    /// Tilts the left foot, negative lifts the toes.
    pub left_ankle_pitch: T,
    /// Tilts the left foot about its length.
    pub left_ankle_roll: T,
    /// Swings the right leg sideways, positive to the left.
    pub right_hip_roll: T,
    /// Swings the right leg, negative forward.
    pub right_hip_pitch: T,
    /// Bends the right knee, positive is bent.
    pub right_knee_pitch: T,
    /// Tilts the right foot, negative lifts the toes.
    pub right_ankle_pitch: T,
    /// Tilts the right foot about its length.
    pub right_ankle_roll: T,
    /// Swings the right arm, 0 points forward, positive down.
    pub right_shoulder_pitch: T,
    /// Spreads the right arm, positive to the left.
    pub right_shoulder_roll: T,
    /// Turns the right upper arm about its length.
    pub right_elbow_yaw: T,
    /// Bends the right elbow, 0 is stretched.
    pub right_elbow_roll: T,
    /// Turns the right hand about the forearm.
    pub right_wrist_yaw: T,
    /// Opens the left hand: 0 closed, 1 open (no angle).
    pub left_hand: T,
    /// Opens the right hand: 0 closed, 1 open (no angle).
    pub right_hand: T,
}

impl<T> Joints<T> {
    /// The same value for every joint.
    pub fn filled(value: T) -> Self
    where
        T: Copy,
    {
        Self::from_array([value; JOINT_COUNT])
    }

    /// Names and values in the order of [`JointName::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = (JointName, &T)> {
        JointName::ALL.into_iter().zip(self.each_ref())
    }

    /// Names and mutable values in the order of [`JointName::ALL`].
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (JointName, &mut T)> {
        JointName::ALL.into_iter().zip(self.each_mut())
    }

    /// Every joint's value from its name.
    pub fn from_fn(value: impl FnMut(JointName) -> T) -> Self {
        Self::from_array(JointName::ALL.map(value))
    }

    /// Every value changed by `change`.
    pub fn map<U>(self, change: impl FnMut(T) -> U) -> Joints<U> {
        Joints::from_array(self.to_array().map(change))
    }
}

impl<T> Index<JointName> for Joints<T> {
    type Output = T;

    fn index(&self, joint: JointName) -> &T {
        self.each_ref()[joint as usize]
    }
}

impl<T> IndexMut<JointName> for Joints<T> {
    fn index_mut(&mut self, joint: JointName) -> &mut T {
        self.each_mut()
            .into_iter()
            .nth(joint as usize)
            .expect("there is a value for every joint name")
    }
}

/// What needs the fields one by one, in the order of [`JointName::ALL`].
macro_rules! impl_arrays {
    ($($field:ident),* $(,)?) => {
        impl<T> Joints<T> {
            /// From values in the order of [`JointName::ALL`].
            pub fn from_array(values: [T; JOINT_COUNT]) -> Self {
                let [$($field),*] = values;
                Self { $($field),* }
            }

            /// The values in the order of [`JointName::ALL`].
            pub fn to_array(self) -> [T; JOINT_COUNT] {
                [$(self.$field),*]
            }

            /// References in the order of [`JointName::ALL`].
            pub fn each_ref(&self) -> [&T; JOINT_COUNT] {
                [$(&self.$field),*]
            }

            /// Mutable references in the order of [`JointName::ALL`].
            pub fn each_mut(&mut self) -> [&mut T; JOINT_COUNT] {
                [$(&mut self.$field),*]
            }
        }
    };
}

impl_arrays!(
    head_yaw,
    head_pitch,
    left_shoulder_pitch,
    left_shoulder_roll,
    left_elbow_yaw,
    left_elbow_roll,
    left_wrist_yaw,
    hip_yaw_pitch,
    left_hip_roll,
    left_hip_pitch,
    left_knee_pitch,
    left_ankle_pitch,
    left_ankle_roll,
    right_hip_roll,
    right_hip_pitch,
    right_knee_pitch,
    right_ankle_pitch,
    right_ankle_roll,
    right_shoulder_pitch,
    right_shoulder_roll,
    right_elbow_yaw,
    right_elbow_roll,
    right_wrist_yaw,
    left_hand,
    right_hand,
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fields_and_places_agree() {
        let places = Joints::from_fn(|joint| joint as usize);
        for (place, (joint, value)) in places.iter().enumerate() {
            assert_eq!((joint as usize, *value), (place, place));
            assert_eq!(places[joint], place);
        }
        assert_eq!(places.left_hand, 23);
        assert_eq!(places.right_ankle_roll, 17);
        assert_eq!(places.to_array()[7], places.hip_yaw_pitch);
    }

    #[test]
    fn writing_by_name_reaches_the_field() {
        let mut joints = Joints::filled(0.0);
        joints[JointName::RightKneePitch] = 1.5;
        assert_eq!(joints.right_knee_pitch, 1.5);
        assert_eq!(joints.map(|value| value * 2.0).right_knee_pitch, 3.0);
    }
}
