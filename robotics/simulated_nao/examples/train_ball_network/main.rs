//! Trains the network that tells balls from other round things, and writes it where `vision` has it.
//!
//! `cargo run --release -p simulated_nao --example train_ball_network [IMAGES]`: the simulated cameras take images under the one
//! half of the conditions of docs/vision.md, vision proposes circles in them, the truth says which are the ball. The same
//! program gives the same weights. Adam (Kingma and Ba 2015), cross entropy.

#[path = "../../tests/support/conditions.rs"]
#[expect(dead_code, reason = "nothing is learnt in the other half")]
mod conditions;
mod network;
#[path = "../../tests/support/scene.rs"]
#[expect(dead_code, reason = "the conditions have scenes of their own")]
mod scene;

use std::error::Error;
use std::fs;
use std::path::Path;

use conditions::{Draw, Half};
use framework::math;
use framework::testing::AdditionalProbe;
use simulated_nao::ground_truth::{BallTruth, ImageTruth};
use vision::ball_detection::BallProposal;
use vision::ball_detection::patch::{Patch, SIDE, normalized};

/// Where training begins; images for the final look are drawn from the next.
const SEED: u64 = 20_261_122;
const IMAGES: u64 = 2_500;
const EPOCHS: usize = 16;
const BATCH: usize = 32;
const RATE: f32 = 2e-3;

/// A circle that vision proposed.
struct Sample {
    patch: Patch,
    is_ball: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let images = std::env::args()
        .nth(1)
        .map_or(Ok(IMAGES), |count| count.parse())?;
    let samples = collect(images, SEED);
    let held_out = collect(images / 4, SEED + 1);
    let balls = samples.iter().filter(|sample| sample.is_ball).count();
    println!(
        "{} circles in {images} images, {balls} of them balls",
        samples.len()
    );
    let weights = train(&samples, &held_out);
    let right = score(&weights, &held_out);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../vision/src/ball_detection");
    let lines: String = weights
        .iter()
        .map(|weight| format!("{:08x}\n", weight.to_bits()))
        .collect();
    fs::write(folder.join("network.txt"), lines)?;
    let text = format!(
        "# What made network.txt; layout in network.rs.\n\
         made_by = \"cargo run --release -p simulated_nao --example train_ball_network {images}\"\n\
         seed = {SEED}\n\
         images = {images}\n\
         circles = {}\n\
         balls = {balls}\n\
         epochs = {EPOCHS}\n\
         held_out_circles = {}\n\
         held_out_right = {right:.4}\n",
        samples.len(),
        held_out.len(),
    );
    fs::write(folder.join("network.toml"), text)?;
    Ok(())
}

fn collect(images: u64, seed: u64) -> Vec<Sample> {
    let mut draw = Draw::new(seed);
    let mut vision = scene::Vision::new();
    vision.proposals = AdditionalProbe::default();
    let mut samples = Vec::new();
    for number in 0..images {
        let (look, exposure) = conditions::scene(Half::Tuned, number, &mut draw);
        let truth = ImageTruth::from(&exposure).ball;
        vision.see(&look, &exposure);
        let proposals = vision.proposals.value().into_iter().flatten();
        samples.extend(proposals.filter_map(|proposal| labelled(proposal, truth.as_ref())));
    }
    samples
}

/// `None` where it is not clear: a ball that is hidden in part or found at its rim is neither.
fn labelled(proposal: &BallProposal, truth: Option<&BallTruth>) -> Option<Sample> {
    let off = truth.map(|truth| {
        let away = nalgebra::distance(&truth.center, &proposal.candidate.center) / truth.radius;
        let ratio = proposal.candidate.radius / truth.radius;
        (away, ratio.max(ratio.recip()), truth.is_whole)
    });
    let is_ball = match off {
        Some((away, ratio, true)) if away < 0.3 && ratio < 1.3 => true,
        Some((away, _, _)) if away < 1.3 => return None,
        _ => false,
    };
    Some(Sample {
        patch: proposal.patch.as_slice().try_into().ok()?,
        is_ball,
    })
}

fn train(samples: &[Sample], held_out: &[Sample]) -> Vec<f32> {
    let mut draw = Draw::new(SEED);
    // The sum of twelve has variance one.
    let mut weights = network::beginning(|| (0..12).map(|_| draw.next()).sum::<f32>() - 6.0);
    let (mut mean, mut square) = (vec![0.0; weights.len()], vec![0.0; weights.len()]);
    let mut order: Vec<_> = (0..samples.len()).collect();
    let mut steps = 0;
    for epoch in 0..EPOCHS {
        for last in (1..order.len()).rev() {
            order.swap(last, draw.below(last + 1));
        }
        let rate = RATE * (1.0 - epoch as f32 / EPOCHS as f32);
        for batch in order.chunks(BATCH) {
            let mut gradient = vec![0.0; weights.len()];
            for index in batch {
                let sample = &samples[*index];
                let image = varied(&sample.patch, &mut draw);
                let wanted = if sample.is_ball { 1.0 } else { 0.0 };
                let slope =
                    |odds: f32| (1.0 / (1.0 + math::exp(-odds)) - wanted) / batch.len() as f32;
                network::learn(&weights, &image, slope, &mut gradient);
            }
            steps += 1;
            for (index, by) in gradient.into_iter().enumerate() {
                mean[index] = 0.9 * mean[index] + 0.1 * by;
                square[index] = 0.999 * square[index] + 0.001 * by * by;
                let corrected = mean[index] / (1.0 - math::powi(0.9_f32, steps));
                let spread = (square[index] / (1.0 - math::powi(0.999_f32, steps))).sqrt();
                weights[index] -= rate * corrected / (spread + 1e-8);
            }
        }
        println!(
            "epoch {epoch}: {:.4} of held out circles right",
            score(&weights, held_out)
        );
    }
    weights
}

/// Mirrored, moved by a pixel, with more noise: what may as well have been seen.
fn varied(patch: &Patch, draw: &mut Draw) -> [f32; SIDE * SIDE] {
    let is_mirrored = draw.next() < 0.5;
    let (right, down) = (draw.below(3), draw.below(3));
    let noise = draw.between(0.0, 6.0);
    let gain = draw.between(0.8, 1.2);
    let moved = std::array::from_fn(|index| {
        let (row, column) = (index / SIDE, index % SIDE);
        let column = if is_mirrored {
            SIDE - 1 - column
        } else {
            column
        };
        let clamped = |at: usize, by: usize| (at + by).saturating_sub(1).min(SIDE - 1);
        let value = f32::from(patch[clamped(row, down) * SIDE + clamped(column, right)]);
        (value * gain + noise * (2.0 * draw.next() - 1.0)) as u8
    });
    normalized(&moved)
}

/// The share of circles about which the network is right at even odds.
fn score(weights: &[f32], samples: &[Sample]) -> f32 {
    let is_right = |sample: &&Sample| {
        let odds = network::learn(weights, &normalized(&sample.patch), |_| 0.0, &mut []);
        (odds > 0.0) == sample.is_ball
    };
    samples.iter().filter(is_right).count() as f32 / samples.len().max(1) as f32
}
