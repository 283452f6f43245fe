//! Merges the commands for body and head into one that no joint is harmed by.
//!
//! Every joint moves from where it was sent last, no faster than allowed and within its limits,
//! whatever anybody asks.

use framework::{
    CycleTime, Input, MainOutput, Parameter, PreviousInput, RequiredInput, Result, context,
};
use kinematics::limits;
use serde::{Deserialize, Serialize};
use types::head::{HeadAngles, HeadCommand};
use types::joints::{JointName, Joints};
use types::motor_commands::MotorCommands;

/// A longer cycle does not allow a longer step, in s.
const LONGEST_STEP: f32 = 0.1;

/// Keeps nothing between cycles: the previous command is an input.
#[derive(Debug, Deserialize, Serialize)]
pub struct MotorCommandsCollector {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    body_commands: RequiredInput<Option<MotorCommands>, "body_commands?">,
    head_command: Input<Option<HeadCommand>, "head_command?">,
    previous: PreviousInput<Option<MotorCommands>, "motor_commands?">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    cycle_time: CycleTime,

    /// Share of every joint's greatest speed that commands may take.
    velocity_share: Parameter<f32, "motor_commands_collector.velocity_share">,
}

#[context]
pub struct MainOutputs {
    /// What the motors shall do; `None` while nobody commands the body.
    motor_commands: MainOutput<Option<MotorCommands>>,
}

impl MotorCommandsCollector {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Merges, then limits speed, then limits angles.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let wanted = merge(context.body_commands, context.head_command);
        let last = context
            .previous
            .map_or(context.positions, |previous| &previous.positions);
        let step = context
            .cycle_time
            .since_last
            .as_secs_f32()
            .min(LONGEST_STEP);
        let share = zero_to_one(*context.velocity_share);
        let positions = Joints::from_fn(|joint| {
            let reach = limits::of(joint).velocity as f32 * share * step;
            approach(joint, last[joint], wanted.positions[joint], reach)
        });
        let commands = MotorCommands {
            positions: limit_head(positions),
            stiffnesses: wanted.stiffnesses.map(zero_to_one),
        };
        Ok(MainOutputs {
            motor_commands: Some(commands).into(),
        })
    }
}

fn merge(body: &MotorCommands, head: Option<&HeadCommand>) -> MotorCommands {
    let mut commands = *body;
    if let Some(HeadCommand { angles, stiffness }) = head {
        commands.positions.head_yaw = angles.yaw;
        commands.positions.head_pitch = angles.pitch;
        commands.stiffnesses.head_yaw = *stiffness;
        commands.stiffnesses.head_pitch = *stiffness;
    }
    commands
}

/// The angle nearest to `wanted` that is within `reach` of `last`, and within the joint's limits.
fn approach(joint: JointName, last: f32, wanted: f32, reach: f32) -> f32 {
    // What is no number is no reason to move; `clamp` would panic on it.
    let last = limits::clamp(joint, last);
    let wanted = if wanted.is_nan() { last } else { wanted };
    limits::clamp(joint, wanted.clamp(last - reach, last + reach))
}

/// The shell limits the pitch by the yaw.
fn limit_head(mut positions: Joints<f32>) -> Joints<f32> {
    let HeadAngles { yaw, pitch } = limits::clamp_head(HeadAngles {
        yaw: positions.head_yaw,
        pitch: positions.head_pitch,
    });
    positions.head_yaw = yaw;
    positions.head_pitch = pitch;
    positions
}

/// What is no number counts as nothing: no movement, no stiffness.
fn zero_to_one(share: f32) -> f32 {
    if share.is_nan() {
        0.0
    } else {
        share.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::Timestamp;

    use super::*;

    /// Where every joint may be.
    fn start() -> Joints<f32> {
        Joints::from_fn(|joint| limits::clamp(joint, 0.0))
    }

    fn collect(
        body: &MotorCommands,
        head: Option<&HeadCommand>,
        previous: Option<&MotorCommands>,
    ) -> MotorCommands {
        let mut node = MotorCommandsCollector::new(CreationContext {}).unwrap();
        let context = CycleContext {
            body_commands: body,
            head_command: head,
            previous,
            positions: &start(),
            cycle_time: CycleTime {
                start: Timestamp::ZERO,
                since_last: Duration::from_millis(12),
            },
            velocity_share: &0.5,
        };
        node.cycle(context).unwrap().motor_commands.value.unwrap()
    }

    #[test]
    fn what_is_no_number_moves_nothing() {
        for (wanted, last, share) in [(f32::NAN, 0.1, 0.5), (0.5, 0.1, f32::NAN)] {
            let mut node = MotorCommandsCollector::new(CreationContext {}).unwrap();
            let context = CycleContext {
                body_commands: &everywhere(wanted),
                head_command: None,
                previous: Some(&everywhere(last)),
                positions: &start(),
                cycle_time: CycleTime {
                    start: Timestamp::ZERO,
                    since_last: Duration::from_millis(12),
                },
                velocity_share: &share,
            };
            let commands = node.cycle(context).unwrap().motor_commands.value.unwrap();
            assert_eq!(commands.positions.left_knee_pitch, last);
        }
        assert!(approach(JointName::HeadYaw, f32::NAN, 0.1, 0.01).is_finite());
    }

    fn everywhere(angle: f32) -> MotorCommands {
        MotorCommands {
            positions: Joints::filled(angle),
            stiffnesses: Joints::filled(0.7),
        }
    }

    #[test]
    fn the_head_follows_its_own_command() {
        let head = HeadCommand {
            angles: HeadAngles {
                yaw: 0.01,
                pitch: -0.02,
            },
            stiffness: 0.4,
        };
        let commands = collect(&everywhere(0.0), Some(&head), None);
        assert_eq!(commands.positions.head_yaw, 0.01);
        assert_eq!(commands.positions.head_pitch, -0.02);
        assert_eq!(commands.stiffnesses.head_pitch, 0.4);
        assert_eq!(commands.stiffnesses.left_knee_pitch, 0.7);
    }

    #[test]
    fn no_joint_moves_faster_than_its_share() {
        let commands = collect(&everywhere(1.0), None, None);
        for (joint, angle) in commands.positions.iter() {
            let reach = limits::of(joint).velocity as f32 * 0.5 * 0.012;
            assert!((angle - start()[joint]).abs() <= reach * 1.001, "{joint:?}");
        }
    }

    #[test]
    fn steps_start_at_the_previous_command_and_not_at_the_measured_angle() {
        let mut previous = everywhere(0.0);
        previous.positions.left_knee_pitch = 1.0;
        let commands = collect(&everywhere(2.0), None, Some(&previous));
        assert!(commands.positions.left_knee_pitch > 1.0);
    }

    #[test]
    fn limits_come_last() {
        let mut previous = everywhere(0.0);
        previous.positions = Joints::filled(5.0);
        let commands = collect(&everywhere(9.0), None, Some(&previous));
        for (joint, angle) in commands.positions.iter() {
            let limits = limits::of(joint);
            assert!(*angle <= limits.upper as f32, "{joint:?}");
        }
        let (_, deepest) = limits::head_pitch_range(f64::from(commands.positions.head_yaw));
        assert!(commands.positions.head_pitch <= deepest as f32);
    }

    #[test]
    fn commands_that_are_no_numbers_move_nothing() {
        let mut wanted = everywhere(f32::NAN);
        wanted.stiffnesses.head_yaw = f32::NAN;
        let commands = collect(&wanted, None, None);
        assert_eq!(commands.positions, start());
        assert_eq!(commands.stiffnesses.head_yaw, 0.0);
    }
}
