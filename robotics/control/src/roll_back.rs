//! Owns `RollBack`, the state of a filter that looks further ahead than it may learn.
//!
//! Persistent values of perception change the state, each once and in order. Transient ones come
//! again, perhaps with others between them: they change only a copy, which every cycle makes anew.

use framework::{Timeline, Timestamp};
use serde::{Deserialize, Serialize};

/// A state and what it would be after the transient values.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(crate) struct RollBack<S> {
    settled: S,
}

impl<S: Clone> RollBack<S> {
    /// What only persistent values, and what else is final, have changed.
    pub(crate) fn settled(&self) -> &S {
        &self.settled
    }

    /// For what is final without being a perception, such as a value of the own cycler.
    pub(crate) fn settled_mut(&mut self) -> &mut S {
        &mut self.settled
    }

    /// Learns the persistent values for good.
    pub(crate) fn settle<V>(
        &mut self,
        persistent: Timeline<'_, V>,
        mut learn: impl FnMut(&mut S, Timestamp, V),
    ) {
        for (timestamp, value) in persistent {
            learn(&mut self.settled, timestamp, value);
        }
    }

    /// The settled state after the transient values, too.
    pub(crate) fn with_transient<V>(
        &self,
        transient: Timeline<'_, V>,
        mut learn: impl FnMut(&mut S, Timestamp, V),
    ) -> S {
        let mut newest = self.settled.clone();
        for (timestamp, value) in transient {
            learn(&mut newest, timestamp, value);
        }
        newest
    }
}

#[cfg(test)]
mod tests {
    use framework::testing::{at_millis, perception};

    use super::*;

    #[test]
    fn only_persistent_values_stay() {
        let mut state = RollBack::<Vec<u32>>::default();
        let learn = |state: &mut Vec<u32>, _: Timestamp, value: &u32| state.push(*value);
        let (settled, ahead) = ([(at_millis(1), &1)], [(at_millis(3), &3)]);
        let input = perception(&settled, &ahead);
        state.settle(input.persistent, learn);
        assert_eq!(state.with_transient(input.transient, learn), [1, 3]);

        // What was transient has become persistent, behind something that was late.
        let (settled, ahead) = ([(at_millis(2), &2), (at_millis(3), &3)], []);
        let input = perception(&settled, &ahead);
        state.settle(input.persistent, learn);
        assert_eq!(state.with_transient(input.transient, learn), [1, 2, 3]);
        assert_eq!(state.settled(), &[1, 2, 3]);
    }
}
