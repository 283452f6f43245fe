//! One stride after the other.

use framework::{Clear, Reflect};
use kinematics::leg_angles;
use kinematics::links::LinkName;
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};
use types::feet::{Feet, Side};
use types::joints::{JointName, Joints};
use types::motion::Step;
use types::motor_commands::MotorCommands;

use crate::arms;
use crate::balance::Balance;
use crate::course::Course;
use crate::parameters::Parameters;
use crate::stride::{Sole, Stride, other, standing};

/// From the torso's origin down to the axis of the hips, in m (NAO V6 URDF).
const HIPS_BELOW_TORSO: f32 = -LinkName::LeftPelvis.origin()[2] as f32;

/// What the walk feels in one cycle.
#[derive(Clear, Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Senses {
    /// In s since the last cycle.
    pub since_last: f32,
    /// Of the body about x and y, in rad/s.
    pub angular_velocity: [f32; 2],
    /// Of the body about the vertical, against anything that does not turn, in rad.
    pub heading: f32,
    /// Share of the body's weight on each foot, 0 to 1.
    pub pressures: Feet<f32>,
}

/// Where the walk is.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct Engine {
    /// `None`: both feet stand side by side.
    stride: Option<Stride>,
    /// In s since the stride began.
    elapsed: f32,
    /// The step before this one.
    last: Step,
    course: Course,
    balance: Balance,
}

impl Engine {
    /// Standing.
    pub fn new() -> Self {
        Self::default()
    }

    /// Whether both feet stand side by side, where another motion can begin.
    pub fn is_standing(&self) -> bool {
        self.stride.is_none()
    }

    /// The stride that is under way.
    pub fn stride(&self) -> Option<&Stride> {
        self.stride.as_ref()
    }

    /// How long it has been under way, in s.
    pub fn elapsed(&self) -> f32 {
        self.elapsed
    }

    /// The foot that carries the body, while the other one swings.
    pub fn support(&self) -> Option<Side> {
        self.stride.map(|stride| stride.support)
    }

    /// Goes on by one cycle; without a wish to its stop, which takes a step or two.
    pub fn cycle(
        &mut self,
        wanted: Option<Step>,
        senses: &Senses,
        parameters: &Parameters,
    ) -> MotorCommands {
        self.balance.cycle(
            senses.angular_velocity,
            senses.since_last,
            &parameters.balance,
        );
        match self.stride {
            None => self.begin(wanted, parameters),
            Some(stride) => {
                self.elapsed += senses.since_last;
                let ends_standing = stride.end == standing(parameters);
                if wanted.is_none() && ends_standing && self.last == Step::ZERO {
                    self.stand(&stride);
                } else if is_done(self.elapsed, &stride, &senses.pressures, parameters) {
                    self.go_on(&stride, wanted, senses.heading, parameters);
                }
            }
        }
        self.commands(parameters)
    }

    /// The first step is one on the spot: weight must come to one foot before the other can go anywhere.
    fn begin(&mut self, wanted: Option<Step>, parameters: &Parameters) {
        let Some(wanted) = wanted else { return };
        // The next swing foot is the one that goes there.
        let support = if wanted.left < 0.0 {
            Side::Right
        } else {
            Side::Left
        };
        (self.last, self.course) = (Step::ZERO, Course::default());
        self.elapsed = 0.0;
        self.stride = Some(Stride::plan(
            standing(parameters),
            Step::ZERO,
            0.0,
            support,
            parameters,
        ));
    }

    /// Ends the last stride when both feet are down, whatever they feel.
    fn stand(&mut self, stride: &Stride) {
        if self.elapsed >= stride.duration {
            (self.stride, self.elapsed) = (None, 0.0);
        }
    }

    fn go_on(
        &mut self,
        stride: &Stride,
        wanted: Option<Step>,
        heading: f32,
        parameters: &Parameters,
    ) {
        let soles = stride.soles(self.elapsed);
        let support = other(stride.support);
        self.course
            .end_stride(stride.step.turn, heading, &parameters.course);
        let (step, turn) = match wanted {
            Some(wanted) => {
                let step = parameters.limits.apply(wanted, stride.step, support);
                (
                    step,
                    self.course.turn_of_feet(step.turn, &parameters.course),
                )
            }
            None => (Step::ZERO, 0.0),
        };
        self.last = stride.step;
        self.elapsed = 0.0;
        self.stride = Some(Stride::plan(soles, step, turn, support, parameters));
    }

    fn commands(&self, parameters: &Parameters) -> MotorCommands {
        let soles = match &self.stride {
            Some(stride) => stride.soles(self.elapsed),
            None => standing(parameters),
        };
        let mut positions = pose(&soles, parameters);
        self.balance_ankles(&mut positions);
        let stiffnesses = Joints::from_fn(|joint| match joint {
            _ if is_leg(joint) => parameters.leg_stiffness,
            _ => parameters.arms.stiffness,
        });
        MotorCommands {
            positions,
            stiffnesses,
        }
    }

    fn balance_ankles(&self, positions: &mut Joints<f32>) {
        let Balance { pitch, roll, .. } = self.balance;
        if self.support() != Some(Side::Right) {
            positions.left_ankle_pitch += pitch;
            positions.left_ankle_roll += roll;
        }
        if self.support() != Some(Side::Left) {
            positions.right_ankle_pitch += pitch;
            positions.right_ankle_roll += roll;
        }
    }
}

/// The pose in which a walk begins and ends, in rad.
pub fn standing_pose(parameters: &Parameters) -> Joints<f32> {
    pose(&standing(parameters), parameters)
}

fn pose(soles: &Feet<Sole>, parameters: &Parameters) -> Joints<f32> {
    let mut positions = Joints::default();
    arms::write(soles, &parameters.arms, &mut positions);
    let walk_to_torso = torso_to_walk(parameters).inverse();
    let soles_to_torso = soles.map(|sole| walk_to_torso * sole.to_walk());
    leg_angles(&soles_to_torso, 0.5).write_to(&mut positions);
    positions
}

/// Whether the swing foot carries, or should have long ago.
fn is_done(elapsed: f32, stride: &Stride, pressures: &Feet<f32>, parameters: &Parameters) -> bool {
    let timing = &parameters.stride;
    let stands = *pressures.on(other(stride.support)) > timing.contact_threshold;
    (stands && elapsed >= timing.earliest_contact) || elapsed >= timing.timeout
}

fn torso_to_walk(parameters: &Parameters) -> Isometry3<f32> {
    let hips_to_walk = Translation3::new(parameters.torso_offset, 0.0, parameters.hip_height);
    let tilt = UnitQuaternion::from_euler_angles(0.0, parameters.torso_tilt, 0.0);
    hips_to_walk * tilt * Translation3::new(0.0, 0.0, HIPS_BELOW_TORSO)
}

fn is_leg(joint: JointName) -> bool {
    let place = joint as usize;
    (JointName::HipYawPitch as usize..=JointName::RightAnkleRoll as usize).contains(&place)
}
