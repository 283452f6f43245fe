//! Says what this robot knows of itself and the ball, for those who may hear it.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use nalgebra::Isometry2;
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::behavior::Role;
use types::fall_state::FallState;
use types::game::{Player, PrimaryState};
use types::team::{TeamBall, TeamMessage};

/// Keeps nothing between cycles.
#[derive(Debug, Deserialize, Serialize)]
pub struct SelfReport {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    fall_state: Input<FallState, "fall_state">,
    ground_to_field: Input<Option<Isometry2<f32>>, "ground_to_field">,
    ball: Input<Option<Ball>, "ball">,
    role: Input<Option<Role>, "role">,
    cycle_time: CycleTime,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
}

#[context]
pub struct MainOutputs {
    /// For the referee; `None` only where this node failed.
    self_report: MainOutput<Option<TeamMessage>>,
    /// The same for the own team; `None` while this robot is not in the game.
    team_report: MainOutput<Option<TeamMessage>>,
}

impl SelfReport {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// A robot that does not stand is fallen.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        let report = TeamMessage {
            player_number: context.player.number,
            is_fallen: *context.fall_state != FallState::Upright,
            plays_ball: *context.role == Some(Role::Striker),
            ground_to_field: *context.ground_to_field,
            ball: context.ball.map(|ball| as_told(&ball, now)),
        };
        let is_in_the_game = matches!(
            context.primary_state,
            PrimaryState::Ready | PrimaryState::Set | PrimaryState::Playing
        );
        Ok(MainOutputs {
            self_report: Some(report).into(),
            team_report: is_in_the_game.then_some(report).into(),
        })
    }
}

fn as_told(ball: &Ball, now: Timestamp) -> TeamBall {
    TeamBall {
        position: ball.position,
        age: (now - ball.seen_at).as_secs_f32(),
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, cycle_time};
    use nalgebra::{Point2, Vector2};
    use types::fall_state::Facing;

    use super::*;

    fn cycle(primary_state: PrimaryState, fall_state: FallState) -> MainOutputs {
        cycle_as(Some(Role::Keeper), primary_state, fall_state)
    }

    fn cycle_as(
        role: Option<Role>,
        primary_state: PrimaryState,
        fall_state: FallState,
    ) -> MainOutputs {
        let mut node = SelfReport::new(CreationContext {}).unwrap();
        let context = CycleContext {
            primary_state: &primary_state,
            fall_state: &fall_state,
            ground_to_field: &Some(Isometry2::translation(-1.0, 0.5)),
            ball: &Some(Ball {
                position: Point2::new(1.5, -0.5),
                velocity: Vector2::zeros(),
                seen_at: at_millis(500),
            }),
            role: &role,
            cycle_time: cycle_time(2000, 12),
            player: &Player {
                number: 3,
                team: 77,
            },
        };
        node.cycle(context).unwrap()
    }

    #[test]
    fn a_fallen_robot_says_so_and_how_old_its_ball_is() {
        let outputs = cycle(PrimaryState::Playing, FallState::Lying(Facing::Up));
        let report = outputs.self_report.value.unwrap();
        assert_eq!((report.player_number, report.is_fallen), (3, true));
        let ball = TeamBall {
            position: Point2::new(1.5, -0.5),
            age: 1.5,
        };
        assert_eq!(report.ball, Some(ball));
        assert_eq!(
            report.ground_to_field,
            Some(Isometry2::translation(-1.0, 0.5))
        );
        assert_eq!(outputs.team_report.value, Some(report));
    }

    #[test]
    fn the_striker_says_that_it_plays_the_ball() {
        for (role, plays_ball) in [
            (Some(Role::Striker), true),
            (Some(Role::Keeper), false),
            (Some(Role::Supporter), false),
            (None, false),
        ] {
            let outputs = cycle_as(role, PrimaryState::Playing, FallState::Upright);
            let report = outputs.team_report.value.unwrap();
            assert_eq!(report.plays_ball, plays_ball, "{role:?}");
        }
    }

    #[test]
    fn the_team_hears_only_from_robots_in_the_game() {
        for (state, is_heard) in [
            (PrimaryState::Unstiff, false),
            (PrimaryState::Initial, false),
            (PrimaryState::Standby, false),
            (PrimaryState::Ready, true),
            (PrimaryState::Set, true),
            (PrimaryState::Playing, true),
            (PrimaryState::Penalized, false),
            (PrimaryState::Finished, false),
        ] {
            let outputs = cycle(state, FallState::Upright);
            assert_eq!(outputs.team_report.is_some(), is_heard, "{state:?}");
            assert!(outputs.self_report.is_some_and(|report| !report.is_fallen));
        }
    }
}
