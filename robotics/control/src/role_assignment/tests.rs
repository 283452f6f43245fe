//! Who is what by number, distance, and what the referee says.

use framework::testing::at_millis;
use nalgebra::Isometry2;
use types::game::SetPlay;
use types::team::{TeamBall, TeamMessage};

use super::*;

fn roles(distances: &[(u8, Option<f32>)], is_playing: bool) -> Vec<Role> {
    roles_with(distances, is_playing, false)
}

fn roles_with(distances: &[(u8, Option<f32>)], is_playing: bool, is_keeper_out: bool) -> Vec<Role> {
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
            plays_ball: false,
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
    let whose_ball = WhoseBall::default();
    cycle_with(node, primary_state, &referee, whose_ball, ball, &teammates)
}

fn cycle_with(
    node: &mut RoleAssignment,
    primary_state: PrimaryState,
    referee: &Option<GameControllerState>,
    whose_ball: WhoseBall,
    ball: f32,
    teammates: &Vec<Teammate>,
) -> MainOutputs {
    cycle_of(2, node, primary_state, referee, whose_ball, ball, teammates)
}

fn cycle_of(
    number: u8,
    node: &mut RoleAssignment,
    primary_state: PrimaryState,
    referee: &Option<GameControllerState>,
    whose_ball: WhoseBall,
    ball: f32,
    teammates: &Vec<Teammate>,
) -> MainOutputs {
    let context = CycleContext {
        primary_state: &primary_state,
        game_controller_state: referee,
        whose_ball: &whose_ball,
        ball: &Some(Ball {
            position: Point2::new(ball, 0.0),
            ..Ball::default()
        }),
        team_ball: &None,
        teammates,
        player: &Player { number, team: 77 },
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
    // It does not play the ball yet, perhaps because it has not heard how far that is by now.
    assert_eq!(role(1.3, teammate(3, 0.4, 0.0, false)), Role::Striker);
    assert_eq!(role(1.5, teammate(3, 0.4, 0.0, false)), Role::Sweeper);
    assert_eq!(role(1.0, teammate(3, 0.8, 0.0, false)), Role::Sweeper);
    assert_eq!(
        role(1.0, teammate(3, 0.4, 0.0, true)),
        Role::Striker,
        "it lies"
    );
}

/// Robots 2 and 3, who hear each other in every cycle: who of them plays the ball after each, and how often that changed.
fn strikers_at(distances: impl Iterator<Item = [f32; 2]>) -> (Vec<usize>, usize) {
    let mut nodes = [2, 3].map(|_| RoleAssignment::new(CreationContext {}).unwrap());
    let mut said = [2, 3].map(|number| teammate(number, 9.0, 0.0, false));
    let mut plays = [false; 2];
    let (mut counts, mut changes) = (vec![], 0);
    for distances in distances {
        let before = plays;
        for (index, node) in nodes.iter_mut().enumerate() {
            let number = said[index].message.player_number;
            let mates = vec![said[1 - index]];
            let (state, nobodys) = (PrimaryState::Playing, WhoseBall::default());
            let ball = distances[index];
            let outputs = cycle_of(number, node, state, &None, nobodys, ball, &mates);
            plays[index] = outputs.role.value == Some(Role::Striker);
            said[index] = teammate(number, ball, 0.0, false);
            said[index].message.plays_ball = plays[index];
        }
        changes += usize::from(plays != before);
        counts.push(plays.into_iter().filter(|plays| *plays).count());
    }
    (counts, changes)
}

#[test]
fn of_two_that_are_about_as_far_from_the_ball_one_plays_it() {
    // Number 3 comes from 2 m to 0.8 m, and stays; number 2 stands at 1 m.
    let comes = (0..300).map(|cycle| [1.0, (2.0 - 0.01 * cycle as f32).max(0.8)]);
    let (counts, changes) = strikers_at(comes);
    assert!(counts.iter().all(|count| *count == 1), "{counts:?}");
    assert_eq!(changes, 1, "the first");
    // Nearer by more than the head start, it takes the ball over; both know a cycle later.
    let comes = (0..300).map(|cycle| [1.0, (2.0 - 0.01 * cycle as f32).max(0.3)]);
    let (counts, changes) = strikers_at(comes);
    assert_eq!(counts.iter().filter(|count| **count != 1).count(), 1);
    assert_eq!((counts.last(), changes), (Some(&1), 3));
}

#[test]
fn a_ball_that_rolls_away_behind_a_message_is_left_by_nobody() {
    // Number 2 said 1 m, and hears that number 3 is at 0.7 m; number 3 hears no more for seven seconds.
    let mut striker = RoleAssignment::new(CreationContext {}).unwrap();
    let mate = teammate(3, 0.7, 0.0, false);
    let roles = [1.0, 1.1, 1.3, 1.4].map(|ball| cycle(&mut striker, ball, vec![mate]).role.value);
    assert_eq!(roles, [Some(Role::Striker); 4]);
    // As soon as number 3 says that it plays it, it is left the ball.
    let mut mate = mate;
    mate.message.plays_ball = true;
    let role = cycle(&mut striker, 1.4, vec![mate]).role.value;
    assert_eq!(role, Some(Role::Sweeper));
}

#[test]
fn noise_does_not_give_the_ball_to_and_fro() {
    let noise = |cycle: u32| 0.2 * ((cycle * 7919 % 13) as f32 / 6.0 - 1.0);
    let distances = (0..300).map(|cycle| [1.0 + noise(cycle), 1.0 - noise(cycle + 5)]);
    let (counts, changes) = strikers_at(distances);
    assert!(counts.iter().all(|count| *count == 1), "{counts:?}");
    assert_eq!(changes, 1, "the first");
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
fn a_goalkeeper_alone_leaves_its_goal_but_not_at_a_penalty_kick_of_the_others() {
    use KickingTeam::{Nobody, Opponent, Own};
    for (goalkeeper, set_play, kicking_team, role) in [
        (2, SetPlay::PenaltyKick, Opponent, Role::Keeper),
        (2, SetPlay::PenaltyKick, Own, Role::Striker),
        (2, SetPlay::GoalKick, Opponent, Role::Striker),
        (2, SetPlay::None, Nobody, Role::Striker),
        (1, SetPlay::PenaltyKick, Opponent, Role::Striker),
    ] {
        let referee = Some(GameControllerState {
            goalkeeper,
            set_play,
            kicking_team,
            ..GameControllerState::default()
        });
        let mut node = RoleAssignment::new(CreationContext {}).unwrap();
        let whose_ball = referee.map(|referee| referee.whose_ball());
        let whose_ball = whose_ball.unwrap_or_default();
        // Nor does it end because nobody is heard any more.
        for heard in [referee, None] {
            let playing = PrimaryState::Playing;
            let outputs = cycle_with(&mut node, playing, &heard, whose_ball, 1.0, &vec![]);
            assert_eq!(
                outputs.role.value,
                Some(role),
                "{goalkeeper} {set_play:?} {kicking_team:?} {}",
                heard.is_some()
            );
        }
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

#[test]
fn in_a_shoot_out_whose_shot_it_is_decides() {
    use KickingTeam::{Nobody, Opponent, Own};
    use PrimaryState::{Penalized, Playing, Set};
    use types::game::GamePhase;
    for (goalkeeper, state, kicking_team, expected) in [
        (1, Set, Own, Some(Role::Striker)),
        (2, Set, Own, Some(Role::Striker)),
        (2, Playing, Own, Some(Role::Striker)),
        (1, Set, Opponent, Some(Role::Keeper)),
        (1, Playing, Opponent, Some(Role::Keeper)),
        (2, Playing, Opponent, Some(Role::Keeper)),
        // The others of the team are substitutes.
        (1, Penalized, Own, None),
        (2, Set, Nobody, Some(Role::Keeper)),
    ] {
        let mut node = RoleAssignment::new(CreationContext {}).unwrap();
        let referee = Some(GameControllerState {
            game_phase: GamePhase::PenaltyShootout,
            goalkeeper,
            kicking_team,
            ..GameControllerState::default()
        });
        let whose_ball = referee.map(|referee| referee.whose_ball());
        let whose_ball = whose_ball.unwrap_or_default();
        for heard in [referee, None] {
            let outputs = cycle_with(&mut node, state, &heard, whose_ball, 0.4, &vec![]);
            assert_eq!(
                outputs.role.value,
                expected,
                "{goalkeeper} {state:?} {kicking_team:?} {}",
                heard.is_some()
            );
        }
    }
}
