//! Estimates where the ball lies and how it rolls, from what both cameras saw in order.
//!
//! A few hypotheses, each a Kalman filter (Kalman 1960) with the friction of the carpet in its
//! prediction; a sighting belongs to the one that expected it most, if it is not too far away for all
//! (gating as in Bar-Shalom and Li 1995). They live in the start frame of odometry, so that a ball
//! at rest stays where it is while the robot walks, turns, or stands.
//!
//! An image that would show a ball and does not speaks against it, so that one that somebody takes away is soon
//! no longer believed in.
//!
//! Cycles of Vision that nothing older can overtake any more are learnt; younger ones only refine
//! this cycle's answer.

mod hypotheses;
mod hypothesis;
mod sight;

use framework::{
    AdditionalOutput, CycleTime, HistoricInput, Input, MainOutput, Parameter, PerceptionInput,
    Reflect, Result, RollBack, Timeline, Timestamp, context,
};
use nalgebra::{Isometry2, Matrix2, Point2, Vector2};
use serde::{Deserialize, Serialize};
use types::ball::{Ball, BallCandidate, BallView, LearntImage};
use types::field_features::FieldBorder;
use types::limbs::LimbMask;
use types::obstacles::{Obstacle, ObstacleCandidate};
use types::odometry::Odometry;

use self::hypotheses::Hypotheses;
use self::hypothesis::{Hypothesis, Sighting};
use self::sight::Sight;
use crate::places::Hypothesis as _;
use crate::sight_noise::SightNoise;
use crate::start_frame::ground_to_start;

/// What is believed of balls and of those who see them.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BallFilterParameters {
    /// A rolling ball keeps 1/e of its speed for so long.
    #[reflect(unit = "s", range = 0.0..)]
    pub rolling_time: f32,
    /// A slower ball rests.
    #[reflect(unit = "m/s", range = 0.0..)]
    pub resting_speed: f32,
    /// How fast a ball is that was seen for the first time or kicked, one standard deviation.
    #[reflect(unit = "m/s", range = 0.0..)]
    pub initial_speed: f32,
    /// In m after 1 s: how far the ball gets without anybody knowing why, one standard deviation.
    pub position_noise: f32,
    /// In m/s after 1 s: how its speed changes without anybody knowing why, one standard deviation.
    pub velocity_noise: f32,
    /// What a sighting is off besides what its own covariance says, just in front of the robot, one standard deviation.
    #[reflect(unit = "m", range = 0.0..)]
    pub least_noise: f32,
    /// By how much more per m of distance, across the line of sight: an image does not know how far the head is turned.
    pub noise_across: f32,
    /// In standard deviations: a sighting farther away from a hypothesis belongs to another one.
    pub gate: f32,
    /// Nearer than this it belongs to it anyway, and was kicked; two hypotheses are one.
    #[reflect(unit = "m", range = 0.0..)]
    pub same_place: f32,
    /// Sightings, old ones counted less, that make a hypothesis a ball.
    pub least_validity: f32,
    /// More than so many do not count.
    pub most_validity: f32,
    /// A hypothesis with fewer is forgotten.
    pub discarded_validity: f32,
    /// A sighting so old counts 1/e.
    #[reflect(unit = "s", range = 0.0..)]
    pub validity_time: f32,
    /// An image that would show the ball and does not leaves so much of its validity.
    #[reflect(range = 0.0..=1.0)]
    pub missed_validity: f32,
    /// Further away a ball that is not found may be there all the same.
    #[reflect(unit = "m", range = 0.0..)]
    pub missed_within: f32,
    /// Nearer to the edge of an image or to the own limbs it may, too: the head turns meanwhile.
    #[reflect(unit = "rad", range = 0.0..)]
    pub missed_edge: f32,
    /// So near to somebody, or to the way of the camera's look past somebody, it may be hidden.
    #[reflect(unit = "m", range = 0.0..)]
    pub hidden_beside: f32,
    /// A ball that nobody saw for so long is forgotten.
    #[reflect(unit = "s", range = 0.0..)]
    pub forget_after: f32,
}

/// A place where the ball may lie, in the ground frame.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
pub struct BallHypothesis {
    /// In m.
    pub position: Point2<f32>,
    /// In m/s.
    pub velocity: Vector2<f32>,
    /// Of the position, along the axes of the ground frame, in m².
    pub covariance: Matrix2<f32>,
    /// How many sightings speak for it, old ones counted less.
    pub validity: f32,
    /// When a camera saw it last.
    pub seen_at: Timestamp,
    /// How many images since then would have shown it and did not.
    pub missed: u32,
}

/// What was learnt of the ball.
#[derive(Debug, Deserialize, Serialize)]
pub struct BallFilter {
    hypotheses: RollBack<Hypotheses>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    balls: PerceptionInput<Vec<BallCandidate>, "Vision", "balls">,
    ball_views: PerceptionInput<Option<BallView>, "Vision", "ball_view">,
    borders: PerceptionInput<FieldBorder, "Vision", "field_border">,
    limb_masks: PerceptionInput<LimbMask, "Vision", "limb_mask">,
    obstacles_seen: PerceptionInput<Vec<ObstacleCandidate>, "Vision", "obstacles">,
    /// Somebody hides a ball from a camera that does not see the feet.
    obstacles: Input<Vec<Obstacle>, "obstacles">,
    odometry: HistoricInput<Odometry, "odometry">,
    cycle_time: CycleTime,
    parameters: Parameter<BallFilterParameters, "ball_filter">,

    /// All places where the ball may lie, settled or not.
    hypotheses: AdditionalOutput<Vec<BallHypothesis>, "ball_filter.hypotheses">,
    /// The ball as it would be without what is not settled.
    persistent_ball: AdditionalOutput<Option<Ball>, "ball_filter.persistent_ball">,
    /// When the images were taken that this cycle learnt from, in that order.
    delivered: AdditionalOutput<Vec<LearntImage>, "ball_filter.delivered">,
}

#[context]
pub struct MainOutputs {
    /// The ball in the ground frame of this cycle; `None` where nobody has seen it lately.
    ball: MainOutput<Option<Ball>>,
}

impl BallFilter {
    /// Knows nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            hypotheses: RollBack::default(),
        })
    }

    /// Learns from what is settled, then looks at what is not.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let (odometry, parameters) = (context.odometry, context.parameters);
        let now = context.cycle_time.start;
        let now_to_start = ground_to_start(&odometry, now);
        let known = context.obstacles;
        let see = |hypotheses: &mut Hypotheses, timestamp, image: Image<'_>| {
            hypotheses.predict(timestamp, parameters);
            let Some(pose) = ground_to_start(&odometry, timestamp) else {
                return;
            };
            hypotheses.begin_image();
            for sighting in sightings(image.balls, timestamp, pose, parameters) {
                hypotheses.learn(&sighting, parameters);
            }
            hypotheses.merge(parameters.same_place);
            if let Some(view) = image.view {
                let seen = image.obstacles.iter().map(|seen| pose * seen.position);
                let known = now_to_start
                    .into_iter()
                    .flat_map(|to_start| known.iter().map(move |known| to_start * known.position));
                let sight = Sight {
                    taken_at: timestamp,
                    view,
                    border: image.border,
                    limbs: image.limbs,
                    hiding: seen.chain(known),
                    ground_to_start: pose,
                };
                hypotheses.miss(&sight, parameters);
            }
        };
        let (balls, views) = (context.balls, context.ball_views);
        let (borders, limbs) = (context.borders, context.limb_masks);
        let obstacles = context.obstacles_seen;
        let persistent = images(
            balls.persistent,
            views.persistent,
            borders.persistent,
            limbs.persistent,
            obstacles.persistent,
        );
        self.hypotheses.settle(persistent, see);
        let transient = images(
            balls.transient,
            views.transient,
            borders.transient,
            limbs.transient,
            obstacles.transient,
        );
        let newest = self.hypotheses.with_transient(transient, see);

        let start_to_ground = now_to_start.map(|pose| pose.inverse());
        let ball_of = |mut hypotheses: Hypotheses| {
            hypotheses.predict(now, parameters);
            let best = hypotheses.best(parameters)?;
            Some(ball(best, start_to_ground?, parameters))
        };
        let settled = self.hypotheses.settled();
        context
            .persistent_ball
            .fill_if_subscribed(|| ball_of(*settled));
        context
            .hypotheses
            .fill_if_subscribed(|| describe(newest, now, start_to_ground, parameters));
        let images = context.balls.persistent.iter();
        context
            .delivered
            .fill_if_subscribed(|| images.map(learnt).collect());
        Ok(MainOutputs {
            ball: ball_of(newest).into(),
        })
    }
}

/// What one image shows, and what it could show.
#[derive(Clone, Copy, Debug)]
struct Image<'c> {
    balls: &'c [BallCandidate],
    view: Option<&'c BallView>,
    border: &'c FieldBorder,
    limbs: &'c LimbMask,
    obstacles: &'c [ObstacleCandidate],
}

fn images<'c>(
    balls: Timeline<'c, &'c Vec<BallCandidate>>,
    views: Timeline<'c, &'c Option<BallView>>,
    borders: Timeline<'c, &'c FieldBorder>,
    limbs: Timeline<'c, &'c LimbMask>,
    obstacles: Timeline<'c, &'c Vec<ObstacleCandidate>>,
) -> impl Iterator<Item = (Timestamp, Image<'c>)> {
    let hidden = limbs.zip(obstacles);
    let images = balls.zip(views).zip(borders.iter().zip(hidden));
    images.map(|((timestamp, (balls, view)), ((_, border), (_, hidden)))| {
        let (limbs, obstacles) = hidden;
        let image = Image {
            balls,
            view: view.as_ref(),
            border,
            limbs,
            obstacles,
        };
        (timestamp, image)
    })
}

fn learnt((captured_at, candidates): (Timestamp, &Vec<BallCandidate>)) -> LearntImage {
    LearntImage {
        captured_at,
        candidates: candidates.len(),
    }
}

/// Candidates with a place on the ground, as seen from the start frame.
fn sightings(
    candidates: &[BallCandidate],
    seen_at: Timestamp,
    ground_to_start: Isometry2<f32>,
    parameters: &BallFilterParameters,
) -> impl Iterator<Item = Sighting> {
    let turn = ground_to_start.rotation.to_rotation_matrix().into_inner();
    let places = candidates
        .iter()
        .filter_map(|candidate| candidate.position.zip(candidate.covariance))
        .filter(|(position, covariance)| {
            let mut numbers = position.iter().chain(covariance);
            numbers.all(|number| number.is_finite())
        });
    places.map(move |(position, covariance)| {
        let sight = ground_to_start * position.coords;
        Sighting {
            position: ground_to_start * position,
            noise: turn * covariance * turn.transpose() + noise(sight, parameters),
            seen_at,
        }
    })
}

/// Covariance of what an image does not know about a sighting.
fn noise(sight: Vector2<f32>, parameters: &BallFilterParameters) -> Matrix2<f32> {
    let noise = SightNoise {
        least: parameters.least_noise,
        along: 0.0,
        tilt: 0.0,
        across: parameters.noise_across,
    };
    noise.covariance(sight)
}

fn ball(
    hypothesis: &Hypothesis,
    start_to_ground: Isometry2<f32>,
    parameters: &BallFilterParameters,
) -> Ball {
    Ball {
        position: start_to_ground * hypothesis.position(),
        velocity: start_to_ground * hypothesis.velocity(parameters),
        seen_at: hypothesis.seen_at,
    }
}

fn describe(
    mut hypotheses: Hypotheses,
    now: Timestamp,
    start_to_ground: Option<Isometry2<f32>>,
    parameters: &BallFilterParameters,
) -> Vec<BallHypothesis> {
    hypotheses.predict(now, parameters);
    let Some(start_to_ground) = start_to_ground else {
        return Vec::new();
    };
    let turn = start_to_ground.rotation.to_rotation_matrix().into_inner();
    let described = hypotheses.iter().map(|hypothesis| {
        let Hypothesis {
            validity, missed, ..
        } = *hypothesis;
        let Ball {
            position,
            velocity,
            seen_at,
        } = ball(hypothesis, start_to_ground, parameters);
        BallHypothesis {
            position,
            velocity,
            covariance: turn * hypothesis.position_covariance() * turn.transpose(),
            validity,
            seen_at,
            missed,
        }
    });
    described.collect()
}

#[cfg(test)]
mod tests;
