//! Puts everything into one place that the behaviour decides on.
//!
//! Whose the ball is stays so when the referee's computer falls silent: a free kick has not ended because the network has.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, context};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::behavior::Role;
use types::fall_state::FallState;
use types::game::{GameControllerState, PrimaryState};
use types::obstacles::Obstacle;
use types::team::Teammate;
use types::world_state::WorldState;

use crate::said::Said;

/// What the referee said last about the game.
#[derive(Debug, Deserialize, Serialize)]
pub struct WorldStateComposer {
    said: Said,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    fall_state: Input<FallState, "fall_state">,
    has_ground_contact: Input<bool, "has_ground_contact">,
    ground_to_field: Input<Option<Isometry2<f32>>, "ground_to_field">,
    ball: Input<Option<Ball>, "ball">,
    obstacles: Input<Vec<Obstacle>, "obstacles">,
    teammates: Input<Vec<Teammate>, "teammates">,
    role: Input<Option<Role>, "role">,
    goalkeeper: Input<u8, "goalkeeper">,
    team_ball: Input<Option<Point2<f32>>, "team_ball">,
    cycle_time: CycleTime,

    /// The ball is free so long after a set play began, also where no referee is heard to say so.
    #[reflect(unit = "s", range = 0.0..)]
    set_play_lasts: Parameter<f32, "world_state_composer.set_play_lasts">,

    /// The robot and what is around it.
    world_state: MainOutput<WorldState>,
}

#[context]
pub struct MainOutputs {}

impl WorldStateComposer {
    /// Has heard nothing: nobody kicks first, and the game is in one of its halves.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            said: Said::default(),
        })
    }

    /// Copies.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let (state, now) = (*context.primary_state, context.cycle_time.start);
        let referee = context.game_controller_state.as_ref();
        self.said = self.said.next(referee, state, now, *context.set_play_lasts);
        let world_state = context.world_state;
        world_state.primary_state = state;
        world_state.game_phase = self.said.game_phase;
        world_state.kicking_team = self.said.kicking_team;
        world_state.set_play = self.said.set_play;
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
    use framework::testing::cycle_time;
    use types::fall_state::Facing;
    use types::game::{GamePhase, KickingTeam, SetPlay};

    use super::*;

    const LASTS: f32 = 30.0;

    fn node() -> WorldStateComposer {
        WorldStateComposer::new(CreationContext {}).unwrap()
    }

    #[test]
    fn everything_arrives_where_it_belongs() {
        let mut world_state = WorldState::default();
        let referee = GameControllerState {
            game_phase: GamePhase::Overtime,
            kicking_team: KickingTeam::Own,
            set_play: SetPlay::CornerKick,
            ..GameControllerState::default()
        };
        let context = CycleContext {
            primary_state: &PrimaryState::Ready,
            game_controller_state: &Some(referee),
            fall_state: &FallState::Lying(Facing::Up),
            has_ground_contact: &true,
            ground_to_field: &Some(Isometry2::translation(1.0, 2.0)),
            ball: &Some(Ball::default()),
            obstacles: &vec![Obstacle::default(); 2],
            teammates: &vec![Teammate::default(); 3],
            role: &Some(Role::Supporter),
            goalkeeper: &4,
            team_ball: &Some(Point2::new(1.0, 2.0)),
            cycle_time: cycle_time(1000, 12),
            set_play_lasts: &LASTS,
            world_state: &mut world_state,
        };
        node().cycle(context).unwrap();
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

    #[test]
    fn whose_the_ball_is_stays_so_in_silence() {
        let mut node = node();
        let corner = GameControllerState {
            kicking_team: KickingTeam::Opponent,
            set_play: SetPlay::CornerKick,
            ..GameControllerState::default()
        };
        let mut at = |now, referee| {
            let mut world_state = WorldState::default();
            let context = CycleContext {
                primary_state: &PrimaryState::Playing,
                game_controller_state: &referee,
                fall_state: &FallState::Upright,
                has_ground_contact: &false,
                ground_to_field: &None,
                ball: &None,
                obstacles: &vec![],
                teammates: &vec![],
                role: &None,
                goalkeeper: &0,
                team_ball: &None,
                cycle_time: cycle_time(now, 12),
                set_play_lasts: &LASTS,
                world_state: &mut world_state,
            };
            node.cycle(context).unwrap();
            (world_state.kicking_team, world_state.set_play)
        };
        let theirs = (KickingTeam::Opponent, SetPlay::CornerKick);
        let nobodys = (KickingTeam::Nobody, SetPlay::None);
        assert_eq!(at(1_000, None), nobodys);
        assert_eq!(at(2_000, Some(corner)), theirs);
        assert_eq!(at(31_900, None), theirs);
        assert_eq!(at(32_100, None), nobodys);
    }
}
