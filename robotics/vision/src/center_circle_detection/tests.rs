//! The circle and everything else that is white on a field, before a robot that stands at many places.

use framework::testing::{AdditionalProbe, ParameterFile};
use nalgebra::{Isometry2, Rotation2};
use types::field_markings::{Course, FieldMarkings};

use super::*;
use crate::field_color::tests::GREEN;
use crate::painting::{self, WHITE, camera_matrix, paint};

const RADIUS: f32 = 0.75;
const PITCH: f32 = 0.4;

fn file() -> ParameterFile {
    ParameterFile::new(include_str!("../../../parameters/default.toml"))
}

fn detect(
    lines: &Vec<LineSegment>,
    image_circle: &mut AdditionalProbe<Vec<Point2<f32>>>,
) -> Option<CenterCircle> {
    let mut node = CenterCircleDetection::new(CreationContext {}).unwrap();
    let outputs = node.cycle(CycleContext {
        lines,
        camera_matrix: &camera_matrix(PITCH),
        radius: &RADIUS,
        parameters: &file().get("vision_top.center_circle_detection"),
        image_circle: image_circle.output(),
    });
    assert!(node.chords.is_empty());
    outputs.unwrap().center_circle.value
}

/// What is found where the floor is white at these places, and of which lines.
fn seen(is_white: impl Fn(Point2<f32>) -> bool) -> (Option<CenterCircle>, Vec<LineSegment>) {
    let matrix = camera_matrix(PITCH);
    let floor = |point| if is_white(point) { WHITE } else { GREEN };
    let lines = painting::lines(&paint(&matrix, &[], floor), &matrix);
    let circle = detect(&lines, &mut AdditionalProbe::unsubscribed());
    (circle, lines)
}

fn is_circle(point: Point2<f32>, center: Point2<f32>) -> bool {
    (nalgebra::distance(&point, &center) - RADIUS).abs() < 0.025
}

/// The circle with the middle line in this direction.
fn with_middle_line(center: Point2<f32>, angle: f32) -> impl Fn(Point2<f32>) -> bool {
    move |point| {
        let across = (Rotation2::new(-angle) * (point - center)).y.abs();
        is_circle(point, center) || across < 0.025
    }
}

fn assert_near(circle: Option<CenterCircle>, center: Point2<f32>, lines: &[LineSegment]) {
    let circle = circle.unwrap_or_else(|| panic!("no circle about {center} in {lines:?}"));
    let off = circle.position - center;
    let allowed = 0.03 + 0.01 * center.coords.norm();
    assert!(
        off.norm() <= allowed,
        "{circle:?} instead of {center}: {lines:?}"
    );
    let deviation = off.dot(&(circle.covariance.try_inverse().unwrap() * off));
    assert!(deviation <= 4.0, "{circle:?} instead of {center}");
    assert!(circle.covariance.cholesky().is_some(), "{circle:?}");
}

#[test]
fn the_circle_is_found_where_it_is_however_the_middle_line_crosses_it() {
    let near = [1.5, 2.0, 2.5].map(|x| (x, [0.0, 0.6, 1.2, 1.57, 2.4].as_slice()));
    let far = (3.0, [0.0, 0.6, 1.57].as_slice());
    for (x, angles) in near.into_iter().chain([far]) {
        for angle in angles {
            let center = Point2::new(x, 0.1);
            let (circle, lines) = seen(with_middle_line(center, *angle));
            assert_near(circle, center, &lines);
        }
    }
}

#[test]
fn a_part_of_the_circle_is_enough() {
    for center in [(1.1, 0.0), (1.7, 0.7), (1.8, -0.8), (2.4, 1.0)] {
        let center = Point2::new(center.0, center.1);
        let (circle, lines) = seen(with_middle_line(center, 1.57));
        assert_near(circle, center, &lines);
        let (circle, lines) = seen(|point| is_circle(point, center));
        assert_near(circle, center, &lines);
    }
}

#[test]
fn a_circle_of_another_size_is_none() {
    for scale in [0.6, 1.6] {
        let center = Point2::new(2.0, 0.0);
        let (circle, lines) =
            seen(|point| (nalgebra::distance(&point, &center) - scale * RADIUS).abs() < 0.025);
        assert_eq!(circle, None, "{lines:?}");
    }
}

#[test]
fn a_line_through_the_inside_says_that_it_is_none() {
    let center = Point2::new(2.0, 0.0);
    let (circle, lines) = seen(|point| is_circle(point, center) || (point.x - 2.3).abs() < 0.025);
    assert_eq!(circle, None, "{lines:?}");
}

/// The straight lines of the field, seen by a robot that stands there.
fn straight_lines(robot: Isometry2<f32>) -> impl Fn(Point2<f32>) -> bool {
    let lines = file()
        .get::<FieldMarkings>("field_dimensions.markings")
        .lines();
    move |point| {
        let place = robot * point;
        lines.iter().any(|line| {
            let (at, along) = match line.course {
                Course::Across => (place.x, place.y),
                Course::Along => (place.y, place.x),
            };
            (at - line.at).abs() < 0.025 && (line.from - 0.025..=line.to + 0.025).contains(&along)
        })
    }
}

#[test]
fn goal_and_penalty_areas_show_no_circle() {
    let mut count = 0;
    for x in [1.8, 2.5, 3.2, 4.0] {
        for y in [-2.2, -1.0, 0.0, 0.7, 1.6] {
            for heading in [-1.6, -0.6, 0.0, 0.4, 1.1] {
                let robot = Isometry2::new(Vector2::new(x, y), heading);
                let (circle, lines) = seen(straight_lines(robot));
                count += lines.len();
                assert_eq!(circle, None, "{lines:?} from {robot}");
            }
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn parallel_lines_show_no_circle() {
    let (circle, lines) = seen(|point| {
        let is_dash = point.y.abs() < 0.25;
        is_dash && [1.2, 1.9, 2.7].iter().any(|x| (point.x - x).abs() < 0.025)
    });
    assert_eq!((circle, lines.len()), (None, 3), "{lines:?}");
}

/// A piece of a circle about this middle, in that direction from it.
fn piece(center: Point2<f32>, angle: f32) -> LineSegment {
    let end = |turn: f32| center + Rotation2::new(angle + turn) * Vector2::new(RADIUS, 0.0);
    LineSegment {
        start: end(-0.25),
        end: end(0.25),
        start_covariance: Matrix2::identity() * 0.01,
        end_covariance: Matrix2::identity() * 0.01,
    }
}

#[test]
fn three_pieces_are_needed_and_what_the_camera_does_to_all_is_not_averaged_out() {
    let center = Point2::new(2.0, 0.3);
    let lines: Vec<_> = [0.3, 1.1, 2.5].map(|angle| piece(center, angle)).into();
    let quiet = &mut AdditionalProbe::unsubscribed();
    assert_eq!(detect(&lines[..2].to_vec(), quiet), None);
    let circle = detect(&lines, quiet).unwrap();
    assert_eq!(circle.chords, 3);
    assert!(circle.covariance.diagonal().min() >= 0.01, "{circle:?}");
    assert!(circle.covariance.diagonal().max() <= 0.012, "{circle:?}");
    let mut with_line = lines[..2].to_vec();
    with_line.push(LineSegment {
        start: Point2::new(2.0, -0.9),
        end: Point2::new(2.0, 0.9),
        ..LineSegment::default()
    });
    assert_eq!(
        detect(&with_line, quiet).map(|circle| circle.chords),
        Some(2)
    );
}

#[test]
fn a_line_inside_speaks_against_it_and_one_through_the_middle_or_near_the_edge_does_not() {
    let center = Point2::new(2.0, 0.3);
    let pieces = [0.3, 1.1, 2.5].map(|angle| piece(center, angle));
    for (off, is_found) in [(0.0, true), (0.3, false), (-0.3, false), (0.65, true)] {
        // Too short for a piece of the circle.
        let [start, end] =
            [-0.1, 0.1].map(|along| center + Rotation2::new(0.7) * Vector2::new(off, along));
        let inside = LineSegment {
            start,
            end,
            ..LineSegment::default()
        };
        let lines: Vec<_> = pieces.into_iter().chain([inside]).collect();
        let circle = detect(&lines, &mut AdditionalProbe::unsubscribed());
        assert_eq!(circle.is_some(), is_found, "{off}: {circle:?}");
    }
}

#[test]
fn the_circle_in_the_image_is_told_to_who_listens() {
    let center = Point2::new(2.0, 0.0);
    let lines = [0.3, 1.1, 2.5].map(|angle| piece(center, angle)).into();
    let mut image_circle = AdditionalProbe::default();
    detect(&lines, &mut image_circle);
    let outline = image_circle.value().unwrap();
    assert_eq!(outline.len(), 37);
    let ground = |pixel: &Point2<f32>| camera_matrix(PITCH).pixel_to_ground(*pixel, 0.0).unwrap();
    let mut off = outline
        .iter()
        .map(|pixel| (nalgebra::distance(&ground(pixel), &center) - RADIUS).abs());
    assert!(off.all(|off| off < 0.05), "{outline:?}");
}

#[test]
fn lines_that_are_no_numbers_are_survived() {
    let nothing = LineSegment {
        start: Point2::new(f32::NAN, 0.0),
        end: Point2::new(1.0, f32::INFINITY),
        ..LineSegment::default()
    };
    let lines = vec![nothing, LineSegment::default(), nothing];
    assert_eq!(detect(&lines, &mut AdditionalProbe::unsubscribed()), None);
}
