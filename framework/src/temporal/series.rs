//! The node's view: values of other instances in order of time.

use std::fmt;
use std::iter::FusedIterator;

use crate::time::Timestamp;

/// One value of another instance, where it stands in the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item<V> {
    /// When the data was taken.
    pub timestamp: Timestamp,
    /// Its place in the order; later than `timestamp` if it became known late.
    pub order: Timestamp,
    /// Number of the cycle that wrote it.
    pub cycle: u64,
    /// What it wrote.
    pub value: V,
}

/// Values by index in their order, persistent ones first; erases which database they come from.
pub trait Series<V> {
    /// How many there are.
    fn len(&self) -> usize;

    /// How many of them are persistent.
    fn persistent(&self) -> usize;

    /// One of them; `index` is less than [`len`](Self::len).
    fn item(&self, index: usize) -> Item<V>;

    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What other instances perceived, split once per cycle.
///
/// A filter applies `persistent` to its state, once and in order, and then predicts what
/// `transient` says on a copy of that state: transient values come again until they are
/// persistent, perhaps with others between them.
///
/// ```
/// # use framework::{PerceptionInput, Timestamp};
/// fn sum(values: PerceptionInput<'_, &u32>, state: &mut u32) -> u32 {
///     for (_timestamp, value) in values.persistent {
///         *state += value;
///     }
///     *state + values.transient.iter().map(|(_, value)| value).sum::<u32>()
/// }
/// # let t = Timestamp::from_nanos;
/// # let (before, now) = ([(t(1), &1), (t(2), &2)], [(t(3), &4)]);
/// # let values = framework::testing::perception(&before, &now);
/// # let mut state = 0;
/// # assert_eq!(sum(values, &mut state), 7);
/// # assert_eq!(state, 3);
/// ```
pub struct PerceptionInput<'c, V> {
    /// Final: delivered once, in order, nothing will come before them any more.
    pub persistent: Timeline<'c, V>,
    /// After the persistent ones; delivered again until they are persistent.
    pub transient: Timeline<'c, V>,
}

impl<'c, V> PerceptionInput<'c, V> {
    /// The two parts of a series.
    #[inline]
    pub fn new(series: &'c dyn Series<V>) -> Self {
        let (persistent, len) = (series.persistent(), series.len());
        Self {
            persistent: Timeline {
                series,
                from: 0,
                to: persistent,
            },
            transient: Timeline {
                series,
                from: persistent,
                to: len,
            },
        }
    }
}

impl<V> Clone for PerceptionInput<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for PerceptionInput<'_, V> {}

impl<V: fmt::Debug> fmt::Debug for PerceptionInput<'_, V> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("PerceptionInput")
            .field("persistent", &self.persistent)
            .field("transient", &self.transient)
            .finish()
    }
}

/// Values in order of time: `for (timestamp, value) in timeline`.
pub struct Timeline<'c, V> {
    series: &'c dyn Series<V>,
    from: usize,
    to: usize,
}

impl<'c, V> Timeline<'c, V> {
    /// All of a series, persistent or not.
    pub fn all(series: &'c dyn Series<V>) -> Self {
        Self {
            series,
            from: 0,
            to: series.len(),
        }
    }

    /// How many values there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.to - self.from
    }

    /// Whether there is none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.from == self.to
    }

    /// The last in order with its timestamp.
    #[inline]
    pub fn last(&self) -> Option<(Timestamp, V)> {
        self.iter().next_back()
    }

    /// Values with their timestamps, in order.
    #[inline]
    pub fn iter(&self) -> Iter<'c, V> {
        Iter {
            items: self.items(),
        }
    }

    /// With those of another output of the same cycles.
    ///
    /// Inputs of one node that name the same producer, an instance or all of a cycler, have an item each for the same
    /// cycles, also where several have the same timestamp. Of other inputs this makes pairs that do not belong together,
    /// which a build with debug assertions refuses.
    ///
    /// ```
    /// # use framework::{Timestamp, testing::perception};
    /// # let at = Timestamp::from_nanos;
    /// # let (names, sizes) = ([(at(1), &'b'), (at(1), &'c')], [(at(1), &10), (at(1), &11)]);
    /// # let (names, sizes) = (perception(&names, &[]), perception(&sizes, &[]));
    /// let pairs: Vec<_> = names.persistent.zip(sizes.persistent).collect();
    /// assert_eq!(pairs, [(at(1), (&'b', &10)), (at(1), (&'c', &11))]);
    /// ```
    #[inline]
    pub fn zip<W>(self, other: Timeline<'c, W>) -> impl Iterator<Item = (Timestamp, (V, W))> {
        debug_assert_eq!(self.len(), other.len(), "inputs of one producer");
        self.items().zip(other.items()).map(|(item, other)| {
            let of = (item.timestamp, item.cycle);
            debug_assert_eq!(of, (other.timestamp, other.cycle), "inputs of one producer");
            (item.timestamp, (item.value, other.value))
        })
    }

    /// Values with timestamp, order and cycle number, in order.
    #[inline]
    pub fn items(&self) -> Items<'c, V> {
        Items { rest: *self }
    }
}

impl<V> Clone for Timeline<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for Timeline<'_, V> {}

impl<V: fmt::Debug> fmt::Debug for Timeline<'_, V> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.items()).finish()
    }
}

impl<'c, V> IntoIterator for Timeline<'c, V> {
    type Item = (Timestamp, V);
    type IntoIter = Iter<'c, V>;

    #[inline]
    fn into_iter(self) -> Iter<'c, V> {
        self.iter()
    }
}

impl<'c, V> IntoIterator for &Timeline<'c, V> {
    type Item = (Timestamp, V);
    type IntoIter = Iter<'c, V>;

    #[inline]
    fn into_iter(self) -> Iter<'c, V> {
        self.iter()
    }
}

/// Values of a [`Timeline`] with their timestamps.
#[derive(Clone)]
pub struct Iter<'c, V> {
    items: Items<'c, V>,
}

impl<V> Iterator for Iter<'_, V> {
    type Item = (Timestamp, V);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.items.next().map(|item| (item.timestamp, item.value))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.items.size_hint()
    }
}

impl<V> DoubleEndedIterator for Iter<'_, V> {
    #[inline]
    fn next_back(&mut self) -> Option<Self::Item> {
        self.items
            .next_back()
            .map(|item| (item.timestamp, item.value))
    }
}

impl<V> ExactSizeIterator for Iter<'_, V> {}

impl<V> FusedIterator for Iter<'_, V> {}

/// Items of a [`Timeline`].
pub struct Items<'c, V> {
    rest: Timeline<'c, V>,
}

impl<V> Clone for Items<'_, V> {
    fn clone(&self) -> Self {
        Self { rest: self.rest }
    }
}

impl<V> Iterator for Items<'_, V> {
    type Item = Item<V>;

    #[inline]
    fn next(&mut self) -> Option<Item<V>> {
        if self.rest.is_empty() {
            return None;
        }
        self.rest.from += 1;
        Some(self.rest.series.item(self.rest.from - 1))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.rest.len(), Some(self.rest.len()))
    }
}

impl<V> DoubleEndedIterator for Items<'_, V> {
    #[inline]
    fn next_back(&mut self) -> Option<Item<V>> {
        if self.rest.is_empty() {
            return None;
        }
        self.rest.to -= 1;
        Some(self.rest.series.item(self.rest.to))
    }
}

impl<V> ExactSizeIterator for Items<'_, V> {}

impl<V> FusedIterator for Items<'_, V> {}
