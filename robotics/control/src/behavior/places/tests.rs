//! Places are legal, out of each other's way, and on the field.

use std::f32::consts::PI;

use framework::testing::ParameterFile;
use types::field_markings::FieldMarkings;

use super::*;
use crate::behavior::tests::parameters;

const ROLES: [Role; 5] = [
    Role::Striker,
    Role::Keeper,
    Role::Supporter,
    Role::DefenderLeft,
    Role::DefenderRight,
];

#[test]
fn places_before_a_kick_off_are_legal_and_nobody_stands_in_the_way() {
    let parameters = parameters();
    for (kicking_team, least) in [(KickingTeam::Own, 0.2), (KickingTeam::Opponent, 0.75)] {
        let places = ROLES.map(|role| {
            let places = &parameters.places;
            let pose = places.before_kick(role, kicking_team, SetPlay::None, &parameters.keeper);
            pose.translation.vector
        });
        for (index, place) in places.iter().enumerate() {
            assert!(place.x < -0.1 && place.norm() > least + 0.1, "{place}");
            assert!(place.x > -4.5 && place.y.abs() < 3.0, "{place}");
            let others = places.iter().skip(index + 1);
            assert!(others.into_iter().all(|other| (place - other).norm() > 0.5));
        }
    }
}

#[test]
fn at_a_penalty_kick_of_the_others_only_the_keeper_is_in_the_penalty_area_on_its_line() {
    let parameters = parameters();
    for role in ROLES {
        let pose = parameters.places.before_kick(
            role,
            KickingTeam::Opponent,
            SetPlay::PenaltyKick,
            &parameters.keeper,
        );
        let place = pose.translation.vector;
        let is_inside = place.x < -2.85 && place.y.abs() < 2.0;
        assert_eq!(is_inside, role == Role::Keeper, "{role:?}");
        // The rules want a foot of it on the line.
        assert!(!is_inside || place.x == -4.5, "{place}");
    }
}

#[test]
fn roles_stand_between_ball_and_goal_and_look_at_the_ball() {
    let parameters = parameters();
    for ball in [[0.0, 0.0], [-3.0, 1.5], [4.0, -2.5], [-4.4, 0.1]] {
        let ball = Point2::from(ball);
        for role in ROLES {
            let pose = parameters
                .places
                .of_role(role, ball, Point2::origin(), &parameters.keeper);
            let place = Point2::from(pose.translation.vector);
            assert!(
                place.x.abs() <= 4.5 && place.y.abs() <= 3.0,
                "{role:?}: {place}"
            );
            let ahead = pose.rotation * Vector2::x();
            if (ball - place).norm() > 0.1 {
                assert!(ahead.dot(&(ball - place)) > 0.0, "{role:?}");
            }
            if role == Role::Keeper {
                assert!(place.y.abs() <= 0.75 && place.x < -3.8, "{place}");
            }
        }
    }
}

#[test]
fn however_near_the_ball_is_three_at_most_stand_in_the_own_goal_area_and_nobody_beside_a_post() {
    let parameters = parameters();
    let file = ParameterFile::new(include_str!("../../../../parameters/default.toml"));
    let field: FieldMarkings = file.get("field_dimensions.markings");
    let (front, side) = (
        field.goal_area_length - field.length / 2.0,
        field.goal_area_width / 2.0,
    );
    let is_inside = |place: &Point2<f32>| place.x < front + 0.1 && place.y.abs() < side + 0.1;
    let grid = (0..=15).flat_map(|x| (-30..=30).map(move |y| [x, y]));
    for [x, y] in grid {
        let ball = Point2::new(0.1 * x as f32 - 4.5, 0.1 * y as f32);
        let place = |role| {
            let pose = parameters
                .places
                .of_role(role, ball, Point2::origin(), &parameters.keeper);
            Point2::from(pose.translation.vector)
        };
        let others = [Role::Supporter, Role::DefenderLeft, Role::DefenderRight].map(place);
        // The striker is at the ball.
        let may_be_inside = [place(Role::Keeper), ball, place(Role::Sweeper)];
        let all = may_be_inside.iter().chain(&others);
        let inside = all.filter(|place| is_inside(place)).count();
        assert!(inside <= 3, "{inside} at {ball}: {others:?}");
        let apart = (others[1] - others[2]).norm();
        assert!(apart > 0.7, "{ball}: {others:?}");
        for place in others {
            let posts = parameters.places.posts(0.0);
            assert!(
                posts.iter().all(|post| (place - post.middle).norm() > 0.25),
                "{ball}: {others:?}"
            );
            // Nor in the way of whoever plays the ball.
            assert!((place - ball).norm() > 0.59, "{ball}: {others:?}");
        }
        // Nor where the others have a free kick there, and are given room.
        let given = [
            Role::Supporter,
            Role::DefenderLeft,
            Role::DefenderRight,
            Role::Striker,
        ]
        .map(|role| {
            let pose = parameters
                .places
                .of_role(role, ball, Point2::origin(), &parameters.keeper);
            let pose = parameters.places.at_a_distance(&pose, ball);
            Point2::from(pose.translation.vector)
        });
        let all = given.iter().chain([&may_be_inside[0]]);
        let inside = all.filter(|place| is_inside(place)).count();
        assert!(inside <= 3, "{inside} at {ball}: {given:?}");
    }
}

#[test]
fn the_supporter_stays_on_its_side_of_a_ball_in_the_middle() {
    let parameters = parameters();
    for (ball, own, side) in [
        (0.05, 1.0, 1.0),
        (-0.05, 1.0, 1.0),
        (0.05, -1.0, -1.0),
        // Of another ball it comes to the side on which more of the field is.
        (0.5, 1.0, -1.0),
        (-0.5, 1.0, 1.0),
    ] {
        let (ball, own) = (Point2::new(-3.6, ball), Point2::new(-3.5, own));
        let places = &parameters.places;
        let pose = places.of_role(Role::Supporter, ball, own, &parameters.keeper);
        assert!(pose.translation.y * side > 1.0, "{ball} from {own}: {pose}");
    }
}

#[test]
fn a_free_kick_of_the_others_is_given_room() {
    let places = parameters().places;
    for (place, is_moved) in [([0.5, 0.0], true), ([-2.0, 0.0], false)] {
        let pose = Isometry2::translation(place[0], place[1]);
        let moved = places.at_a_distance(&pose, Point2::new(0.2, 0.3));
        assert_eq!(moved != pose, is_moved);
        let distance = (moved.translation.vector - Vector2::new(0.2, 0.3)).norm();
        assert!(distance > 0.75, "{distance}");
    }
}

#[test]
fn the_aim_is_the_easiest_direction_into_the_goal() {
    let parameters = parameters();
    let places = parameters.places;
    let aim = |x: f32, y: f32, easy: f32| places.aim(Point2::new(x, y), easy, &parameters.attack);
    // Straight ahead gets there.
    assert!((aim(3.0, 0.3, 0.0)).abs() < 1e-6);
    // Whoever heads elsewhere aims at what is in from the nearer post.
    let left = math::atan2(0.55_f32, 1.5);
    for easy in [0.5, FRAC_PI_2, 3.0] {
        assert!((aim(3.0, 0.0, easy) - left).abs() < 1e-5);
    }
    assert!((aim(3.0, 0.0, -2.0) + left).abs() < 1e-5);
    // From beside the goal it goes back to where it can be seen from.
    for (x, y) in [(4.48, 2.0), (4.6, -1.0)] {
        let aim = aim(x, y, 0.0);
        assert!(math::cos(aim) < 0.0 && math::sin(aim) * y < 0.0, "{aim}");
    }
    assert!(aim(-4.0, 0.0, PI).abs() < 0.1);
}

#[test]
fn a_ball_on_the_own_goal_line_goes_past_the_post_and_keeps_its_side() {
    let parameters = parameters();
    let aim = |x: f32, y: f32, easy: f32| {
        let places = parameters.places;
        places.aim(Point2::new(x, y), easy, &parameters.attack)
    };
    for (y, easy, is_left) in [
        (0.2, 0.0, true),
        (-0.2, 0.0, false),
        (0.7, -1.0, true),
        // In the middle where the robot has turned to.
        (0.01, -1.2, false),
        (-0.01, -1.2, false),
        (-0.01, 1.2, true),
    ] {
        let aim = aim(-4.45, y, easy);
        assert_eq!(aim > 0.0, is_left, "{y} {easy}: {aim}");
        // So far that it does not roll into the post.
        assert!((1.2..1.3).contains(&aim.abs()), "{aim}");
    }
    // Beside the goal from where there is room beside the net, and further away as everywhere.
    for y in [0.86_f32, 0.95, 1.02, -0.9] {
        let behind = y - parameters.attack.behind * math::sin(aim(-4.4, y, 0.0));
        assert!((behind.abs() - 1.05).abs() < 0.01, "{y}: {behind}");
    }
    assert!(aim(-4.4, 1.5, 0.0).abs() < 0.5);
}

#[test]
fn the_measures_are_those_of_the_field_by_which_the_robot_finds_its_place() {
    let file = ParameterFile::new(include_str!("../../../../parameters/default.toml"));
    let field: FieldMarkings = file.get("field_dimensions.markings");
    let places = parameters().places;
    for (place, marking) in [
        (places.goal_line, field.length / 2.0),
        (places.touch_line, field.width / 2.0),
        (places.goal_area_length, field.goal_area_length),
        (places.penalty_area_length, field.penalty_area_length),
        (places.penalty_area_side, field.penalty_area_width / 2.0),
        (places.penalty_mark, field.penalty_mark_distance),
    ] {
        assert_eq!(place, marking);
    }
}

#[test]
fn measures_that_leave_no_room_leave_a_place() {
    let parameters = parameters();
    let mut places = parameters.places;
    places.margin = places.touch_line + 0.5;
    places.before_goal = places.goal_line + 0.5;
    places.beside_goal = places.post + 0.5;
    let ball = Point2::new(-3.7, 0.5);
    for role in ROLES {
        let pose = places.of_role(role, ball, Point2::origin(), &parameters.keeper);
        assert!(pose.translation.y.abs() <= places.touch_line, "{role:?}");
    }
    assert_eq!(places.out_of_goals(ball), Point2::new(0.0, 0.5));
}

#[test]
fn goals_are_not_walked_into() {
    let places = parameters().places;
    for (x, y, expected) in [
        (-4.7, 0.3, -4.5),
        (-4.7, 0.6, -4.4),
        (4.6, -0.75, 4.4),
        (-4.3, 0.0, -4.3),
        (-4.7, 1.2, -4.7),
    ] {
        let moved = places.out_of_goals(Point2::new(x, y));
        assert_eq!(moved, Point2::new(expected, y));
    }
}

#[test]
fn no_way_leads_through_a_goal_or_off_the_carpet() {
    let places = parameters().places;
    for (x, y, is_closed) in [
        (4.6, 0.7, true),
        (-4.9, -0.8, true),
        (-4.9, 1.1, false),
        (4.4, 0.7, false),
        (0.0, 3.3, false),
        (0.0, -3.7, true),
        (5.1, 2.0, true),
    ] {
        assert_eq!(places.is_closed(Point2::new(x, y)), is_closed, "{x} {y}");
    }
    let out = places.way_out_of_goal(Point2::new(-4.8, 0.7)).unwrap();
    assert!(out.x > -4.3 && out.y < 0.5, "{out}");
    assert_eq!(places.way_out_of_goal(Point2::new(-4.8, 0.9)), None);
    assert_eq!(places.way_out_of_goal(Point2::new(-4.5, 0.0)), None);
}
