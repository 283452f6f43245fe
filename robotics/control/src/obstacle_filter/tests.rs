//! Robots, posts, and hands in front of robots that stand and turn.

use std::f32::consts::FRAC_PI_2;
use std::sync::LazyLock;

use framework::testing::{ParameterFile, at_millis, cycle_time, history, perception};
use framework::{Timestamp, math};
use nalgebra::{Point2, Vector2};

use super::hypotheses::MOST_HYPOTHESES;
use super::*;

type Seen<'a> = Vec<(Timestamp, &'a Vec<ObstacleCandidate>)>;

/// What the body feels in a cycle.
#[derive(Clone, Copy, Default)]
struct Felt {
    sonar: SonarDistances,
    bumpers: Feet<bool>,
    fall_state: FallState,
}

const LEFT_ECHO: Felt = Felt {
    sonar: SonarDistances {
        left: Some(0.5),
        right: None,
    },
    bumpers: Feet {
        left: false,
        right: false,
    },
    fall_state: FallState::Upright,
};

const RIGHT_TOUCH: Felt = Felt {
    sonar: SonarDistances {
        left: None,
        right: None,
    },
    bumpers: Feet {
        left: false,
        right: true,
    },
    fall_state: FallState::Upright,
};

/// Those of the robot.
fn parameters() -> ObstacleFilterParameters {
    static PARAMETERS: LazyLock<ObstacleFilterParameters> = LazyLock::new(|| {
        ParameterFile::new(include_str!("../../../parameters/default.toml")).get("obstacle_filter")
    });
    *PARAMETERS
}

fn node() -> ObstacleFilter {
    ObstacleFilter::new(CreationContext {}).unwrap()
}

fn candidate(x: f32, y: f32) -> Vec<ObstacleCandidate> {
    vec![ObstacleCandidate {
        position: Point2::new(x, y),
        ..ObstacleCandidate::default()
    }]
}

/// A cycle at `now` ms of a robot that has turned by `yaw` since the start.
fn cycle_at(
    node: &mut ObstacleFilter,
    (now, yaw): (u64, f32),
    felt: Felt,
    (persistent, transient): (Seen<'_>, Seen<'_>),
) -> Vec<Obstacle> {
    let start = Odometry::default();
    let turned = Odometry {
        ground_to_start: Isometry2::new(Vector2::zeros(), yaw),
    };
    let past = [(Timestamp::ZERO, &start)];
    let mut obstacles = Vec::new();
    let context = CycleContext {
        candidates: perception(&persistent, &transient),
        odometry: history(&past, at_millis(now), &turned),
        sonar_distances: &felt.sonar,
        bumpers: &felt.bumpers,
        fall_state: &felt.fall_state,
        cycle_time: cycle_time(now, 12),
        parameters: &parameters(),
        obstacles: &mut obstacles,
    };
    node.cycle(context).unwrap();
    obstacles
}

/// A cycle in which the robot stands and feels nothing.
fn cycle(node: &mut ObstacleFilter, now: u64, seen: Seen<'_>) -> Vec<Obstacle> {
    cycle_at(node, (now, 0.0), Felt::default(), (seen, vec![]))
}

fn images(from: u64, count: u64, seen: &Vec<ObstacleCandidate>) -> Seen<'_> {
    let image = |index| (at_millis(from + 33 * index), seen);
    (0..count).map(image).collect()
}

fn assert_near(found: Point2<f32>, x: f32, y: f32) {
    let error = (found - Point2::new(x, y)).norm();
    assert!(error <= 1e-5, "{found} is not ({x}, {y})");
}

#[test]
fn a_robot_that_was_seen_often_enough_stands_behind_its_feet() {
    let (mut node, seen) = (node(), candidate(1.0, 0.0));
    assert_eq!(cycle(&mut node, 140, images(0, 4, &seen)), []);
    let obstacles = cycle(&mut node, 200, images(132, 1, &seen));
    assert_near(obstacles[0].position, 1.07, 0.0);
    assert_eq!(obstacles.len(), 1);
    assert_eq!(obstacles[0].kind, ObstacleKind::Robot);
    assert_eq!(obstacles[0].radius, 0.2);
    assert_eq!(obstacles[0].seen_at, at_millis(132));
}

#[test]
fn an_obstacle_is_remembered_until_it_is_too_old() {
    let (mut node, seen) = (node(), candidate(1.0, 0.0));
    cycle(&mut node, 400, images(0, 10, &seen));
    assert_eq!(cycle(&mut node, 5290, vec![]).len(), 1);
    assert_eq!(cycle(&mut node, 5310, vec![]), []);
}

#[test]
fn transient_candidates_answer_but_are_not_learnt() {
    let (mut node, seen) = (node(), candidate(1.0, 0.0));
    let transient = (vec![], images(0, 5, &seen));
    let felt = Felt::default();
    assert_eq!(cycle_at(&mut node, (200, 0.0), felt, transient).len(), 1);
    assert_eq!(cycle(&mut node, 212, vec![]), []);
}

#[test]
fn what_was_seen_before_a_turn_stands_beside_the_robot_after_it() {
    let seen = candidate(1.0, 0.0);
    let persistent = (images(0, 5, &seen), vec![]);
    let felt = Felt::default();
    let obstacles = cycle_at(&mut node(), (200, FRAC_PI_2), felt, persistent);
    assert_near(obstacles[0].position, 0.0, -1.07);
}

#[test]
fn the_nearest_stands_first() {
    let far_and_near = [candidate(2.0, 0.0), candidate(0.5, 0.5)].concat();
    let obstacles = cycle(&mut node(), 400, images(0, 10, &far_and_near));
    assert_eq!(obstacles.len(), 2);
    assert!(obstacles[0].position.x < 1.0 && obstacles[1].position.x > 2.0);
}

#[test]
fn an_echo_on_one_side_is_something_on_that_side() {
    let mut node = node();
    let mut obstacles = Vec::new();
    for index in 0..60 {
        obstacles = cycle_at(&mut node, (12 * index, 0.0), LEFT_ECHO, (vec![], vec![]));
    }
    // The echo comes from its near side.
    let (sine, cosine) = math::sin_cos(parameters().sonar_angle);
    assert_near(obstacles[0].position, 0.625 * cosine, 0.625 * sine);
    assert_eq!(obstacles[0].kind, ObstacleKind::Unknown);
    assert_eq!(obstacles[0].radius, 0.125);
}

#[test]
fn echoes_on_both_sides_are_one_thing_ahead_and_far_ones_nothing() {
    for (distance, count) in [(0.5, 1), (2.0, 0), (f32::NAN, 0)] {
        let mut node = node();
        let mut obstacles = Vec::new();
        let both = Felt {
            sonar: SonarDistances {
                left: Some(distance),
                right: Some(distance + 0.1),
            },
            ..Felt::default()
        };
        for index in 0..60 {
            obstacles = cycle_at(&mut node, (12 * index, 0.0), both, (vec![], vec![]));
        }
        assert_eq!(obstacles.len(), count, "at {distance} m");
        for obstacle in obstacles {
            assert_near(obstacle.position, 0.675, 0.0);
        }
    }
}

#[test]
fn what_a_foot_touches_is_there_at_once() {
    let obstacles = cycle_at(&mut node(), (12, 0.0), RIGHT_TOUCH, (vec![], vec![]));
    assert_eq!(obstacles.len(), 1);
    // The foot touches its near side.
    let distance = parameters().bumper_distance + parameters().unknown_radius;
    let (sine, cosine) = math::sin_cos(parameters().bumper_angle);
    assert_near(obstacles[0].position, distance * cosine, -distance * sine);
}

#[test]
fn a_bumper_that_sticks_is_no_obstacle_for_longer_than_a_touch() {
    let mut node = node();
    let mut at = |now: u64, felt| cycle_at(&mut node, (now, 0.0), felt, (vec![], vec![])).len();
    let last = (0..700).map(|index| at(12 * index, RIGHT_TOUCH)).last();
    assert_eq!(last, Some(0));
    assert_eq!(at(8412, Felt::default()), 0);
    assert_eq!(at(8424, RIGHT_TOUCH), 1, "it was let go");
}

#[test]
fn a_robot_that_lies_hears_and_touches_the_ground_alone() {
    use types::fall_state::{Facing, FallDirection};
    for fall_state in [
        FallState::Falling(FallDirection::Forward),
        FallState::Lying(Facing::Down),
        FallState::Sitting,
    ] {
        let mut node = node();
        let felt = Felt {
            sonar: LEFT_ECHO.sonar,
            bumpers: RIGHT_TOUCH.bumpers,
            fall_state,
        };
        for index in 0..60 {
            let found = cycle_at(&mut node, (12 * index, 0.0), felt, (vec![], vec![]));
            assert_eq!(found, [], "{fall_state:?}");
        }
    }
}

#[test]
fn an_echo_from_a_robot_does_not_make_it_something_else() {
    let mut node = node();
    let angle = parameters().sonar_angle;
    let seen = candidate(0.3 * math::cos(angle), 0.3 * math::sin(angle));
    cycle(&mut node, 400, images(0, 10, &seen));
    let obstacles = cycle_at(&mut node, (412, 0.0), LEFT_ECHO, (vec![], vec![]));
    assert_eq!(obstacles.len(), 1);
    assert_eq!(obstacles[0].kind, ObstacleKind::Robot);
}

#[test]
fn a_camera_moves_what_an_echo_repeats_in_every_cycle() {
    let (mut node, seen) = (node(), candidate(0.75, 0.0));
    let ahead = Felt {
        sonar: SonarDistances {
            left: Some(0.6),
            right: Some(0.6),
        },
        ..Felt::default()
    };
    let mut obstacles = Vec::new();
    for index in 0..200 {
        let now = 12 * index;
        let image = (index % 3 == 0).then_some((at_millis(now), &seen));
        let seen = (image.into_iter().collect(), vec![]);
        obstacles = cycle_at(&mut node, (now, 0.0), ahead, seen);
    }
    // Four fifths of the way from the echo's 0.725 m to the camera's 0.82 m.
    assert_eq!(obstacles.len(), 1);
    assert!(obstacles[0].position.x > 0.79, "{}", obstacles[0].position);
}

#[test]
fn an_echo_counts_the_same_however_often_it_is_repeated() {
    let variance = |step| {
        let felt: Vec<_> = echoes(&LEFT_ECHO.sonar, step, &parameters()).collect();
        math::powi(felt[0].noise, 2) * step
    };
    assert!((variance(0.012) - variance(0.1)).abs() < 1e-6);
    assert_eq!(echoes(&LEFT_ECHO.sonar, 0.0, &parameters()).count(), 0);
}

#[test]
fn what_is_sure_stays_however_many_things_are_seen_once() {
    let (mut node, sure) = (node(), candidate(1.0, 0.0));
    cycle(&mut node, 400, images(0, 10, &sure));
    let once: Vec<_> = (0..MOST_HYPOTHESES)
        .flat_map(|index| candidate(2.0 + (index % 4) as f32, 1.0 + (index / 4) as f32))
        .collect();
    let obstacles = cycle(&mut node, 500, images(400, 1, &once));
    assert_eq!(obstacles.len(), 1, "{obstacles:?}");
    assert_near(obstacles[0].position, 1.07, 0.0);
}

#[test]
fn candidates_that_are_nowhere_are_no_obstacles() {
    let nonsense = [candidate(f32::NAN, 0.0), candidate(f32::INFINITY, 1.0)].concat();
    let mut node = node();
    assert_eq!(cycle(&mut node, 400, images(0, 10, &nonsense)), []);
    let seen = candidate(1.0, 0.0);
    assert_eq!(cycle(&mut node, 800, images(400, 10, &seen)).len(), 1);
}
