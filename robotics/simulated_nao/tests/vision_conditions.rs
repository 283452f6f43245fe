//! How well vision sees balls under the conditions of docs/vision.md, in the half in which their network was trained and in the
//! other one.
//!
//! `HULKGEN_VISION_IMAGES=3000 cargo test -p simulated_nao --test vision_conditions -- --nocapture` prints the table of the page.

#[path = "support/conditions.rs"]
mod conditions;
#[path = "support/scene.rs"]
#[expect(dead_code, reason = "the conditions have scenes of their own")]
mod scene;
#[path = "support/score.rs"]
mod score;

use std::time::Duration;

use conditions::Half;
use scene::Vision;
use score::{Balls, scenes};
use simulated_nao::ground_truth::ImageTruth;

/// Without the variable.
const IMAGES: u64 = 250;

fn score(half: Half) -> Balls {
    let mut vision = Vision::new();
    let mut balls = Balls::default();
    let mut spent: Vec<Duration> = Vec::new();
    for (look, exposure) in scenes(half, IMAGES) {
        let sight = vision.see(&look, &exposure);
        balls.add(&exposure, &ImageTruth::from(&exposure), &sight.balls);
        spent.push(vision.spent);
    }
    spent.sort_unstable();
    let slow = spent
        .get(spent.len() * 99 / 100)
        .copied()
        .unwrap_or_default();
    println!("{half:?}: of 100 images 99 take at most {slow:?} of the processor");
    balls.print(half);
    balls
}

#[test]
fn balls_are_seen_under_the_conditions_that_detectors_were_tuned_for() {
    score(Half::Tuned).assert_good(0.85);
}

#[test]
fn balls_are_seen_under_conditions_that_nobody_looked_at() {
    score(Half::Other).assert_good(0.8);
}
