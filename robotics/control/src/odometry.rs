//! Tells how the robot has moved over the ground, from its legs and from how its torso has turned.
//!
//! The supporting sole stays where it is: what moves against it moves over the ground. Between two
//! cycles the same sole counts in both, so that a change of sides is no movement. The heading comes
//! from the orientation alone, since soles slip when the robot turns but the gyroscope feels it.
//!
//! A gyroscope that scatters turns nothing: a robot is still while its soles rest against each other
//! and nothing rotates, and then neither place nor heading change at all. The price is that somebody
//! who turns a still robot more slowly than `odometry.still_rotation` is not noticed, nor how far
//! anybody slides or carries it.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context, math};
use nalgebra::{Isometry2, Isometry3, Point2, Rotation2, UnitQuaternion, Vector2, Vector3};
use serde::{Deserialize, Serialize};
use types::fall_state::FallState;
use types::feet::{Feet, Side};
use types::odometry::Odometry;
use types::robot_kinematics::RobotKinematics;
use types::sensor_data::InertialMeasurement;

use crate::angle::wrap;
use crate::level::torso_to_level;

/// Above this sine of its elevation the torso's x axis points to no direction on the ground.
const STEEPEST: f32 = 0.9;

/// Where the robot has got.
#[derive(Debug, Default, Deserialize, Serialize)]
pub struct OdometryProvider {
    /// Of the ground frame in the ground frame of the first cycle, in m.
    position: Point2<f32>,
    /// Likewise, in rad.
    heading: f32,
    last: Option<Stance>,
    rest: Rest,
}

/// How the robot stood in the cycle that was counted last.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Stance {
    /// In the ground frame, in m; `None` where no sole supported it.
    soles: Option<Feet<Vector2<f32>>>,
    /// Of the torso in the world, in rad.
    heading: f32,
}

/// Whether and for how long the robot has been still.
#[derive(Debug, Default, Deserialize, Serialize)]
struct Rest {
    /// The right sole in the frame of the left when they last moved.
    right_to_left: Option<Isometry3<f32>>,
    /// Since the last movement, in s; `None` before the first.
    duration: Option<f32>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    robot_kinematics: Input<RobotKinematics, "robot_kinematics">,
    support_side: Input<Option<Side>, "support_side?">,
    orientation: Input<UnitQuaternion<f32>, "orientation">,
    inertial: Input<InertialMeasurement, "sensor_data.inertial">,
    fall_state: Input<FallState, "fall_state">,
    cycle_time: CycleTime,

    /// How far the robot gets ahead, as a share of what the joints say.
    forward_scale: Parameter<f32, "odometry.forward_scale">,
    /// How far the robot gets to its sides, as a share of what the joints say.
    left_scale: Parameter<f32, "odometry.left_scale">,
    /// Soles that move less against each other are still.
    #[reflect(unit = "m", range = 0.0..)]
    still_distance: Parameter<f32, "odometry.still_distance">,
    /// Soles that turn less against each other are still.
    #[reflect(unit = "rad")]
    still_angle: Parameter<f32, "odometry.still_angle">,
    /// A torso that turns more slowly is still.
    #[reflect(unit = "rad/s", range = 0.0..)]
    still_rotation: Parameter<f32, "odometry.still_rotation">,
    /// A robot that has been still for so long stands.
    #[reflect(unit = "s", range = 0.0..)]
    still_time: Parameter<f32, "odometry.still_time">,
}

#[context]
pub struct MainOutputs {
    /// Where the robot is, seen from where it was first.
    odometry: MainOutput<Odometry>,
}

impl OdometryProvider {
    /// Where it starts is the origin.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self::default())
    }

    /// Counts what has changed since the cycle that was counted last.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        self.rest.update(&context);
        if let Some(stance) = stance(&context) {
            self.advance(stance, &context);
        }
        let ground_to_start = Isometry2::new(self.position.coords, self.heading);
        Ok(MainOutputs {
            odometry: Odometry { ground_to_start }.into(),
        })
    }

    fn advance(&mut self, stance: Stance, context: &CycleContext) {
        let Some(last) = &mut self.last else {
            self.last = Some(stance);
            return;
        };
        let rest = self.rest.duration;
        if rest.is_none_or(|duration| duration >= *context.still_time) {
            // What turned meanwhile is noise. What the soles have moved is counted when they move on.
            last.heading = stance.heading;
            return;
        }
        let turn = wrap(stance.heading - last.heading);
        let moved = match (context.support_side, last.soles, stance.soles) {
            (Some(side), Some(before), Some(now)) => {
                before.on(*side) - Rotation2::new(turn) * now.on(*side)
            }
            _ => Vector2::zeros(),
        };
        let scale = Vector2::new(*context.forward_scale, *context.left_scale);
        let moved = Rotation2::new(self.heading) * moved.component_mul(&scale);
        self.last = Some(stance);
        if moved.iter().all(|component| component.is_finite()) {
            self.position += moved;
            self.heading = wrap(self.heading + turn);
        }
    }
}

impl Rest {
    fn update(&mut self, context: &CycleContext) {
        let Feet { left, right } = context.robot_kinematics.soles_to_torso;
        let right_to_left = left.inv_mul(&right);
        let reference = *self.right_to_left.get_or_insert(right_to_left);
        let change = reference.inv_mul(&right_to_left);
        let soles_rest = change.translation.vector.norm() <= *context.still_distance
            && change.rotation.angle() <= *context.still_angle;
        if !soles_rest {
            self.right_to_left = Some(right_to_left);
        }
        if !soles_rest || context.inertial.gyroscope.norm() > *context.still_rotation {
            self.duration = Some(0.0);
        } else if let Some(duration) = &mut self.duration {
            *duration += context.cycle_time.since_last.as_secs_f32();
        }
    }
}

/// How the robot stands; `None` where it has no heading, and where a sensor sent no numbers.
fn stance(context: &CycleContext) -> Option<Stance> {
    let ahead = context.orientation * Vector3::x();
    let heading = math::atan2(ahead.y, ahead.x);
    let stands = context.support_side.is_some()
        && matches!(
            context.fall_state,
            FallState::Upright | FallState::Falling(_)
        );
    let soles = stands.then(|| soles_to_ground(context.robot_kinematics, context.orientation));
    let is_number = soles.is_none_or(|soles| soles.left.iter().all(|place| place.is_finite()));
    (ahead.z.abs() < STEEPEST && heading.is_finite() && is_number)
        .then_some(Stance { soles, heading })
}

/// Where the soles are in the ground frame: level, midway between them, x along the heading.
fn soles_to_ground(
    kinematics: &RobotKinematics,
    torso_to_world: &UnitQuaternion<f32>,
) -> Feet<Vector2<f32>> {
    let level = torso_to_level(torso_to_world);
    let Feet { left, right } = kinematics.soles_to_torso;
    let to_left = level * (left.translation.vector - right.translation.vector) / 2.0;
    Feet {
        left: to_left.xy(),
        right: -to_left.xy(),
    }
}

#[cfg(test)]
mod tests;
