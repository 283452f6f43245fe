//! Images that would show the ball and do not.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use types::camera::{CameraMatrix, Intrinsics};
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
fn a_ball_behind_the_own_limbs_is_believed_in() {
    let up_to = |top: f32| Around {
        limbs: LimbMask {
            limbs: vec![LimbOutline {
                corners: vec![Point2::new(200.0, top), Point2::new(440.0, top)],
            }],
        },
        ..looking()
    };
    assert!(is_believed_in((1.2, 0.0), &up_to(row(1.2) + 10.0)));
    assert!(!is_believed_in((1.2, 0.0), &up_to(row(1.2) + 100.0)));
}

#[test]
fn a_ball_behind_somebody_is_believed_in() {
    let behind = |obstacles| Around {
        obstacles,
        ..looking()
    };
    let ball = (2.0, 0.0);
    for (x, y) in [(1.0, 0.0), (1.0, 0.2), (1.9, -0.1), (2.1, 0.0)] {
        assert!(is_believed_in(ball, &behind(somebody(x, y))), "{x} {y}");
    }
    for (x, y) in [(1.0, 0.5), (2.6, 0.0), (-0.5, 0.0)] {
        assert!(!is_believed_in(ball, &behind(somebody(x, y))), "{x} {y}");
    }
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
            obstacles: somebody(f32::NAN, f32::INFINITY),
            ..looking()
        };
        assert!(is_believed_in((1.2, 0.0), &around), "{view:?}");
    }
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
