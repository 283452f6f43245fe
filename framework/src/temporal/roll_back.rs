//! A filter that looks further ahead than it may learn.
//!
//! What is persistent changes the state, each item once and in order. What is transient comes again in the next cycle,
//! perhaps with others between: it changes only a copy, which every cycle makes anew.

use serde::{Deserialize, Serialize};

#[cfg(doc)]
use crate::temporal::Timeline;
use crate::time::Timestamp;

/// A state, and what it would be after the transient values.
///
/// ```
/// use framework::testing::{at_millis, perception};
/// use framework::{RollBack, Timestamp};
///
/// let mut mean = RollBack::<(f32, f32)>::default();
/// let learn = |(sum, count): &mut (f32, f32), _: Timestamp, value: &f32| {
///     *sum += value;
///     *count += 1.0;
/// };
/// let (settled, ahead) = ([(at_millis(1), &2.0)], [(at_millis(3), &4.0)]);
/// let input = perception(&settled, &ahead);
/// mean.settle(input.persistent, learn);
/// assert_eq!(mean.with_transient(input.transient, learn), (6.0, 2.0));
/// assert_eq!(mean.settled(), &(2.0, 1.0));
/// ```
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct RollBack<S> {
    settled: S,
}

impl<S: Clone> RollBack<S> {
    /// Starts from this state.
    pub fn new(settled: S) -> Self {
        Self { settled }
    }

    /// What only persistent values, and what else is final, have changed.
    pub fn settled(&self) -> &S {
        &self.settled
    }

    /// For what is final without being a perception, such as a value of the own cycler.
    pub fn settled_mut(&mut self) -> &mut S {
        &mut self.settled
    }

    /// Learns the persistent values for good; those of several outputs by [`Timeline::zip`].
    pub fn settle<V>(
        &mut self,
        persistent: impl IntoIterator<Item = (Timestamp, V)>,
        mut learn: impl FnMut(&mut S, Timestamp, V),
    ) {
        for (timestamp, value) in persistent {
            learn(&mut self.settled, timestamp, value);
        }
    }

    /// The settled state after the transient values, too. Costs one clone of the state and what `learn` costs for each.
    pub fn with_transient<V>(
        &self,
        transient: impl IntoIterator<Item = (Timestamp, V)>,
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
    use proptest::prelude::*;

    use super::*;
    use crate::testing::{at_millis, perception};

    fn learn(state: &mut Vec<u32>, _: Timestamp, value: &u32) {
        state.push(*value);
    }

    #[test]
    fn what_was_transient_becomes_persistent_behind_what_was_late() {
        let mut state = RollBack::<Vec<u32>>::default();
        let (settled, ahead) = ([(at_millis(1), &1)], [(at_millis(3), &3)]);
        let input = perception(&settled, &ahead);
        state.settle(input.persistent, learn);
        assert_eq!(state.with_transient(input.transient, learn), [1, 3]);

        let (settled, ahead) = ([(at_millis(2), &2), (at_millis(3), &3)], []);
        let input = perception(&settled, &ahead);
        state.settle(input.persistent, learn);
        assert_eq!(state.with_transient(input.transient, learn), [1, 2, 3]);
        assert_eq!(state.settled(), &[1, 2, 3]);
    }

    proptest! {
        #[test]
        fn the_state_does_not_depend_on_when_values_settled(
            // Values that become persistent in each cycle, and how many are seen ahead of it.
            cycles in prop::collection::vec((0_usize..4, 0_usize..4), 1..20),
        ) {
            let all: Vec<u32> = (0..200).collect();
            let timed: Vec<_> = all.iter().map(|value| (at_millis(u64::from(*value)), value)).collect();
            let mut state = RollBack::new(Vec::new());
            let mut done = 0;
            for (persistent, transient) in cycles {
                let (settled, ahead) = (done + persistent, done + persistent + transient);
                let values = (timed[done..settled].to_vec(), timed[settled..ahead].to_vec());
                let input = perception(&values.0, &values.1);
                state.settle(input.persistent, learn);
                prop_assert_eq!(state.settled(), &all[..settled]);
                prop_assert_eq!(state.with_transient(input.transient, learn), &all[..ahead]);
                done = settled;
            }
        }
    }
}
