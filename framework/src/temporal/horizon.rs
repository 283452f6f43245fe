//! Where persistent ends and transient begins, for all instances that one instance consumes.

use crate::time::Timestamp;

/// A [`Consumer`](super::Consumer) of whichever database, as [`Horizon::consume`] and
/// [`Interleaving::merge`](super::Interleaving::merge) need it.
pub trait Lane {
    /// Lets go of what was persistent and takes what is complete now.
    fn poll(&mut self, t0: Timestamp, horizon: Timestamp) -> Bounds;

    /// Makes everything persistent that is visible and ordered before `boundary`; the last of
    /// those orders.
    fn settle(&mut self, boundary: Timestamp) -> Option<Timestamp>;

    /// How many cycles are persistent: the first ones.
    fn persistent(&self) -> usize;

    /// How many cycles are persistent or transient.
    fn visible(&self) -> usize;

    /// How many cycles there can be.
    fn window(&self) -> usize;

    /// Order and timestamp of a visible cycle.
    fn rank(&self, index: usize) -> (Timestamp, Timestamp);
}

/// What one instance asks of the boundary between persistent and transient.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Everything still to come is ordered at or after this.
    pub pending: Timestamp,
    /// Everything visible before this has to turn persistent.
    pub pressure: Timestamp,
}

impl Bounds {
    /// Nothing is to come and there is no hurry.
    pub(super) const NONE: Self = Self {
        pending: Timestamp::NEVER,
        pressure: Timestamp::ZERO,
    };
}

/// How far one real-time instance has delivered.
#[derive(Clone, Debug, Default)]
pub struct Horizon {
    delivered: Timestamp,
}

impl Horizon {
    /// Nothing is delivered yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The greatest order that was delivered as persistent; zero before.
    pub fn delivered(&self) -> Timestamp {
        self.delivered
    }

    /// Splits what is complete for a cycle at `t0`; lanes are in manifest order of the instances.
    #[inline]
    pub fn consume<const N: usize>(&mut self, t0: Timestamp, mut lanes: [&mut dyn Lane; N]) {
        let mut pending = Timestamp::NEVER;
        let mut pressure = Timestamp::ZERO;
        for lane in &mut lanes {
            let bounds = lane.poll(t0, self.delivered);
            pending = pending.min(bounds.pending);
            pressure = pressure.max(bounds.pressure);
        }
        let boundary = pending.max(pressure);
        for lane in &mut lanes {
            // What is delivered is never before the horizon: it had at least that order.
            self.delivered = lane
                .settle(boundary)
                .map_or(self.delivered, |last| last.max(self.delivered));
        }
    }
}
