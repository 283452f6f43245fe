//! How well vision sees under the conditions of docs/vision.md, in the half in which it was tuned and in the other one.
//!
//! `HULKGEN_VISION_IMAGES=3000 cargo test -p simulated_nao --test vision_conditions -- --nocapture` prints the table of the page.

#[path = "support/conditions.rs"]
mod conditions;
#[path = "support/scene.rs"]
#[expect(dead_code, reason = "the conditions have scenes of their own")]
mod scene;

use std::time::Duration;

use conditions::{Draw, Half};
use nalgebra::Point2;
use scene::{Sight, Vision};
use simulated_nao::ground_truth::{BallTruth, ImageTruth};
use types::ball::BallCandidate;

/// Without the variable.
const IMAGES: u64 = 250;
/// Other images than those of the training.
const SEED: u64 = 17;
/// Edges of the distances that are told apart, m.
const DISTANCES: [f32; 6] = [0.0, 1.0, 2.0, 3.0, 3.7, 4.3];

/// Balls at some distance.
#[derive(Clone, Copy, Debug, Default)]
struct Balls {
    shown: u32,
    found: u32,
    /// Within 5 cm and 5 % of the distance.
    precise: u32,
}

/// What came of many images.
#[derive(Debug, Default)]
struct Score {
    images: u32,
    balls: [Balls; DISTANCES.len() - 1],
    /// Images with a ball where there is none.
    wrong: u32,
    /// How far off the balls were found, in parts of what is allowed.
    off: Vec<f32>,
    /// Time of the processor for each image.
    spent: Vec<Duration>,
}

impl Score {
    fn add(&mut self, truth: &ImageTruth, place: Option<Point2<f32>>, sight: &Sight) {
        self.images += 1;
        let ball = truth.ball.zip(place);
        let is_ball =
            |candidate: &&BallCandidate| ball.is_some_and(|(ball, _)| is_at(candidate, &ball));
        self.wrong += u32::from(!sight.balls.iter().all(|candidate| is_ball(&candidate)));
        let Some((_, place)) = ball.filter(|(ball, _)| ball.is_whole) else {
            return;
        };
        let distance = place.coords.norm();
        let Some(bin) =
            (DISTANCES.windows(2)).position(|edges| (edges[0]..edges[1]).contains(&distance))
        else {
            return;
        };
        let balls = &mut self.balls[bin];
        balls.shown += 1;
        if let Some(found) = sight.balls.iter().find(is_ball) {
            let off = found
                .position
                .map_or(f32::MAX, |position| nalgebra::distance(&position, &place));
            let off = off / (0.05 + 0.05 * distance);
            balls.found += 1;
            balls.precise += u32::from(off <= 1.0);
            self.off.push(off);
        }
    }

    /// Of balls up to 3 m.
    fn share(&self, count: impl Fn(&Balls) -> u32) -> f32 {
        let near = &self.balls[..3];
        near.iter().map(&count).sum::<u32>() as f32
            / near.iter().map(|balls| balls.shown).sum::<u32>() as f32
    }

    fn print(&mut self, half: Half) {
        self.off.sort_unstable_by(f32::total_cmp);
        let median = self
            .off
            .get(self.off.len() / 2)
            .copied()
            .unwrap_or(f32::NAN);
        self.spent.sort_unstable();
        let slow = self
            .spent
            .get(self.spent.len() * 99 / 100)
            .copied()
            .unwrap_or_default();
        println!("{half:?}: of 100 images 99 take at most {slow:?} of the processor");
        println!(
            "{half:?}: {} images, a ball where there is none in {}; median error {median:.2} of what is allowed",
            self.images, self.wrong
        );
        for (edges, balls) in DISTANCES.windows(2).zip(&self.balls) {
            let Balls {
                shown,
                found,
                precise,
            } = balls;
            println!(
                "  {} to {} m: {found} of {shown} found, {precise} of them precisely",
                edges[0], edges[1]
            );
        }
    }
}

/// Whether it is that ball, as an image shows it.
fn is_at(candidate: &BallCandidate, ball: &BallTruth) -> bool {
    nalgebra::distance(&candidate.center, &ball.center) <= 1.5 * ball.radius.max(4.0)
}

fn score(half: Half) -> Score {
    let images = std::env::var("HULKGEN_VISION_IMAGES").ok();
    let images = images.map_or(IMAGES, |count| {
        count.parse().expect("it is a number of images")
    });
    let mut draw = Draw::new(SEED + half as u64);
    let mut vision = Vision::new();
    let mut score = Score::default();
    for number in 0..images {
        let (look, exposure) = conditions::scene(half, number, &mut draw);
        let truth = ImageTruth::from(&exposure);
        let place = exposure
            .ball
            .map(|ball| exposure.ground_to_field.inverse_transform_point(&ball).xy());
        let sight = vision.see(&look, &exposure);
        score.add(&truth, place, &sight);
        score.spent.push(vision.spent);
    }
    score.print(half);
    score
}

fn assert_good(score: &Score, least_found: f32) {
    let (found, precise) = (
        score.share(|balls| balls.found),
        score.share(|balls| balls.precise),
    );
    assert!(
        found >= least_found,
        "{found} of the balls up to 3 m were found"
    );
    assert!(precise >= 0.97 * found, "{precise} of {found} were precise");
    // One more than what one in a thousand allows: a few hundred images cannot show less.
    assert!(score.wrong <= 1 + score.images / 1000, "{score:?}");
}

#[test]
fn balls_are_seen_under_the_conditions_that_detectors_were_tuned_for() {
    assert_good(&score(Half::Tuned), 0.85);
}

#[test]
fn balls_are_seen_under_conditions_that_nobody_looked_at() {
    assert_good(&score(Half::Other), 0.8);
}
