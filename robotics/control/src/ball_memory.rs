//! Remembers where the ball lies, from what both cameras saw in the order in which they saw it.
//!
//! Cycles of Vision that nothing older can overtake any more change the memory; younger ones only
//! refine this cycle's answer. The robot may turn between image and cycle: the heading at the time
//! of the image tells where the ball was seen.

use framework::{AdditionalOutput, Timestamp};
use framework::{
    CycleTime, HistoricInput, MainOutput, Parameter, PerceptionInput, Result, context,
};
use nalgebra::{Point2, Rotation2, UnitQuaternion};
use serde::{Deserialize, Serialize};
use types::ball::{Ball, BallCandidate};

/// What is remembered of the ball.
#[derive(Debug, Deserialize, Serialize)]
pub struct BallMemory {
    remembered: Option<Sighting>,
}

/// A ball around the robot, in axes that do not turn with it.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
struct Sighting {
    /// In m from the middle between the soles.
    position: Point2<f32>,
    seen_at: Timestamp,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    balls: PerceptionInput<Vec<BallCandidate>, "Vision", "balls">,
    orientation: HistoricInput<UnitQuaternion<f32>, "orientation">,
    cycle_time: CycleTime,

    /// How much of a new sighting goes into the remembered position, 0 to 1.
    gain: Parameter<f32, "ball_memory.gain">,
    /// In m: a sighting farther away than this is another place, and replaces the remembered one.
    same_place: Parameter<f32, "ball_memory.same_place">,
    /// In s: a ball that nobody saw for so long is forgotten.
    forget_after: Parameter<f32, "ball_memory.forget_after">,

    persistent_ball: AdditionalOutput<Option<Ball>, "ball_memory.persistent_ball">,
}

#[context]
pub struct MainOutputs {
    /// The ball in the ground frame of this cycle.
    ball: MainOutput<Option<Ball>>,
}

impl BallMemory {
    /// Remembers nothing.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { remembered: None })
    }

    /// Learns from what is settled, then looks at what is not.
    pub fn cycle(&mut self, mut context: CycleContext) -> Result<MainOutputs> {
        let now = context.cycle_time.start;
        let forget_after = *context.forget_after;
        let heading = context.heading_at(now);
        let in_ground_frame = |sighting: Sighting| {
            let age = (now - sighting.seen_at).as_secs_f32();
            (age <= forget_after).then(|| Ball {
                position: heading.inverse() * sighting.position,
                seen_at: sighting.seen_at,
            })
        };

        for (timestamp, candidates) in context.balls.persistent {
            self.remembered = context.learn(self.remembered, timestamp, candidates);
        }
        let mut newest = self.remembered;
        for (timestamp, candidates) in context.balls.transient {
            newest = context.learn(newest, timestamp, candidates);
        }
        let remembered = self.remembered;
        context
            .persistent_ball
            .fill_if_subscribed(|| remembered.and_then(in_ground_frame));
        Ok(MainOutputs {
            ball: newest.and_then(in_ground_frame).into(),
        })
    }
}

impl CycleContext<'_> {
    /// What is known after one image: of several balls, the one at the known place counts, and as
    /// long as none is known the nearest.
    fn learn(
        &self,
        known: Option<Sighting>,
        timestamp: Timestamp,
        candidates: &[BallCandidate],
    ) -> Option<Sighting> {
        let heading = self.heading_at(timestamp);
        let expected = known.map_or(Point2::origin(), |sighting| sighting.position);
        let seen = candidates
            .iter()
            .filter_map(|candidate| candidate.position)
            .map(|position| heading * position)
            .min_by(|a, b| (a - expected).norm().total_cmp(&(b - expected).norm()));
        let Some(seen) = seen else {
            return known;
        };
        let position = match known {
            Some(Sighting { position, .. }) if (seen - position).norm() < *self.same_place => {
                position + (seen - position) * self.gain.clamp(0.0, 1.0)
            }
            _ => seen,
        };
        // An image that arrives late is no reason to forget a younger one.
        let seen_at = known.map_or(timestamp, |sighting| sighting.seen_at.max(timestamp));
        Some(Sighting { position, seen_at })
    }

    /// Where the robot looked at that time; before the history begins, where it looks now.
    fn heading_at(&self, timestamp: Timestamp) -> Rotation2<f32> {
        let orientation = self.orientation.get(timestamp);
        let oldest = || {
            self.orientation
                .iter()
                .next()
                .map(|(_, orientation)| orientation)
        };
        let (_, _, yaw) = orientation
            .or_else(oldest)
            .copied()
            .unwrap_or_default()
            .euler_angles();
        Rotation2::new(yaw)
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;
    use std::time::Duration;

    use framework::AdditionalSlot;
    use framework::testing::{history, perception};

    use super::*;

    type Seen<'a> = Vec<(Timestamp, &'a Vec<BallCandidate>)>;

    fn at(seconds: f32) -> Timestamp {
        Timestamp::ZERO + Duration::from_secs_f32(seconds)
    }

    fn candidate(x: f32, y: f32) -> Vec<BallCandidate> {
        vec![BallCandidate {
            position: Some(Point2::new(x, y)),
            ..BallCandidate::default()
        }]
    }

    fn node() -> BallMemory {
        BallMemory::new(CreationContext {}).unwrap()
    }

    /// A cycle at `now`; until then the robot looked along x, now it looks along `yaw`.
    fn cycle(
        node: &mut BallMemory,
        now: f32,
        yaw: f32,
        persistent: Seen<'_>,
        transient: Seen<'_>,
    ) -> Option<Ball> {
        let ahead = UnitQuaternion::identity();
        let before = [(Timestamp::ZERO, &ahead)];
        let mut slot = AdditionalSlot::default();
        let orientation = UnitQuaternion::from_euler_angles(0.0, 0.0, yaw);
        let context = CycleContext {
            balls: perception(&persistent, &transient),
            orientation: history(&before, at(now), &orientation),
            cycle_time: CycleTime {
                start: at(now),
                since_last: Duration::from_millis(12),
            },
            gain: &0.5,
            same_place: &0.5,
            forget_after: &3.0,
            persistent_ball: AdditionalOutput::new(false, 1, &mut slot),
        };
        node.cycle(context).unwrap().ball.value
    }

    #[test]
    fn a_ball_is_remembered_until_it_is_too_old() {
        let mut node = node();
        let seen = candidate(1.0, 0.2);
        cycle(&mut node, 1.0, 0.0, vec![(at(1.0), &seen)], vec![]);
        let remembered = cycle(&mut node, 3.9, 0.0, vec![], vec![]).unwrap();
        assert_eq!(
            (remembered.position, remembered.seen_at),
            (Point2::new(1.0, 0.2), at(1.0))
        );
        assert_eq!(cycle(&mut node, 4.1, 0.0, vec![], vec![]), None);
    }

    #[test]
    fn transient_sightings_answer_but_are_not_learnt() {
        let mut node = node();
        let seen = candidate(2.0, 0.0);
        let ball = cycle(&mut node, 1.0, 0.0, vec![], vec![(at(0.9), &seen)]).unwrap();
        assert_eq!(ball.position, Point2::new(2.0, 0.0));
        assert_eq!(cycle(&mut node, 1.1, 0.0, vec![], vec![]), None);
    }

    #[test]
    fn a_ball_seen_before_a_turn_lies_beside_the_robot_after_it() {
        let mut node = node();
        let seen = candidate(1.0, 0.0);
        let ball = cycle(&mut node, 1.0, FRAC_PI_2, vec![(at(0.5), &seen)], vec![]).unwrap();
        assert!(
            (ball.position - Point2::new(0.0, -1.0)).norm() < 1e-6,
            "{}",
            ball.position
        );
    }

    #[test]
    fn near_sightings_are_averaged_and_far_ones_replace() {
        let mut node = node();
        let (first, near, far) = (
            candidate(1.0, 0.0),
            candidate(1.2, 0.0),
            candidate(3.0, 1.0),
        );
        let seen: Seen<'_> = vec![(at(0.1), &first), (at(0.2), &near)];
        let ball = cycle(&mut node, 0.3, 0.0, seen, vec![]).unwrap();
        assert!((ball.position.x - 1.1).abs() < 1e-6);
        let ball = cycle(&mut node, 0.4, 0.0, vec![(at(0.35), &far)], vec![]).unwrap();
        assert_eq!(ball.position, Point2::new(3.0, 1.0));
    }

    #[test]
    fn of_several_candidates_the_one_at_the_known_place_counts() {
        let mut node = node();
        let first = candidate(2.0, 0.0);
        let both = [candidate(0.5, 1.0), candidate(2.0, 0.0)].concat();
        cycle(&mut node, 0.1, 0.0, vec![(at(0.1), &first)], vec![]);
        let ball = cycle(&mut node, 0.2, 0.0, vec![(at(0.2), &both)], vec![]).unwrap();
        assert_eq!(ball.position, Point2::new(2.0, 0.0));
    }

    #[test]
    fn candidates_without_a_place_on_the_ground_teach_nothing() {
        let mut node = node();
        let (seen, nothing) = (vec![BallCandidate::default()], vec![]);
        let images: Seen<'_> = vec![(at(0.1), &seen), (at(0.2), &nothing)];
        assert_eq!(cycle(&mut node, 0.3, 0.0, images, vec![]), None);
    }
}
