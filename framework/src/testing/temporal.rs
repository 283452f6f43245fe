//! Perception, historic and latest inputs for tests of nodes, made of values that the test has.

use crate::buffer::Latest;
use crate::history::{HistoricInput, Past};
use crate::temporal::{Item, PerceptionInput, Series, Timeline};
use crate::time::Timestamp;

/// A perception input: `perception(&[(timestamp, &value)], &[])`.
///
/// Both parts are arrays or vectors in order of time. The order of a value is its timestamp, its
/// cycle number its position, counted from 1 in each part.
pub fn perception<'c, V: Copy>(
    persistent: &'c impl Values<V>,
    transient: &'c impl Values<V>,
) -> PerceptionInput<'c, V> {
    PerceptionInput {
        persistent: Timeline::all(persistent),
        transient: Timeline::all(transient),
    }
}

/// A historic input: `history(&[(before, &old)], now, &value)`, oldest value first.
pub fn history<'c, V: Copy>(
    past: &'c impl Values<V>,
    now: Timestamp,
    value: V,
) -> HistoricInput<'c, V> {
    HistoricInput::new(past, now, value)
}

/// A latest input of a cycle at `now`, from the first cycle of its instance and not seen before.
pub fn latest<V>(timestamp: Timestamp, value: V, now: Timestamp) -> Option<Latest<V>> {
    Some(Latest {
        value,
        timestamp,
        cycle: 1,
        age: now - timestamp,
        is_new: true,
    })
}

/// Arrays and vectors of `(timestamp, value)`, where `value` is what the node sees: `&T`, or
/// `Option<&T>` for an optional path.
pub trait Values<V>: Series<V> + Past<V> {}

impl<V: Copy, const N: usize> Values<V> for [(Timestamp, V); N] {}

impl<V: Copy> Values<V> for Vec<(Timestamp, V)> {}

impl<V: Copy, const N: usize> Series<V> for [(Timestamp, V); N] {
    fn len(&self) -> usize {
        N
    }

    fn persistent(&self) -> usize {
        0
    }

    fn item(&self, index: usize) -> Item<V> {
        item(self, index)
    }
}

impl<V: Copy> Series<V> for Vec<(Timestamp, V)> {
    fn len(&self) -> usize {
        self.as_slice().len()
    }

    fn persistent(&self) -> usize {
        0
    }

    fn item(&self, index: usize) -> Item<V> {
        item(self, index)
    }
}

impl<V: Copy, const N: usize> Past<V> for [(Timestamp, V); N] {
    fn len(&self) -> usize {
        N
    }

    fn value(&self, index: usize) -> (Timestamp, V) {
        self[index]
    }
}

impl<V: Copy> Past<V> for Vec<(Timestamp, V)> {
    fn len(&self) -> usize {
        self.as_slice().len()
    }

    fn value(&self, index: usize) -> (Timestamp, V) {
        self[index]
    }
}

fn item<V: Copy>(values: &[(Timestamp, V)], index: usize) -> Item<V> {
    let (timestamp, value) = values[index];
    Item {
        timestamp,
        order: timestamp,
        cycle: index as u64 + 1,
        value,
    }
}
