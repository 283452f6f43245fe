//! What vision makes of a few images, kept as text: a change of any detector shows what it changes.
//!
//! `INSTA_UPDATE=always` writes `golden.txt` anew, to be read like every other change.

#[path = "support/conditions.rs"]
mod conditions;
#[path = "support/scene.rs"]
#[expect(dead_code, reason = "golden images need a part of it")]
mod scene;

use std::fmt::Write as _;
use std::fs;

use conditions::{Draw, Half};
use nalgebra::{Matrix2, Point2, Point3};
use scene::{Look, Sight, Vision};
use types::camera::CameraPosition;
use types::field_features::CornerKind;

const IMAGES: u64 = 12;
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden.txt");

/// A place in cm and one standard deviation along both axes of the ground.
fn place(position: Point2<f32>, covariance: &Matrix2<f32>) -> String {
    let cm = |metres: f32| (metres * 100.0).round() as i32;
    let deviations = covariance.diagonal().map(f32::sqrt);
    let [x, y] = [position.x, position.y].map(cm);
    format!(
        "({x}, {y}) ± ({}, {}) cm",
        cm(deviations.x),
        cm(deviations.y)
    )
}

/// An image that was chosen for what it shows.
struct Chosen {
    name: &'static str,
    look: Look,
    ball: Option<[f32; 2]>,
    shows: fn(&Sight) -> bool,
}

fn has_corner(sight: &Sight, kind: CornerKind) -> bool {
    sight.corners.iter().any(|corner| corner.kind == kind)
}

/// By a robot that stands there (m, m, rad) with this yaw and pitch of its head (rad).
fn taken(
    name: &'static str,
    robot: [f64; 3],
    [yaw, pitch]: [f64; 2],
    camera: CameraPosition,
    shows: fn(&Sight) -> bool,
) -> Chosen {
    Chosen {
        name,
        look: Look {
            robot,
            yaw,
            pitch,
            camera,
        },
        ball: None,
        shows,
    }
}

/// Circle, corners, mark, and the own body.
fn chosen() -> [Chosen; 7] {
    use CameraPosition::{Bottom, Top};
    let has_circle = |sight: &Sight| sight.center_circle.is_some();
    let has_mark = |sight: &Sight| sight.penalty_mark.is_some();
    let has_both = |sight: &Sight| sight.penalty_mark.is_some() && !sight.balls.is_empty();
    let has_limbs = |sight: &Sight| !sight.limb_mask.limbs.is_empty();
    let has_l = |sight: &Sight| has_corner(sight, CornerKind::L);
    let has_t = |sight: &Sight| has_corner(sight, CornerKind::T);
    let aside = "circle from aside";
    let goal_line = "where the penalty area meets the goal line";
    [
        taken("circle", [-1.7, 0.2, 0.0], [0.0, 0.3], Top, has_circle),
        taken(aside, [0.4, -1.6, 1.7], [0.2, 0.3], Top, has_circle),
        taken("corner", [3.3, 1.9, 0.75], [0.0, 0.25], Top, has_l),
        taken(goal_line, [3.3, 1.4, 0.4], [0.0, 0.3], Top, has_t),
        taken("mark", [2.0, 0.3, -0.2], [0.0, 0.3], Top, has_mark),
        Chosen {
            ball: Some([2.9, 0.4]),
            ..taken("mark and ball", [2.0, 0.3, -0.2], [0.0, 0.3], Top, has_both)
        },
        taken("own body", [-2.0, 1.0, 0.3], [0.9, 0.4], Bottom, has_limbs),
    ]
}

fn percent(share: f32) -> f32 {
    (share * 1000.0).round() / 10.0
}

/// What the nodes say before they look for anything.
fn describe_image(text: &mut String, sight: &Sight) -> std::fmt::Result {
    let color = sight.color;
    writeln!(
        text,
        "  field at least {} % green, at most {} % red and {} % blue, luminance from {}",
        percent(color.minimum_green),
        percent(color.maximum_red),
        percent(color.maximum_blue),
        color.minimum_luminance
    )?;
    for limb in &sight.limb_mask.limbs {
        let corners = limb.corners.iter();
        let corners: Vec<_> = corners
            .map(|corner| format!("({:.0}, {:.0})", corner.x, corner.y))
            .collect();
        writeln!(text, "  limb below {} px", corners.join(" "))?;
    }
    Ok(())
}

fn describe(text: &mut String, sight: &Sight) -> std::fmt::Result {
    describe_image(text, sight)?;
    for line in &sight.border.lines {
        writeln!(
            text,
            "  border from row {:.0} with slope {:.2}",
            line.at_left, line.slope
        )?;
    }
    for line in &sight.lines {
        let start = place(line.start, &line.start_covariance);
        writeln!(
            text,
            "  line from {start} to {}",
            place(line.end, &line.end_covariance)
        )?;
    }
    if let Some(circle) = &sight.center_circle {
        writeln!(
            text,
            "  circle of {} pieces about {}",
            circle.chords,
            place(circle.position, &circle.covariance)
        )?;
    }
    for corner in &sight.corners {
        writeln!(
            text,
            "  {:?} at {}",
            corner.kind,
            place(corner.position, &corner.covariance)
        )?;
    }
    if let Some(mark) = &sight.penalty_mark {
        writeln!(text, "  mark at {}", place(mark.position, &mark.covariance))?;
    }
    for ball in &sight.balls {
        if let Some((position, covariance)) = ball.position.zip(ball.covariance) {
            writeln!(
                text,
                "  ball of {:.0} px at {}",
                ball.radius,
                place(position, &covariance)
            )?;
        }
    }
    for obstacle in &sight.obstacles {
        writeln!(
            text,
            "  obstacle at {}",
            place(obstacle.position, &obstacle.covariance)
        )?;
    }
    Ok(())
}

#[test]
fn vision_sees_in_the_same_images_what_it_saw() {
    let mut text = String::new();
    let mut vision = Vision::new();
    for half in [Half::Tuned, Half::Other] {
        let mut draw = Draw::new(5);
        for number in 0..IMAGES / 2 {
            let (look, exposure) = conditions::scene(half, number, &mut draw);
            let sight = vision.see(&look, &exposure);
            assert_definite(&sight);
            writeln!(text, "{half:?}, image {number}, camera {:?}", look.camera).unwrap();
            describe(&mut text, &sight).unwrap();
        }
    }
    for (number, image) in (0..).zip(chosen()) {
        let look = image.look;
        let ball = image.ball.map(|[x, y]| Point3::new(x, y, 0.05));
        let sight = vision.see(&look, &look.expose_among(number, ball, &[]));
        assert!((image.shows)(&sight), "{}: {sight:?}", image.name);
        assert_definite(&sight);
        writeln!(text, "{}, camera {:?}", image.name, look.camera).unwrap();
        describe(&mut text, &sight).unwrap();
    }
    if std::env::var("INSTA_UPDATE").is_ok_and(|wanted| wanted == "always") {
        fs::write(FILE, &text).unwrap();
    }
    let expected = fs::read_to_string(FILE).unwrap_or_default();
    assert!(
        text == expected,
        "vision sees something else than {FILE} says; INSTA_UPDATE=always writes it anew:\n{text}"
    );
}

fn assert_definite(sight: &Sight) {
    for covariance in covariances(sight) {
        assert!(covariance.cholesky().is_some(), "{sight:?}");
    }
}

/// All that vision says about how well places are known.
fn covariances(sight: &Sight) -> impl Iterator<Item = Matrix2<f32>> {
    let balls = sight.balls.iter().filter_map(|ball| ball.covariance);
    let lines = sight
        .lines
        .iter()
        .flat_map(|line| [line.start_covariance, line.end_covariance]);
    let circle = sight.center_circle.iter().map(|circle| circle.covariance);
    let corners = sight.corners.iter().map(|corner| corner.covariance);
    let mark = sight.penalty_mark.iter().map(|mark| mark.covariance);
    let obstacles = sight.obstacles.iter().map(|obstacle| obstacle.covariance);
    let of_field = lines.chain(circle).chain(corners).chain(mark);
    balls.chain(of_field).chain(obstacles)
}
