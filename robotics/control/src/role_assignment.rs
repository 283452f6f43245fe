//! Decides what this robot is for its team.
//!
//! Every robot decides for itself, from the last messages of the others, by the same rule: the goalkeeper's shirt guards the
//! goal, of the others the one that is nearest to the ball plays it, the rest take their places in the order of their numbers.
//! Messages come every few seconds, so that robots may disagree for as long; who plays the ball already counts as nearer than
//! it is. Where the keeper is out, taken out or far from its goal, the first of the rest stands between ball and goal. Before
//! the ball is in play numbers alone count. A robot that hears nobody plays the ball itself.
//!
//! Whose the goalkeeper's shirt is the referee says, and whoever has been taken out has no role: `teammates` leaves others out.

use framework::{Input, MainOutput, Parameter, Reflect, Result, context};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::ball::Ball;
use types::behavior::Role;
use types::field_markings::FieldMarkings;
use types::game::{GameControllerState, Player, PrimaryState};
use types::team::Teammate;

/// In the order in which players without gloves and without the ball take them.
const PLACES: [Role; 3] = [Role::DefenderLeft, Role::Supporter, Role::DefenderRight];

/// What this robot was last, and what the referee said last.
#[derive(Debug, Deserialize, Serialize)]
pub struct RoleAssignment {
    role: Option<Role>,
    /// Number of the goalkeeper's shirt; a referee that falls silent has not given it to somebody else.
    goalkeeper: Option<u8>,
    /// Whether that one was out.
    is_keeper_out: bool,
}

/// How robots of a team share the work.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct RoleParameters {
    /// Number of the goalkeeper's shirt until the referee says it.
    pub keeper: u8,
    /// So much nearer to the ball than it is the robot counts that plays it.
    #[reflect(unit = "m", range = 0.0..)]
    pub hysteresis: f32,
    /// A keeper that is farther from the middle of its goal is out.
    #[reflect(unit = "m", range = 0.0..)]
    pub keeper_out: f32,
    /// And is back when it is nearer.
    #[reflect(unit = "m", range = 0.0..)]
    pub keeper_back: f32,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    primary_state: Input<PrimaryState, "primary_state">,
    game_controller_state: Input<Option<GameControllerState>, "game_controller_state">,
    ball: Input<Option<Ball>, "ball">,
    team_ball: Input<Option<Point2<f32>>, "team_ball">,
    teammates: Input<Vec<Teammate>, "teammates">,

    /// Who this robot is in the game.
    player: Parameter<Player, "player">,
    parameters: Parameter<RoleParameters, "role_assignment">,
    markings: Parameter<FieldMarkings, "field_dimensions.markings">,
}

#[context]
pub struct MainOutputs {
    /// What this robot is for its team; `None` while it may not play.
    role: MainOutput<Option<Role>>,
    /// Number of the own goalkeeper's shirt; no robot has it where there is none.
    goalkeeper: MainOutput<u8>,
}

impl RoleAssignment {
    /// Alone until somebody is heard.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            role: Some(Role::Striker),
            goalkeeper: None,
            is_keeper_out: false,
        })
    }

    /// From what is known now.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let own = context
            .ball
            .map(|ball| ball.position)
            .or(*context.team_ball)
            .map(|ball| ball.coords.norm());
        let head_start = match self.role {
            Some(Role::Striker) => context.parameters.hysteresis,
            _ => 0.0,
        };
        let said = context.game_controller_state.as_ref();
        self.goalkeeper = said.map(|said| said.goalkeeper).or(self.goalkeeper);
        let goalkeeper = self.goalkeeper.unwrap_or(context.parameters.keeper);
        let others = context.teammates.iter().map(|teammate| Candidate {
            number: teammate.message.player_number,
            distance: distance_to_ball(teammate),
        });
        let own = Candidate {
            number: context.player.number,
            distance: own.map(|distance| distance - head_start),
        };
        self.is_keeper_out = self.is_keeper_out(goalkeeper, &context);
        self.role = match context.primary_state {
            PrimaryState::Penalized => None,
            state => {
                let is_playing = *state == PrimaryState::Playing;
                let is_out = is_playing && self.is_keeper_out;
                Some(role(own, others, goalkeeper, is_playing, is_out))
            }
        };
        Ok(MainOutputs {
            role: self.role.into(),
            goalkeeper: goalkeeper.into(),
        })
    }

    /// Whether the goal is without a keeper: nobody has its shirt who may play, or it has gone far away.
    fn is_keeper_out(&self, goalkeeper: u8, context: &CycleContext<'_>) -> bool {
        let goal = Point2::new(-0.5 * context.markings.length, 0.0);
        let reach = match self.is_keeper_out {
            true => context.parameters.keeper_back,
            false => context.parameters.keeper_out,
        };
        let mut teammates = context.teammates.iter();
        let keeper = teammates.find(|teammate| teammate.message.player_number == goalkeeper);
        // One that does not know where it is stays where it is.
        keeper.is_none_or(|keeper| {
            keeper
                .message
                .ground_to_field
                .is_some_and(|pose| (Point2::from(pose.translation.vector) - goal).norm() > reach)
        })
    }
}

/// Who could play the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    number: u8,
    /// From the ball in m; `None` for one that does not know, or lies.
    distance: Option<f32>,
}

fn role(
    own: Candidate,
    others: impl Iterator<Item = Candidate> + Clone,
    keeper: u8,
    is_playing: bool,
    is_keeper_out: bool,
) -> Role {
    let others = others.filter(|other| other.number != own.number);
    let is_alone = others.clone().next().is_none();
    if own.number == keeper {
        // Nobody else plays, so there is nothing to win at the goal.
        return match is_alone && is_playing {
            true => Role::Striker,
            false => Role::Keeper,
        };
    }
    let field_players = || others.clone().filter(|other| other.number != keeper);
    let comes_before = |one: Candidate, other: Candidate| {
        let key = |candidate: Candidate| match is_playing {
            true => candidate.distance.unwrap_or(f32::INFINITY),
            false => 0.0,
        };
        key(one)
            .total_cmp(&key(other))
            .then(one.number.cmp(&other.number))
            .is_lt()
    };
    let striker = field_players().fold(own, |best, other| match comes_before(other, best) {
        true => other,
        false => best,
    });
    if striker.number == own.number {
        return Role::Striker;
    }
    let before =
        field_players().filter(|other| other.number != striker.number && other.number < own.number);
    match before.count() {
        0 if is_keeper_out => Role::Sweeper,
        before => PLACES[before % PLACES.len()],
    }
}

fn distance_to_ball(teammate: &Teammate) -> Option<f32> {
    let message = &teammate.message;
    let ball = message.ball.filter(|_| !message.is_fallen)?;
    Some(ball.position.coords.norm())
}

#[cfg(test)]
mod tests {
    use framework::testing::at_millis;
    use nalgebra::Isometry2;
    use types::team::{TeamBall, TeamMessage};

    use super::*;

    fn roles(distances: &[(u8, Option<f32>)], is_playing: bool) -> Vec<Role> {
        roles_with(distances, is_playing, false)
    }

    fn roles_with(
        distances: &[(u8, Option<f32>)],
        is_playing: bool,
        is_keeper_out: bool,
    ) -> Vec<Role> {
        let candidate = |&(number, distance)| Candidate { number, distance };
        let all = distances.iter();
        all.clone()
            .map(|own| {
                let others = all.clone().map(candidate);
                role(candidate(own), others, 1, is_playing, is_keeper_out)
            })
            .collect()
    }

    #[test]
    fn roles_by_who_is_there_and_how_far_the_ball_is() {
        use Role::{DefenderLeft, DefenderRight, Keeper, Striker, Supporter};
        let far = Some(4.0);
        for (distances, is_playing, expected) in [
            // Alone, the goalkeeper plays the ball, but not before the game is on.
            (vec![(1, far)], true, vec![Striker]),
            (vec![(1, far)], false, vec![Keeper]),
            (vec![(4, None)], true, vec![Striker]),
            (vec![(1, Some(0.5)), (2, far)], true, vec![Keeper, Striker]),
            // The nearest plays it, whatever its number.
            (
                vec![
                    (1, None),
                    (2, far),
                    (3, Some(1.0)),
                    (4, None),
                    (5, Some(2.0)),
                ],
                true,
                vec![Keeper, DefenderLeft, Striker, Supporter, DefenderRight],
            ),
            // Until it is in play numbers count, and so they do where nobody knows the ball.
            (
                vec![(1, None), (2, far), (3, Some(1.0)), (4, None), (5, None)],
                false,
                vec![Keeper, Striker, DefenderLeft, Supporter, DefenderRight],
            ),
            (
                vec![(1, None), (2, None), (3, None)],
                true,
                vec![Keeper, Striker, DefenderLeft],
            ),
            // A sixth takes the first place again.
            (
                vec![
                    (1, None),
                    (2, Some(1.0)),
                    (3, None),
                    (4, None),
                    (5, None),
                    (6, None),
                ],
                true,
                vec![
                    Keeper,
                    Striker,
                    DefenderLeft,
                    Supporter,
                    DefenderRight,
                    DefenderLeft,
                ],
            ),
        ] {
            assert_eq!(roles(&distances, is_playing), expected, "{distances:?}");
        }
    }

    fn teammate(number: u8, ball: f32, age: f32, is_fallen: bool) -> Teammate {
        Teammate {
            message: TeamMessage {
                player_number: number,
                is_fallen,
                ground_to_field: Some(Isometry2::translation(-4.2, 0.0)),
                ball: Some(TeamBall {
                    position: Point2::new(ball, 0.0),
                    age,
                }),
            },
            heard_at: at_millis(1000),
        }
    }

    fn cycle(node: &mut RoleAssignment, ball: f32, teammates: Vec<Teammate>) -> MainOutputs {
        cycle_in(node, PrimaryState::Playing, None, ball, teammates)
    }

    fn cycle_in(
        node: &mut RoleAssignment,
        primary_state: PrimaryState,
        goalkeeper: Option<u8>,
        ball: f32,
        teammates: Vec<Teammate>,
    ) -> MainOutputs {
        let referee = goalkeeper.map(|goalkeeper| GameControllerState {
            goalkeeper,
            ..GameControllerState::default()
        });
        let context = CycleContext {
            primary_state: &primary_state,
            game_controller_state: &referee,
            ball: &Some(Ball {
                position: Point2::new(ball, 0.0),
                ..Ball::default()
            }),
            team_ball: &None,
            teammates: &teammates,
            player: &Player {
                number: 2,
                team: 77,
            },
            markings: &FieldMarkings {
                length: 9.0,
                ..FieldMarkings::default()
            },
            parameters: &RoleParameters {
                keeper: 1,
                hysteresis: 0.5,
                keeper_out: 1.8,
                keeper_back: 1.2,
            },
        };
        node.cycle(context).unwrap()
    }

    #[test]
    fn who_plays_the_ball_goes_on_while_the_other_is_hardly_nearer() {
        let mut node = RoleAssignment::new(CreationContext {}).unwrap();
        let mut role = |ball, other| cycle(&mut node, ball, vec![other]).role.value.unwrap();
        assert_eq!(role(1.0, teammate(3, 0.8, 0.0, false)), Role::Striker);
        assert_eq!(role(1.0, teammate(3, 0.4, 0.0, false)), Role::Sweeper);
        assert_eq!(role(1.0, teammate(3, 0.8, 0.0, false)), Role::Sweeper);
        assert_eq!(
            role(1.0, teammate(3, 0.4, 0.0, true)),
            Role::Striker,
            "it lies"
        );
    }

    #[test]
    fn the_goalkeeper_is_whom_the_referee_names_and_where_it_names_nobody_there_is_none() {
        use PrimaryState::{Playing, Ready};
        use Role::{DefenderLeft, Keeper, Striker, Supporter, Sweeper};
        for (said, state, mates, role, goalkeeper) in [
            // This robot is number 2, its file says 1; number 3 is nearer to the ball.
            (None, Playing, vec![1, 3], DefenderLeft, 1),
            (Some(1), Playing, vec![1, 3], DefenderLeft, 1),
            (Some(2), Playing, vec![1, 3], Keeper, 2),
            (Some(2), Ready, vec![1, 3], Keeper, 2),
            (Some(2), Ready, vec![], Keeper, 2),
            (Some(2), Playing, vec![], Striker, 2),
            // A goalkeeper plays no ball, and the number 1 is a player as the others are.
            (Some(3), Playing, vec![1, 3], DefenderLeft, 3),
            (Some(3), Playing, vec![3], Striker, 3),
            (Some(1), Ready, vec![1, 3], Striker, 1),
            (Some(3), Ready, vec![1, 3], DefenderLeft, 3),
            // Nobody, a substitute that is no team mate, or a number that no shirt has.
            (Some(0), Playing, vec![1, 3], Supporter, 0),
            (Some(9), Ready, vec![3], Striker, 9),
            // A goal without a keeper is nobody's before the game is on.
            (Some(9), Ready, vec![1], DefenderLeft, 9),
            (Some(9), Playing, vec![1], Sweeper, 9),
            (Some(255), Ready, vec![3], Striker, 255),
        ] {
            let mut node = RoleAssignment::new(CreationContext {}).unwrap();
            let nearer = |number| teammate(number, 0.2 * f32::from(4 - number), 0.0, false);
            let mates: Vec<_> = mates.into_iter().map(nearer).collect();
            let outputs = cycle_in(&mut node, state, said, 2.0, mates.clone());
            assert_eq!(
                (outputs.role.value, outputs.goalkeeper.value),
                (Some(role), goalkeeper),
                "{said:?} {state:?} {mates:?}"
            );
        }
    }

    #[test]
    fn one_of_those_that_do_not_play_the_ball_sweeps_while_the_keeper_is_out() {
        use Role::{DefenderLeft, DefenderRight, Striker, Supporter, Sweeper};
        let players = [2, 3, 4, 5, 6, 7].map(|number| (number, Some(f32::from(number))));
        assert_eq!(
            roles_with(&players, true, true),
            [
                Striker,
                Sweeper,
                Supporter,
                DefenderRight,
                DefenderLeft,
                Supporter
            ]
        );
        assert_eq!(roles_with(&players[..1], true, true), [Striker]);
    }

    #[test]
    fn the_keeper_is_out_without_a_message_or_far_from_its_goal_until_it_is_back() {
        use PrimaryState::{Playing, Ready};
        let mut node = RoleAssignment::new(CreationContext {}).unwrap();
        let mut role = |state, keeper: Option<Option<f32>>| {
            let keeper = keeper.map(|x| {
                let mut keeper = teammate(1, 4.0, 0.0, false);
                keeper.message.ground_to_field = x.map(|x| Isometry2::translation(x, 0.0));
                keeper
            });
            let mates = keeper.into_iter().chain([teammate(3, 0.2, 0.0, false)]);
            cycle_in(&mut node, state, Some(1), 2.0, mates.collect())
                .role
                .value
        };
        for (state, keeper, expected) in [
            (Playing, Some(Some(-4.0)), Role::DefenderLeft),
            // It plays a ball away, then goes further, and comes back.
            (Playing, Some(Some(-3.0)), Role::DefenderLeft),
            (Playing, Some(Some(-2.5)), Role::Sweeper),
            (Playing, Some(Some(-3.0)), Role::Sweeper),
            (Playing, Some(Some(-3.5)), Role::DefenderLeft),
            (Playing, Some(None), Role::DefenderLeft),
            // Taken out, or silent.
            (Playing, None, Role::Sweeper),
            (Ready, None, Role::Striker),
            (Ready, Some(Some(0.0)), Role::Striker),
        ] {
            assert_eq!(role(state, keeper), Some(expected), "{state:?} {keeper:?}");
        }
    }

    #[test]
    fn a_referee_that_falls_silent_has_named_nobody_else() {
        let mut node = RoleAssignment::new(CreationContext {}).unwrap();
        let mut goalkeeper = |said| {
            let mates = vec![teammate(3, 0.2, 0.0, false)];
            let outputs = cycle_in(&mut node, PrimaryState::Playing, said, 2.0, mates);
            outputs.goalkeeper.value
        };
        assert_eq!(goalkeeper(None), 1);
        assert_eq!(goalkeeper(Some(2)), 2);
        assert_eq!(goalkeeper(None), 2);
        assert_eq!(goalkeeper(Some(3)), 3);
    }

    #[test]
    fn who_has_been_taken_out_has_no_role_and_begins_as_any_other() {
        let mut node = RoleAssignment::new(CreationContext {}).unwrap();
        let mut role = |state, other| {
            let mates = vec![teammate(3, other, 0.0, false)];
            cycle_in(&mut node, state, Some(1), 1.0, mates).role.value
        };
        let (playing, penalized) = (PrimaryState::Playing, PrimaryState::Penalized);
        assert_eq!(role(playing, 0.8), Some(Role::Striker));
        assert_eq!(role(penalized, 0.8), None);
        assert_eq!(role(playing, 0.8), Some(Role::Sweeper));
        assert_eq!(role(penalized, 0.8), None);
        assert_eq!(role(playing, 1.2), Some(Role::Striker));
    }
}
