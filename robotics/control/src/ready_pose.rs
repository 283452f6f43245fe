//! Brings the body from wherever it is to the ready pose, no joint faster than it may, and holds it.

use framework::{CycleTime, CyclerState, Input, MainOutput, Parameter, Result, context};
use kinematics::limits;
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::motor_commands::{MotionPhase, MotorCommands};

/// Peak speed over mean speed of the smooth step `3 s² - 2 s³`.
const PEAK: f32 = 1.5;

/// Where the motion began and how far it has got.
#[derive(Debug, Deserialize, Serialize)]
pub struct ReadyPose {
    start: Option<Joints<f32>>,
    /// In s.
    elapsed: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    positions: Input<Joints<f32>, "sensor_data.positions">,
    cycle_time: CycleTime,
    motion_phase: CyclerState<MotionPhase, "motion_phase">,

    /// The pose to reach, in rad.
    ready_positions: Parameter<Joints<f32>, "ready_pose.positions">,
    /// Stiffness of every joint, 0 (limp) to 1.
    stiffness: Parameter<f32, "ready_pose.stiffness">,
    /// Share of every joint's greatest speed that the motion may take.
    velocity_share: Parameter<f32, "ready_pose.velocity_share">,
    /// In s: the motion takes at least so long.
    minimum_duration: Parameter<f32, "ready_pose.minimum_duration">,
}

#[context]
pub struct MainOutputs {
    /// For all joints; the head's are for when nobody else moves it.
    body_commands: MainOutput<Option<MotorCommands>>,
}

impl ReadyPose {
    /// Starts from the first measured pose.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            start: None,
            elapsed: 0.0,
        })
    }

    /// The next pose on the way.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let start = match self.start {
            Some(start) => {
                self.elapsed += context.cycle_time.since_last.as_secs_f32();
                start
            }
            None => *self.start.insert(*context.positions),
        };
        let target = context.ready_positions;
        let duration = duration(&start, target, *context.velocity_share)
            .max(*context.minimum_duration)
            .max(f32::EPSILON);
        let progress = (self.elapsed / duration).min(1.0);
        *context.motion_phase = if progress < 1.0 {
            MotionPhase::Rising
        } else {
            MotionPhase::Ready
        };

        let share = progress * progress * (3.0 - 2.0 * progress);
        let commands = MotorCommands {
            positions: Joints::from_fn(|joint| {
                start[joint] * (1.0 - share) + target[joint] * share
            }),
            stiffnesses: Joints::filled(*context.stiffness),
        };
        Ok(MainOutputs {
            body_commands: Some(commands).into(),
        })
    }
}

/// How long the slowest joint takes, in s.
fn duration(start: &Joints<f32>, target: &Joints<f32>, velocity_share: f32) -> f32 {
    let durations = start.iter().map(|(joint, angle)| {
        let velocity = limits::of(joint).velocity as f32 * velocity_share.clamp(0.01, 1.0);
        PEAK * (target[joint] - angle).abs() / velocity
    });
    durations.fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use framework::Timestamp;

    use super::*;

    fn target() -> Joints<f32> {
        let mut target = Joints::filled(0.0);
        target.left_knee_pitch = 0.93;
        target.left_shoulder_pitch = 1.57;
        target
    }

    fn cycle(node: &mut ReadyPose, measured: &Joints<f32>) -> (MotorCommands, MotionPhase) {
        let mut motion_phase = MotionPhase::Rising;
        let context = CycleContext {
            positions: measured,
            cycle_time: CycleTime {
                start: Timestamp::ZERO,
                since_last: Duration::from_millis(12),
            },
            motion_phase: &mut motion_phase,
            ready_positions: &target(),
            stiffness: &0.8,
            velocity_share: &0.25,
            minimum_duration: &1.0,
        };
        let outputs = node.cycle(context).unwrap();
        (outputs.body_commands.value.unwrap(), motion_phase)
    }

    #[test]
    fn the_first_command_is_where_the_robot_is() {
        let mut node = ReadyPose::new(CreationContext {}).unwrap();
        let measured = Joints::filled(0.3);
        let (commands, phase) = cycle(&mut node, &measured);
        assert_eq!(commands.positions, measured);
        assert_eq!(phase, MotionPhase::Rising);
    }

    #[test]
    fn no_joint_is_faster_than_its_share_on_the_way_to_the_pose() {
        let mut node = ReadyPose::new(CreationContext {}).unwrap();
        let measured = Joints::filled(-0.3);
        let (mut last, _) = cycle(&mut node, &measured);
        for _ in 0..200 {
            let (commands, _) = cycle(&mut node, &measured);
            for (joint, angle) in commands.positions.iter() {
                let velocity = (angle - last.positions[joint]).abs() / 0.012;
                let limit = limits::of(joint).velocity as f32 * 0.25;
                assert!(velocity <= limit * 1.001, "{joint:?}: {velocity} > {limit}");
            }
            last = commands;
        }
        assert_eq!(last.positions, target());
    }

    #[test]
    fn the_pose_is_held_once_it_is_reached() {
        let mut node = ReadyPose::new(CreationContext {}).unwrap();
        for _ in 0..200 {
            cycle(&mut node, &Joints::filled(0.0));
        }
        let (commands, phase) = cycle(&mut node, &Joints::filled(0.5));
        assert_eq!((commands.positions, phase), (target(), MotionPhase::Ready));
        assert_eq!(commands.stiffnesses.head_yaw, 0.8);
    }
}
