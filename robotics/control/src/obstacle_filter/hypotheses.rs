//! The places where something may stand, each a Kalman filter for a position that hardly changes.

use framework::Timestamp;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use types::obstacles::ObstacleKind;

use super::ObstacleFilterParameters;

/// More are not kept: the one that was perceived longest ago makes room.
pub(super) const MOST_HYPOTHESES: usize = 16;

/// Something that stands in the start frame.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(super) struct Hypothesis {
    /// In m.
    pub(super) position: Point2<f32>,
    /// Of each coordinate, in m².
    variance: f32,
    /// How many measurements speak for it.
    pub(super) evidence: f32,
    pub(super) kind: ObstacleKind,
    pub(super) seen_at: Timestamp,
}

/// Where something stands, in the start frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measurement {
    /// In m.
    pub(super) position: Point2<f32>,
    /// One standard deviation, in m.
    pub(super) noise: f32,
    /// As how many measurements it counts.
    pub(super) evidence: f32,
    pub(super) kind: ObstacleKind,
}

/// Hypotheses as they are at one time.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub(super) struct Hypotheses {
    time: Timestamp,
    places: [Option<Hypothesis>; MOST_HYPOTHESES],
}

impl Hypotheses {
    pub(super) fn iter(&self) -> impl Iterator<Item = &Hypothesis> {
        self.places.iter().flatten()
    }

    /// What becomes of them until `time`; nothing where that is in the past.
    pub(super) fn predict(&mut self, time: Timestamp, parameters: &ObstacleFilterParameters) {
        let elapsed = (time - self.time).as_secs_f32();
        self.time = self.time.max(time);
        for place in &mut self.places {
            place.take_if(|hypothesis| {
                hypothesis.variance += parameters.position_noise.powi(2) * elapsed;
                let silence = (self.time - hypothesis.seen_at).as_secs_f32();
                !(hypothesis.is_finite() && silence <= parameters.forget_after)
            });
        }
    }

    /// Gives what was measured at `seen_at` to the nearest hypothesis, or begins a new one.
    pub(super) fn learn(
        &mut self,
        measurement: &Measurement,
        seen_at: Timestamp,
        parameters: &ObstacleFilterParameters,
    ) {
        let distance =
            |hypothesis: &Hypothesis| (hypothesis.position - measurement.position).norm();
        let known = self.places.iter_mut().flatten();
        let nearest = known
            .map(|hypothesis| (distance(hypothesis), hypothesis))
            .filter(|(distance, _)| *distance <= parameters.same_place)
            .min_by(|(a, _), (b, _)| a.total_cmp(b));
        match nearest {
            Some((_, hypothesis)) => hypothesis.learn(measurement, seen_at, parameters),
            None => self.insert(Hypothesis {
                position: measurement.position,
                variance: measurement.noise.powi(2),
                evidence: measurement.evidence,
                kind: measurement.kind,
                seen_at,
            }),
        }
    }

    /// Of hypotheses that have come to the same place only the one with most evidence stays.
    pub(super) fn merge(&mut self, parameters: &ObstacleFilterParameters) {
        let evidence =
            |place: &Option<Hypothesis>| place.map_or(0.0, |hypothesis| hypothesis.evidence);
        self.places
            .sort_by(|a, b| evidence(b).total_cmp(&evidence(a)));
        for index in 1..MOST_HYPOTHESES {
            let (surer, rest) = self.places.split_at_mut(index);
            rest[0].take_if(|hypothesis| {
                let mut others = surer.iter().flatten();
                others.any(|other| {
                    (other.position - hypothesis.position).norm() <= parameters.same_place
                })
            });
        }
    }

    fn insert(&mut self, hypothesis: Hypothesis) {
        let seen_at = |place: &&mut Option<Hypothesis>| place.map(|place| place.seen_at);
        if let Some(place) = self.places.iter_mut().min_by_key(seen_at) {
            *place = Some(hypothesis);
        }
    }
}

impl Hypothesis {
    fn is_finite(&self) -> bool {
        let numbers = [
            self.position.x,
            self.position.y,
            self.variance,
            self.evidence,
        ];
        numbers.into_iter().all(f32::is_finite)
    }

    /// Moves towards the measurement; once a robot, always a robot.
    fn learn(
        &mut self,
        measurement: &Measurement,
        seen_at: Timestamp,
        parameters: &ObstacleFilterParameters,
    ) {
        let expected = (self.variance + measurement.noise.powi(2)).max(f32::MIN_POSITIVE);
        let gain = self.variance / expected;
        self.position += (measurement.position - self.position) * gain;
        self.variance *= 1.0 - gain;
        self.evidence = (self.evidence + measurement.evidence).min(parameters.most_evidence);
        self.seen_at = self.seen_at.max(seen_at);
        if measurement.kind == ObstacleKind::Robot {
            self.kind = ObstacleKind::Robot;
        }
    }
}
