//! Images that would show the ball and do not.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use types::camera::{CameraMatrix, Intrinsics};
use types::field_features::ImageLine;
use types::limbs::LimbOutline;

use super::*;

/// Half a metre up, looking 0.4 rad down along x of the ground.
fn view() -> BallView {
    let down = UnitQuaternion::from_euler_angles(-FRAC_PI_2 - 0.4, 0.0, 0.0);
    let ahead = UnitQuaternion::from_euler_angles(0.0, 0.0, -FRAC_PI_2);
    let camera = Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.5), ahead * down);
    BallView {
        camera_matrix: CameraMatrix {
            ground_to_camera: camera.inverse(),
            intrinsics: Intrinsics {
                focal: Vector2::new(608.0, 609.6),
                center: Vector2::new(320.0, 240.0),
            },
        },
        size: Vector2::new(640.0, 480.0),
        least_radius: 3.5,
        ball_radius: 0.05,
    }
}

fn looking() -> Around {
    Around {
        view: Some(view()),
        ..Around::default()
    }
}

/// The row of the image in which the middle of a ball straight ahead is seen, px.
fn row(distance: f32) -> f32 {
    let matrix = view().camera_matrix;
    let center = Vector2::new(distance, 0.0).push(0.05).into();
    matrix.ground_to_pixel(center).unwrap().y
}

/// Somebody's foot there.
fn somebody(x: f32, y: f32) -> Vec<ObstacleCandidate> {
    vec![ObstacleCandidate {
        position: Point2::new(x, y),
        ..ObstacleCandidate::default()
    }]
}

/// What remains of a ball that was seen there for a second, after so many images without it, of a robot that went
/// from the one pose to the other when it was taken away.
fn remains_after(
    images_without: u64,
    (x, y): (f32, f32),
    poses: (&Odometry, &Odometry),
    around: &Around,
) -> Cycle {
    let (mut node, seen, nothing) = (node(), candidate(x, y), Vec::new());
    let (before, after) = poses;
    let known = (images(0, 30, &seen), vec![]);
    cycle_around(
        &mut node,
        1000,
        (before, before),
        &parameters(),
        known,
        &looking(),
    );
    let without = (images(1000, images_without, &nothing), vec![]);
    let now = 1010 + 33 * images_without;
    cycle_around(
        &mut node,
        now,
        (after, after),
        &parameters(),
        without,
        around,
    )
}

fn is_believed_in(place: (f32, f32), around: &Around) -> bool {
    let standing = Odometry::default();
    let cycle = remains_after(30, place, (&standing, &standing), around);
    cycle.ball.is_some()
}

#[test]
fn a_ball_that_images_do_not_show_where_it_would_have_to_be_is_forgotten_within_a_second() {
    let standing = Odometry::default();
    let after = |count| remains_after(count, (1.2, 0.1), (&standing, &standing), &looking());
    let soon = after(10);
    assert_eq!(soon.hypotheses[0].missed, 10);
    assert_near(soon.ball.unwrap().position, 1.2, 0.1, 1e-3);
    assert_eq!(after(30).ball, None);
}

#[test]
fn what_is_not_settled_speaks_against_it_as_well() {
    let (mut node, seen, nothing) = (node(), candidate(1.2, 0.1), Vec::new());
    let standing = Odometry::default();
    let around = (&standing, &standing);
    let images = (images(0, 30, &seen), images(1000, 30, &nothing));
    let cycle = cycle_around(&mut node, 2000, around, &parameters(), images, &looking());
    assert!(cycle.persistent_ball.is_some());
    assert_eq!(cycle.ball, None);
}

#[test]
fn an_image_that_shows_it_after_all_makes_up_for_what_missed_it() {
    let (mut node, seen, nothing) = (node(), candidate(1.2, 0.1), Vec::new());
    let standing = Odometry::default();
    // Three of four images miss it.
    for index in 0..200 {
        let shown = if index % 4 == 0 { &seen } else { &nothing };
        let image = (images(33 * index, 1, shown), vec![]);
        let now = 33 * index + 5;
        let poses = (&standing, &standing);
        let cycle = cycle_around(&mut node, now, poses, &parameters(), image, &looking());
        if index > 12 {
            assert!(cycle.ball.is_some(), "image {index}");
        }
    }
}

#[test]
fn where_it_is_not_in_the_image_nothing_speaks_against_it() {
    for place in [(1.2, 1.0), (-1.0, 0.0), (0.3, 0.0), (1.2, 0.6)] {
        assert!(is_believed_in(place, &looking()), "{place:?}");
    }
    assert!(is_believed_in((1.2, 0.1), &Around::default()));
    // So far away that vision misses many.
    assert!(is_believed_in((4.3, 0.0), &looking()));
    assert!(!is_believed_in((3.9, 0.0), &looking()));
}

#[test]
fn a_ball_that_the_robot_has_turned_away_from_is_believed_in() {
    let (before, after) = (Odometry::default(), pose(0.0, 0.0, FRAC_PI_2));
    let cycle = remains_after(30, (1.2, 0.1), (&before, &after), &looking());
    assert!(cycle.ball.is_some());
    let towards = remains_after(30, (0.0, 1.2), (&before, &after), &looking());
    assert_eq!(towards.ball, None);
}

#[test]
fn a_ball_behind_or_beside_the_own_limbs_is_believed_in() {
    let limb = |left: f32, right: f32, top: f32| Around {
        limbs: LimbMask {
            limbs: vec![LimbOutline {
                corners: vec![Point2::new(left, top), Point2::new(right, top)],
            }],
        },
        ..looking()
    };
    // A ball 1.2 m ahead has its middle in column 320 and a radius of 24 px.
    let (row, ball) = (row(1.2), (1.2, 0.0));
    for (left, right, top) in [
        (200.0, 440.0, row + 10.0),
        (200.0, 300.0, row - 100.0),
        (345.0, 440.0, row - 100.0),
    ] {
        assert!(is_believed_in(ball, &limb(left, right, top)), "{left}");
    }
    for (left, right, top) in [
        (200.0, 440.0, row + 100.0),
        (100.0, 250.0, row - 100.0),
        (390.0, 440.0, row - 100.0),
    ] {
        assert!(!is_believed_in(ball, &limb(left, right, top)), "{left}");
    }
}

#[test]
fn a_ball_beyond_the_border_is_believed_in() {
    let border = |row: f32| Around {
        border: FieldBorder {
            lines: vec![ImageLine {
                at_left: row,
                slope: 0.0,
            }],
        },
        ..looking()
    };
    let (row, ball) = (row(2.0), (2.0, 0.0));
    assert!(is_believed_in(ball, &border(row + 20.0)));
    assert!(is_believed_in(ball, &border(row - 20.0)), "near to it");
    assert!(!is_believed_in(ball, &border(row - 60.0)));
}

#[test]
fn a_ball_too_small_to_be_looked_for_is_believed_in() {
    let down_to = |least_radius| Around {
        view: Some(BallView {
            least_radius,
            ..view()
        }),
        ..looking()
    };
    assert!(is_believed_in((3.0, 0.0), &down_to(12.0)));
    assert!(!is_believed_in((3.0, 0.0), &down_to(8.0)));
}

#[test]
fn a_ball_behind_somebody_is_believed_in_whoever_knows_of_them() {
    let seen = |x, y| Around {
        obstacles: somebody(x, y),
        ..looking()
    };
    // The other camera sees the feet, or the sonar hears somebody.
    let known = |x, y| Around {
        known: vec![Obstacle {
            position: Point2::new(x, y),
            ..Obstacle::default()
        }],
        ..looking()
    };
    let ball = (2.0, 0.0);
    for (x, y) in [(1.0, 0.0), (1.0, 0.2), (1.9, -0.1), (2.1, 0.0)] {
        assert!(is_believed_in(ball, &seen(x, y)), "{x} {y}");
        assert!(is_believed_in(ball, &known(x, y)), "{x} {y}");
    }
    for (x, y) in [(1.0, 0.5), (2.6, 0.0), (-0.5, 0.0)] {
        assert!(!is_believed_in(ball, &seen(x, y)), "{x} {y}");
        assert!(!is_believed_in(ball, &known(x, y)), "{x} {y}");
    }
}

#[test]
fn of_two_images_of_one_time_each_has_its_own_sight() {
    let (seen, nothing) = (candidate(1.2, 0.1), Vec::new());
    let (looks, away) = (Some(view()), None);
    // Whichever of the two cameras would show it, and in whichever order they come.
    for (views, is_shown, missed) in [
        ([&looks, &away], [false, false], 1),
        ([&away, &looks], [false, false], 1),
        ([&looks, &looks], [false, false], 2),
        ([&away, &away], [false, false], 0),
        ([&looks, &away], [true, false], 0),
        ([&away, &looks], [false, true], 0),
    ] {
        let (mut node, standing) = (node(), Odometry::default());
        let poses = (&standing, &standing);
        let known = (images(0, 30, &seen), vec![]);
        cycle_around(&mut node, 1000, poses, &parameters(), known, &looking());
        let at = at_millis(1000);
        let balls = is_shown.map(|is_shown| (at, if is_shown { &seen } else { &nothing }));
        let around = Around::default();
        let views = views.map(|view| (at, view));
        let borders = [(at, &around.border); 2];
        let limbs = [(at, &around.limbs); 2];
        let obstacles = [(at, &around.obstacles); 2];
        let mut hypotheses = AdditionalProbe::default();
        let mut ball = AdditionalProbe::unsubscribed();
        let mut delivered = AdditionalProbe::unsubscribed();
        let context = CycleContext {
            balls: perception(&balls, &[]),
            ball_views: perception(&views, &[]),
            borders: perception(&borders, &[]),
            limb_masks: perception(&limbs, &[]),
            obstacles_seen: perception(&obstacles, &[]),
            obstacles: &around.known,
            odometry: history(&[], at_millis(1012), &standing),
            cycle_time: cycle_time(1012, 12),
            parameters: &parameters(),
            hypotheses: hypotheses.output(),
            persistent_ball: ball.output(),
            delivered: delivered.output(),
        };
        node.cycle(context).unwrap();
        let found = hypotheses.value().unwrap();
        assert_eq!(found.len(), 1, "{is_shown:?}");
        assert_eq!(found[0].missed, missed, "{views:?} {is_shown:?}");
    }
}

#[test]
fn an_image_that_comes_late_says_nothing_against_what_was_seen_since() {
    let (mut node, seen, nothing) = (node(), candidate(1.2, 0.1), Vec::new());
    let standing = Odometry::default();
    let poses = (&standing, &standing);
    let known = (images(0, 30, &seen), vec![]);
    cycle_around(&mut node, 1000, poses, &parameters(), known, &looking());
    let late = (vec![(at_millis(940), &nothing)], vec![]);
    let found = cycle_around(&mut node, 1012, poses, &parameters(), late, &looking());
    assert_eq!(found.hypotheses[0].missed, 0);
}

#[test]
fn both_cameras_at_one_time_see_one_ball() {
    let seen = candidate(1.2, 0.1);
    let mut first = node();
    let both: Seen<'_> = vec![(at_millis(33), &seen); 2];
    let two = cycle(&mut first, 40, both, vec![]);
    assert_eq!(two.hypotheses.len(), 1);
    assert!(two.hypotheses[0].validity > 1.9, "both speak for it");
}

#[test]
fn a_view_and_parameters_that_are_no_numbers_are_survived() {
    let broken = BallView {
        size: Vector2::new(f32::NAN, f32::INFINITY),
        ball_radius: f32::NAN,
        ..view()
    };
    for view in [broken, BallView::default()] {
        let around = Around {
            view: Some(view),
            ..looking()
        };
        assert!(is_believed_in((1.2, 0.0), &around), "{view:?}");
    }
    let nobody = Around {
        obstacles: somebody(f32::NAN, f32::INFINITY),
        ..looking()
    };
    assert!(!is_believed_in((1.2, 0.0), &nobody));
    let (mut node, seen, nothing) = (node(), candidate(1.2, 0.1), Vec::new());
    let nonsense = BallFilterParameters {
        missed_validity: f32::NAN,
        ..parameters()
    };
    let standing = Odometry::default();
    let images = (images(0, 30, &seen), images(1000, 3, &nothing));
    let poses = (&standing, &standing);
    let cycle = cycle_around(&mut node, 1200, poses, &nonsense, images, &looking());
    assert_eq!(cycle.ball, None);
}
