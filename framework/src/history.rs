//! The recent values of one output of the own cycler, by time.

use std::fmt;
use std::time::Duration;

use crate::time::Timestamp;

/// The last values of an output: those of the last `reach`, and the one before.
///
/// A ring that grows until it has room for them; from then on a push copies into the room of a
/// value that is out of reach (`clone_from`) and allocates nothing itself.
#[derive(Clone, Debug)]
pub struct History<T> {
    reach: Duration,
    entries: Vec<(Timestamp, T)>,
    /// Index of the oldest entry in reach.
    oldest: usize,
    /// How many are in reach.
    len: usize,
    /// In a replay: how many the frame gave that was loaded last.
    loaded: Option<usize>,
}

impl<T: Clone> History<T> {
    /// Empty; `reach` is how far back before the newest value [`HistoricInput::get`] finds one.
    pub fn new(reach: Duration) -> Self {
        Self {
            reach,
            entries: Vec::new(),
            oldest: 0,
            len: 0,
            loaded: None,
        }
    }

    /// Adds a value; timestamps increase.
    #[inline]
    pub fn push(&mut self, timestamp: Timestamp, value: &T) {
        // What a replay adds to a loaded history is taken back, and nothing else may be missing then.
        while self.loaded.is_none()
            && self.len > 0
            && self.next_oldest().unwrap_or(timestamp) + self.reach <= timestamp
        {
            self.oldest = self.position(1);
            self.len -= 1;
        }
        if self.len == self.entries.len() {
            self.grow(timestamp, value);
        } else {
            let position = self.position(self.len);
            let entry = &mut self.entries[position];
            entry.0 = timestamp;
            entry.1.clone_from(value);
        }
        self.len += 1;
    }

    #[cold]
    fn grow(&mut self, timestamp: Timestamp, value: &T) {
        self.entries.rotate_left(self.oldest);
        self.oldest = 0;
        self.entries.push((timestamp, value.clone()));
    }
}

impl<T> History<T> {
    /// How many values it keeps.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether nothing was pushed.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Forgets the values and keeps the room.
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Makes it what the last frame gave, without what the replay added to it.
    pub(crate) fn begin_load(&mut self) {
        self.len = self.loaded.take().unwrap_or(self.len);
    }

    /// From here on the replay adds to it.
    pub(crate) fn end_load(&mut self) {
        self.loaded = Some(self.len);
    }

    /// What lies at a path in every value: `history.project(|pose| &pose.position)`.
    #[inline]
    pub fn project<'c, V, F: Fn(&'c T) -> V>(&'c self, path: F) -> Stored<'c, T, F> {
        Stored {
            history: self,
            path,
        }
    }

    /// The oldest is needed as long as the timestamp after it is in reach.
    #[inline]
    fn next_oldest(&self) -> Option<Timestamp> {
        (self.len > 1).then(|| self.entry(1).0)
    }

    /// By age, 0 is the oldest.
    #[inline]
    fn entry(&self, index: usize) -> &(Timestamp, T) {
        &self.entries[self.position(index)]
    }

    #[inline]
    fn position(&self, index: usize) -> usize {
        let position = self.oldest + index;
        if position < self.entries.len() {
            position
        } else {
            position - self.entries.len()
        }
    }
}

/// Values by age, oldest first; erases which output they come from.
pub trait Past<V> {
    /// How many there are.
    fn len(&self) -> usize;

    /// One of them; `index` is less than [`len`](Self::len).
    fn value(&self, index: usize) -> (Timestamp, V);

    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What lies at a path in every value of a history.
pub struct Stored<'c, T, F> {
    /// The values.
    pub history: &'c History<T>,
    /// From a value to what a node sees of it.
    pub path: F,
}

impl<'c, T, V, F: Fn(&'c T) -> V> Past<V> for Stored<'c, T, F> {
    #[inline]
    fn len(&self) -> usize {
        self.history.len
    }

    #[inline]
    fn value(&self, index: usize) -> (Timestamp, V) {
        let (timestamp, value) = self.history.entry(index);
        (*timestamp, (self.path)(value))
    }
}

/// An output of the own cycler by time, with this cycle's value as the newest.
#[derive(Clone, Copy)]
pub struct HistoricInput<'c, V> {
    past: &'c dyn Past<V>,
    now: Timestamp,
    value: V,
}

impl<'c, V: Copy> HistoricInput<'c, V> {
    /// `past` are the finished cycles, `now` and `value` belong to the running one.
    #[inline]
    pub fn new(past: &'c dyn Past<V>, now: Timestamp, value: V) -> Self {
        Self { past, now, value }
    }

    /// The value at this time, or else the last one before; `None` if that is out of reach.
    #[inline]
    pub fn get(&self, timestamp: Timestamp) -> Option<V> {
        if timestamp >= self.now {
            return Some(self.value);
        }
        // Mostly not long ago: from the newest back in steps that double, so that what is older is not even looked at.
        let (mut high, mut step) = (self.past.len(), 1);
        let (mut low, mut found) = loop {
            let index = high.checked_sub(1)?.saturating_sub(step - 1);
            let (time, value) = self.past.value(index);
            if time <= timestamp {
                break (index + 1, value);
            }
            (high, step) = (index, step * 2);
        };
        while low < high {
            let middle = low.midpoint(high);
            let (time, value) = self.past.value(middle);
            if time <= timestamp {
                (low, found) = (middle + 1, value);
            } else {
                high = middle;
            }
        }
        Some(found)
    }

    /// All values with the timestamps of their cycles, oldest first, this cycle's last.
    #[inline]
    pub fn iter(
        &self,
    ) -> impl DoubleEndedIterator<Item = (Timestamp, V)> + ExactSizeIterator + use<'c, V> {
        let Self { past, now, value } = *self;
        let len = past.len();
        (0..len + 1).map(move |index| {
            if index < len {
                past.value(index)
            } else {
                (now, value)
            }
        })
    }

    /// How many values there are: at least this cycle's.
    #[expect(clippy::len_without_is_empty, reason = "never empty")]
    pub fn len(&self) -> usize {
        self.past.len() + 1
    }
}

impl<V: Copy + fmt::Debug> fmt::Debug for HistoricInput<'_, V> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.iter()).finish()
    }
}
