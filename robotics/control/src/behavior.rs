//! Decides what body and head do, from what the robot knows about the game and the world.
//!
//! Limp where the robot falls or lies, still where the rules want it still, else on its feet with an
//! eye on the ball.

use framework::{Input, MainOutput, Result, context};
use serde::{Deserialize, Serialize};
use types::fall_state::FallState;
use types::game::PrimaryState;
use types::motion::{BodyMotion, HeadMotion, MotionCommand};
use types::world_state::WorldState;

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct Behavior {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    world_state: Input<WorldState, "world_state">,
}

#[context]
pub struct MainOutputs {
    /// What the robot shall do with itself.
    motion_command: MainOutput<MotionCommand>,
}

impl Behavior {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// What the state of the game allows, unless the robot falls or lies.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs {
            motion_command: decide(context.world_state).into(),
        })
    }
}

/// What robots may do in each state is as in the RoboCup SPL rules 2025.
fn decide(world_state: &WorldState) -> MotionCommand {
    if let FallState::Falling(_) | FallState::Lying(_) = world_state.fall_state {
        return command(BodyMotion::Unstiff, HeadMotion::WithBody);
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

const fn command(body: BodyMotion, head: HeadMotion) -> MotionCommand {
    MotionCommand { body, head }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point2;
    use types::ball::Ball;
    use types::fall_state::{Facing, FallDirection};

    use super::*;

    fn decision(world_state: &WorldState) -> MotionCommand {
        let mut node = Behavior::new(CreationContext {}).unwrap();
        let outputs = node.cycle(CycleContext { world_state }).unwrap();
        outputs.motion_command.value
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
            let follows = command(BodyMotion::Stand, HeadMotion::LookAt(ball.position));
            assert_eq!(upright(state, Some(ball)), follows);
            let looks_around = command(BodyMotion::Stand, HeadMotion::LookAround);
            assert_eq!(upright(state, None), looks_around);
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
    fn whoever_falls_or_lies_is_limp_whatever_the_game_says() {
        let limp = command(BodyMotion::Unstiff, HeadMotion::WithBody);
        for fall_state in [
            FallState::Falling(FallDirection::Left),
            FallState::Lying(Facing::Up),
        ] {
            for primary_state in [PrimaryState::Playing, PrimaryState::Unstiff] {
                let world_state = WorldState {
                    primary_state,
                    fall_state,
                    ..WorldState::default()
                };
                assert_eq!(decision(&world_state), limp);
            }
        }
    }
}
