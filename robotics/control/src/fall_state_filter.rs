//! Tells whether the robot stands, sits, falls, or lies, so that it protects itself and gets up.
//!
//! It falls when the torso tilts beyond what comes back, or when it tilts and the centre of mass
//! has left the outline of the soles. Gravity, smoothed, tells how it lies in the end.

use framework::{AdditionalOutput, CycleTime, Input, MainOutput, Parameter, Reflect, math};
use framework::{Result, Timestamp, context};
use kinematics::inertial::GRAVITY;
use nalgebra::{Point3, UnitQuaternion, Vector2, Vector3};
use serde::{Deserialize, Serialize};
use types::fall_state::{Facing, FallDirection, FallState};
use types::joints::Joints;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::InertialMeasurement;

use self::overhang::overhang;
use crate::hysteresis::exceeds;
use crate::low_pass::LowPass;

mod overhang;

/// What was decided so far.
#[derive(Debug, Deserialize, Serialize)]
pub struct FallStateFilter {
    state: FallState,
    since: Timestamp,
    acceleration: LowPass<Vector3<f32>>,
}

/// How far the torso may tilt without falling, all in rad.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TiltLimits {
    /// Towards the face.
    pub forward: f32,
    /// Towards the back.
    pub backward: f32,
    /// Towards either arm.
    pub sideways: f32,
    /// By how much less it tilts when it is upright again.
    pub hysteresis: f32,
}

/// How the robot sits, all in rad.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sitting {
    /// Of the torso, negative leans back.
    pub pitch: f32,
    /// Of both hips.
    pub hip_pitch: f32,
    /// Of both knees.
    pub knee_pitch: f32,
    /// Of both ankles.
    pub ankle_pitch: f32,
    /// How far the legs may be from that: root of the sum of squares over both legs.
    pub legs_deviation: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    inertial: Input<InertialMeasurement, "sensor_data.inertial">,
    orientation: Input<UnitQuaternion<f32>, "orientation">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    robot_kinematics: Input<RobotKinematics, "robot_kinematics">,
    center_of_mass: Input<Point3<f32>, "center_of_mass">,
    has_ground_contact: Input<bool, "has_ground_contact">,
    cycle_time: CycleTime,

    /// Beyond these the robot falls.
    tilt: Parameter<TiltLimits, "fall_state_filter.tilt">,
    /// How far the centre of mass must be outside of the soles for a fall.
    #[reflect(unit = "m", range = 0.0..)]
    overhang: Parameter<f32, "fall_state_filter.overhang">,
    /// How fast the torso must tilt for a fall over the edge of the soles.
    #[reflect(unit = "rad/s", range = 0.0..)]
    tilting_rotation: Parameter<f32, "fall_state_filter.tilting_rotation">,
    /// How slowly the smoothed acceleration follows.
    #[reflect(unit = "s", range = 0.0..)]
    acceleration_time: Parameter<f32, "fall_state_filter.acceleration_time">,
    /// How far the smoothed acceleration may be from that of a robot that lies or sits.
    #[reflect(unit = "m/s²", range = 0.0..)]
    resting_deviation: Parameter<f32, "fall_state_filter.resting_deviation">,
    /// How the robot sits.
    sitting: Parameter<Sitting, "fall_state_filter.sitting">,
    /// After so long a fall is over, whatever the sensors say.
    #[reflect(unit = "s", range = 0.0..)]
    longest_fall: Parameter<f32, "fall_state_filter.longest_fall">,

    /// In m: how far the centre of mass is outside of the soles; negative inside of them.
    center_of_mass_overhang: AdditionalOutput<f32, "fall_state_filter.center_of_mass_overhang">,
}

#[context]
pub struct MainOutputs {
    /// How the torso stands or lies.
    fall_state: MainOutput<FallState>,
}

impl FallStateFilter {
    /// Upright until something else is felt.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            state: FallState::Upright,
            since: Timestamp::ZERO,
            acceleration: LowPass::default(),
        })
    }

    /// Looks for rest first, then for a fall.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let acceleration = self.acceleration.update(
            context.inertial.accelerometer,
            context.cycle_time.since_last.as_secs_f32(),
            *context.acceleration_time,
        );
        let state = self.next(&mut context, acceleration);
        if state != self.state {
            self.state = state;
            self.since = context.cycle_time.start;
        }
        Ok(MainOutputs {
            fall_state: state.into(),
        })
    }

    fn next(&self, context: &mut CycleContext, acceleration: Vector3<f32>) -> FallState {
        let has_fallen = self.state != FallState::Upright;
        let tilting_to = context.tilts_beyond_limits(has_fallen);
        let falling_to = context.falls_over_edge();
        let falls = matches!(self.state, FallState::Falling(_));
        let falls_too_long = falls && self.lasts_too_long(context);
        if context.sits(acceleration) {
            return FallState::Sitting;
        }
        match (tilting_to, context.lies(acceleration)) {
            (Some(_), Some(facing)) => FallState::Lying(facing),
            (Some(_), None) if falls_too_long => FallState::Lying(facing(acceleration)),
            (Some(direction), None) => match self.state {
                FallState::Upright | FallState::Sitting => FallState::Falling(direction),
                falling_or_lying => falling_or_lying,
            },
            (None, _) if falls_too_long => FallState::Upright,
            (None, _) => match falling_to {
                Some(_) if falls => self.state,
                Some(direction) => FallState::Falling(direction),
                None => FallState::Upright,
            },
        }
    }

    fn lasts_too_long(&self, context: &CycleContext) -> bool {
        // What is no number, and what is infinite, is no end.
        (context.cycle_time.start - self.since).as_secs_f32() >= *context.longest_fall
    }
}

impl CycleContext<'_> {
    /// Where the torso tilts to beyond its limits; while `has_fallen`, the limits are narrower.
    fn tilts_beyond_limits(&self, has_fallen: bool) -> Option<FallDirection> {
        let limits = self.tilt;
        let up = self.orientation.inverse() * Vector3::z();
        // How far, up to upside down, and to where.
        let aside = up.xy().norm();
        let share = math::atan2(aside, up.z) / aside.max(f32::EPSILON);
        let (forward, right) = (-up.x * share, up.y * share);
        let excesses = [
            (forward - limits.forward, FallDirection::Forward),
            (-forward - limits.backward, FallDirection::Backward),
            (-right - limits.sideways, FallDirection::Left),
            (right - limits.sideways, FallDirection::Right),
        ];
        let (_, direction) = excesses
            .into_iter()
            .filter(|(excess, _)| exceeds(*excess, 0.0, limits.hysteresis, has_fallen))
            .max_by(|(one, _), (other, _)| one.total_cmp(other))?;
        // Sitting down and getting up from there are slow, low, and done on purpose.
        let sits_back = direction == FallDirection::Backward && self.folds_legs();
        (!sits_back || up.z < 0.0).then_some(direction)
    }

    /// Over which edge of the soles the robot tilts, its centre of mass outside already.
    fn falls_over_edge(&mut self) -> Option<FallDirection> {
        let overhang = overhang(self.orientation, self.robot_kinematics, self.center_of_mass);
        self.center_of_mass_overhang
            .fill_if_subscribed(|| overhang.distance);
        let gyroscope = self.inertial.gyroscope;
        let rotation = overhang
            .outward
            .dot(&Vector2::new(gyroscope.y, -gyroscope.x));
        let falls = *self.has_ground_contact
            && rotation > *self.tilting_rotation
            && overhang.distance > *self.overhang;
        falls.then_some(overhang.direction())
    }

    /// On which side gravity says that the robot lies.
    fn lies(&self, acceleration: Vector3<f32>) -> Option<Facing> {
        let facing = facing(acceleration);
        let ahead = match facing {
            Facing::Down => -GRAVITY,
            Facing::Up => GRAVITY,
        };
        let deviation = (acceleration - Vector3::x() * ahead as f32).norm();
        (deviation < *self.resting_deviation).then_some(facing)
    }

    fn sits(&self, acceleration: Vector3<f32>) -> bool {
        let (sine, cosine) = math::sin_cos(self.sitting.pitch);
        let expected = Vector3::new(-sine, 0.0, cosine) * GRAVITY as f32;
        let deviation = (acceleration - expected).norm();
        // A robot that squats upright has its legs folded, too, even before its soles feel anything.
        let leans_back = acceleration.x > expected.x / 2.0;
        let rests = leans_back && deviation < *self.resting_deviation;
        rests && !self.has_ground_contact && self.folds_legs()
    }

    fn folds_legs(&self) -> bool {
        let joints = self.positions;
        let hips = [joints.left_hip_pitch, joints.right_hip_pitch];
        let knees = [joints.left_knee_pitch, joints.right_knee_pitch];
        let ankles = [joints.left_ankle_pitch, joints.right_ankle_pitch];
        let sitting = self.sitting;
        let squares = |angles: [f32; 2], expected: f32| {
            angles
                .map(|angle| math::powi(angle - expected, 2))
                .iter()
                .sum::<f32>()
        };
        let sum = squares(hips, sitting.hip_pitch)
            + squares(knees, sitting.knee_pitch)
            + squares(ankles, sitting.ankle_pitch);
        sum.sqrt() < sitting.legs_deviation
    }
}

/// What the face points to more: gravity pulls a robot that lies on its back to its back.
fn facing(acceleration: Vector3<f32>) -> Facing {
    if acceleration.x > 0.0 {
        Facing::Up
    } else {
        Facing::Down
    }
}

#[cfg(test)]
mod tests;
