//! The few places where the ball may lie, and which of them a sighting belongs to.

use framework::Timestamp;
use serde::{Deserialize, Serialize};

use super::BallFilterParameters;
use super::hypothesis::{Hypothesis, Sighting};

/// More are not kept: the least valid one makes room.
pub(super) const MOST_HYPOTHESES: usize = 8;

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

    /// The one that most speaks for, if enough does.
    pub(super) fn best(&self, parameters: &BallFilterParameters) -> Option<&Hypothesis> {
        let known = self.iter();
        known
            .filter(|hypothesis| hypothesis.validity >= parameters.least_validity)
            .max_by(|a, b| a.validity.total_cmp(&b.validity))
    }

    /// What becomes of them until `time`; nothing where that is in the past.
    pub(super) fn predict(&mut self, time: Timestamp, parameters: &BallFilterParameters) {
        let elapsed = (time - self.time).as_secs_f32();
        self.time = self.time.max(time);
        for place in &mut self.places {
            place.take_if(|hypothesis| {
                hypothesis.predict(elapsed, parameters);
                let silence = (self.time - hypothesis.seen_at).as_secs_f32();
                let is_kept = hypothesis.is_finite()
                    && hypothesis.validity >= parameters.discarded_validity
                    && silence <= parameters.forget_after;
                !is_kept
            });
        }
    }

    /// Gives the sighting to the hypothesis that expected it most, or begins a new one.
    pub(super) fn learn(&mut self, sighting: &Sighting, parameters: &BallFilterParameters) {
        let expecting = self
            .places
            .iter_mut()
            .flatten()
            .filter_map(|hypothesis| {
                let distance = (sighting.position - hypothesis.position()).norm();
                let deviation = hypothesis.deviation(sighting)?;
                let fits = deviation <= parameters.gate || distance <= parameters.same_place;
                fits.then_some((deviation, hypothesis))
            })
            .min_by(|(a, _), (b, _)| a.total_cmp(b));
        match expecting {
            Some((_, hypothesis)) => hypothesis.learn(sighting, parameters),
            None => self.insert(Hypothesis::seen_first(sighting, parameters)),
        }
    }

    /// Of hypotheses that have come to the same place only the most valid one stays.
    pub(super) fn merge(&mut self, parameters: &BallFilterParameters) {
        self.places
            .sort_by(|a, b| validity(b).total_cmp(&validity(a)));
        for index in 1..MOST_HYPOTHESES {
            let (more_valid, rest) = self.places.split_at_mut(index);
            let is_elsewhere = |hypothesis: &mut Hypothesis| {
                let mut others = more_valid.iter().flatten();
                others.all(|other| {
                    (other.position() - hypothesis.position()).norm() > parameters.same_place
                })
            };
            rest[0].take_if(|hypothesis| !is_elsewhere(hypothesis));
        }
    }

    fn insert(&mut self, hypothesis: Hypothesis) {
        let least = self
            .places
            .iter_mut()
            .min_by(|a, b| validity(a).total_cmp(&validity(b)));
        if let Some(place) = least {
            *place = Some(hypothesis);
        }
    }
}

/// A free place has none.
fn validity(place: &Option<Hypothesis>) -> f32 {
    place.map_or(0.0, |hypothesis| hypothesis.validity)
}
