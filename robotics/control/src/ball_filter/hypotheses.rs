//! The few places where the ball may lie, and which of them a sighting belongs to.

use framework::Timestamp;
use nalgebra::Point2;

use super::BallFilterParameters;
use super::hypothesis::{Hypothesis, Sighting};
use super::sight::Sight;
use crate::places::{Hypothesis as _, Places};

/// More are not kept: the least valid one makes room.
pub(super) const MOST_HYPOTHESES: usize = 8;

/// Hypotheses as they are at one time.
pub(super) type Hypotheses = Places<Hypothesis, MOST_HYPOTHESES>;

impl Hypotheses {
    /// The one that most speaks for, if enough does.
    pub(super) fn best(&self, parameters: &BallFilterParameters) -> Option<&Hypothesis> {
        let known = self.iter();
        known
            .filter(|hypothesis| hypothesis.validity >= parameters.least_validity)
            .max_by(|a, b| a.validity.total_cmp(&b.validity))
    }

    /// What becomes of them until `time`; nothing where that is in the past.
    pub(super) fn predict(&mut self, time: Timestamp, parameters: &BallFilterParameters) {
        self.advance(time, |hypothesis, elapsed, now| {
            hypothesis.predict(elapsed, parameters);
            let silence = (now - hypothesis.seen_at).as_secs_f32();
            hypothesis.is_finite()
                && hypothesis.validity >= parameters.discarded_validity
                && silence <= parameters.forget_after
        });
    }

    /// Looks at another image.
    pub(super) fn begin_image(&mut self) {
        for hypothesis in self.iter_mut() {
            hypothesis.is_shown = false;
        }
    }

    /// Gives the sighting to the hypothesis that expected it most, or begins a new one.
    ///
    /// One image shows a ball once: what is near to a sighting of the same image is another thing.
    pub(super) fn learn(&mut self, sighting: &Sighting, parameters: &BallFilterParameters) {
        let expecting = self
            .iter_mut()
            .filter(|hypothesis| !hypothesis.is_shown)
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

    /// Believes less in balls that the image would show and does not, after `learn` of all that it shows; an image that
    /// comes late says nothing against what was seen since.
    pub(super) fn miss<Hiding: Iterator<Item = Point2<f32>> + Clone>(
        &mut self,
        sight: &Sight<'_, Hiding>,
        parameters: &BallFilterParameters,
    ) {
        let unseen = self
            .iter_mut()
            .filter(|known| !known.is_shown && known.seen_at <= sight.taken_at);
        for hypothesis in unseen.filter(|unseen| sight.would_show(unseen, parameters)) {
            hypothesis.miss(parameters);
        }
    }
}
