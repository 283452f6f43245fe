//! What vision makes of a dozen images, kept as text: a change of any detector shows what it changes.
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
use nalgebra::{Matrix2, Point2};
use scene::{Sight, Vision};

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

fn describe(text: &mut String, sight: &Sight) -> std::fmt::Result {
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
            for covariance in covariances(&sight) {
                assert!(covariance.cholesky().is_some(), "{sight:?}");
            }
            writeln!(text, "{half:?}, image {number}, camera {:?}", look.camera).unwrap();
            describe(&mut text, &sight).unwrap();
        }
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
