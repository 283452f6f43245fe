//! A cycler instance as the drivers see it.

use std::sync::Arc;
use std::time::Duration;

use hulkgen_recording::Writing;

use super::{Counters, Cycle, InstanceDescription, Reference};
use crate::digest::DigestError;
use crate::error::Result;
use crate::guarded::State;
use crate::recorded::{Capture, DIGEST, Digests, Forms, SaveError, Saving, Types, Visit};
use crate::reflect::Reflect;
use crate::report::InstanceReport;
use crate::subscriptions::Subscriptions;
use crate::tap::{Reports, Tap};
use crate::time::Timestamp;

/// How long setup nodes that failed under `skip` or `hold` wait on the wall clock before they start over.
pub const PAUSE_AFTER_SETUP_FAILURE: Duration = Duration::from_millis(10);

/// One cycler instance, whatever its body. A driver calls `wait`, `begin`, `run`, `finish`, again and again.
pub trait Instance: Send {
    /// What the manifest says about it.
    fn description(&self) -> &InstanceDescription;

    /// The cycle that began last.
    fn cycle(&self) -> Cycle;

    /// Lets the setup nodes wait for the outside world; `Err` if the robot has to stop.
    fn wait(&mut self) -> Result<Waited>;

    /// Gives the cycle its timestamp, announces it or consumes, and takes everything it may read; a cycle that began before
    /// and was not finished is abandoned.
    fn begin(&mut self);

    /// Runs the nodes; a failure takes effect in `finish`.
    fn run(&mut self);

    /// Publishes the cycle, or abandons it if it failed; `Err` if the robot has to stop.
    fn finish(&mut self) -> Result<Finished>;

    /// Ends a cycle that began as if it had never been; harmless without one.
    fn abandon(&mut self);

    /// Creates nodes and states anew; `Err` if the robot has to stop.
    fn restart(&mut self) -> Result<Restarted>;

    /// Its counts, to be read while it runs.
    fn counters(&self) -> &Arc<Counters>;

    /// What it did so far.
    fn report(&self) -> InstanceReport;

    /// Names of its main outputs.
    fn main_outputs(&self) -> &'static [&'static str];

    /// A main output of the last finished cycle.
    fn main_output(&self, name: &str) -> Option<&dyn Reflect>;

    /// An additional output, if the last finished cycle filled it.
    fn additional_output(&self, name: &str) -> Option<&dyn Reflect>;

    /// Ends for a server: one for each output, and one for reports. Taps that it gave before have nothing any more.
    fn tap(&mut self, subscriptions: &Subscriptions) -> (Vec<Tap>, Reports);

    /// How each output is written, whatever its type: main outputs, then additional ones.
    fn forms(&self, forms: &mut Forms);

    /// Everything that the cycle read from other instances.
    fn references(&self, visit: &mut dyn FnMut(Reference));

    /// Every node's state by the node's path, then `cycler_state`.
    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State));

    /// Calls `restore` of the nodes that have one, after their states were loaded.
    fn restore(&mut self) -> Result<()>;

    /// Saves all that the cycle that has just begun depends on.
    ///
    /// # Errors
    /// If there is no room, or a value cannot be serialised.
    fn save(&mut self, capture: &mut Capture<'_, '_>) -> Result<(), SaveError>;

    /// Saves what stands in the frame itself, behind its head: of histories what came since that time, `None` for all of it.
    fn save_alone(&mut self, since: Option<Timestamp>, out: &mut Saving<'_, '_>);

    /// The types of what [`Instance::save`] writes.
    fn types(&self) -> Types;

    /// Saves digests of what the nodes wrote in the last finished cycle, in the order of [`Instance::digested`].
    fn save_digests(&self, digests: &mut Digests<'_, '_>);

    /// What those are of: node and output, in the order of the nodes' calls.
    fn digested(&self) -> &'static [(&'static str, &'static str)];

    /// Digests of what the nodes wrote in the last finished cycle.
    ///
    /// # Errors
    /// If a value's own `Serialize` fails.
    fn digests(&self, visit: Visit<'_>) -> Result<(), DigestError> {
        let digested = self.digested();
        let length = digested.len() * DIGEST;
        let mut bytes = vec![0; length];
        let mut writing = Writing::new(&mut bytes);
        let mut digests = Digests::new(&mut writing);
        self.save_digests(&mut digests);
        digests.end()?;
        debug_assert!(
            writing.length() == length && !writing.is_full(),
            "what is digested is named, and nothing else"
        );
        let (digests, _) = bytes.as_chunks();
        for ((node, output), digest) in digested.iter().zip(digests) {
            visit(node, output, u64::from_le_bytes(*digest));
        }
        Ok(())
    }
}

/// How a `wait` ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waited {
    /// Its data is there: `begin` comes next.
    Ready,
    /// Nothing came: `wait` comes next.
    NoEvent,
    /// A setup node failed under `skip` or `hold`: `wait` comes next, after [`PAUSE_AFTER_SETUP_FAILURE`] on the wall clock.
    Failed,
    /// A setup node failed under `restart`: `restart` comes next.
    Restarting {
        /// Not before.
        at: Timestamp,
    },
    /// The robot is being stopped.
    Stopped,
}

/// How a cycle ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finished {
    /// Published.
    Completed,
    /// Published, the first one after a restart.
    Recovered,
    /// Not published; `wait` comes next.
    Abandoned,
    /// Not published; `restart` comes next.
    Restarting {
        /// Not before.
        at: Timestamp,
    },
    /// Not published: the robot is being stopped.
    Stopped,
}

/// How a restart ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Restarted {
    /// `wait` comes next.
    Done,
    /// It failed; `restart` comes next.
    Again {
        /// Not before.
        at: Timestamp,
    },
    /// The robot is being stopped.
    Stopped,
}
