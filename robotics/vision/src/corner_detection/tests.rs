//! Corners of every kind, and what is none.

use framework::testing::{AdditionalProbe, ParameterFile};
use nalgebra::{Matrix2, Rotation2};
use types::limbs::LimbOutline;

use super::*;
use crate::center_circle_detection::{self, CenterCircleDetection};
use crate::field_color::tests::GREEN;
use crate::painting::{self, PROJECTION_NOISE, WHITE, camera_matrix, paint};

const PITCH: f32 = 0.5;

fn file() -> ParameterFile {
    ParameterFile::new(include_str!("../../../parameters/default.toml"))
}

fn look(
    image: &YuyvImage,
    lines: &Vec<LineSegment>,
    center_circle: Option<&CenterCircle>,
    limb_mask: &LimbMask,
) -> Vec<LineCorner> {
    let mut corners = Vec::new();
    CornerDetection::new(CreationContext {})
        .unwrap()
        .cycle(CycleContext {
            image: &Leased::of(image.clone()),
            lines,
            center_circle,
            limb_mask,
            camera_matrix: &camera_matrix(PITCH),
            radius: &0.75,
            parameters: &file().get("corner_detection"),
            projection_noise: &PROJECTION_NOISE,
            corners: &mut corners,
        })
        .unwrap();
    corners
}

fn center_circle(lines: &Vec<LineSegment>, matrix: &CameraMatrix) -> Option<CenterCircle> {
    let mut node = CenterCircleDetection::new(center_circle_detection::CreationContext {}).unwrap();
    let outputs = node.cycle(center_circle_detection::CycleContext {
        lines,
        camera_matrix: matrix,
        radius: &0.75,
        parameters: &file().get("vision_top.center_circle_detection"),
        image_circle: AdditionalProbe::unsubscribed().output(),
    });
    outputs.unwrap().center_circle.value
}

/// What is found where the floor is white at these places, seen from this corner, whose first arm leads that way.
fn seen(corner: Point2<f32>, angle: f32, is_white: fn(Vector2<f32>) -> bool) -> Vec<LineCorner> {
    let matrix = camera_matrix(PITCH);
    let floor = |point: Point2<f32>| {
        let place = Rotation2::new(-angle) * (point - corner);
        if is_white(place) { WHITE } else { GREEN }
    };
    let image = paint(&matrix, &[], floor);
    let lines = painting::lines(&image, &matrix);
    let circle = center_circle(&lines, &matrix);
    look(&image, &lines, circle.as_ref(), &LimbMask::default())
}

fn is_across(place: Vector2<f32>) -> bool {
    place.x.abs() < 0.025
}

fn is_along(place: Vector2<f32>) -> bool {
    place.y.abs() < 0.025
}

/// Whether one corner alone is there: of this kind, there, opening that way.
fn assert_one(
    corners: &[LineCorner],
    kind: CornerKind,
    place: Point2<f32>,
    direction: Option<Vector2<f32>>,
) {
    let [corner] = corners else {
        panic!("{corners:?} instead of {kind:?} at {place}");
    };
    assert_eq!(corner.kind, kind, "{corner:?}");
    let off = corner.position - place;
    assert!(off.norm() < 0.04, "{corner:?} instead of {place}");
    assert!(corner.covariance.cholesky().is_some(), "{corner:?}");
    let turned = direction.map_or(0.0, |direction| corner.direction.angle(&direction));
    assert!(turned < 0.1, "{corner:?} instead of {direction:?}");
    let pixel = camera_matrix(PITCH).ground_to_pixel(corner.position.coords.push(0.0).into());
    assert_eq!(Some(corner.center), pixel);
}

const PLACES: [(f32, f32, f32); 6] = [
    (1.2, 0.0, 0.4),
    (1.5, 0.2, -0.6),
    (1.3, -0.1, 2.0),
    (1.8, 0.0, 2.9),
    (1.8, 0.2, -2.2),
    (2.0, 0.3, 1.0),
];

#[test]
fn an_l_opens_between_its_arms() {
    for (x, y, angle) in PLACES {
        let place = Point2::new(x, y);
        let corners = seen(place, angle, |place| {
            is_along(place) && place.x > -0.025 || is_across(place) && place.y > -0.025
        });
        let direction = Rotation2::new(angle) * Vector2::new(1.0, 1.0).normalize();
        assert_one(&corners, CornerKind::L, place, Some(direction));
    }
}

#[test]
fn a_t_opens_along_its_stem() {
    for (x, y, angle) in PLACES {
        let place = Point2::new(x, y);
        let corners = seen(place, angle, |place| {
            is_across(place) || is_along(place) && place.x > 0.0
        });
        let direction = Rotation2::new(angle) * Vector2::x();
        assert_one(&corners, CornerKind::T, place, Some(direction));
    }
}

#[test]
fn an_x_is_one() {
    for (x, y, angle) in PLACES {
        let place = Point2::new(x, y);
        let corners = seen(place, angle, |place| is_across(place) || is_along(place));
        assert_one(&corners, CornerKind::X, place, None);
    }
}

#[test]
fn lines_that_end_before_they_meet_make_none() {
    for (x, y, angle) in PLACES {
        let corners = seen(Point2::new(x, y), angle, |place| {
            is_across(place) || is_along(place) && place.x > 0.3
        });
        assert_eq!(corners, [], "at {x}, {y}");
    }
}

#[test]
fn lines_that_meet_at_another_angle_make_none() {
    let corners = seen(Point2::new(1.5, 0.0), 0.0, |place| {
        is_along(place) || is_along(Rotation2::new(1.1) * place)
    });
    assert_eq!(corners, []);
}

#[test]
fn parallel_lines_make_none() {
    let corners = seen(Point2::new(1.2, 0.0), 0.3, |place| {
        is_along(place) || is_along(place - Vector2::new(0.0, 0.5))
    });
    assert_eq!(corners, []);
}

#[test]
fn circle_and_middle_line_make_none() {
    for x in [1.5, 1.8, 2.2] {
        for angle in [0.0, 0.8, 1.57] {
            let corners = seen(Point2::new(x, 0.0), angle, |place| {
                is_along(place) || (place.norm() - 0.75).abs() < 0.025
            });
            assert_eq!(corners, [], "from {x} m, turned by {angle}");
        }
    }
}

fn line(start: (f32, f32), end: (f32, f32)) -> LineSegment {
    LineSegment {
        start: Point2::new(start.0, start.1),
        end: Point2::new(end.0, end.1),
        ..LineSegment::default()
    }
}

fn plain() -> YuyvImage {
    YuyvImage::new(640, 480)
}

#[test]
fn pieces_of_one_line_are_one() {
    let lines = vec![
        line((1.5, -0.8), (1.5, -0.05)),
        line((1.55, 0.0), (2.4, 0.0)),
        line((1.5, 0.05), (1.5, 0.8)),
    ];
    let corners = look(&plain(), &lines, None, &LimbMask::default());
    assert_one(
        &corners,
        CornerKind::T,
        Point2::new(1.5, 0.0),
        Some(Vector2::x()),
    );
}

#[test]
fn where_nobody_would_see_it_go_on_there_is_no_corner() {
    let lines = vec![line((1.5, -0.7), (1.5, 0.0)), line((1.5, 0.0), (2.4, 0.0))];
    let limb = |row: f32| LimbMask {
        limbs: vec![LimbOutline {
            corners: vec![Point2::new(0.0, row), Point2::new(640.0, row)],
        }],
    };
    let corner = Point2::new(1.5, 0.0);
    let row = |x: f32| {
        let place = nalgebra::Point3::new(x, 0.0, 0.0);
        camera_matrix(PITCH).ground_to_pixel(place).unwrap().y
    };
    let corners = look(&plain(), &lines, None, &limb(row(0.9)));
    assert_one(&corners, CornerKind::L, corner, None);
    assert_eq!(look(&plain(), &lines, None, &limb(row(1.35))), []);
    // Where its line was seen on the other side it goes on, whatever hides the place.
    let through = vec![lines[0], line((0.9, 0.0), (2.4, 0.0))];
    let corners = look(&plain(), &through, None, &limb(row(1.35)));
    assert_one(&corners, CornerKind::T, corner, Some(-Vector2::y()));
    // At the edge of the image, where the line to the left may go on.
    let half = camera_matrix(PITCH)
        .pixel_to_ground(Point2::new(20.0, row(1.5)), 0.0)
        .unwrap()
        .y;
    let lines = vec![
        line((1.5, 0.0), (1.5, half)),
        line((1.5, half), (2.4, half)),
    ];
    assert_eq!(look(&plain(), &lines, None, &LimbMask::default()), []);
}

#[test]
fn a_piece_of_a_circle_that_was_seen_makes_none() {
    let lines = vec![
        line((0.9, 0.0), (2.6, 0.0)),
        line((1.2, -0.26), (1.2, 0.26)),
    ];
    let circle = |x: f32| CenterCircle {
        position: Point2::new(x, 0.0),
        covariance: Matrix2::identity(),
        chords: 3,
    };
    let none = LimbMask::default();
    let found = |x: f32| look(&plain(), &lines, Some(&circle(x)), &none).len();
    assert_eq!((found(1.93), found(3.2)), (0, 1));
}

#[test]
fn lines_that_are_no_numbers_are_survived() {
    let lines = vec![
        line((f32::NAN, 0.0), (1.0, f32::INFINITY)),
        line((1.0, 1.0), (1.0, 1.0)),
        line((1.5, 0.0), (2.4, 0.0)),
    ];
    assert_eq!(look(&plain(), &lines, None, &LimbMask::default()), []);
}
