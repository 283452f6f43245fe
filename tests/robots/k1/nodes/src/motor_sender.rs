//! Puts together what standing, head and arms want, and tells the motors.

use framework::{HardwareInterface, MainOutput, Parameter, RequiredInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::interfaces::MotorInterface;
use crate::joints::{COUNT, HEAD_YAW, LEFT_ARM, Part, RIGHT_ARM, SHOULDER_PITCH, part};
use crate::types::{Angles, Gains, MotorCommands};

/// Has nothing to remember.
#[derive(Debug, Deserialize, Serialize)]
pub struct MotorSender {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    standing: RequiredInput<Option<Angles>, "standing?">,
    head_yaw: RequiredInput<Option<f32>, "head_yaw?">,
    arm_pitch: RequiredInput<Option<f32>, "arm_pitch?">,
    leg: Parameter<Gains, "motor_sender.leg">,
    ankle: Parameter<Gains, "motor_sender.ankle">,
    arm: Parameter<Gains, "motor_sender.arm">,
    head: Parameter<Gains, "motor_sender.head">,
}

#[context]
pub struct MainOutputs {
    motor_commands: MainOutput<MotorCommands>,
}

impl MotorSender {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// One command for all motors.
    pub fn cycle(&mut self, context: CycleContext<impl MotorInterface>) -> Result<MainOutputs> {
        let mut positions = *context.standing;
        positions[HEAD_YAW] += context.head_yaw;
        positions[LEFT_ARM + SHOULDER_PITCH] += context.arm_pitch;
        positions[RIGHT_ARM + SHOULDER_PITCH] -= context.arm_pitch;
        let gains: [Gains; COUNT] = std::array::from_fn(|joint| match part(joint) {
            Part::Head => *context.head,
            Part::Arm => *context.arm,
            Part::Leg => *context.leg,
            Part::Ankle => *context.ankle,
        });
        let commands = MotorCommands {
            positions,
            stiffnesses: gains.map(|gains| gains.stiffness),
            dampings: gains.map(|gains| gains.damping),
        };
        context.hardware_interface.write_motors(&commands)?;
        Ok(MainOutputs {
            motor_commands: commands.into(),
        })
    }
}
