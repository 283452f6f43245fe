//! Decides what body and head do, from what the robot knows about the game and the world.
//!
//! Protects itself where the robot falls, gets up where it plays, still where the rules want it still, else on its feet with an
//! eye on the ball, which it walks to while the game is on. A client may drive the body instead.

use framework::{Input, MainOutput, Parameter, Result, context};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::fall_state::{Facing, FallDirection, FallState};
use types::game::PrimaryState;
use types::motion::{BodyMotion, ClientWish, HeadMotion, MotionCommand, Script, Step};
use types::world_state::WorldState;

pub use self::approach::Approach;
use self::approach::step_towards;

mod approach;

/// What was decided before.
#[derive(Debug, Deserialize, Serialize)]
pub struct Behavior {
    /// Whether the robot walks to the ball.
    is_on_its_way: bool,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    world_state: Input<WorldState, "world_state">,
    client_wish: Input<Option<ClientWish>, "client_wish?">,

    /// How to walk to the ball.
    approach: Parameter<Approach, "behavior.approach">,
}

#[context]
pub struct MainOutputs {
    /// What the robot shall do with itself.
    motion_command: MainOutput<MotionCommand>,
}

impl Behavior {
    /// The ball has not been seen yet.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            is_on_its_way: false,
        })
    }

    /// What the state of the game allows, unless the robot falls or lies.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let decided = decide(context.world_state);
        let step = self.step_to_ball(context.world_state, context.approach);
        let motion_command = match (context.client_wish, step) {
            (Some(wish), _) if decided.body == BodyMotion::Stand => MotionCommand {
                body: wish.body,
                step: wish.step,
                ..decided
            },
            (None, Some(step)) => MotionCommand {
                body: BodyMotion::Walk,
                step,
                ..decided
            },
            _ => decided,
        };
        Ok(MainOutputs {
            motion_command: motion_command.into(),
        })
    }

    /// `None` where the robot shall not walk, or has nowhere to go.
    fn step_to_ball(&mut self, world_state: &WorldState, approach: &Approach) -> Option<Step> {
        let ball = ball_to_walk_to(world_state);
        let step = ball.and_then(|ball| step_towards(ball, self.is_on_its_way, approach));
        self.is_on_its_way = step.is_some();
        step
    }
}

/// In the ground frame, m; `None` where the robot is not to walk to it.
fn ball_to_walk_to(world_state: &WorldState) -> Option<Point2<f32>> {
    let may_walk = world_state.primary_state == PrimaryState::Playing
        && world_state.fall_state == FallState::Upright;
    let ball = world_state.ball.filter(|_| may_walk)?;
    Some(ball.position)
}

/// Without a client and without walking. What robots may do in each state is as in the RoboCup SPL rules 2025.
fn decide(world_state: &WorldState) -> MotionCommand {
    if let Some(body) = on_the_ground(world_state) {
        return command(body, HeadMotion::WithBody);
    }
    match world_state.primary_state {
        PrimaryState::Unstiff => command(BodyMotion::SitDown, HeadMotion::WithBody),
        PrimaryState::Penalized => command(BodyMotion::Penalized, HeadMotion::WithBody),
        PrimaryState::Initial | PrimaryState::Standby => {
            command(BodyMotion::Stand, HeadMotion::LookAround)
        }
        PrimaryState::Ready | PrimaryState::Set | PrimaryState::Playing => {
            let head = world_state.ball.map_or(HeadMotion::LookAround, |ball| {
                HeadMotion::LookAt(ball.position)
            });
            command(BodyMotion::Stand, head)
        }
        PrimaryState::Finished => command(BodyMotion::Stand, HeadMotion::Ahead),
    }
}

/// What a robot that falls or lies does: it protects itself, and gets up where it plays. One that is limp stays so, and nobody
/// has his hands on a robot that moves.
fn on_the_ground(world_state: &WorldState) -> Option<BodyMotion> {
    let script = match world_state.fall_state {
        FallState::Upright | FallState::Sitting => return None,
        FallState::Falling(FallDirection::Forward) => Script::FallForward,
        FallState::Falling(FallDirection::Backward) => Script::FallBackward,
        FallState::Falling(FallDirection::Left | FallDirection::Right) => Script::FallSideways,
        FallState::Lying(Facing::Down) => Script::StandUpFront,
        FallState::Lying(Facing::Up) => Script::StandUpBack,
    };
    let may_move = match world_state.primary_state {
        PrimaryState::Unstiff => false,
        PrimaryState::Ready | PrimaryState::Set | PrimaryState::Playing => true,
        PrimaryState::Initial
        | PrimaryState::Standby
        | PrimaryState::Penalized
        | PrimaryState::Finished => script.protects(),
    };
    Some(if may_move {
        BodyMotion::Scripted(script)
    } else {
        BodyMotion::Unstiff
    })
}

const fn command(body: BodyMotion, head: HeadMotion) -> MotionCommand {
    MotionCommand {
        body,
        head,
        step: Step::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point2;
    use types::ball::Ball;

    use super::approach::tests::APPROACH;
    use super::*;

    fn decision(world_state: &WorldState) -> MotionCommand {
        decision_with(world_state, None)
    }

    fn decision_with(world_state: &WorldState, client_wish: Option<&ClientWish>) -> MotionCommand {
        let mut node = Behavior::new(CreationContext {}).unwrap();
        let context = CycleContext {
            world_state,
            client_wish,
            approach: &APPROACH,
        };
        node.cycle(context).unwrap().motion_command.value
    }

    fn upright(primary_state: PrimaryState, ball: Option<Ball>) -> MotionCommand {
        decision(&WorldState {
            primary_state,
            ball,
            ..WorldState::default()
        })
    }

    #[test]
    fn a_robot_that_shall_be_limp_sits_down_first() {
        let decision = upright(PrimaryState::Unstiff, None);
        assert_eq!(decision, command(BodyMotion::SitDown, HeadMotion::WithBody));
    }

    #[test]
    fn a_penalised_robot_stands_still_with_its_head() {
        let decision = upright(PrimaryState::Penalized, Some(Ball::default()));
        let still = command(BodyMotion::Penalized, HeadMotion::WithBody);
        assert_eq!(decision, still);
    }

    #[test]
    fn before_the_game_the_robot_stands_and_looks_around() {
        let looks_around = command(BodyMotion::Stand, HeadMotion::LookAround);
        for state in [PrimaryState::Initial, PrimaryState::Standby] {
            assert_eq!(upright(state, Some(Ball::default())), looks_around);
        }
    }

    #[test]
    fn in_the_game_the_head_follows_the_ball_and_looks_for_one_that_is_not_known() {
        let ball = Ball {
            position: Point2::new(1.5, -0.2),
            ..Ball::default()
        };
        for state in [
            PrimaryState::Ready,
            PrimaryState::Set,
            PrimaryState::Playing,
        ] {
            let follows = HeadMotion::LookAt(ball.position);
            assert_eq!(upright(state, Some(ball)).head, follows);
            let looks_around = command(BodyMotion::Stand, HeadMotion::LookAround);
            assert_eq!(upright(state, None), looks_around);
        }
    }

    #[test]
    fn the_robot_walks_to_the_ball_while_the_game_is_on_and_at_no_other_time() {
        use PrimaryState::{Finished, Initial, Penalized, Playing, Ready, Set, Standby, Unstiff};
        let far = Ball {
            position: Point2::new(1.5, -0.2),
            ..Ball::default()
        };
        let near = Ball {
            position: Point2::new(0.19, 0.0),
            ..Ball::default()
        };
        let decision = upright(Playing, Some(far));
        assert_eq!(decision.body, BodyMotion::Walk);
        assert!(decision.step.forward > 0.05 && decision.step.turn < 0.0);
        assert_eq!(upright(Playing, Some(near)).body, BodyMotion::Stand);
        for state in [Unstiff, Initial, Standby, Ready, Set, Penalized, Finished] {
            assert_ne!(
                upright(state, Some(far)).body,
                BodyMotion::Walk,
                "{state:?}"
            );
        }
    }

    #[test]
    fn a_client_drives_a_robot_that_stands_or_walks_and_no_other() {
        let step = Step {
            left: 0.02,
            ..Step::ZERO
        };
        let wish = ClientWish {
            body: BodyMotion::Walk,
            step,
        };
        let with_ball = |primary_state, fall_state| WorldState {
            primary_state,
            fall_state,
            ball: Some(Ball {
                position: Point2::new(1.0, 0.0),
                ..Ball::default()
            }),
            ..WorldState::default()
        };
        for (primary_state, fall_state, body) in [
            (PrimaryState::Initial, FallState::Upright, BodyMotion::Walk),
            (PrimaryState::Playing, FallState::Upright, BodyMotion::Walk),
            (
                PrimaryState::Penalized,
                FallState::Upright,
                BodyMotion::Penalized,
            ),
            (
                PrimaryState::Unstiff,
                FallState::Upright,
                BodyMotion::SitDown,
            ),
            (
                PrimaryState::Initial,
                FallState::Lying(Facing::Up),
                BodyMotion::Unstiff,
            ),
        ] {
            let world_state = with_ball(primary_state, fall_state);
            let decision = decision_with(&world_state, Some(&wish));
            assert_eq!(decision.body, body, "{primary_state:?}");
            assert_eq!(decision.step == step, body == BodyMotion::Walk);
        }
    }

    #[test]
    fn after_the_game_the_robot_stands_and_looks_ahead() {
        let decision = upright(PrimaryState::Finished, Some(Ball::default()));
        assert_eq!(decision, command(BodyMotion::Stand, HeadMotion::Ahead));
    }

    #[test]
    fn a_sitting_robot_rises_for_the_game() {
        let world_state = WorldState {
            primary_state: PrimaryState::Initial,
            fall_state: FallState::Sitting,
            ..WorldState::default()
        };
        assert_eq!(decision(&world_state).body, BodyMotion::Stand);
    }

    #[test]
    fn whoever_falls_protects_itself_and_whoever_lies_gets_up_where_it_plays() {
        use PrimaryState::{Finished, Initial, Penalized, Playing, Ready, Unstiff};
        let falls = FallState::Falling(FallDirection::Left);
        let lies = FallState::Lying(Facing::Up);
        let body = |primary_state, fall_state| {
            let world_state = WorldState {
                primary_state,
                fall_state,
                ..WorldState::default()
            };
            decision(&world_state).body
        };
        for state in [Initial, Ready, Playing, Penalized, Finished] {
            let protects = BodyMotion::Scripted(Script::FallSideways);
            assert_eq!(body(state, falls), protects, "{state:?}");
        }
        for state in [Ready, Playing] {
            let rises = BodyMotion::Scripted(Script::StandUpBack);
            assert_eq!(body(state, lies), rises, "{state:?}");
        }
        for state in [Initial, Penalized, Finished, Unstiff] {
            assert_eq!(body(state, lies), BodyMotion::Unstiff, "{state:?}");
        }
        assert_eq!(body(Unstiff, falls), BodyMotion::Unstiff);
    }
}
