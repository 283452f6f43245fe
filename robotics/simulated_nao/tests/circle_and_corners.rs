//! How well vision finds the centre circle and corners of lines in images of the simulated cameras.

#[path = "support/scene.rs"]
#[expect(dead_code, reason = "they need a part of it")]
mod scene;

use framework::math;
use framework::testing::ParameterFile;
use nalgebra::{Point2, Point3};
use scene::{Look, Vision, looks};
use simulated_nao::camera::Exposure;
use simulated_nao::ground_truth::ImageTruth;
use types::camera::CameraPosition;
use types::field_features::LineCorner;
use types::field_markings::{CORNER_COUNT, FieldCorner, FieldMarkings};

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
        .flat_map(|(index, corner)| {
            let position = corner.position;
            [0.3, 2.4, 4.5].map(|turn| {
                let bearing = turn + 0.5 * index as f64;
                Look {
                    robot: [
                        f64::from(position.x) - 1.5 * math::cos(bearing),
                        f64::from(position.y) - 1.5 * math::sin(bearing),
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

fn corners() -> [FieldCorner; CORNER_COUNT] {
    let parameters = ParameterFile::new(include_str!("../../parameters/default.toml"));
    let markings: FieldMarkings = parameters.get("field_dimensions.markings");
    markings.corners()
}

#[test]
fn corners_are_those_of_the_field() {
    let (mut vision, corners) = (Vision::new(), corners());
    let (mut shown, mut found, mut seen, mut wrong) = (0, 0, 0, 0);
    for (number, look) in looks_around() {
        let exposure = look.expose(number, None);
        let sight = vision.see(&look, &exposure);
        let known: Vec<_> = corners
            .into_iter()
            .map(|corner| FieldCorner {
                position: to_ground(&exposure, corner.position),
                direction: exposure
                    .ground_to_field
                    .inverse_transform_vector(&corner.direction.push(0.0))
                    .xy(),
                ..corner
            })
            .collect();
        let is = |corner: &LineCorner, known: &FieldCorner| {
            corner.kind == known.kind
                && nalgebra::distance(&corner.position, &known.position)
                    <= 0.05 + 0.05 * known.position.coords.norm()
                && corner.direction.angle(&known.direction) <= 0.2
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
                .ground_to_pixel(corner.position.coords.push(0.0).into());
            let is_shown = corner.position.coords.norm() < 2.0
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
