//! Owns which angles a motion's file may give each joint, in rad: those of `kinematics::limits`, rounded outwards to the
//! three digits of the files, so that `hulkgen check` sees what no joint can do.

use framework::Reflect;
use serde::{Deserialize, Serialize};

/// The head.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    /// Positive to the left.
    #[reflect(unit = "rad", range = -2.086..=2.086)]
    pub yaw: f32,
    /// Positive looks down. How far it goes depends on the yaw, which is judged where motions are read.
    #[reflect(unit = "rad", range = -0.672..=0.515)]
    pub pitch: f32,
}

/// The left arm.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LeftArm {
    /// 0 points forward, positive down.
    #[reflect(unit = "rad", range = -2.086..=2.086)]
    pub shoulder_pitch: f32,
    /// Positive to the left.
    #[reflect(unit = "rad", range = -0.315..=1.327)]
    pub shoulder_roll: f32,
    /// About the upper arm.
    #[reflect(unit = "rad", range = -2.086..=2.086)]
    pub elbow_yaw: f32,
    /// 0 is stretched.
    #[reflect(unit = "rad", range = -1.545..=-0.034)]
    pub elbow_roll: f32,
    /// About the forearm.
    #[reflect(unit = "rad", range = -1.824..=1.824)]
    pub wrist_yaw: f32,
}

/// The right arm.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RightArm {
    /// 0 points forward, positive down.
    #[reflect(unit = "rad", range = -2.086..=2.086)]
    pub shoulder_pitch: f32,
    /// Positive to the left.
    #[reflect(unit = "rad", range = -1.327..=0.315)]
    pub shoulder_roll: f32,
    /// About the upper arm.
    #[reflect(unit = "rad", range = -2.086..=2.086)]
    pub elbow_yaw: f32,
    /// 0 is stretched.
    #[reflect(unit = "rad", range = 0.034..=1.545)]
    pub elbow_roll: f32,
    /// About the forearm.
    #[reflect(unit = "rad", range = -1.824..=1.824)]
    pub wrist_yaw: f32,
}

/// The left leg without the motor that it shares with the right one.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LeftLeg {
    /// Positive to the left.
    #[reflect(unit = "rad", range = -0.380..=0.791)]
    pub hip_roll: f32,
    /// Negative forward.
    #[reflect(unit = "rad", range = -1.536..=0.484)]
    pub hip_pitch: f32,
    /// Positive is bent.
    #[reflect(unit = "rad", range = -0.093..=2.113)]
    pub knee_pitch: f32,
    /// Negative lifts the toes.
    #[reflect(unit = "rad", range = -1.190..=0.923)]
    pub ankle_pitch: f32,
    /// About the foot's length.
    #[reflect(unit = "rad", range = -0.398..=0.769)]
    pub ankle_roll: f32,
}

/// The right leg without the motor that it shares with the left one.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RightLeg {
    /// Positive to the left.
    #[reflect(unit = "rad", range = -0.791..=0.380)]
    pub hip_roll: f32,
    /// Negative forward.
    #[reflect(unit = "rad", range = -1.536..=0.484)]
    pub hip_pitch: f32,
    /// Positive is bent.
    #[reflect(unit = "rad", range = -0.093..=2.113)]
    pub knee_pitch: f32,
    /// Negative lifts the toes.
    #[reflect(unit = "rad", range = -1.187..=0.933)]
    pub ankle_pitch: f32,
    /// About the foot's length.
    #[reflect(unit = "rad", range = -0.769..=0.398)]
    pub ankle_roll: f32,
}
