//! Several instances in one order.

use super::horizon::Lane;
use super::series::{Item, Items, Series, Timeline};
use crate::time::Timestamp;

/// The visible cycles of the instances of one cycler, sorted by order, timestamp, instance and cycle number.
#[derive(Debug, Default)]
pub struct Interleaving {
    positions: Vec<Position>,
    persistent: usize,
}

#[derive(Clone, Copy, Debug)]
struct Position {
    lane: usize,
    index: usize,
}

impl Interleaving {
    /// Of no cycles yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sorts what the lanes show since [`Horizon::consume`](super::Horizon::consume); lanes are in
    /// manifest order of the instances. Allocates only the first time.
    pub fn merge<const N: usize>(&mut self, lanes: [&dyn Lane; N]) {
        self.positions.clear();
        self.persistent = 0;
        if lanes.iter().all(|lane| lane.visible() == 0) {
            return;
        }
        self.positions
            .reserve(lanes.iter().map(|lane| lane.window()).sum());
        self.persistent = lanes.iter().map(|lane| lane.persistent()).sum();
        let mut next = [0; N];
        loop {
            // Several that came late together have the order of the horizon: the earlier capture goes first. Of equals
            // the first lane; within a lane cycles are in order already.
            let first = (0..N)
                .filter(|lane| next[*lane] < lanes[*lane].visible())
                .min_by_key(|lane| lanes[*lane].rank(next[*lane]));
            let Some(lane) = first else { return };
            self.positions.push(Position {
                lane,
                index: next[lane],
            });
            next[lane] += 1;
        }
    }
}

/// One output of several instances in one order.
pub struct Interleaved<'c, V, const N: usize> {
    /// The order, merged over the same instances.
    pub order: &'c Interleaving,
    /// The output of each instance.
    pub instances: [&'c dyn Series<V>; N],
}

impl<V, const N: usize> Series<V> for Interleaved<'_, V, N> {
    #[inline]
    fn len(&self) -> usize {
        self.order.positions.len()
    }

    #[inline]
    fn persistent(&self) -> usize {
        self.order.persistent
    }

    #[inline]
    fn item(&self, index: usize) -> Item<V> {
        let Position { lane, index } = self.order.positions[index];
        self.instances[lane].item(index)
    }
}

/// Several timelines in one order:
/// `for (timestamp, balls) in interleave([top.persistent, bottom.persistent])`.
///
/// Of equal orders the earlier timestamp comes first, of equal timestamps the earlier timeline of the array.
pub fn interleave<'c, V, const N: usize>(
    timelines: [Timeline<'c, V>; N],
) -> impl Iterator<Item = (Timestamp, V)> + use<'c, V, N> {
    let mut rest = timelines.map(|timeline| timeline.items());
    let mut heads = rest.each_mut().map(Items::next);
    std::iter::from_fn(move || {
        let first = (0..N)
            .filter_map(|timeline| {
                let head = heads[timeline].as_ref()?;
                Some((head.order, head.timestamp, timeline))
            })
            .min();
        let (_, _, timeline) = first?;
        let item = std::mem::replace(&mut heads[timeline], rest[timeline].next())?;
        Some((item.timestamp, item.value))
    })
}
