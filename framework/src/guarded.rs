//! A node with what keeps its failures to itself: errors and panics are caught, counted and named here.

mod panics;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::cycler::Cycle;
use crate::error::{Error, Result};
use crate::report::{NodeReport, tell};
use crate::time::Timestamp;
use crate::timing::{Histogram, Tally};

/// How long `hold` repeats the last good outputs.
pub const LONGEST_HOLD: Duration = Duration::from_millis(100);

/// What the manifest wants done when a node fails.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnFailure {
    /// The robot stops, in order.
    #[default]
    Stop,
    /// The instance's nodes and states are created anew.
    Restart,
    /// The node's outputs are their defaults in this cycle.
    Skip,
    /// The node's outputs are the last good ones for at most 100 ms, then as `Skip`.
    Hold,
}

/// What a call under `hold` gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held<O> {
    /// The node wrote its outputs.
    Written(O),
    /// It failed: the outputs of the last finished cycle stand in.
    Hold,
    /// It has been failing for too long: defaults stand in.
    Skip,
}

/// Something that a recording keeps and a replay puts back.
pub trait State {
    /// Writes the state in any format.
    fn save(&self, serializer: &mut dyn erased_serde::Serializer) -> Result<()>;
    /// Replaces the state by what was saved.
    fn load(&mut self, deserializer: &mut dyn erased_serde::Deserializer<'_>) -> Result<()>;
}

/// A node of one instance.
#[derive(Debug)]
pub struct Guarded<N> {
    name: &'static str,
    on_failure: OnFailure,
    node: N,
    /// It panicked: its state cannot be trusted until it is created anew.
    broken: bool,
    /// Why it could not be created anew.
    not_renewed: Option<String>,
    /// Timestamp of the last cycle in which it did not fail.
    good_at: Option<Timestamp>,
    calls: u64,
    skipped: u64,
    failures: u64,
    histogram: Histogram,
}

impl<N> Guarded<N> {
    /// A node that was just created; `name` is its path in the manifest.
    pub fn new(name: &'static str, on_failure: OnFailure, node: N) -> Self {
        panics::install_hook();
        Self {
            name,
            on_failure,
            node,
            broken: false,
            not_renewed: None,
            good_at: None,
            calls: 0,
            skipped: 0,
            failures: 0,
            histogram: Histogram::default(),
        }
    }

    /// Calls the node. Its error or panic becomes an error with its name and policy.
    #[inline]
    pub fn call<O, E: Into<Error>>(
        &mut self,
        cycle: Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<O> {
        self.calls += 1;
        if self.broken {
            return Err(self.refused(cycle));
        }
        let stopwatch = cycle.timed.then(Stopwatch::start);
        let inside = panics::enter(self.name);
        let node = &mut self.node;
        // Through a place of its own: what a closure returns would be copied piece by piece.
        let mut returned = None;
        let caught = catch_unwind(AssertUnwindSafe(|| returned = Some(call(node))));
        drop(inside);
        if let Some(stopwatch) = stopwatch {
            let took = stopwatch.elapsed();
            self.histogram.record(took);
            Tally::add_node(self.name, took);
        }
        match returned {
            Some(Ok(outputs)) => {
                self.good_at = Some(cycle.time.start);
                Ok(outputs)
            }
            Some(Err(error)) => Err(self.failed(error.into(), cycle)),
            None => Err(self.panicked(caught, cycle)),
        }
    }

    /// As [`Guarded::call`], but `None` if the node failed: its outputs are their defaults in this cycle.
    #[inline]
    pub fn call_or_skip<O, E: Into<Error>>(
        &mut self,
        cycle: Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<Option<O>> {
        match self.call(cycle, call) {
            Ok(outputs) => Ok(Some(outputs)),
            Err(error) if ends_cycle(&error, cycle) => Err(error),
            Err(_) => Ok(None),
        }
    }

    /// As [`Guarded::call`], but a failure repeats the last good outputs for at most [`LONGEST_HOLD`].
    #[inline]
    pub fn call_or_hold<O, E: Into<Error>>(
        &mut self,
        cycle: Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<Held<O>> {
        match self.call(cycle, call) {
            Ok(outputs) => Ok(Held::Written(outputs)),
            Err(error) if ends_cycle(&error, cycle) => Err(error),
            Err(_) => Ok(match self.good_at {
                Some(good_at) if cycle.time.start - good_at <= LONGEST_HOLD => Held::Hold,
                _ => Held::Skip,
            }),
        }
    }

    /// Counts that the node is not called because a required input is absent.
    #[inline]
    pub fn skip(&mut self) {
        self.skipped += 1;
        Tally::change(|tally| tally.skipped += 1);
    }

    /// After a panic, creates the node anew; does nothing otherwise.
    ///
    /// If that fails under `skip` or `hold`, the next call fails and it is tried again before the one after.
    #[inline]
    pub fn renew_if_broken(&mut self, create: impl FnOnce() -> Result<N>) -> Result<()> {
        if self.broken {
            self.create_anew(create)
        } else {
            Ok(())
        }
    }

    /// Replaces the node; what was counted stays.
    pub fn renew(&mut self, node: N) {
        self.node = node;
        self.broken = false;
        self.not_renewed = None;
    }

    /// The node, for its `restore` in a replay.
    pub fn node_mut(&mut self) -> &mut N {
        &mut self.node
    }

    /// What the node did so far.
    pub fn report(&self) -> NodeReport {
        NodeReport {
            node: self.name,
            calls: self.calls,
            skipped: self.skipped,
            failures: self.failures,
            histogram: self.histogram.clone(),
        }
    }

    #[cold]
    fn create_anew(&mut self, create: impl FnOnce() -> Result<N>) -> Result<()> {
        match contain(self.name, create) {
            Ok(node) => {
                self.renew(node);
                Ok(())
            }
            Err(error) => {
                match self.on_failure {
                    OnFailure::Skip | OnFailure::Hold if !error.is_stopped() => {
                        // The next failure names the node itself.
                        self.not_renewed = Some(Error::from(error.into_boxed()).to_string());
                        Ok(())
                    }
                    on_failure => Err(error.of_node(self.name, Some(on_failure))),
                }
            }
        }
    }

    #[cold]
    fn panicked(&mut self, caught: std::thread::Result<()>, cycle: Cycle) -> Error {
        self.broken = true;
        self.failed(panics::of_caught(caught), cycle)
    }

    /// The failure of a call that cannot be made.
    #[cold]
    fn refused(&mut self, cycle: Cycle) -> Error {
        let message = match &self.not_renewed {
            Some(reason) => format!("it panicked and could not be created anew: {reason}"),
            None => "it panicked and was not created anew".to_owned(),
        };
        self.failed(Error::new(message), cycle)
    }

    #[cold]
    fn failed(&mut self, error: Error, cycle: Cycle) -> Error {
        let error = error.of_node(self.name, Some(self.on_failure));
        if !ends_cycle(&error, cycle) {
            self.failures += 1;
            Tally::change(|tally| tally.failures += 1);
            // Every failure is counted; a node that fails in every cycle must not flood the terminal.
            if self.failures.is_power_of_two() {
                let failures = self.failures;
                tell(format_args!("{error} (failure {failures} of this node)"));
            }
        }
        error
    }
}

impl<N: Serialize + DeserializeOwned> State for Guarded<N> {
    fn save(&self, serializer: &mut dyn erased_serde::Serializer) -> Result<()> {
        self.node.save(serializer)
    }

    fn load(&mut self, deserializer: &mut dyn erased_serde::Deserializer<'_>) -> Result<()> {
        self.renew(erased_serde::deserialize(deserializer)?);
        Ok(())
    }
}

impl<T: Serialize + DeserializeOwned> State for T {
    fn save(&self, serializer: &mut dyn erased_serde::Serializer) -> Result<()> {
        Ok(erased_serde::Serialize::erased_serialize(self, serializer)?)
    }

    fn load(&mut self, deserializer: &mut dyn erased_serde::Deserializer<'_>) -> Result<()> {
        *self = erased_serde::deserialize(deserializer)?;
        Ok(())
    }
}

/// Runs framework or generated code; a panic in it becomes an error.
#[inline]
pub(crate) fn contain<T>(what: &'static str, run: impl FnOnce() -> Result<T>) -> Result<T> {
    let inside = panics::enter(what);
    let mut returned = None;
    let caught = catch_unwind(AssertUnwindSafe(|| returned = Some(run())));
    drop(inside);
    returned.unwrap_or_else(|| Err(panics::of_caught(caught)))
}

/// Whether the error is no failure of the node but says that this cycle is not to be.
///
/// Only setup nodes can find that nothing came: once a cycle has begun, it is about something.
fn ends_cycle(error: &Error, cycle: Cycle) -> bool {
    error.is_stopped() || (cycle.in_setup && error.is_no_event())
}

/// Measures a node without what it is blocked inside the hardware interface.
struct Stopwatch {
    started: Instant,
    blocked_before: Duration,
}

impl Stopwatch {
    fn start() -> Self {
        Self {
            started: Instant::now(),
            blocked_before: Tally::peek().blocked,
        }
    }

    fn elapsed(&self) -> Duration {
        let blocked = Tally::peek().blocked - self.blocked_before;
        self.started.elapsed().saturating_sub(blocked)
    }
}
