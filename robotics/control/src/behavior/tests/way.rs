//! Who leaves the ball to whom it was stuck with.

use types::game::KickingTeam;
use types::obstacles::Obstacle;

use super::*;

/// What a robot does with its body in so many seconds of the same world, one after the other, and for how many whole seconds.
pub(super) fn stuck_in(
    seconds: f32,
    world_at: impl Fn(f32) -> WorldState,
) -> Vec<(Activity, BodyMotion, u64)> {
    let mut node = Behavior::new(CreationContext {}).unwrap();
    let parameters = parameters();
    let mut done: Vec<(Activity, BodyMotion, u64)> = Vec::new();
    for cycle in 0..(100.0 * seconds) as u64 {
        let world_state = world_at(0.01 * cycle as f32);
        let millis = 1000 + 10 * cycle;
        let (command, activity) = cycle_of(&mut node, &world_state, None, millis, &parameters);
        let backs_off = activity == Activity::BackOff && command.body == BodyMotion::Walk;
        assert_eq!(backs_off, command.step.forward < 0.0);
        match done.last_mut() {
            Some((last, body, cycles)) if (*last, *body) == (activity, command.body) => {
                *cycles += 1;
            }
            _ => done.push((activity, command.body, 1)),
        }
    }
    let whole = |(activity, body, cycles)| (activity, body, (cycles + 50) / 100);
    done.into_iter().map(whole).collect()
}

/// Somebody stands before the robot, behind the ball.
fn at(x: f32, ball_ahead: f32) -> WorldState {
    WorldState {
        primary_state: PrimaryState::Playing,
        ball: ball(ball_ahead, 0.0),
        ground_to_field: Some(Isometry2::translation(x, 0.0)),
        obstacles: vec![Obstacle {
            position: Point2::new(0.5, 0.0),
            radius: 0.2,
            ..Obstacle::default()
        }],
        ..WorldState::default()
    }
}

#[test]
fn in_the_others_half_a_robot_leaves_the_ball_to_whom_it_was_stuck_with() {
    let RecoveryParameters {
        after,
        duration,
        gives_way,
        ..
    } = parameters().recovery;
    let whole = |seconds: f32| seconds.round() as u64;
    let gets_away = after + duration;
    let plays_on = gets_away + gives_way;
    let stands = (Activity::BackOff, BodyMotion::Stand);
    let gives_way_in = |world_at: &dyn Fn(f32) -> WorldState| -> u64 {
        let done = stuck_in(plays_on + 3.0, world_at);
        let backs_off = (Activity::BackOff, BodyMotion::Walk, whole(duration));
        assert!(done.contains(&backs_off), "{done:?}");
        let stood = done
            .iter()
            .filter(|(activity, body, _)| (*activity, *body) == stands);
        stood.map(|(_, _, seconds)| seconds).sum()
    };
    assert_eq!(gives_way_in(&|_| at(1.0, 0.3)), whole(gives_way));
    // Where it does not see the ball itself, too.
    let unseen = |now| WorldState {
        team_ball: Some(Point2::new(1.5, 0.0)),
        ball: ball(0.3, 0.0).filter(|_| now < gets_away),
        ..at(1.0, 0.3)
    };
    assert_eq!(gives_way_in(&unseen), whole(gives_way));
    // The ball lies in the own half.
    assert_eq!(gives_way_in(&|_| at(-0.5, 0.3)), 0);
    // Nobody was there.
    let alone = |_| WorldState {
        obstacles: Vec::new(),
        ..at(1.0, 0.3)
    };
    assert_eq!(gives_way_in(&alone), 0);
    // The referee gives it to the robot's team meanwhile, and it has been touched since.
    let kick_in = |now| WorldState {
        set_play: match now > gets_away && now < gets_away + 1.0 {
            true => SetPlay::KickIn,
            false => SetPlay::None,
        },
        kicking_team: KickingTeam::Own,
        ..at(1.0, 0.3)
    };
    assert_eq!(gives_way_in(&kick_in), 0);
}
