//! Puts everything into one place that the behaviour decides on.
//!
//! Whose the ball is stays so when the referee's computer falls silent: a free kick has not ended because the network has.

use framework::{CycleTime, Input, MainOutput, Parameter, Result, Timestamp, context};
use nalgebra::{Isometry2, Point2};
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::behavior::Role;
use types::fall_state::FallState;
use types::game::{GameControllerState, GamePhase, KickingTeam, PrimaryState, SetPlay};
use types::obstacles::Obstacle;
use types::team::Teammate;
use types::world_state::WorldState;

/// What the referee said last about the game.
#[derive(Debug, Deserialize, Serialize)]
pub struct WorldStateComposer {
    said: Said,
}

/// Whose the ball is, and what this robot did when that was said.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
struct Said {
    primary_state: PrimaryState,
    game_phase: GamePhase,
    kicking_team: KickingTeam,
    set_play: SetPlay,
    /// Since when it is this set play, in this state.
    since: Timestamp,
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
        self.said = match context.game_controller_state {
            Some(referee) => self.said.after(referee, state, now),
            None => self.said.in_silence(state, now, *context.set_play_lasts),
        };
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

impl Said {
    /// The referee says it now.
    fn after(
        self,
        referee: &GameControllerState,
        primary_state: PrimaryState,
        now: Timestamp,
    ) -> Self {
        let goes_on = self.primary_state == primary_state && self.set_play == referee.set_play;
        Self {
            primary_state,
            game_phase: referee.game_phase,
            kicking_team: referee.kicking_team,
            set_play: referee.set_play,
            since: if goes_on { self.since } else { now },
        }
    }

    /// Nobody says anything: it holds until somebody at the buttons, or the end of the set play, makes something else of the
    /// game. A whistle in Set does not.
    fn in_silence(self, primary_state: PrimaryState, now: Timestamp, set_play_lasts: f32) -> Self {
        let is_kicked_off =
            self.primary_state == PrimaryState::Set && primary_state == PrimaryState::Playing;
        if is_kicked_off {
            return Self {
                primary_state,
                since: now,
                ..self
            };
        }
        let is_over = primary_state == PrimaryState::Playing
            && self.game_phase != GamePhase::PenaltyShootout
            && self.set_play != SetPlay::None
            && (now - self.since).as_secs_f32() > set_play_lasts;
        if primary_state != self.primary_state || is_over {
            return Self {
                primary_state,
                since: now,
                ..Self::default()
            };
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::cycle_time;
    use types::fall_state::Facing;

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

    /// A cycle at `now` ms with what the referee says.
    fn cycle(
        node: &mut WorldStateComposer,
        now: u64,
        primary_state: PrimaryState,
        said: Option<(GamePhase, KickingTeam, SetPlay)>,
    ) -> (GamePhase, KickingTeam, SetPlay) {
        let mut world_state = WorldState::default();
        let referee = said.map(|(game_phase, kicking_team, set_play)| GameControllerState {
            game_phase,
            kicking_team,
            set_play,
            ..GameControllerState::default()
        });
        let context = CycleContext {
            primary_state: &primary_state,
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
        (
            world_state.game_phase,
            world_state.kicking_team,
            world_state.set_play,
        )
    }

    const NOTHING: (GamePhase, KickingTeam, SetPlay) =
        (GamePhase::Normal, KickingTeam::Nobody, SetPlay::None);

    #[test]
    fn who_has_never_heard_a_referee_knows_of_no_set_play() {
        let said = cycle(&mut node(), 12, PrimaryState::Playing, None);
        assert_eq!(said, NOTHING);
    }

    #[test]
    fn a_free_kick_goes_on_in_silence_until_its_time_is_over() {
        let corner = (
            GamePhase::Normal,
            KickingTeam::Opponent,
            SetPlay::CornerKick,
        );
        let (mut node, playing) = (node(), PrimaryState::Playing);
        cycle(&mut node, 1_000, playing, Some(NOTHING));
        cycle(&mut node, 2_000, playing, Some(corner));
        assert_eq!(cycle(&mut node, 10_000, playing, Some(corner)), corner);
        assert_eq!(cycle(&mut node, 31_900, playing, None), corner);
        assert_eq!(cycle(&mut node, 32_100, playing, None), NOTHING);
        // Whoever is heard knows better.
        assert_eq!(cycle(&mut node, 33_000, playing, Some(corner)), corner);
        assert_eq!(cycle(&mut node, 34_000, playing, Some(NOTHING)), NOTHING);
        assert_eq!(cycle(&mut node, 35_000, playing, None), NOTHING);
    }

    #[test]
    fn a_shot_of_the_shoot_out_goes_on_in_silence() {
        let shot = (
            GamePhase::PenaltyShootout,
            KickingTeam::Opponent,
            SetPlay::PenaltyKick,
        );
        let mut node = node();
        cycle(&mut node, 1_000, PrimaryState::Set, Some(shot));
        assert_eq!(cycle(&mut node, 5_000, PrimaryState::Playing, None), shot);
        assert_eq!(cycle(&mut node, 65_000, PrimaryState::Playing, None), shot);
    }

    #[test]
    fn a_whistle_in_silence_lets_the_others_kick_off_and_a_button_ends_what_was_said() {
        let kick_off = (GamePhase::Normal, KickingTeam::Opponent, SetPlay::None);
        let mut node = node();
        cycle(&mut node, 1_000, PrimaryState::Ready, Some(kick_off));
        cycle(&mut node, 2_000, PrimaryState::Set, Some(kick_off));
        let playing = cycle(&mut node, 9_000, PrimaryState::Playing, None);
        assert_eq!(playing, kick_off);
        let penalized = cycle(&mut node, 10_000, PrimaryState::Penalized, None);
        assert_eq!(penalized, NOTHING);
    }
}
