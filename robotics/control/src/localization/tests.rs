//! Robots that walk, are wrong, and are carried about on a field of which they see what lies before them.

use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

use framework::math;
use framework::testing::{
    AdditionalProbe, ParameterFile, at_millis, cycle_time, history, perception,
};
use nalgebra::{Matrix2, Point2};
use proptest::prelude::*;
use types::field_markings::Course;

use super::*;
use crate::angle::wrap;

mod lost;
mod put;

/// The robot's cameras see about so far, m, and so far aside while the head turns, rad.
const REACH: f32 = 4.0;
const ASIDE: f32 = 1.0;

static FILE: LazyLock<ParameterFile> =
    LazyLock::new(|| ParameterFile::new(include_str!("../../../parameters/default.toml")));
static MARKINGS: LazyLock<FieldMarkings> = LazyLock::new(|| FILE.get("field_dimensions.markings"));
static PARAMETERS: LazyLock<LocalizationParameters> = LazyLock::new(|| FILE.get("localization"));

/// What happens in one image.
struct Moment<'a> {
    millis: u64,
    odometry: Isometry2<f32>,
    lines: &'a Vec<LineSegment>,
    circle: Option<CenterCircle>,
    corners: Vec<LineCorner>,
    is_settled: bool,
    primary_state: PrimaryState,
    said: Option<GameControllerState>,
    has_ground_contact: bool,
    number: u8,
}

struct Cycle {
    ground_to_field: Option<Isometry2<f32>>,
    hypotheses: Vec<PoseHypothesis>,
}

fn node() -> Localization {
    Localization::new(CreationContext {}).unwrap()
}

fn segment(start: Point2<f32>, end: Point2<f32>) -> LineSegment {
    let nowhere = LineSegment::default();
    let mut segment = nowhere;
    [segment.start, segment.end] = [start, end];
    segment
}

fn pose(x: f32, y: f32, heading: f32) -> Isometry2<f32> {
    Isometry2::new(Vector2::new(x, y), heading)
}

/// Images by the times at which they were taken.
type Images<'a, T> = Vec<(Timestamp, &'a T)>;

/// What one image shows, as settled and as open.
fn image<T>(at: Timestamp, seen: &T, is_settled: bool) -> (Images<'_, T>, Images<'_, T>) {
    let shown = vec![(at, seen)];
    if is_settled {
        (shown, Vec::new())
    } else {
        (Vec::new(), shown)
    }
}

fn cycle(node: &mut Localization, moment: &Moment<'_>) -> Cycle {
    let odometry = Odometry {
        ground_to_start: moment.odometry,
    };
    let now = at_millis(moment.millis);
    let is_settled = moment.is_settled;
    let (lines, open_lines) = image(now, moment.lines, is_settled);
    let (marks, open_marks) = image(now, &None::<PenaltyMark>, is_settled);
    let (circles, open_circles) = image(now, &moment.circle, is_settled);
    let (corners, open_corners) = image(now, &moment.corners, is_settled);
    let mut hypotheses = AdditionalProbe::default();
    let context = CycleContext {
        lines: perception(&lines, &open_lines),
        penalty_mark: perception(&marks, &open_marks),
        center_circle: perception(&circles, &open_circles),
        corners: perception(&corners, &open_corners),
        odometry: history(&[], now, &odometry),
        fall_state: &FallState::Upright,
        has_ground_contact: &moment.has_ground_contact,
        primary_state: &moment.primary_state,
        game_controller_state: &moment.said,
        cycle_time: cycle_time(moment.millis, 33),
        player: &Player {
            number: moment.number,
            team: 77,
        },
        markings: &MARKINGS,
        parameters: &PARAMETERS,
        hypotheses: hypotheses.output(),
    };
    let ground_to_field = node.cycle(context).unwrap().ground_to_field.value;
    Cycle {
        ground_to_field,
        hypotheses: hypotheses.value().unwrap().clone(),
    }
}

/// A robot that plays and believes what its odometry says.
fn playing(millis: u64, odometry: Isometry2<f32>, lines: &Vec<LineSegment>) -> Moment<'_> {
    Moment {
        millis,
        odometry,
        lines,
        circle: None,
        corners: Vec::new(),
        is_settled: true,
        primary_state: PrimaryState::Playing,
        said: None,
        has_ground_contact: true,
        number: 1,
    }
}

/// Pieces of the field's lines and of its circle before a robot that stands there, in its ground frame.
fn view_from(ground_to_field: &Isometry2<f32>) -> Vec<LineSegment> {
    let straight = MARKINGS.lines().into_iter().map(|line| {
        let count = ((line.to - line.from) / 0.05) as u16;
        let points = (0..=count).map(move |index| {
            let along = line.from + 0.05 * f32::from(index);
            match line.course {
                Course::Across => Point2::new(line.at, along),
                Course::Along => Point2::new(along, line.at),
            }
        });
        points.collect::<Vec<_>>()
    });
    let arc = |from: u16| {
        let point = move |index: u16| {
            let angle = PI / 6.0 * (f32::from(from) + f32::from(index) / 10.0);
            Point2::new(math::cos(angle), math::sin(angle)) * MARKINGS.circle_radius
        };
        (0..=10).map(point).collect::<Vec<_>>()
    };
    let all = straight.chain((0..12).map(arc));
    let seen = all.filter_map(|points| {
        let mut run: Vec<Point2<f32>> = Vec::new();
        for point in points {
            let ground = ground_to_field.inverse() * point;
            let bearing = math::atan2(ground.y, ground.x);
            if (0.3..REACH).contains(&ground.coords.norm()) && bearing.abs() < ASIDE {
                run.push(ground);
            } else if run.len() > 6 {
                break;
            } else {
                run.clear();
            }
        }
        (run.len() > 6).then(|| segment(run[0], run[run.len() - 1]))
    });
    seen.collect()
}

/// Corners of the field before a robot that stands there, in its ground frame.
fn corners_from(ground_to_field: &Isometry2<f32>) -> Vec<LineCorner> {
    let to_ground = ground_to_field.inverse();
    let corners = MARKINGS.corners().into_iter().map(|corner| LineCorner {
        kind: corner.kind,
        position: to_ground * corner.position,
        direction: to_ground * corner.direction,
        ..LineCorner::default()
    });
    let is_seen = |corner: &LineCorner| {
        let place = corner.position;
        (0.5..3.0).contains(&place.coords.norm()) && math::atan2(place.y, place.x).abs() < ASIDE
    };
    corners.filter(is_seen).collect()
}

fn assert_near(found: Option<Isometry2<f32>>, truth: &Isometry2<f32>, distance: f32, angle: f32) {
    let found = found.expect("it knows where it is");
    let apart = truth.inv_mul(&found);
    assert!(
        apart.translation.vector.norm() <= distance && apart.rotation.angle().abs() <= angle,
        "{found} instead of {truth}"
    );
}

#[test]
fn a_robot_that_was_put_down_carelessly_finds_out_where() {
    let truth = pose(-2.8, 2.8, -FRAC_PI_2 + 0.2);
    let mut node = node();
    let lines = view_from(&truth);
    assert!(lines.len() >= 2, "{lines:?}");
    let mut found = None;
    for index in 1..60 {
        found = cycle(
            &mut node,
            &playing(33 * index, Isometry2::identity(), &lines),
        )
        .ground_to_field;
    }
    assert_near(found, &truth, 0.1, 0.05);
}

/// Walks laps; its odometry says 1.08 times the way and 1.05 times the turn. The errors of place and
/// heading after each image.
fn lap(is_blind: bool) -> Vec<(f32, f32)> {
    let mut node = node();
    let mut truth = pose(-3.0, 3.0, -FRAC_PI_2);
    let mut odometry = Isometry2::identity();
    let mut errors = Vec::new();
    for index in 1..3000_u64 {
        // At 0.2 m/s into the field and round and round about its middle.
        let turn = if index < 250 { 0.0 } else { 0.004 };
        truth *= pose(0.2 * 0.033, 0.0, turn);
        odometry *= pose(1.08 * 0.2 * 0.033, 0.0, 1.05 * turn);
        let lines = if is_blind {
            Vec::new()
        } else {
            view_from(&truth)
        };
        let found = cycle(&mut node, &playing(33 * index, odometry, &lines)).ground_to_field;
        let apart = truth.inv_mul(&found.unwrap_or_else(|| panic!("lost after {index} images")));
        errors.push((
            apart.translation.vector.norm(),
            apart.rotation.angle().abs(),
        ));
    }
    errors
}

#[test]
fn lines_make_up_for_what_odometry_gets_wrong() {
    let worst = |errors: Vec<(f32, f32)>| {
        let both = errors.into_iter();
        both.fold((0.0_f32, 0.0_f32), |(place, angle), error| {
            (place.max(error.0), angle.max(error.1))
        })
    };
    let (blind, seeing) = (worst(lap(true)), worst(lap(false)));
    println!("at most {blind:?} off without lines, {seeing:?} with them");
    assert!(blind.0 > 0.5, "{blind:?}");
    assert!(seeing.0 < 0.2 && seeing.1 < 0.1, "{seeing:?}");
}

/// Stands somewhere, is put elsewhere without noticing, and turns there by so much with each of 910 images. For how many
/// images of 33 ms it was wrong by more than 0.3 m, and where it believes itself at the end. Each image shows what `show` leaves
/// of the lines before it.
fn kidnapped(
    to: &Isometry2<f32>,
    turn: f32,
    with_corners: bool,
    show: impl Fn(u64, &mut Vec<LineSegment>),
) -> (usize, Option<Isometry2<f32>>, Isometry2<f32>) {
    let mut node = node();
    let start = pose(-3.0, 3.0, -FRAC_PI_2);
    let lines = view_from(&start);
    for index in 1..100 {
        cycle(
            &mut node,
            &playing(33 * index, Isometry2::identity(), &lines),
        );
    }
    let (mut wrong, mut found, mut truth) = (0, None, *to);
    for index in 0..910_u64 {
        let odometry = pose(0.0, 0.0, turn * index as f32);
        truth = to * odometry;
        let mut lines = view_from(&truth);
        show(index, &mut lines);
        let mut moment = playing(3300 + 33 * index, odometry, &lines);
        if with_corners {
            moment.corners = corners_from(&truth);
        }
        found = cycle(&mut node, &moment).ground_to_field;
        let error = found.map(|found| truth.inv_mul(&found).translation.vector.norm());
        wrong += usize::from(error.is_none_or(|error| error > 0.3));
    }
    (wrong, found, truth)
}

#[test]
fn a_kidnapped_robot_finds_itself_again() {
    let places = [
        pose(-2.0, 1.0, 1.5),
        pose(-1.0, -2.0, 0.0),
        pose(-4.0, -1.5, 0.7),
        pose(-0.6, 0.4, 3.0),
        pose(-2.2, -0.3, -2.0),
    ];
    for with_corners in [false, true] {
        for place in places {
            // Twice round.
            let (wrong, found, truth) = kidnapped(&place, 0.0138, with_corners, |_, _| {});
            println!("put to {place}, corners {with_corners}: wrong in {wrong} images");
            assert!(wrong < 600, "put to {place}: wrong in {wrong} images");
            assert_near(found, &truth, 0.2, 0.1);
        }
    }
}

#[test]
fn a_robot_that_sees_only_short_pieces_of_lines_finds_itself_by_corners() {
    let short = |_, lines: &mut Vec<LineSegment>| {
        for line in lines {
            let most = line.length().min(0.6);
            line.end = line.start + line.direction().unwrap() * most;
        }
    };
    let places = [
        pose(-2.0, 1.0, 1.5),
        pose(-3.2, -1.2, 0.7),
        pose(-2.2, -0.3, -2.0),
    ];
    for place in places {
        let look = |with_corners| kidnapped(&place, 0.0138, with_corners, short);
        let ((without, ..), (wrong, found, truth)) = (look(false), look(true));
        println!("put to {place}: wrong in {wrong} images, without corners in {without}");
        assert!(
            wrong < 600 && wrong < without,
            "wrong in {wrong} images, without corners in {without}"
        );
        assert_near(found, &truth, 0.2, 0.1);
    }
}

#[test]
fn the_circle_says_where_the_robot_is_and_its_pieces_are_not_learnt_beside_it() {
    let truth = pose(-1.8, 0.3, 0.2);
    let start = pose(-3.0, 3.0, -FRAC_PI_2);
    let seen = |off: f32| {
        let mut node = node();
        let to_truth = start.inverse() * pose(-1.9, 0.1, 0.2);
        let nothing = Vec::new();
        cycle(&mut node, &playing(12, Isometry2::identity(), &nothing));
        let mut lines = view_from(&truth);
        lines.retain(|line| line.length() < 0.5);
        for line in &mut lines {
            let off = Vector2::new(off, -off);
            (line.start, line.end) = (line.start + off, line.end + off);
        }
        assert!(lines.len() > 3, "{lines:?}");
        let circle = CenterCircle {
            position: truth.inverse() * Point2::origin(),
            covariance: Matrix2::identity() * 0.01,
            chords: 5,
        };
        let mut found = Vec::new();
        for index in 1..40 {
            let mut moment = playing(12 + 33 * index, to_truth, &lines);
            moment.circle = Some(circle);
            found = cycle(&mut node, &moment).hypotheses;
        }
        (found[0], circle)
    };
    let (found, circle) = seen(0.0);
    let off = (found.ground_to_field * circle.position).coords.norm();
    assert!(
        off < 0.03,
        "the circle is taken to be {off} m beside the middle"
    );
    assert!(found.evidence > 0.9, "{found:?}");
    assert_eq!(seen(0.1).0, found, "pieces of the circle say nothing more");
}

#[test]
fn a_robot_that_sees_nothing_across_the_middle_line_but_the_circle_finds_itself_again() {
    // All straight lines before it go from touch line to touch line. Its head looks to the left for 2 s, to the right, ...
    let (wrong, found, truth) = kidnapped(&pose(-0.8, 1.8, -2.0), 0.0, false, |index, lines| {
        let looks_left = (index / 60).is_multiple_of(2);
        lines.retain(|line| (nalgebra::center(&line.start, &line.end).y > 0.0) == looks_left);
    });
    assert!(wrong < 150, "wrong in {wrong} images");
    assert_near(found, &truth, 0.2, 0.1);
}

#[test]
fn transient_images_answer_but_are_not_learnt() {
    let truth = pose(-2.8, 2.8, -FRAC_PI_2 + 0.2);
    let lines = view_from(&truth);
    let nothing = Vec::new();
    let mut node = node();
    cycle(&mut node, &playing(12, Isometry2::identity(), &nothing));
    let transient = Moment {
        is_settled: false,
        ..playing(45, Isometry2::identity(), &lines)
    };
    let ahead = cycle(&mut node, &transient).ground_to_field.unwrap();
    let start = pose(-3.0, 3.0, -FRAC_PI_2);
    assert!(
        start.inv_mul(&ahead).translation.vector.norm() > 0.05,
        "{ahead}"
    );
    let after = cycle(&mut node, &playing(57, Isometry2::identity(), &nothing));
    assert_near(after.ground_to_field, &start, 1e-4, 1e-4);
}

#[test]
fn odometry_and_lines_that_are_no_numbers_are_survived() {
    let mut node = node();
    let nothing = segment(Point2::new(f32::NAN, 0.0), Point2::new(1.0, f32::INFINITY));
    let nonsense = vec![nothing; 3];
    for index in 1..100 {
        let odometry = if index % 7 == 0 {
            pose(f32::NAN, 0.0, f32::INFINITY)
        } else {
            Isometry2::identity()
        };
        let found = cycle(&mut node, &playing(33 * index, odometry, &nonsense));
        for hypothesis in found.hypotheses {
            assert!(
                hypothesis
                    .ground_to_field
                    .translation
                    .vector
                    .norm()
                    .is_finite()
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn whatever_is_seen_covariances_stay_symmetric_and_positive_definite(
        images in prop::collection::vec(
            (
                prop::collection::vec(prop::array::uniform4(-4.0_f32..4.0), 0..5),
                prop::array::uniform3(-0.1_f32..0.1),
            ),
            1..80,
        )
    ) {
        let mut node = node();
        let mut odometry = Isometry2::identity();
        for (index, (lines, [x, y, turn])) in (1_u64..).zip(images) {
            odometry *= pose(x, y, turn);
            let lines = lines.into_iter();
            let lines = lines.map(|[a, b, c, d]| segment(Point2::new(a, b), Point2::new(c, d)));
            let lines = lines.collect();
            let found = cycle(&mut node, &playing(200 * index, odometry, &lines));
            for hypothesis in found.hypotheses {
                let covariance = hypothesis.covariance;
                prop_assert_eq!(covariance, covariance.transpose());
                prop_assert!(covariance.cholesky().is_some(), "{}", covariance);
                prop_assert!(wrap(hypothesis.ground_to_field.rotation.angle()).is_finite());
                prop_assert!((0.0..=1.0).contains(&hypothesis.evidence));
            }
        }
    }
}
