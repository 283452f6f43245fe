//! Owns the chaos mode of lockstep: when data arrives and how long cycles take is drawn, within what a body allows.
//!
//! Invariant: the same seed draws the same; no draw makes an instance fall behind data that come at a pace slower than
//! its longest cycle and its wake-up together. Where data come faster, events are missed, as on a busy computer.

use std::time::Duration;

use crate::cycler::{InstanceDescription, Kind};
use crate::split_mix::SplitMix;

/// How much later than its data an instance of a perception cycler begins at most: what a busy computer takes to wake a thread.
const PERCEPTION_WAKES_WITHIN: Duration = Duration::from_millis(2);
/// The same for a real-time cycler, whose thread goes first.
const REAL_TIME_WAKES_WITHIN: Duration = Duration::from_millis(1);
/// How long a cycle of a perception cycler without deadline takes at most.
const LONGEST_WITHOUT_DEADLINE: Duration = Duration::from_millis(20);

/// Draws delays from a seed.
#[derive(Clone, Debug)]
pub(super) struct Chaos {
    numbers: SplitMix,
}

impl Chaos {
    pub(super) fn new(seed: u64) -> Self {
        Self {
            numbers: SplitMix::new(seed),
        }
    }

    /// From the arrival of data to `begin`.
    pub(super) fn wake(&mut self, description: &InstanceDescription) -> Duration {
        self.up_to(match description.kind {
            Kind::Perception => PERCEPTION_WAKES_WITHIN,
            Kind::RealTime => REAL_TIME_WAKES_WITHIN,
        })
    }

    /// From `begin` to `finish`: up to the deadline of a perception cycler (20 ms without one), up to half of it for a
    /// real-time cycler.
    pub(super) fn cycle(&mut self, description: &InstanceDescription) -> Duration {
        let deadline = description.deadline;
        self.up_to(match description.kind {
            Kind::Perception => deadline.unwrap_or(LONGEST_WITHOUT_DEADLINE),
            // A body waits for its command: most of the deadline is the node's own margin.
            Kind::RealTime => deadline.unwrap_or_default() / 2,
        })
    }

    fn up_to(&mut self, greatest: Duration) -> Duration {
        let nanoseconds = u64::try_from(greatest.as_nanos()).unwrap_or(u64::MAX);
        Duration::from_nanos(self.numbers.next() % nanoseconds.saturating_add(1).max(1))
    }
}
