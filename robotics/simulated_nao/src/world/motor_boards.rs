//! The boards between LoLA and the motors: they move each target over to the next one.

use std::time::Duration;

use framework::Timestamp;
use types::joints::Joints;
use types::motor_commands::MotorCommands;

/// A new command comes every 12 ms; targets move over to it in that time, so that joints turn
/// evenly.
const TRANSITION: Duration = Duration::from_millis(12);

/// What the motors are told, and since when.
pub(super) struct MotorBoards {
    from: Joints<f32>,
    commands: MotorCommands,
    since: Timestamp,
}

impl MotorBoards {
    /// Limp motors.
    pub(super) fn new(joints: &Joints<f64>) -> Self {
        let positions = joints.map(|angle| angle as f32);
        Self {
            from: positions,
            commands: MotorCommands {
                positions,
                stiffnesses: Joints::default(),
            },
            since: Timestamp::ZERO,
        }
    }

    pub(super) fn commands(&self) -> &MotorCommands {
        &self.commands
    }

    /// The targets at a time after the last command.
    pub(super) fn at(&self, time: Timestamp) -> MotorCommands {
        let part = ((time - self.since).as_secs_f32() / TRANSITION.as_secs_f32()).min(1.0);
        MotorCommands {
            positions: Joints::from_fn(|joint| {
                let (from, to) = (self.from[joint], self.commands.positions[joint]);
                if part < 1.0 {
                    from + (to - from) * part
                } else {
                    to
                }
            }),
            stiffnesses: self.commands.stiffnesses,
        }
    }

    /// Heads for a new command; what was limp starts where it is.
    pub(super) fn command(
        &mut self,
        commands: MotorCommands,
        joints: &Joints<f64>,
        now: Timestamp,
    ) {
        let targets = self.at(now).positions;
        let was_limp = self.commands.stiffnesses.map(|stiffness| stiffness <= 0.0);
        self.from = Joints::from_fn(|joint| {
            if was_limp[joint] {
                joints[joint] as f32
            } else {
                targets[joint]
            }
        });
        self.commands = commands;
        self.since = now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_move_evenly_to_the_command() {
        let mut boards = MotorBoards::new(&Joints::default());
        let commands = MotorCommands {
            positions: Joints::filled(0.1),
            stiffnesses: Joints::filled(1.0),
        };
        boards.command(commands, &Joints::default(), Timestamp::ZERO);
        let half = boards
            .at(Timestamp::ZERO + TRANSITION / 2)
            .positions
            .head_yaw;
        assert!((half - 0.05).abs() < 1e-6, "{half}");
        assert_eq!(
            boards
                .at(Timestamp::ZERO + TRANSITION * 3)
                .positions
                .head_yaw,
            0.1
        );
    }

    #[test]
    fn a_limp_joint_starts_where_it_is() {
        let mut boards = MotorBoards::new(&Joints::default());
        let commands = MotorCommands {
            positions: Joints::filled(0.1),
            stiffnesses: Joints::filled(1.0),
        };
        boards.command(commands, &Joints::filled(-0.5), Timestamp::ZERO);
        assert_eq!(boards.at(Timestamp::ZERO).positions.head_yaw, -0.5);
    }
}
