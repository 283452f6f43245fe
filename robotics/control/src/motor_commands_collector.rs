//! Makes one command for all motors out of those for body and head, and one that harms no joint.
//!
//! Every joint moves from where it was sent last, no faster than allowed and within its limits,
//! whatever anybody asks. What nobody commands is limp.

use framework::{CycleTime, Input, MainOutput, Parameter, PreviousInput, Result, context};
use serde::{Deserialize, Serialize};
use types::head::HeadCommand;
use types::joints::Joints;
use types::motion::{BodyMotion, MotionSelection};
use types::motor_commands::MotorCommands;

use crate::motor_limits::harmless;

/// Keeps nothing between cycles: the previous command is an input.
#[derive(Debug, Deserialize, Serialize)]
pub struct MotorCommandsCollector {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_selection: Input<MotionSelection, "motion_selection">,
    dispatch_commands: Input<Option<MotorCommands>, "dispatch_commands?">,
    stand_commands: Input<Option<MotorCommands>, "stand_commands?">,
    penalized_commands: Input<Option<MotorCommands>, "penalized_commands?">,
    sit_down_commands: Input<Option<MotorCommands>, "sit_down_commands?">,
    walk_commands: Input<Option<MotorCommands>, "walk_commands?">,
    script_commands: Input<Option<MotorCommands>, "script_commands?">,
    head_command: Input<Option<HeadCommand>, "head_command?">,
    previous: PreviousInput<Option<MotorCommands>, "motor_commands?">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    cycle_time: CycleTime,

    /// Share of every joint's greatest speed that commands may take.
    velocity_share: Parameter<f32, "motor_commands_collector.velocity_share">,
}

#[context]
pub struct MainOutputs {
    /// What the motors shall do; `None` only where this node failed.
    motor_commands: MainOutput<Option<MotorCommands>>,
}

impl MotorCommandsCollector {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Merges, then limits.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let wanted = context.body_commands().map_or_else(
            || MotorCommands::holding(*context.positions, 0.0),
            |body| merge(body, context.head_command),
        );
        let commands = harmless(
            &wanted,
            context.previous,
            context.positions,
            context.cycle_time.since_last.as_secs_f32(),
            *context.velocity_share,
        );
        Ok(MainOutputs {
            motor_commands: Some(commands).into(),
        })
    }
}

impl<'context> CycleContext<'context> {
    /// What whoever has the body wants; `None` where nobody has it, or says nothing.
    fn body_commands(&self) -> Option<&'context MotorCommands> {
        if self.motion_selection.is_dispatching {
            return self.dispatch_commands;
        }
        match self.motion_selection.current {
            BodyMotion::Unstiff => None,
            BodyMotion::SitDown => self.sit_down_commands,
            BodyMotion::Stand => self.stand_commands,
            BodyMotion::Penalized => self.penalized_commands,
            BodyMotion::Walk => self.walk_commands,
            BodyMotion::Scripted(_) => self.script_commands,
        }
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

#[cfg(test)]
mod tests {
    use framework::testing;
    use kinematics::limits;
    use types::head::HeadAngles;
    use types::joints::JointName;
    use types::motion::Script;

    use super::*;

    const STAND: MotionSelection = MotionSelection {
        current: BodyMotion::Stand,
        is_dispatching: false,
    };

    /// Where every joint may be.
    fn start() -> Joints<f32> {
        Joints::from_fn(|joint| limits::clamp(joint, 0.0))
    }

    fn everywhere(angle: f32) -> MotorCommands {
        MotorCommands {
            positions: Joints::filled(angle),
            stiffnesses: Joints::filled(0.7),
        }
    }

    /// A robot that stands at `start`, and nobody commands it.
    fn nobody<'context>(
        motion_selection: &'context MotionSelection,
        positions: &'context Joints<f32>,
    ) -> CycleContext<'context> {
        CycleContext {
            motion_selection,
            dispatch_commands: None,
            stand_commands: None,
            penalized_commands: None,
            sit_down_commands: None,
            walk_commands: None,
            script_commands: None,
            head_command: None,
            previous: None,
            positions,
            cycle_time: testing::cycle_time(0, 12),
            velocity_share: &0.5,
        }
    }

    fn collect(context: CycleContext) -> MotorCommands {
        let mut node = MotorCommandsCollector::new(CreationContext {}).unwrap();
        node.cycle(context).unwrap().motor_commands.value.unwrap()
    }

    fn collect_stand(
        body: &MotorCommands,
        head: Option<&HeadCommand>,
        previous: Option<&MotorCommands>,
    ) -> MotorCommands {
        collect(CycleContext {
            stand_commands: Some(body),
            head_command: head,
            previous,
            ..nobody(&STAND, &start())
        })
    }

    #[test]
    fn the_body_obeys_the_motion_that_has_it() {
        let [dispatch, stand, penalized, sit_down, walk, script] =
            [0.11, 0.12, 0.13, 0.14, 0.15, 0.16].map(|stiffness| MotorCommands {
                positions: start(),
                stiffnesses: Joints::filled(stiffness),
            });
        let stiffness = |current, is_dispatching| {
            let selection = MotionSelection {
                current,
                is_dispatching,
            };
            let commands = collect(CycleContext {
                dispatch_commands: Some(&dispatch),
                stand_commands: Some(&stand),
                penalized_commands: Some(&penalized),
                sit_down_commands: Some(&sit_down),
                walk_commands: Some(&walk),
                script_commands: Some(&script),
                ..nobody(&selection, &start())
            });
            commands.stiffnesses.left_knee_pitch
        };
        assert_eq!(stiffness(BodyMotion::Stand, true), 0.11);
        assert_eq!(stiffness(BodyMotion::Stand, false), 0.12);
        assert_eq!(stiffness(BodyMotion::Penalized, false), 0.13);
        assert_eq!(stiffness(BodyMotion::SitDown, false), 0.14);
        assert_eq!(stiffness(BodyMotion::Walk, false), 0.15);
        let kick = BodyMotion::Scripted(Script::KickLeft);
        assert_eq!(stiffness(kick, false), 0.16);
        assert_eq!(stiffness(BodyMotion::Unstiff, false), 0.0);
    }

    #[test]
    fn what_nobody_commands_is_limp_wherever_it_is_pushed() {
        let mut pushed = start();
        pushed.left_shoulder_pitch = 1.0;
        for selection in [STAND, MotionSelection::default()] {
            let commands = collect(CycleContext {
                previous: Some(&MotorCommands::holding(start(), 0.0)),
                ..nobody(&selection, &pushed)
            });
            assert_eq!(commands, MotorCommands::holding(pushed, 0.0));
        }
    }

    #[test]
    fn a_joint_that_was_limp_starts_where_it_was_pushed() {
        let mut pushed = start();
        pushed.left_knee_pitch = 1.0;
        let commands = collect(CycleContext {
            stand_commands: Some(&everywhere(0.0)),
            previous: Some(&MotorCommands::holding(start(), 0.0)),
            ..nobody(&STAND, &pushed)
        });
        let reach = limits::of(JointName::LeftKneePitch).velocity as f32 * 0.5 * 0.012;
        assert!((commands.positions.left_knee_pitch - (1.0 - reach)).abs() < 1e-6);
    }

    #[test]
    fn what_is_no_number_moves_nothing() {
        for (wanted, last, share) in [(f32::NAN, 0.1, 0.5), (0.5, 0.1, f32::NAN)] {
            let commands = collect(CycleContext {
                stand_commands: Some(&everywhere(wanted)),
                previous: Some(&everywhere(last)),
                velocity_share: &share,
                ..nobody(&STAND, &start())
            });
            assert_eq!(commands.positions.left_knee_pitch, last);
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
        let commands = collect_stand(&everywhere(0.0), Some(&head), None);
        assert_eq!(commands.positions.head_yaw, 0.01);
        assert_eq!(commands.positions.head_pitch, -0.02);
        assert_eq!(commands.stiffnesses.head_pitch, 0.4);
        assert_eq!(commands.stiffnesses.left_knee_pitch, 0.7);
    }

    #[test]
    fn no_joint_moves_faster_than_its_share() {
        let commands = collect_stand(&everywhere(1.0), None, None);
        for (joint, angle) in commands.positions.iter() {
            let reach = limits::of(joint).velocity as f32 * 0.5 * 0.012;
            assert!((angle - start()[joint]).abs() <= reach * 1.001, "{joint:?}");
        }
    }

    #[test]
    fn steps_start_at_the_previous_command_and_not_at_the_measured_angle() {
        let mut previous = everywhere(0.0);
        previous.positions.left_knee_pitch = 1.0;
        let commands = collect_stand(&everywhere(2.0), None, Some(&previous));
        assert!(commands.positions.left_knee_pitch > 1.0);
    }

    #[test]
    fn limits_come_last() {
        let mut previous = everywhere(0.0);
        previous.positions = Joints::filled(5.0);
        let commands = collect_stand(&everywhere(9.0), None, Some(&previous));
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
        let commands = collect_stand(&wanted, None, None);
        assert_eq!(commands.positions, start());
        assert_eq!(commands.stiffnesses.head_yaw, 0.0);
    }
}
