//! Owns `Places`, the few places where a filter believes something to be.
//!
//! Invariant: what speaks for a new place alone never drives out one for which more speaks, while
//! there is one for which less does.

use framework::Timestamp;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

/// Where something may be.
pub(crate) trait Hypothesis: Copy {
    /// In the start frame, in m.
    fn position(&self) -> Point2<f32>;

    /// How much speaks for it; more than 0.
    fn evidence(&self) -> f32;
}

/// At most `N` hypotheses as they are at one time, without any heap.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(bound(
    serialize = "[Option<H>; N]: Serialize",
    deserialize = "[Option<H>; N]: Deserialize<'de>"
))]
pub(crate) struct Places<H, const N: usize> {
    time: Timestamp,
    places: [Option<H>; N],
}

impl<H: Copy, const N: usize> Default for Places<H, N> {
    fn default() -> Self {
        Self {
            time: Timestamp::ZERO,
            places: [None; N],
        }
    }
}

impl<H: Hypothesis, const N: usize> Places<H, N> {
    pub(crate) fn iter(&self) -> impl Iterator<Item = &H> {
        self.places.iter().flatten()
    }

    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut H> {
        self.places.iter_mut().flatten()
    }

    /// Goes on to `time` and keeps what `is_kept` after so many seconds, which it may change; a time
    /// in the past is 0 s away. It also hears what time it is then.
    pub(crate) fn advance(
        &mut self,
        time: Timestamp,
        is_kept: impl Fn(&mut H, f32, Timestamp) -> bool,
    ) {
        let elapsed = (time - self.time).as_secs_f32();
        self.time = self.time.max(time);
        for place in &mut self.places {
            place.take_if(|hypothesis| !is_kept(hypothesis, elapsed, self.time));
        }
    }

    /// Of hypotheses that have come so near to each other, in m, only the surest one stays.
    pub(crate) fn merge(&mut self, same_place: f32) {
        self.places
            .sort_by(|a, b| evidence(b).total_cmp(&evidence(a)));
        for index in 1..N {
            let (surer, rest) = self.places.split_at_mut(index);
            rest[0].take_if(|hypothesis| {
                let mut others = surer.iter().flatten();
                others.any(|other| (other.position() - hypothesis.position()).norm() <= same_place)
            });
        }
    }

    /// Takes a free place, or that of the hypothesis for which least speaks.
    pub(crate) fn insert(&mut self, hypothesis: H) {
        let least = self
            .places
            .iter_mut()
            .min_by(|a, b| evidence(a).total_cmp(&evidence(b)));
        if let Some(place) = least {
            *place = Some(hypothesis);
        }
    }
}

/// A free place has none.
fn evidence<H: Hypothesis>(place: &Option<H>) -> f32 {
    place.as_ref().map_or(0.0, Hypothesis::evidence)
}
