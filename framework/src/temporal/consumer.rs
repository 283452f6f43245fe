//! What one real-time instance has taken from one perception instance.

use std::collections::VecDeque;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::horizon::{Bounds, Lane};
use super::reference::{Reference, ReferenceKind};
use super::series::{Item, Series};
use crate::buffer::{Entry, Queue};
use crate::time::Timestamp;

/// The cycles of one instance that are taken and not let go, oldest first: some persistent, then
/// some transient, then some that wait for their time.
pub struct Consumer<T> {
    queue: Queue<T>,
    pending_timeout: Duration,
    /// Beside the cycles in the queue.
    places: VecDeque<Place>,
    persistent: usize,
    /// Persistent and transient.
    visible: usize,
    /// The announcement that the last cycle did not wait for.
    given_up: Option<Timestamp>,
    counts: QueueCounts,
}

#[derive(Clone, Copy)]
struct Place {
    order: Timestamp,
    /// Of the cycle beside it.
    timestamp: Timestamp,
    is_expired: bool,
}

/// What became of the cycles of one instance on their way to one consumer.
///
/// announced = completed + abandoned + pending; completed = delivered + dropped + not yet
/// persistent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct QueueCounts {
    /// Completed and delivered as persistent.
    pub delivered: u64,
    /// Of those: with an order later than their timestamp.
    pub late: u64,
    /// Of those: announced for longer than `pending_timeout`, so that they were not waited for.
    pub expired: u64,
    /// Announced and never completed.
    pub abandoned: u64,
    /// Completed and overwritten before they were taken.
    pub dropped: u64,
}

impl<T> Consumer<T> {
    /// `pending_timeout`: for how long an announcement of this instance is waited for.
    pub fn new(queue: Queue<T>, pending_timeout: Duration) -> Self {
        Self {
            places: VecDeque::with_capacity(queue.window()),
            queue,
            pending_timeout,
            persistent: 0,
            visible: 0,
            given_up: None,
            counts: QueueCounts::default(),
        }
    }

    /// One output of every visible cycle.
    #[inline]
    pub fn project<'c, V, F: Fn(&'c T) -> V>(&'c self, path: F) -> Projection<'c, T, F> {
        Projection {
            consumer: self,
            path,
        }
    }

    /// Counters since the start.
    pub fn report(&self) -> QueueCounts {
        QueueCounts {
            abandoned: self.queue.abandoned(),
            dropped: self.queue.dropped(),
            ..self.counts
        }
    }

    /// Which cycles of `instance` the consuming cycle sees, for a recording.
    pub fn references(&self, instance: &'static str, visit: &mut dyn FnMut(Reference)) {
        for (index, Place { order, .. }) in self.places.iter().take(self.visible).enumerate() {
            let order = *order;
            let cycle = self.queue.get(index).map_or(0, |entry| entry.cycle);
            let kind = if index < self.persistent {
                ReferenceKind::Persistent { order }
            } else {
                ReferenceKind::Transient { order }
            };
            visit(Reference {
                instance,
                cycle,
                kind,
            });
        }
    }

    /// A cycle that is seen, and its order.
    pub fn entry(&self, index: usize) -> Option<(&Entry<T>, Timestamp)> {
        let place = self.places.get(index)?;
        Some((self.queue.get(index)?, place.order))
    }

    /// Lets go of everything, also of what is complete and was not taken.
    pub fn forget(&mut self) {
        self.queue.release(self.places.len());
        self.places.clear();
        (self.persistent, self.visible) = (0, 0);
        while self.queue.take().is_some() {
            self.queue.release(1);
        }
    }

    /// Takes the next cycle with an order that was given before; `false`: there is none, or no room.
    pub fn take_at(&mut self, order: Timestamp) -> bool {
        let Some(entry) = self.queue.take() else {
            return false;
        };
        self.places.push_back(Place {
            order,
            timestamp: entry.timestamp,
            is_expired: false,
        });
        true
    }

    /// Shows everything that was taken, the oldest `persistent` as such.
    pub fn show(&mut self, persistent: usize) {
        self.visible = self.places.len();
        self.persistent = persistent.min(self.visible);
    }

    fn let_go_of_persistent(&mut self) {
        self.queue.release(self.persistent);
        // Draining a range costs more than all of this, few as they are.
        for _ in 0..self.persistent {
            self.places.pop_front();
        }
        self.persistent = 0;
    }

    /// Gives every new cycle its place; the order of the newest cycle, at least the horizon.
    #[inline]
    fn take_new(&mut self, horizon: Timestamp) -> Timestamp {
        // What is left from before is not before the horizon, else it were persistent.
        let mut newest = self.places.back().map_or(horizon, |place| place.order);
        while let Some(entry) = self.queue.take() {
            newest = newest.max(entry.timestamp);
            self.places.push_back(Place {
                order: newest,
                timestamp: entry.timestamp,
                // No two cycles of an instance have the same timestamp.
                is_expired: self.given_up == Some(entry.timestamp),
            });
        }
        newest
    }

    /// Before which order everything is known; `newest` is the order of the newest cycle.
    #[inline]
    fn pending(
        &mut self,
        announced: Option<Timestamp>,
        t0: Timestamp,
        newest: Timestamp,
    ) -> Timestamp {
        if self.queue.waiting() > 0 {
            // No room: what is complete already comes after the newest that was taken.
            return newest.next();
        }
        self.given_up = announced.filter(|announced| t0 - *announced > self.pending_timeout);
        match announced {
            Some(announced) if self.given_up.is_none() => announced.max(newest),
            _ => Timestamp::NEVER,
        }
    }

    /// Before which order everything must turn persistent, so that there is room for one more.
    #[inline]
    fn pressure(&self) -> Timestamp {
        let needed = if self.queue.is_full() {
            self.queue.waiting() + 1
        } else {
            0
        };
        match needed.min(self.visible) {
            0 => Timestamp::ZERO,
            count => self.places[count - 1].order.next(),
        }
    }
}

impl<T> Lane for Consumer<T> {
    #[inline]
    fn poll(&mut self, t0: Timestamp, horizon: Timestamp) -> Bounds {
        // The announcement first: what is not announced any more can be taken, so that no cycle
        // falls in between.
        let announced = self.queue.announced();
        if announced.is_none() && self.places.is_empty() && self.queue.waiting() == 0 {
            // Mostly there is no news.
            self.given_up = None;
            return Bounds::NONE;
        }
        self.let_go_of_persistent();
        let newest = self.take_new(horizon);
        self.visible = self.places.partition_point(|place| place.order <= t0);
        Bounds {
            pending: self.pending(announced, t0, newest),
            pressure: self.pressure(),
        }
    }

    #[inline]
    fn settle(&mut self, boundary: Timestamp) -> Option<Timestamp> {
        if self.visible == 0 {
            return None;
        }
        let mut last = None;
        for place in self.places.iter().take(self.visible) {
            if place.order >= boundary {
                break;
            }
            last = Some(place.order);
            self.persistent += 1;
            self.counts.delivered += 1;
            self.counts.late += u64::from(place.order > place.timestamp);
            self.counts.expired += u64::from(place.is_expired);
        }
        last
    }

    #[inline]
    fn persistent(&self) -> usize {
        self.persistent
    }

    #[inline]
    fn visible(&self) -> usize {
        self.visible
    }

    #[inline]
    fn window(&self) -> usize {
        self.queue.window()
    }

    #[inline]
    fn rank(&self, index: usize) -> (Timestamp, Timestamp) {
        let place = &self.places[index];
        (place.order, place.timestamp)
    }
}

/// One output of every visible cycle of a consumer.
pub struct Projection<'c, T, F> {
    consumer: &'c Consumer<T>,
    path: F,
}

impl<'c, T, V, F: Fn(&'c T) -> V> Series<V> for Projection<'c, T, F> {
    #[inline]
    fn len(&self) -> usize {
        self.consumer.visible
    }

    #[inline]
    fn persistent(&self) -> usize {
        self.consumer.persistent
    }

    #[inline]
    fn item(&self, index: usize) -> Item<V> {
        let entry = self
            .consumer
            .queue
            .get(index)
            .expect("places are beside taken cycles");
        Item {
            timestamp: entry.timestamp,
            order: self.consumer.places[index].order,
            cycle: entry.cycle,
            value: (self.path)(&entry.value),
        }
    }
}
