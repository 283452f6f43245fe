//! Robots that people put somewhere: before the game, after a penalty, for a shot of a shoot-out.

use types::game::{GamePhase, KickingTeam};

use super::*;

#[test]
fn before_it_has_seen_anything_it_stands_where_its_number_starts() {
    let mut node = node();
    let nothing = Vec::new();
    let found = cycle(
        &mut node,
        &Moment {
            primary_state: PrimaryState::Unstiff,
            ..playing(12, pose(5.0, 5.0, 1.0), &nothing)
        },
    );
    assert_near(
        found.ground_to_field,
        &pose(-3.0, 3.0, -FRAC_PI_2),
        1e-5,
        1e-5,
    );
    let found = cycle(
        &mut node,
        &playing(24, pose(5.0, 5.0, 1.0) * pose(1.0, 0.0, 0.0), &nothing),
    );
    assert_near(
        found.ground_to_field,
        &pose(-3.0, 2.0, -FRAC_PI_2),
        1e-5,
        1e-5,
    );
    assert_eq!(found.hypotheses.len(), 1);
}

#[test]
fn who_has_no_start_pose_is_lost_until_it_sees_from_which_of_them_it_begins() {
    let nothing = Vec::new();
    for start in &PARAMETERS.start_poses {
        let truth = pose(start.x, start.y, start.heading);
        let mut node = node();
        let limp = Moment {
            primary_state: PrimaryState::Unstiff,
            number: 9,
            ..playing(33, Isometry2::identity(), &nothing)
        };
        let begun = cycle(&mut node, &limp);
        assert_eq!(begun.ground_to_field, None);
        assert_eq!(begun.hypotheses.len(), PARAMETERS.start_poses.len());
        let lines = view_from(&truth);
        let mut found = None;
        for index in 2..60 {
            let initial = Moment {
                primary_state: PrimaryState::Initial,
                number: 9,
                ..playing(33 * index, Isometry2::identity(), &lines)
            };
            found = cycle(&mut node, &initial).ground_to_field;
        }
        assert_near(found, &truth, 0.1, 0.05);
    }
}

#[test]
fn a_single_start_pose_is_everybodys() {
    let single = LocalizationParameters {
        start_poses: vec![FieldPose {
            x: -1.0,
            ..FieldPose::default()
        }],
        ..PARAMETERS.clone()
    };
    let view = View {
        markings: &MARKINGS,
        parameters: &single,
    };
    let player = Player {
        number: 9,
        team: 77,
    };
    let begun: Vec<_> = starts(player, &view).collect();
    assert_eq!(begun, [put_at(pose(-1.0, 0.0, 0.0), &view)]);
}

#[test]
fn before_the_second_half_it_is_put_to_its_start_whatever_it_believed() {
    use PrimaryState::{Finished, Initial, Playing, Ready, Standby};
    let nothing = Vec::new();
    let start = pose(-3.0, 3.0, -FRAC_PI_2);
    let mut node = node();
    let mut at = |index: u64, primary_state, odometry, has_ground_contact| {
        let moment = Moment {
            primary_state,
            has_ground_contact,
            ..playing(33 * index, odometry, &nothing)
        };
        cycle(&mut node, &moment).ground_to_field
    };
    // It ends near the place, in its old frame, from which the second half begins.
    let walked = start.inverse() * pose(2.6, -2.5, FRAC_PI_2);
    at(1, Playing, Isometry2::identity(), true);
    assert_near(
        at(2, Playing, walked, true),
        &pose(2.6, -2.5, FRAC_PI_2),
        1e-4,
        1e-4,
    );
    at(3, Finished, walked, true);
    assert_near(at(4, Initial, walked, true), &start, 1e-4, 1e-4);
    // Somebody turns it on the way there.
    let turned = walked * pose(0.0, 0.0, 1.0);
    assert_near(at(5, Initial, turned, false), &start, 1e-4, 1e-4);
    assert_near(at(6, Initial, turned, true), &start, 1e-4, 1e-4);
    assert_near(at(7, Standby, turned, true), &start, 1e-4, 1e-4);
    // Who stands in Initial learns as ever, and goes on from where it is.
    let stepped = turned * pose(0.1, 0.0, 0.0);
    let expected = start * pose(0.1, 0.0, 0.0);
    assert_near(at(8, Initial, stepped, true), &start, 1e-4, 1e-4);
    let stepped_again = stepped * pose(0.1, 0.0, 0.0);
    assert_near(at(9, Initial, stepped_again, true), &expected, 1e-4, 1e-4);
    // The referee was not heard in between.
    at(10, Finished, stepped_again, true);
    assert_near(at(11, Ready, stepped_again, true), &start, 1e-4, 1e-4);
}

#[test]
fn lines_decide_beside_which_touch_line_a_robot_comes_back() {
    for side in [1.0, -1.0] {
        let mut node = node();
        let nothing = Vec::new();
        let penalized = Moment {
            primary_state: PrimaryState::Penalized,
            ..playing(33, Isometry2::identity(), &nothing)
        };
        cycle(&mut node, &penalized);
        let start = pose(-3.2, side * 3.5, -side * FRAC_PI_2);
        let mut found = None;
        let mut truth = start;
        for index in 2..160_u64 {
            // One comes back from the left, the other one from the right: only lines tell.
            let odometry = pose(0.0066 * index as f32, 0.0, 0.0);
            truth = start * odometry;
            let lines = view_from(&truth);
            found = cycle(&mut node, &playing(33 * index, odometry, &lines)).ground_to_field;
        }
        assert_near(found, &truth, 0.2, 0.1);
    }
}

/// A robot that stands in this state of a shoot-out.
fn shot<'a>(
    index: u64,
    primary_state: PrimaryState,
    kicking_team: KickingTeam,
    lines: &'a Vec<LineSegment>,
) -> Moment<'a> {
    Moment {
        primary_state,
        said: Some(GameControllerState {
            game_phase: GamePhase::PenaltyShootout,
            kicking_team,
            ..GameControllerState::default()
        }),
        ..playing(33 * index, Isometry2::identity(), lines)
    }
}

#[test]
fn in_a_shoot_out_it_was_put_to_the_ball_or_into_the_goal() {
    use PrimaryState::{Finished, Initial, Penalized, Playing, Set, Unstiff};
    let nothing = Vec::new();
    let (ball, goal) = (pose(2.85, 0.0, 0.0), pose(-4.5, 0.0, 0.0));
    for (team, expected) in [(KickingTeam::Own, ball), (KickingTeam::Opponent, goal)] {
        for before in [Unstiff, Initial, Penalized, Finished] {
            let mut node = node();
            cycle(&mut node, &shot(1, before, team, &nothing));
            let found = cycle(&mut node, &shot(2, Set, team, &nothing));
            assert_near(found.ground_to_field, &expected, 1e-4, 1e-4);
            // A whistle that was somebody else's: nobody has touched the robot.
            let truth = expected * pose(0.2, 0.1, 0.1);
            let lines = view_from(&truth);
            for index in 3..90 {
                cycle(&mut node, &shot(index, Playing, team, &lines));
            }
            let found = cycle(&mut node, &shot(90, Set, team, &lines));
            assert_near(found.ground_to_field, &truth, 0.1, 0.05);
        }
        let found = cycle(&mut node(), &shot(1, Set, team, &nothing));
        assert_near(found.ground_to_field, &expected, 1e-4, 1e-4);
    }
}

#[test]
fn whoever_is_carried_when_set_begins_or_comes_late_stands_where_the_shot_is_taken_from() {
    use PrimaryState::{Finished, Penalized, Playing, Set, Unstiff};
    let nothing = Vec::new();
    let (own, other) = (KickingTeam::Own, KickingTeam::Opponent);
    let (ball, goal) = (pose(2.85, 0.0, 0.0), pose(-4.5, 0.0, 0.0));
    let turned = |index, state, has_ground_contact| Moment {
        has_ground_contact,
        odometry: pose(0.0, 0.0, 0.4 * f32::min(index as f32, 3.0)),
        ..shot(index, state, own, &nothing)
    };
    let put = |moments: &[Moment<'_>]| {
        let mut node = node();
        let found = moments.iter().map(|moment| cycle(&mut node, moment));
        found.last().unwrap().ground_to_field
    };
    let carried = [
        turned(1, Finished, false),
        turned(2, Set, false),
        turned(3, Set, false),
        turned(4, Set, true),
        turned(5, Set, true),
    ];
    assert_near(put(&carried), &ball, 1e-4, 1e-4);
    let until_the_whistle = [
        turned(2, Set, false),
        turned(3, Set, false),
        turned(4, Playing, true),
    ];
    assert_near(put(&until_the_whistle), &ball, 1e-4, 1e-4);
    let shot = |index, state, team| shot(index, state, team, &nothing);
    // Somebody presses its chest, or the referee takes back a penalty, after the whistle.
    for before in [Unstiff, Penalized] {
        let late = [shot(1, before, own), shot(2, Playing, own)];
        assert_near(put(&late), &ball, 1e-4, 1e-4);
    }
    // The next shot is the others'; nobody heard that the last one was over.
    let next = [
        shot(1, Set, own),
        shot(2, Playing, own),
        shot(3, Set, other),
    ];
    assert_near(put(&next), &goal, 1e-4, 1e-4);
    let again = [
        shot(1, Set, other),
        shot(2, Playing, other),
        shot(3, Finished, other),
        shot(4, Set, own),
    ];
    assert_near(put(&again), &ball, 1e-4, 1e-4);
    // Whose it is becomes known later.
    let late = [shot(1, Set, KickingTeam::Nobody), shot(2, Set, other)];
    assert_near(put(&late), &goal, 1e-4, 1e-4);
}

#[test]
fn set_of_a_kick_off_puts_it_nowhere() {
    let nothing = Vec::new();
    let mut node = node();
    let ready = Moment {
        primary_state: PrimaryState::Ready,
        ..playing(33, Isometry2::identity(), &nothing)
    };
    let before = cycle(&mut node, &ready).ground_to_field;
    for (phase, team) in [
        (GamePhase::Normal, KickingTeam::Own),
        (GamePhase::PenaltyShootout, KickingTeam::Nobody),
    ] {
        let mut set = shot(2, PrimaryState::Set, team, &nothing);
        set.said = set.said.map(|said| GameControllerState {
            game_phase: phase,
            ..said
        });
        assert_eq!(cycle(&mut node, &set).ground_to_field, before);
        cycle(&mut node, &ready);
    }
}
