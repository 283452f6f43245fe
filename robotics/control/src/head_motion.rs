//! Moves the head to where it shall look, slowly enough for sharp and well-placed images.
//!
//! A client may ask it to look somewhere else instead, until it says otherwise or the robot is limp or
//! penalised: buttons and referee come first. While the body is on its way from one motion to
//! the next, or down, the head goes with it.

use framework::{
    CycleTime, Input, MainOutput, Parameter, PreviousInput, Procedure, Result, context,
};
use kinematics::limits;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use types::head::{HeadAngles, HeadCommand, HeadRequest};
use types::joints::Joints;
use types::motion::{BodyMotion, HeadMotion as Wanted, MotionCommand, MotionSelection};
use types::motor_commands::MotorCommands;

use crate::transition;

/// Where a client wants the head to look.
#[derive(Debug, Deserialize, Serialize)]
pub struct HeadMotion {
    looking_at: Option<HeadAngles>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    motion_command: Input<MotionCommand, "motion_command">,
    motion_selection: Input<MotionSelection, "motion_selection">,
    around: Input<Option<HeadAngles>, "look_around?">,
    at_point: Input<Option<HeadAngles>, "look_at?">,
    positions: Input<Joints<f32>, "sensor_data.positions">,
    previous: PreviousInput<Option<MotorCommands>, "motor_commands?">,
    cycle_time: CycleTime,

    /// In rad/s: the faster, the less do images fit the measured angles.
    velocity: Parameter<f32, "head_motion.velocity">,
    /// Stiffness of the head, 0 (limp) to 1.
    stiffness: Parameter<f32, "head_motion.stiffness">,

    /// Answered with the angles that the head can reach.
    look_at: Procedure<HeadRequest, HeadAngles, "look_at">,
}

#[context]
pub struct MainOutputs {
    /// `None` while the head goes with the body.
    head_command: MainOutput<Option<HeadCommand>>,
}

impl HeadMotion {
    /// Nobody has asked yet.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { looking_at: None })
    }

    /// One step towards where the head shall look.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let pose = transition::current_pose(context.previous, context.positions);
        let from = HeadAngles {
            yaw: pose.head_yaw,
            pitch: pose.head_pitch,
        };
        let is_free = (context.motion_selection).is_head_free(context.motion_command.head);
        let goal = context.goal();
        let obstacle = obstacle(context.motion_command);
        if obstacle.is_some() {
            self.looking_at = None;
        }
        if let Some(call) = context.look_at {
            match (*call.request(), obstacle) {
                (HeadRequest::Scan, _) => {
                    self.looking_at = None;
                    call.answer(from);
                }
                (HeadRequest::LookAt(_), Some(reason)) => call.refuse(reason),
                (HeadRequest::LookAt(angles), None) => {
                    let reachable = limits::clamp_head(angles);
                    self.looking_at = Some(reachable);
                    call.answer(reachable);
                }
            }
        }

        let goal = self.looking_at.or(goal).unwrap_or(from);
        let reach = *context.velocity * context.cycle_time.since_last.as_secs_f32();
        let head_command = is_free.then(|| HeadCommand {
            angles: step(from, goal, reach),
            stiffness: *context.stiffness,
        });
        Ok(MainOutputs {
            head_command: head_command.into(),
        })
    }
}

impl CycleContext<'_> {
    /// Where the behaviour wants the head; `None` where nobody knows: it stays.
    fn goal(&self) -> Option<HeadAngles> {
        match self.motion_command.head {
            Wanted::WithBody => None,
            Wanted::Ahead => Some(HeadAngles::default()),
            Wanted::LookAround => self.around.copied(),
            Wanted::LookAt(_) => self.at_point.copied(),
        }
    }
}

/// Why no client may turn the head now.
fn obstacle(command: &MotionCommand) -> Option<&'static str> {
    match command.body {
        BodyMotion::Unstiff | BodyMotion::SitDown => Some("the robot is limp, or about to be"),
        BodyMotion::Penalized => Some("the robot is penalised"),
        _ => None,
    }
}

/// The angles on the straight way to the goal that are within reach, in rad.
fn step(from: HeadAngles, goal: HeadAngles, reach: f32) -> HeadAngles {
    let goal = limits::clamp_head(goal);
    let way = Vector2::new(goal.yaw - from.yaw, goal.pitch - from.pitch);
    // A parameter that is no number reaches nothing.
    let reach = reach.max(0.0);
    if way.norm() <= reach {
        return goal;
    }
    let step = way.normalize() * reach;
    limits::clamp_head(HeadAngles {
        yaw: from.yaw + step.x,
        pitch: from.pitch + step.y,
    })
}

#[cfg(test)]
mod tests {
    use framework::procedure::procedure;
    use framework::{math, testing};
    use nalgebra::Point2;
    use types::motion::Script;

    use super::*;

    const LEFT: HeadAngles = HeadAngles {
        yaw: 0.6,
        pitch: 0.2,
    };
    const RIGHT: HeadAngles = HeadAngles {
        yaw: -0.6,
        pitch: 0.3,
    };

    /// A standing body whose head was sent somewhere.
    struct Situation {
        motion_command: MotionCommand,
        motion_selection: MotionSelection,
        around: Option<HeadAngles>,
        at_point: Option<HeadAngles>,
        positions: Joints<f32>,
        sent: MotorCommands,
    }

    impl Situation {
        fn new(head: Wanted) -> Self {
            Self {
                motion_command: MotionCommand {
                    body: BodyMotion::Stand,
                    head,
                    ..MotionCommand::default()
                },
                motion_selection: MotionSelection {
                    current: BodyMotion::Stand,
                    is_dispatching: false,
                },
                around: Some(LEFT),
                at_point: Some(RIGHT),
                positions: Joints::filled(0.0),
                sent: MotorCommands {
                    positions: Joints::filled(0.0),
                    stiffnesses: Joints::filled(0.6),
                },
            }
        }

        fn context(&self) -> CycleContext<'_> {
            CycleContext {
                motion_command: &self.motion_command,
                motion_selection: &self.motion_selection,
                around: self.around.as_ref(),
                at_point: self.at_point.as_ref(),
                positions: &self.positions,
                previous: Some(&self.sent),
                cycle_time: testing::cycle_time(0, 12),
                velocity: &0.3,
                stiffness: &0.6,
                look_at: None,
            }
        }

        /// Lets the head go where it was sent, no faster than it may.
        fn turn(&mut self, node: &mut HeadMotion, cycles: usize) -> HeadAngles {
            for _ in 0..cycles {
                let command = node.cycle(self.context()).unwrap().head_command.value;
                let HeadAngles { yaw, pitch } = command.unwrap().angles;
                let sent = &mut self.sent.positions;
                let way = math::hypot(yaw - sent.head_yaw, pitch - sent.head_pitch);
                assert!(way <= 0.3 * 0.012 * 1.001, "{way}");
                (sent.head_yaw, sent.head_pitch) = (yaw, pitch);
            }
            HeadAngles {
                yaw: self.sent.positions.head_yaw,
                pitch: self.sent.positions.head_pitch,
            }
        }
    }

    fn node() -> HeadMotion {
        HeadMotion::new(CreationContext {}).unwrap()
    }

    #[test]
    fn the_head_gets_where_the_behaviour_wants_it_at_its_velocity() {
        let mut situation = Situation::new(Wanted::LookAround);
        assert_eq!(situation.turn(&mut node(), 500), LEFT);
        situation.motion_command.head = Wanted::LookAt(Point2::new(1.0, 0.0));
        assert_eq!(situation.turn(&mut node(), 500), RIGHT);
        situation.motion_command.head = Wanted::Ahead;
        assert_eq!(situation.turn(&mut node(), 500), HeadAngles::default());
    }

    #[test]
    fn the_head_is_free_while_the_body_is_upright_or_gets_there_and_goes_with_it_else() {
        let script = BodyMotion::Scripted(Script::KickLeft);
        for (current, is_free) in [
            (BodyMotion::Stand, true),
            (BodyMotion::Penalized, true),
            (BodyMotion::Walk, true),
            (BodyMotion::SitDown, false),
            (BodyMotion::Unstiff, false),
            (script, false),
        ] {
            for is_dispatching in [false, true] {
                let mut situation = Situation::new(Wanted::LookAround);
                situation.motion_selection = MotionSelection {
                    current,
                    is_dispatching,
                };
                let command = node().cycle(situation.context()).unwrap().head_command;
                assert_eq!(command.value.is_some(), is_free, "{current:?}");
            }
        }
    }

    #[test]
    fn the_head_goes_with_the_body_where_the_behaviour_says_so() {
        let situation = Situation::new(Wanted::WithBody);
        let command = node().cycle(situation.context()).unwrap().head_command;
        assert_eq!(command.value, None);
    }

    #[test]
    fn a_head_that_has_nowhere_to_look_stays() {
        let mut situation = Situation::new(Wanted::LookAround);
        situation.around = None;
        situation.sent.positions.head_yaw = 0.1;
        assert_eq!(situation.turn(&mut node(), 10).yaw, 0.1);
    }

    #[test]
    fn a_velocity_that_is_no_number_moves_nothing_and_is_forgotten() {
        let mut node = node();
        let situation = Situation::new(Wanted::LookAround);
        let mut angles = |velocity: &f32| {
            let mut context = situation.context();
            context.velocity = velocity;
            let command = node.cycle(context).unwrap().head_command.value;
            command.unwrap().angles
        };
        assert_eq!(angles(&f32::NAN), HeadAngles::default());
        assert!(angles(&0.3).yaw > 0.0);
    }

    #[test]
    fn a_client_may_ask_the_head_to_look_somewhere_and_let_it_go() {
        let mut node = node();
        let mut situation = Situation::new(Wanted::LookAround);
        let (caller, mut answerer) = procedure();
        let mut ask = |node: &mut HeadMotion, situation: &Situation, request| {
            let pending = caller.call(request);
            answerer.take();
            let mut context = situation.context();
            context.look_at = answerer.call();
            node.cycle(context).unwrap();
            pending.try_answer().unwrap().unwrap()
        };
        let asked = HeadAngles {
            yaw: -0.5,
            pitch: 2.0,
        };
        let answer = ask(&mut node, &situation, HeadRequest::LookAt(asked));
        assert_eq!(answer, limits::clamp_head(asked));
        assert_eq!(situation.turn(&mut node, 500), answer);

        assert_eq!(ask(&mut node, &situation, HeadRequest::Scan), answer);
        assert_eq!(situation.turn(&mut node, 500), LEFT);
    }

    #[test]
    fn a_robot_that_was_limp_or_penalised_looks_where_it_wants_itself() {
        let (caller, mut answerer) = procedure();
        let mut ask = |node: &mut HeadMotion, situation: &Situation| {
            let pending = caller.call(HeadRequest::LookAt(RIGHT));
            answerer.take();
            let mut context = situation.context();
            context.look_at = answerer.call();
            node.cycle(context).unwrap();
            pending.try_answer().unwrap()
        };
        for (body, head, is_out) in [
            (BodyMotion::SitDown, Wanted::WithBody, true),
            // A client has sat it down.
            (BodyMotion::SitDown, Wanted::LookAround, true),
            (BodyMotion::Unstiff, Wanted::WithBody, true),
            (BodyMotion::Penalized, Wanted::WithBody, true),
            // Who gets up goes on to look there.
            (
                BodyMotion::Scripted(Script::StandUpBack),
                Wanted::WithBody,
                false,
            ),
        ] {
            let mut node = node();
            let mut situation = Situation::new(Wanted::LookAround);
            assert_eq!(ask(&mut node, &situation).unwrap(), RIGHT);
            let playing = std::mem::replace(
                &mut situation.motion_command,
                MotionCommand {
                    body,
                    head,
                    ..MotionCommand::default()
                },
            );
            node.cycle(situation.context()).unwrap();
            if is_out {
                assert!(ask(&mut node, &situation).is_err(), "{body:?}");
            }
            situation.motion_command = playing;
            let expected = if is_out { LEFT } else { RIGHT };
            assert_eq!(situation.turn(&mut node, 500), expected, "{body:?}");
        }
    }
}
