//! How well vision finds the centre circle and corners of lines in images of the simulated cameras.

#[path = "support/scene.rs"]
#[expect(dead_code, reason = "they need a part of it")]
mod scene;

use framework::math;
use nalgebra::{Point2, Point3, Vector2, Vector3};
use scene::{Look, Vision, looks};
use simulated_nao::camera::Exposure;
use simulated_nao::field::{LENGTH, WIDTH};
use simulated_nao::ground_truth::ImageTruth;
use types::camera::CameraPosition;
use types::field_features::{CornerKind, LineCorner};

/// From the goal line into the field and along it, m.
const AREAS: [[f32; 2]; 2] = [[0.6, 2.2], [1.65, 4.0]];

/// All over the field, around the centre circle, and towards every corner.
fn looks_around() -> impl Iterator<Item = (u64, Look)> {
    let about_the_circle = (0..40).map(|index| {
        let bearing = f64::from(index) * 0.7;
        let distance = 0.4 + 0.07 * f64::from(index);
        Look {
            robot: [
                -distance * math::cos(bearing),
                -distance * math::sin(bearing),
                bearing,
            ],
            yaw: 0.4 * math::sin(f64::from(index)),
            pitch: 0.2,
            camera: CameraPosition::Top,
        }
    });
    let turned = looks().flat_map(|look| {
        [0.0, 0.29, 0.6].map(|turn| Look {
            yaw: look.yaw + turn,
            ..look
        })
    });
    let to_corners = corners()
        .into_iter()
        .enumerate()
        .flat_map(|(index, (_, place, _))| {
            [0.3, 2.4, 4.5].map(|turn| {
                let bearing = turn + 0.5 * index as f64;
                Look {
                    robot: [
                        f64::from(place.x) - 1.5 * math::cos(bearing),
                        f64::from(place.y) - 1.5 * math::sin(bearing),
                        bearing,
                    ],
                    yaw: 0.1,
                    pitch: 0.25,
                    camera: CameraPosition::Top,
                }
            })
        });
    // Behind a goal the robot sees the field through its net.
    let is_before_goals = |look: &Look| look.robot[0].abs() <= 4.5;
    let all = turned.chain(about_the_circle).chain(to_corners);
    (0..).zip(all.filter(is_before_goals))
}

fn to_ground(exposure: &Exposure, place: Point2<f32>) -> Point2<f32> {
    let place = Point3::new(place.x, place.y, 0.0);
    exposure
        .ground_to_field
        .inverse_transform_point(&place)
        .xy()
}

#[test]
fn the_centre_circle_is_found_where_it_is_and_nowhere_else() {
    let mut vision = Vision::new();
    let (mut images, mut shown, mut found, mut worst, mut squares) = (0, 0, 0, 0.0_f32, 0.0);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let circle = vision.see(&look, &exposure).center_circle;
        let truth = to_ground(&exposure, Point2::origin());
        images += 1;
        let pixel = ImageTruth::from(&exposure).project(Point3::origin());
        let is_expected = truth.coords.norm() < 2.5
            && pixel.is_some_and(|pixel| (150.0..490.0).contains(&pixel.x));
        shown += usize::from(is_expected);
        let Some(circle) = circle else {
            if is_expected {
                println!("not found at {truth}: {look:?}");
            }
            continue;
        };
        found += usize::from(is_expected);
        let off = circle.position - truth;
        let allowed = 0.05 + 0.03 * truth.coords.norm();
        worst = worst.max(off.norm() / allowed);
        squares += off.dot(&(circle.covariance.try_inverse().unwrap() * off));
        assert!(
            off.norm() <= allowed,
            "{circle:?} instead of {truth}: {look:?}"
        );
    }
    println!(
        "{found} of {shown} circles in {images} images, at most {worst} of what is allowed off, {squares} squared deviations"
    );
    assert!(shown >= 10, "{shown}");
    assert!(found * 10 >= shown * 8, "{found} of {shown}");
}

/// Every corner of straight lines: what it is, where, and which way it opens, in the field frame.
fn corners() -> Vec<(CornerKind, Point2<f32>, Vector2<f32>)> {
    let (goal, touch) = (LENGTH / 2.0, WIDTH / 2.0);
    let mut corners = Vec::new();
    for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let inward = Vector2::new(-x, -y).normalize();
        corners.push((CornerKind::L, Point2::new(x * goal, y * touch), inward));
        for [length, width] in AREAS {
            let half = y * width / 2.0;
            let front = Point2::new(x * (goal - length), half);
            corners.push((CornerKind::L, front, Vector2::new(x, -y).normalize()));
            corners.push((
                CornerKind::T,
                Point2::new(x * goal, half),
                Vector2::new(-x, 0.0),
            ));
        }
    }
    for y in [1.0, -1.0] {
        corners.push((
            CornerKind::T,
            Point2::new(0.0, y * touch),
            Vector2::new(0.0, -y),
        ));
    }
    corners
}

#[test]
fn corners_are_those_of_the_field() {
    let mut vision = Vision::new();
    let (mut shown, mut found, mut seen, mut wrong) = (0, 0, 0, 0);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let sight = vision.see(&look, &exposure);
        let known: Vec<_> = corners()
            .into_iter()
            .map(|(kind, place, opening)| {
                let opening = Vector3::new(opening.x, opening.y, 0.0);
                let opening = exposure.ground_to_field.inverse_transform_vector(&opening);
                (kind, to_ground(&exposure, place), opening.xy())
            })
            .collect();
        let is =
            |corner: &LineCorner,
             (kind, place, opening): &(CornerKind, Point2<f32>, Vector2<f32>)| {
                corner.kind == *kind
                    && nalgebra::distance(&corner.position, place)
                        <= 0.05 + 0.05 * place.coords.norm()
                    && corner.direction.angle(opening) <= 0.2
            };
        for corner in &sight.corners {
            seen += 1;
            if !known.iter().any(|known| is(corner, known)) {
                wrong += 1;
                println!("{corner:?}: {look:?} {:?}", sight.lines);
            }
        }
        let truth = ImageTruth::from(&exposure);
        for corner in &known {
            let pixel = truth
                .camera_matrix
                .ground_to_pixel(corner.1.coords.push(0.0).into());
            let is_shown = corner.1.coords.norm() < 2.0
                && pixel.is_some_and(|pixel| {
                    (120.0..520.0).contains(&pixel.x) && (80.0..360.0).contains(&pixel.y)
                });
            shown += usize::from(is_shown);
            found += usize::from(is_shown && sight.corners.iter().any(|seen| is(seen, corner)));
        }
    }
    println!("{found} of {shown} corners found, {wrong} of {seen} that were seen are none");
    assert!(shown > 10, "{shown}");
    assert!(found * 2 >= shown, "{found} of {shown}");
    assert!(wrong * 20 <= seen, "{wrong} of {seen}");
}
