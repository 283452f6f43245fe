//! One cycler instance: the loop around its generated body, in four calls so that both drivers can turn it.
//!
//! ```text
//! wait:    setup nodes wait for the outside world          -> capture time
//! begin:   timestamp; announce, or consume; take everything the cycle may read, once
//! run:     nodes in order
//! finish:  publish and complete, or abandon                 -> what the driver does next
//! ```
//! A failed `run` takes effect in `finish`: until then the announcement stands, as it would while the nodes still run.

mod counters;
mod description;
mod instance;
mod restarts;
mod turn;

pub use counters::{Counters, Counts};
pub use description::{InstanceDescription, Kind, Record};
pub use instance::{Finished, Instance, PAUSE_AFTER_SETUP_FAILURE, Restarted, Waited};
pub use turn::Cycler;

use crate::error::Result;
use crate::guarded::State;
use crate::reflect::Reflect;
use crate::report::{NodeReport, QueueReport};
use crate::tap::OutputVisitor;
pub use crate::temporal::{Reference, ReferenceKind};
use crate::time::{CycleTime, Timestamp};

/// The generated part of a cycler instance: its nodes between its buffers.
pub trait Body: Send {
    /// The main outputs that other instances read: what a slot of the instance's buffer holds.
    type Shared: Default + Send + Sync + 'static;

    /// Nodes and cycler state anew, from the newest parameters.
    fn create(&mut self) -> Result<()>;

    /// Takes the newest parameters and runs the setup nodes; gives the capture time if one of them knows it.
    fn wait(&mut self, slots: Slots<'_, Self::Shared>, cycle: Cycle) -> Result<Option<Timestamp>>;

    /// The one capture point: takes everything that the cycle may read.
    fn begin(&mut self, slots: Slots<'_, Self::Shared>, cycle: Cycle);

    /// Runs the nodes in order.
    fn run(&mut self, slots: Slots<'_, Self::Shared>, cycle: Cycle) -> Result<()>;

    /// Keeps history, swaps the own outputs, closes procedures; the slot is published right afterwards.
    fn finish(&mut self, shared: &Self::Shared, cycle: Cycle);

    /// Closes procedures; nothing of the cycle is kept.
    fn abandon(&mut self);

    /// Everything that this cycle read from other instances, by name and number instead of by value.
    fn references(&self, visit: &mut dyn FnMut(Reference));

    /// Names of all main outputs, in manifest order of their nodes.
    fn main_outputs(&self) -> &'static [&'static str];

    /// A main output of the last finished cycle.
    fn main_output<'a>(&'a self, shared: &'a Self::Shared, name: &str) -> Option<&'a dyn Reflect>;

    /// An additional output, if this cycle filled it.
    fn additional_output(&self, name: &str, cycle: u64) -> Option<&dyn Reflect>;

    /// Every output of the last finished cycle.
    fn outputs<'a>(
        &'a self,
        shared: &'a Self::Shared,
        cycle: u64,
        visitor: &mut impl OutputVisitor<'a>,
    );

    /// What the nodes did so far, in manifest order.
    fn nodes(&self, visit: &mut dyn FnMut(NodeReport));

    /// What the perception consumers did so far, in manifest order.
    fn queues(&self, visit: &mut dyn FnMut(QueueReport));

    /// Every node's state by the node's path, then `cycler_state`.
    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State));

    /// Calls `restore` of the nodes that have one, after their states were loaded.
    fn restore(&mut self) -> Result<()>;
}

/// One cycle as its nodes know it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cycle {
    /// Counts begun cycles from 1.
    pub number: u64,
    /// Its timestamp. In `wait`, where it is not known yet, that of the cycle before.
    pub time: CycleTime,
    /// Whether its nodes are timed.
    pub timed: bool,
    /// Whether it has not begun: setup nodes are waiting for what it will be about.
    pub in_setup: bool,
    /// Whether some of its nodes alone may begin: in a replay of them. Such a cycle is timed.
    pub partial: bool,
}

/// Where a body writes what others read, and what it wrote there in its last finished cycle.
#[derive(Debug)]
pub struct Slots<'a, S> {
    /// Being written; holds what some older cycle left in it.
    pub current: &'a mut S,
    /// The last finished cycle.
    pub previous: &'a S,
}

/// The outputs that stay with the instance: of this cycle, and of the last finished one.
#[derive(Clone, Debug, Default)]
pub struct Swap<T> {
    values: [T; 2],
    /// Which of the two this cycle writes; they change places without being moved.
    second_is_current: bool,
}

impl<T> Swap<T> {
    /// What this cycle writes; before it does, what the last but one left.
    #[inline]
    pub fn current(&self) -> &T {
        let [first, second] = &self.values;
        if self.second_is_current {
            second
        } else {
            first
        }
    }

    /// What the last finished cycle wrote.
    #[inline]
    pub fn previous(&self) -> &T {
        let [first, second] = &self.values;
        if self.second_is_current {
            first
        } else {
            second
        }
    }

    /// Both at once, to read one while writing the other.
    #[inline]
    pub fn both(&mut self) -> (&mut T, &T) {
        let (current, previous) = self.both_to_load();
        (current, previous)
    }

    /// Both at once, to make them what they were.
    #[inline]
    pub fn both_to_load(&mut self) -> (&mut T, &mut T) {
        let [first, second] = &mut self.values;
        if self.second_is_current {
            (second, first)
        } else {
            (first, second)
        }
    }

    /// Ends a cycle: what it wrote is now what the last finished one wrote.
    #[inline]
    pub fn swap(&mut self) {
        self.second_is_current = !self.second_is_current;
    }
}

#[cfg(test)]
mod tests {
    use super::Swap;

    #[test]
    fn what_a_cycle_wrote_is_previous_in_the_next() {
        let mut outputs = Swap::<u32>::default();
        for cycle in 1..5 {
            let (current, previous) = outputs.both();
            assert_eq!(*previous, cycle - 1);
            *current = cycle;
            assert_eq!(*outputs.current(), cycle);
            outputs.swap();
            assert_eq!(*outputs.previous(), cycle);
        }
    }
}
