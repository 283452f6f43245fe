//! Owns where the robot's parts are, as the joint angles say.

use framework::{Clear, Reflect};
use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};

use crate::feet::Feet;

/// Poses in the torso frame (origin between the shoulders, 0.085 m above the hip axis).
///
/// `part_to_torso * point_in_part` is the point in the torso frame.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct RobotKinematics {
    /// The head after both its joints, origin in the neck.
    pub head_to_torso: Isometry3<f32>,
    /// The soles: on the ground below the ankle.
    pub soles_to_torso: Feet<Isometry3<f32>>,
    /// The tibiae, origin in the knee.
    pub knees_to_torso: Feet<Isometry3<f32>>,
    /// The forearms, origin in the elbow.
    pub elbows_to_torso: Hands<Isometry3<f32>>,
    /// The centres of the hands.
    pub hands_to_torso: Hands<Isometry3<f32>>,
}

/// One value for each hand.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Hands<T> {
    /// Of the left hand.
    pub left: T,
    /// Of the right hand.
    pub right: T,
}
