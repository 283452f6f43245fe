//! The numbers of the walk.

use framework::Reflect;
use serde::{Deserialize, Serialize};

use crate::step::StepLimits;

/// Everything that can be tuned.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    pub limits: StepLimits,
    pub stride: StrideParameters,
    pub course: CourseParameters,
    pub balance: BalanceParameters,
    pub arms: ArmParameters,
    /// From the soles up to the axis of the hips, in m.
    #[reflect(range = 0.001..)]
    pub hip_height: f32,
    /// The body stands so far in front of the middle between its feet, in m.
    pub torso_offset: f32,
    /// The body leans forward so much, in rad.
    pub torso_tilt: f32,
    /// From the middle to each foot, in m.
    #[reflect(range = 0.0..)]
    pub foot_offset: f32,
    /// Of the legs, 0 (limp) to 1.
    #[reflect(range = 0.0..=1.0)]
    pub leg_stiffness: f32,
}

/// How a foot goes from here to there.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct StrideParameters {
    /// In s, of a step on the spot.
    #[reflect(range = 0.001..)]
    pub duration: f32,
    /// In s per m of travel of the swing foot.
    #[reflect(range = 0.0..)]
    pub duration_per_meter: f32,
    /// In m: how high the swing foot is lifted in a step on the spot.
    #[reflect(range = 0.0..)]
    pub apex: f32,
    /// In m per m of travel of the swing foot.
    #[reflect(range = 0.0..)]
    pub apex_per_meter: f32,
    /// In s: a foot that feels the floor earlier has not left it yet.
    #[reflect(range = 0.0..)]
    pub earliest_contact: f32,
    /// Share of the body's weight from which on the swing foot stands, 0 to 1.
    #[reflect(range = 0.0..=1.0)]
    pub contact_threshold: f32,
    /// In s: without any contact the feet change roles after so long.
    #[reflect(range = 0.0..)]
    pub timeout: f32,
}

/// How the walk keeps to the turns that are wanted.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CourseParameters {
    /// Share of a turn of the feet that the body makes, greater than 0.
    #[reflect(range = 0.001..)]
    pub effect: f32,
    /// Share of what is owed that the next step makes good, 0 to 1.
    #[reflect(range = 0.0..=1.0)]
    pub gain: f32,
    /// In rad: more is not owed.
    #[reflect(range = 0.0..)]
    pub most: f32,
}

/// How the ankles answer the gyroscope.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BalanceParameters {
    /// Of the ankle's pitch, in rad per rad/s.
    #[reflect(range = 0.0..)]
    pub pitch_gain: f32,
    /// Of the ankle's roll, in rad per rad/s.
    #[reflect(range = 0.0..)]
    pub roll_gain: f32,
    /// Share of the newest value in the low-pass filter, 0 to 1.
    #[reflect(range = 0.0..=1.0)]
    pub newest: f32,
    /// In rad/s: no correction changes faster.
    #[reflect(range = 0.0..)]
    pub greatest_speed: f32,
}

/// What the arms do meanwhile.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ArmParameters {
    /// In rad: how far they are spread.
    pub roll: f32,
    /// In rad per m that the opposite foot is in front.
    pub swing: f32,
    /// 0 (limp) to 1.
    #[reflect(range = 0.0..=1.0)]
    pub stiffness: f32,
}
