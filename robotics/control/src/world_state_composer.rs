//! Puts everything into one place that the behaviour decides on.

use framework::{Input, MainOutput, Result, context};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::behavior::Role;
use types::fall_state::FallState;
use types::game::{PrimaryState, WhoseBall};
use types::obstacles::Obstacle;
use types::team::Teammate;
use types::world_state::WorldState;

/// Remembers nothing.
#[derive(Debug, Deserialize, Serialize)]
pub struct WorldStateComposer {}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    whose_ball: Input<WhoseBall, "whose_ball">,
    fall_state: Input<FallState, "fall_state">,
    has_ground_contact: Input<bool, "has_ground_contact">,
    ground_to_field: Input<Option<Isometry2<f32>>, "ground_to_field">,
    ball: Input<Option<Ball>, "ball">,
    obstacles: Input<Vec<Obstacle>, "obstacles">,
    teammates: Input<Vec<Teammate>, "teammates">,
    role: Input<Option<Role>, "role">,
    goalkeeper: Input<u8, "goalkeeper">,
    team_ball: Input<Option<Point2<f32>>, "team_ball">,

    /// The robot and what is around it.
    world_state: MainOutput<WorldState>,
}

#[context]
pub struct MainOutputs {}

impl WorldStateComposer {
    /// Nothing to prepare.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {})
    }

    /// Copies.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let WhoseBall {
            game_phase,
            kicking_team,
            set_play,
        } = *context.whose_ball;
        let world_state = context.world_state;
        world_state.primary_state = *context.primary_state;
        world_state.game_phase = game_phase;
        world_state.kicking_team = kicking_team;
        world_state.set_play = set_play;
        world_state.role = *context.role;
        world_state.goalkeeper = *context.goalkeeper;
        world_state.fall_state = *context.fall_state;
        world_state.has_ground_contact = *context.has_ground_contact;
        world_state.ground_to_field = *context.ground_to_field;
        world_state.ball = *context.ball;
        world_state.team_ball = *context.team_ball;
        world_state.obstacles.extend_from_slice(context.obstacles);
        world_state.teammates.extend_from_slice(context.teammates);
        Ok(MainOutputs {})
    }
}

#[cfg(test)]
mod tests {
    use types::fall_state::Facing;
    use types::game::{GamePhase, KickingTeam, SetPlay};

    use super::*;

    #[test]
    fn everything_arrives_where_it_belongs() {
        let mut world_state = WorldState::default();
        let whose_ball = WhoseBall {
            game_phase: GamePhase::Overtime,
            kicking_team: KickingTeam::Own,
            set_play: SetPlay::CornerKick,
        };
        let context = CycleContext {
            primary_state: &PrimaryState::Ready,
            whose_ball: &whose_ball,
            fall_state: &FallState::Lying(Facing::Up),
            has_ground_contact: &true,
            ground_to_field: &Some(Isometry2::translation(1.0, 2.0)),
            ball: &Some(Ball::default()),
            obstacles: &vec![Obstacle::default(); 2],
            teammates: &vec![Teammate::default(); 3],
            role: &Some(Role::Supporter),
            goalkeeper: &4,
            team_ball: &Some(Point2::new(1.0, 2.0)),
            world_state: &mut world_state,
        };
        let mut node = WorldStateComposer::new(CreationContext {}).unwrap();
        node.cycle(context).unwrap();
        let expected = WorldState {
            primary_state: PrimaryState::Ready,
            game_phase: GamePhase::Overtime,
            kicking_team: KickingTeam::Own,
            set_play: SetPlay::CornerKick,
            role: Some(Role::Supporter),
            goalkeeper: 4,
            fall_state: FallState::Lying(Facing::Up),
            has_ground_contact: true,
            ground_to_field: Some(Isometry2::translation(1.0, 2.0)),
            ball: Some(Ball::default()),
            team_ball: Some(Point2::new(1.0, 2.0)),
            obstacles: vec![Obstacle::default(); 2],
            teammates: vec![Teammate::default(); 3],
        };
        assert_eq!(world_state, expected);
    }
}
