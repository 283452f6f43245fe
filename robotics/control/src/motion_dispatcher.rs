//! Brings the body from wherever it is to where the selected motion begins, no joint faster than it may.

use framework::{
    CycleTime, CyclerState, Input, MainOutput, Parameter, PreviousInput, Result, context,
};
use keyframes::Motions;
use serde::{Deserialize, Serialize};
use types::joints::Joints;
use types::motion::{BodyMotion, MotionCommand, MotionSelection};
use types::motor_commands::MotorCommands;

use crate::transition;

/// The way that the body is on.
#[derive(Debug, Deserialize, Serialize)]
pub struct MotionDispatcher {
    way: Option<Way>,
}

/// From where, to which motion, and for how long already.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Way {
    start: Joints<f32>,
    motion: BodyMotion,
    /// Whether the head has a way of its own.
    is_head_free: bool,
    /// In s.
    elapsed: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_command: Input<MotionCommand, "motion_command">,
    motion_selection: Input<MotionSelection, "motion_selection">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    previous: PreviousInput<Option<MotorCommands>, "motor_commands?">,
    cycle_time: CycleTime,
    /// Whether the body is where the motion begins.
    safe_exit: CyclerState<bool, "safe_exits.dispatch">,

    /// Where standing begins, in rad.
    stand: Parameter<Joints<f32>, "stand.positions">,
    /// Where the penalised pose begins, in rad.
    penalized_pose: Parameter<Joints<f32>, "penalized_pose.positions">,
    /// Where sitting down begins, in rad.
    crouch: Parameter<Joints<f32>, "sit_down.crouch">,
    /// Walking begins with both feet side by side.
    walk: Parameter<walking::Parameters, "walking_engine">,
    /// Scripted motions begin with their first pose.
    motions: Parameter<Motions, "motions">,
    /// Stiffness of every joint, 0 (limp) to 1.
    stiffness: Parameter<f32, "motion_dispatcher.stiffness">,
    /// Share of every joint's greatest speed that the way may take.
    velocity_share: Parameter<f32, "motion_dispatcher.velocity_share">,
    /// In s: the way takes at least so long, unless the body is there already.
    minimum_duration: Parameter<f32, "motion_dispatcher.minimum_duration">,
}

#[context]
pub struct MainOutputs {
    /// For all joints; `None` while a motion has the body.
    dispatch_commands: MainOutput<Option<MotorCommands>>,
}

impl MotionDispatcher {
    /// On no way.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { way: None })
    }

    /// The next pose on the way.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let motion = context.motion_selection.current;
        let Some(begin) = context.begin() else {
            self.way = None;
            *context.safe_exit = false;
            return Ok(MainOutputs {
                dispatch_commands: None.into(),
            });
        };
        let is_head_free = (context.motion_selection).is_head_free(context.motion_command.head);
        let way = match self.way {
            Some(way) if (way.motion, way.is_head_free) == (motion, is_head_free) => Way {
                elapsed: way.elapsed + context.cycle_time.since_last.as_secs_f32(),
                ..way
            },
            _ => Way {
                start: transition::current_pose(context.previous, context.positions),
                motion,
                is_head_free,
                elapsed: 0.0,
            },
        };
        self.way = Some(way);

        let target = way.target(begin);
        let duration = match transition::duration(&way.start, &target, *context.velocity_share) {
            0.0 => 0.0,
            duration => duration.max(*context.minimum_duration),
        };
        let progress = transition::progress(way.elapsed, duration);
        *context.safe_exit = progress == 1.0;
        let commands = MotorCommands::holding(
            transition::pose(&way.start, &target, progress),
            *context.stiffness,
        );
        Ok(MainOutputs {
            dispatch_commands: Some(commands).into(),
        })
    }
}

impl Way {
    /// Where the motion begins, without a head that has a way of its own: nobody waits for it.
    fn target(&self, begin: Joints<f32>) -> Joints<f32> {
        if !self.is_head_free {
            return begin;
        }
        Joints {
            head_yaw: self.start.head_yaw,
            head_pitch: self.start.head_pitch,
            ..begin
        }
    }
}

impl CycleContext<'_> {
    /// Where the selected motion begins; `None` where the body is not on its way to one.
    fn begin(&self) -> Option<Joints<f32>> {
        let begin = match self.motion_selection.current {
            BodyMotion::Unstiff => None,
            BodyMotion::SitDown => Some(*self.crouch),
            BodyMotion::Stand => Some(*self.stand),
            BodyMotion::Penalized => Some(*self.penalized_pose),
            BodyMotion::Walk => Some(walking::standing_pose(self.walk)),
            BodyMotion::Scripted(script) => Some(self.motions.of(script).start()),
        };
        begin.filter(|_| self.motion_selection.is_dispatching)
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{self, ParameterFile};
    use kinematics::limits;
    use types::motion::{HeadMotion, Script};

    use super::*;

    fn stand() -> Joints<f32> {
        let mut stand = Joints::filled(0.0);
        stand.left_knee_pitch = 0.93;
        stand.left_shoulder_pitch = 1.57;
        stand
    }

    fn cycle(
        node: &mut MotionDispatcher,
        selection: (BodyMotion, bool),
        measured: &Joints<f32>,
        previous: Option<&MotorCommands>,
    ) -> (Option<MotorCommands>, bool) {
        cycle_of(node, HeadMotion::WithBody, selection, measured, previous)
    }

    fn cycle_of(
        node: &mut MotionDispatcher,
        head: HeadMotion,
        selection: (BodyMotion, bool),
        measured: &Joints<f32>,
        previous: Option<&MotorCommands>,
    ) -> (Option<MotorCommands>, bool) {
        let mut safe_exit = true;
        let parameters = ParameterFile::new(include_str!("../../parameters/default.toml"));
        let (current, is_dispatching) = selection;
        let motion_selection = MotionSelection {
            current,
            is_dispatching,
        };
        let motion_command = MotionCommand {
            head,
            ..MotionCommand::default()
        };
        let context = CycleContext {
            motion_command: &motion_command,
            motion_selection: &motion_selection,
            positions: measured,
            previous,
            cycle_time: testing::cycle_time(0, 12),
            safe_exit: &mut safe_exit,
            stand: &stand(),
            penalized_pose: &Joints::filled(0.1),
            crouch: &Joints::filled(0.2),
            walk: &parameters.get("walking_engine"),
            motions: &parameters.get("motions"),
            stiffness: &0.8,
            velocity_share: &0.25,
            minimum_duration: &1.0,
        };
        let commands = node.cycle(context).unwrap().dispatch_commands.value;
        (commands, safe_exit)
    }

    fn node() -> MotionDispatcher {
        MotionDispatcher::new(CreationContext {}).unwrap()
    }

    #[test]
    fn the_first_command_is_where_the_robot_is() {
        let measured = Joints::filled(0.3);
        let (commands, safe_exit) = cycle(&mut node(), (BodyMotion::Stand, true), &measured, None);
        assert_eq!(commands.unwrap().positions, measured);
        assert!(!safe_exit);
    }

    #[test]
    fn a_body_that_is_held_starts_where_it_was_sent() {
        let sent = MotorCommands {
            positions: Joints::filled(0.4),
            stiffnesses: Joints::filled(0.8),
        };
        let measured = Joints::filled(0.3);
        let stand = (BodyMotion::Stand, true);
        let (commands, _) = cycle(&mut node(), stand, &measured, Some(&sent));
        assert_eq!(commands.unwrap().positions, sent.positions);
    }

    #[test]
    fn no_joint_is_faster_than_its_share_and_only_the_end_is_a_safe_exit() {
        let mut node = node();
        let measured = Joints::filled(-0.3);
        let mut last = measured;
        for _ in 0..200 {
            let (commands, safe_exit) =
                cycle(&mut node, (BodyMotion::Stand, true), &measured, None);
            let positions = commands.unwrap().positions;
            for (joint, angle) in positions.iter() {
                let velocity = (angle - last[joint]).abs() / 0.012;
                let limit = limits::of(joint).velocity as f32 * 0.25;
                assert!(velocity <= limit * 1.001, "{joint:?}: {velocity} > {limit}");
            }
            assert_eq!(safe_exit, positions == stand());
            last = positions;
        }
        assert_eq!(last, stand());
    }

    #[test]
    fn a_body_that_is_there_has_arrived_at_once() {
        let (commands, safe_exit) = cycle(&mut node(), (BodyMotion::Stand, true), &stand(), None);
        assert_eq!(commands.unwrap().positions, stand());
        assert!(safe_exit);
    }

    #[test]
    fn nobody_waits_for_a_head_that_goes_elsewhere() {
        let mut measured = stand();
        measured.head_yaw = 1.2;
        let first = |head, motion| {
            let (commands, safe_exit) =
                cycle_of(&mut node(), head, (motion, true), &measured, None);
            assert_eq!(commands.unwrap().positions, measured);
            safe_exit
        };
        assert!(first(HeadMotion::LookAround, BodyMotion::Stand));
        assert!(!first(HeadMotion::WithBody, BodyMotion::Stand));
        let kick = BodyMotion::Scripted(Script::KickLeft);
        assert!(!first(HeadMotion::LookAround, kick));
    }

    #[test]
    fn another_motion_is_another_way() {
        let mut node = node();
        for _ in 0..200 {
            cycle(&mut node, (BodyMotion::Stand, true), &stand(), None);
        }
        for motion in [BodyMotion::Penalized, BodyMotion::SitDown] {
            let (commands, safe_exit) = cycle(&mut node, (motion, true), &stand(), None);
            assert_eq!(commands.unwrap().positions, stand());
            assert!(!safe_exit);
        }
    }

    #[test]
    fn nothing_is_commanded_while_a_motion_has_the_body() {
        let measured = Joints::filled(0.0);
        for motion in [BodyMotion::Stand, BodyMotion::Unstiff] {
            let (commands, _) = cycle(&mut node(), (motion, false), &measured, None);
            assert_eq!(commands, None);
        }
    }

    #[test]
    fn a_second_way_to_the_same_motion_starts_anew() {
        let mut node = node();
        let measured = Joints::filled(0.0);
        for _ in 0..200 {
            cycle(&mut node, (BodyMotion::Stand, true), &measured, None);
        }
        cycle(&mut node, (BodyMotion::Unstiff, false), &measured, None);
        let (commands, _) = cycle(&mut node, (BodyMotion::Stand, true), &measured, None);
        assert_eq!(commands.unwrap().positions, measured);
    }
}
