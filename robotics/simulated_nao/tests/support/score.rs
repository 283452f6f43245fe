//! Images under the conditions of docs/vision.md, and what comes of the balls in them.

use nalgebra::Point2;
use simulated_nao::camera::Exposure;
use simulated_nao::ground_truth::{BallTruth, ImageTruth};
use types::ball::BallCandidate;

use super::conditions::{self, Draw, Half};
use super::scene::Look;

/// Other images than those of the training.
const SEED: u64 = 17;
/// Edges of the distances that are told apart, m.
const DISTANCES: [f32; 6] = [0.0, 1.0, 2.0, 3.0, 3.7, 4.3];

/// As many scenes of this half as `HULKGEN_VISION_IMAGES` says, or so many.
pub(crate) fn scenes(half: Half, otherwise: u64) -> impl Iterator<Item = (Look, Exposure)> {
    let images = std::env::var("HULKGEN_VISION_IMAGES").ok();
    let images = images.map_or(otherwise, |count| {
        count.parse().expect("it is a number of images")
    });
    let mut draw = Draw::new(SEED + half as u64);
    (0..images).map(move |number| conditions::scene(half, number, &mut draw))
}

/// Balls at some distance.
#[derive(Clone, Copy, Debug, Default)]
struct Distance {
    shown: u32,
    found: u32,
    /// Within 5 cm and 5 % of the distance.
    precise: u32,
}

/// What came of many images.
#[derive(Debug, Default)]
pub(crate) struct Balls {
    images: u32,
    distances: [Distance; DISTANCES.len() - 1],
    /// Images with a ball where there is none.
    wrong: u32,
    /// How far off the balls were found, in parts of what is allowed.
    off: Vec<f32>,
}

impl Balls {
    pub(crate) fn add(
        &mut self,
        exposure: &Exposure,
        truth: &ImageTruth,
        candidates: &[BallCandidate],
    ) {
        let place = exposure
            .ball
            .map(|ball| exposure.ground_to_field.inverse_transform_point(&ball).xy());
        self.images += 1;
        let ball = truth.ball.zip(place);
        let is_ball =
            |candidate: &&BallCandidate| ball.is_some_and(|(ball, _)| is_at(candidate, &ball));
        self.wrong += u32::from(!candidates.iter().all(|candidate| is_ball(&candidate)));
        let Some((_, place)) = ball.filter(|(ball, _)| ball.is_whole) else {
            return;
        };
        self.add_whole(place, candidates.iter().find(is_ball));
    }

    fn add_whole(&mut self, place: Point2<f32>, found: Option<&BallCandidate>) {
        let away = place.coords.norm();
        let Some(bin) =
            (DISTANCES.windows(2)).position(|edges| (edges[0]..edges[1]).contains(&away))
        else {
            return;
        };
        let distance = &mut self.distances[bin];
        distance.shown += 1;
        if let Some(found) = found {
            let off = found
                .position
                .map_or(f32::MAX, |position| nalgebra::distance(&position, &place));
            let off = off / (0.05 + 0.05 * away);
            distance.found += 1;
            distance.precise += u32::from(off <= 1.0);
            self.off.push(off);
        }
    }

    /// Of balls up to 3 m.
    fn share(&self, count: impl Fn(&Distance) -> u32) -> f32 {
        let near = &self.distances[..3];
        near.iter().map(&count).sum::<u32>() as f32
            / near.iter().map(|distance| distance.shown).sum::<u32>() as f32
    }

    pub(crate) fn print(&mut self, half: Half) {
        self.off.sort_unstable_by(f32::total_cmp);
        let median = self.off.get(self.off.len() / 2);
        println!(
            "{half:?}: {} images, a ball where there is none in {}; median error {:.2} of what is allowed",
            self.images,
            self.wrong,
            median.unwrap_or(&f32::NAN)
        );
        for (edges, distance) in DISTANCES.windows(2).zip(&self.distances) {
            let Distance {
                shown,
                found,
                precise,
            } = distance;
            println!(
                "  {} to {} m: {found} of {shown} found, {precise} of them precisely",
                edges[0], edges[1]
            );
        }
    }

    pub(crate) fn assert_good(&self, least_found: f32) {
        let found = self.share(|distance| distance.found);
        let precise = self.share(|distance| distance.precise);
        assert!(
            found >= least_found,
            "{found} of the balls up to 3 m were found"
        );
        assert!(precise >= 0.97 * found, "{precise} of {found} were precise");
        // One more than what one in a thousand allows: a few hundred images cannot show less.
        assert!(self.wrong <= 1 + self.images / 1000, "{self:?}");
    }
}

/// Whether it is that ball, as an image shows it.
fn is_at(candidate: &BallCandidate, ball: &BallTruth) -> bool {
    nalgebra::distance(&candidate.center, &ball.center) <= 1.5 * ball.radius.max(4.0)
}
