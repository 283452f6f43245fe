//! Who makes room for a mate that gets up.

use types::game::KickingTeam;
use types::obstacles::Obstacle;
use types::team::{TeamMessage, Teammate};

use super::*;

#[test]
fn who_stands_makes_room_for_a_mate_that_gets_up() {
    use PrimaryState::{Playing, Ready, Set};
    let parameters = parameters();
    let RecoveryParameters { near, mate, .. } = parameters.recovery;
    for (state, is_fallen, says, sees, makes_room) in [
        (Playing, true, Some(0.5), 0.4, true),
        (Ready, true, Some(0.5), 0.4, true),
        // It believes itself on the other side, nearly where it may be and farther away; or nowhere.
        (Playing, true, Some(-0.9 * mate), 0.4, true),
        (Playing, true, Some(-1.1 * mate), 0.4, false),
        (Playing, true, None, 0.4, true),
        (Playing, true, Some(0.5), 0.9 * near, true),
        (Playing, true, Some(0.5), 1.1 * near, false),
        (Playing, false, Some(0.5), 0.4, false),
        (Set, true, Some(0.5), 0.4, false),
    ] {
        let keeper = &parameters.keeper;
        let place = match state {
            Ready => parameters.places.before_kick(
                Role::Striker,
                KickingTeam::Nobody,
                SetPlay::None,
                keeper,
            ),
            _ => Isometry2::translation(-2.0, 0.0),
        };
        let message = TeamMessage {
            player_number: 3,
            is_fallen,
            plays_ball: false,
            ground_to_field: says.map(|says| place * Isometry2::translation(0.0, says)),
            ball: None,
        };
        let world_state = WorldState {
            primary_state: state,
            role: Some(Role::Striker),
            ground_to_field: Some(place),
            teammates: vec![Teammate {
                message,
                ..Teammate::default()
            }],
            obstacles: vec![Obstacle {
                position: Point2::new(0.0, sees),
                radius: 0.2,
                ..Obstacle::default()
            }],
            ..WorldState::default()
        };
        let (command, activity) = decision_with(&world_state, None);
        let is_away = activity == Activity::BackOff && command.step.left < 0.0;
        assert_eq!(
            is_away, makes_room,
            "{state:?} {is_fallen} {says:?} {sees}: {activity:?}"
        );
        if !makes_room {
            assert_eq!(command.body, BodyMotion::Stand, "{activity:?}");
        }
    }
}

/// A supporter in its place, a mate so far to its left that lies, m.
fn beside_fallen_mate(aside: f32) -> WorldState {
    let parameters = parameters();
    let place = parameters.places.of_role(
        Role::Supporter,
        Point2::new(2.0, 0.0),
        Point2::origin(),
        &parameters.keeper,
    );
    let beside = Point2::new(0.0, aside);
    let message = TeamMessage {
        is_fallen: true,
        ground_to_field: Some(place * Isometry2::translation(0.0, aside)),
        ..TeamMessage::default()
    };
    WorldState {
        primary_state: PrimaryState::Playing,
        role: Some(Role::Supporter),
        ground_to_field: Some(place),
        ball: ball_seen_from(&place),
        teammates: vec![Teammate {
            message,
            ..Teammate::default()
        }],
        obstacles: vec![Obstacle {
            position: beside,
            radius: 0.2,
            ..Obstacle::default()
        }],
        ..WorldState::default()
    }
}

fn ball_seen_from(place: &Isometry2<f32>) -> Option<Ball> {
    let position = place.inverse() * Point2::new(2.0, 0.0);
    ball(position.x, position.y)
}

#[test]
fn who_made_room_stays_away_until_the_mate_is_up() {
    let parameters = parameters();
    let RecoveryParameters { near, room, .. } = parameters.recovery;
    let mut node = Behavior::new(CreationContext {}).unwrap();
    let mut world_state = beside_fallen_mate(0.4);
    let mut nearest = Vec::new();
    let mut last = Activity::default();
    for cycle in 0..1000 {
        // It is up after ten seconds.
        world_state.teammates[0].message.is_fallen = cycle < 840;
        let millis = 10_000 + 12 * cycle;
        let (command, activity) = cycle_of(&mut node, &world_state, None, millis, &parameters);
        last = activity;
        // A step lasts for some twenty cycles.
        let step = command.step;
        let moved = Isometry2::new(
            Vector2::new(step.forward, step.left) / 20.0,
            step.turn / 20.0,
        );
        let obstacle = &mut world_state.obstacles[0].position;
        *obstacle = moved.inverse() * *obstacle;
        nearest.push(obstacle.coords.norm());
        let place = world_state.ground_to_field.unwrap() * moved;
        world_state.ground_to_field = Some(place);
        world_state.ball = ball_seen_from(&place);
    }
    let away = nearest
        .iter()
        .position(|distance| *distance >= near)
        .unwrap();
    assert!(away < 250, "after {away} cycles");
    let stays = &nearest[away..840];
    assert!(
        stays
            .iter()
            .all(|distance| (near..near + room).contains(distance))
    );
    // And then back to its place.
    assert_eq!(last, Activity::HoldPosition);
    assert!(nearest[999] < near, "{}", nearest[999]);
}

#[test]
fn who_keeps_the_goal_makes_no_room() {
    let mut scene = Scene::at(-4.5, 0.0, 0.0).with_ball(1.5, 0.0);
    scene.world.role = Some(Role::Keeper);
    scene.world.obstacles = vec![Obstacle {
        position: Point2::new(0.0, 0.4),
        radius: 0.2,
        ..Obstacle::default()
    }];
    scene.world.teammates = vec![Teammate {
        message: TeamMessage {
            is_fallen: true,
            ..TeamMessage::default()
        },
        ..Teammate::default()
    }];
    let stands = |activity| {
        move |view: &View<'_>| {
            let still = Decision::of_body(activity, BodyMotion::Stand, view.head());
            make_room(view, still)
        }
    };
    for (activity, set_play, makes_room) in [
        (Activity::GuardGoal, SetPlay::None, true),
        (Activity::GuardGoal, SetPlay::PenaltyKick, false),
        (Activity::Block, SetPlay::None, false),
        (Activity::WatchShot, SetPlay::None, false),
    ] {
        scene.world.set_play = set_play;
        let decided = scene.view(stands(activity)).activity;
        assert_eq!(
            decided == Activity::BackOff,
            makes_room,
            "{activity:?} {set_play:?}"
        );
    }
}

#[test]
fn who_walks_past_a_mate_that_gets_up_walks_on() {
    let mut scene = Scene::at(-2.0, 0.0, 0.0).with_ball(2.0, 0.0);
    scene.world.role = Some(Role::Striker);
    let beside = Obstacle {
        position: Point2::new(0.0, 0.5),
        radius: 0.2,
        ..Obstacle::default()
    };
    scene.world.obstacles = vec![beside];
    let message = TeamMessage {
        is_fallen: true,
        ground_to_field: Some(Isometry2::translation(-2.0, 0.5)),
        ..TeamMessage::default()
    };
    scene.world.teammates = vec![Teammate {
        message,
        ..Teammate::default()
    }];
    assert_eq!(scene.view(decide).activity, Activity::WalkBehindBall);
}
