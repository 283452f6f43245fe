//! A node with what keeps its failures to itself: errors and panics are counted and named here.

mod only;
mod panics;

use std::hint::cold_path;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::cycler::Cycle;
use crate::error::{Error, Result, Stopped};
use crate::parameters::Given;
use crate::report::{Allocations, NodeReport, tell};
use crate::time::Timestamp;
use crate::timing::{self, Histogram, Tally};
pub(crate) use only::only;

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
    /// Replaces the state by what was saved as JSON or TOML, in good condition.
    fn load(&mut self, given: &Given<'_>) -> Result<()>;

    /// What its failures left behind, which the state itself does not know. Only nodes fail.
    fn condition(&self) -> Condition {
        Condition::default()
    }

    /// Puts back what [`State::condition`] gave, after the state was loaded.
    fn set_condition(&mut self, _condition: Condition) {}
}

/// What the failures of a node left behind: beside its state all that decides what its next call does.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Condition {
    /// It panicked, and is created anew before its next call.
    pub broken: bool,
    /// Why it could not be created anew: what its next call fails with.
    pub not_renewed: Option<String>,
    /// Timestamp of the last cycle in which it did not fail; under `hold` its outputs stand for [`LONGEST_HOLD`] from there.
    pub good_at: Option<Timestamp>,
}

/// A node of one instance.
///
/// What every cycle touches lies beside the node's state; the ledger is opened when something happens.
#[derive(Debug)]
pub struct Guarded<N> {
    node: N,
    /// It panicked: its state cannot be trusted until it is created anew.
    broken: bool,
    /// Whether its failures left behind what only the ledger knows: otherwise a recording need not open it.
    noted: bool,
    calls: u64,
    ledger: Box<Ledger>,
}

/// Who the node is, and what happened to it.
#[derive(Debug)]
struct Ledger {
    name: &'static str,
    on_failure: OnFailure,
    /// Why it could not be created anew.
    not_renewed: Option<String>,
    /// Timestamp of the last cycle in which it did not fail; kept for `hold` alone.
    good_at: Option<Timestamp>,
    skipped: u64,
    failures: u64,
}

impl<N> Guarded<N> {
    /// A node that was just created; `name` is its path in the manifest.
    pub fn new(name: &'static str, on_failure: OnFailure, node: N) -> Self {
        panics::install_hook();
        Self {
            node,
            broken: false,
            noted: false,
            calls: 0,
            ledger: Box::new(Ledger {
                name,
                on_failure,
                not_renewed: None,
                good_at: None,
                skipped: 0,
                failures: 0,
            }),
        }
    }

    /// Calls the node. Its error becomes one with its name and policy; its panic becomes that where the instance catches it,
    /// so that a node which does not panic pays nothing for it.
    // Always, as are the functions of the nodes: only where the compiler sees that an error is unlikely does it take the nodes
    // that follow for likely, and go on inlining.
    #[inline(always)]
    pub fn call<O, E: Into<Error>>(
        &mut self,
        cycle: &Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<O> {
        self.calls += 1;
        if self.broken {
            cold_path();
            let error = self.ledger.refused();
            return Err(self.ledger.failed(error, cycle));
        }
        if cycle.timed {
            begin(self.ledger.name, cycle)?;
        }
        let unwinding = Unwinding {
            broken: &mut self.broken,
            ledger: &mut self.ledger,
        };
        let returned = call(&mut self.node);
        // Only its unwinding says anything.
        std::mem::forget(unwinding);
        match returned {
            Ok(outputs) => Ok(outputs),
            Err(error) => {
                cold_path();
                Err(self.ledger.failed(error.into(), cycle))
            }
        }
    }

    /// As [`Guarded::call`], but a panic is an error here already.
    #[inline]
    fn call_and_catch<O, E: Into<Error>>(
        &mut self,
        cycle: &Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<O> {
        // Through a place of its own: what a closure returns would be copied piece by piece.
        let mut returned = None;
        panics::forget_caught();
        let caught = catch_unwind(AssertUnwindSafe(|| returned = Some(self.call(cycle, call))));
        returned.unwrap_or_else(|| {
            let error = panics::of_caught(caught).in_cycle(cycle.number);
            self.ledger.tell(&error);
            Err(error)
        })
    }

    /// As [`Guarded::call`], but `None` if the node failed: its outputs are their defaults in this cycle.
    #[inline]
    pub fn call_or_skip<O, E: Into<Error>>(
        &mut self,
        cycle: &Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<Option<O>> {
        match self.call_and_catch(cycle, call) {
            Ok(outputs) => Ok(Some(outputs)),
            Err(error) if ends_cycle(&error, cycle.in_setup) => Err(error),
            Err(_) => Ok(None),
        }
    }

    /// As [`Guarded::call`], but a failure repeats the last good outputs for at most [`LONGEST_HOLD`].
    #[inline]
    pub fn call_or_hold<O, E: Into<Error>>(
        &mut self,
        cycle: &Cycle,
        call: impl FnOnce(&mut N) -> Result<O, E>,
    ) -> Result<Held<O>> {
        match self.call_and_catch(cycle, call) {
            Ok(outputs) => {
                self.ledger.good_at = Some(cycle.time.start);
                self.noted = true;
                Ok(Held::Written(outputs))
            }
            Err(error) if ends_cycle(&error, cycle.in_setup) => Err(error),
            Err(_) => Ok(match self.ledger.good_at {
                Some(good_at) if cycle.time.start - good_at <= LONGEST_HOLD => Held::Hold,
                _ => Held::Skip,
            }),
        }
    }

    /// Clients replaced these outputs of the cycle, or none: what is not the node's own is not held when it fails.
    pub fn replaced(&mut self, outputs: &[bool]) {
        if outputs.contains(&true) {
            self.ledger.good_at = None;
        }
    }

    /// Counts that the node is not called because a required input is absent.
    #[inline]
    pub fn skip(&mut self) {
        self.ledger.skipped += 1;
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
        self.ledger.not_renewed = None;
    }

    /// What fails was told when it happened: nothing is told of this node again.
    pub(crate) fn hush(&mut self) {
        // Only powers of two are told.
        self.ledger.failures = 1 << 62 | 1;
    }

    /// The node, for its `restore` in a replay.
    pub fn node_mut(&mut self) -> &mut N {
        &mut self.node
    }

    pub(crate) fn node(&self) -> &N {
        &self.node
    }

    /// What [`Condition`] is made of.
    #[inline]
    pub(crate) fn failed(&self) -> (bool, Option<&String>, Option<Timestamp>) {
        if !self.noted {
            return (self.broken, None, None);
        }
        cold_path();
        let Ledger {
            not_renewed,
            good_at,
            ..
        } = &*self.ledger;
        (self.broken, not_renewed.as_ref(), *good_at)
    }

    /// What the node did so far; how long it took, the instance knows.
    pub fn report(&self) -> NodeReport {
        NodeReport {
            node: self.ledger.name,
            calls: self.calls,
            skipped: self.ledger.skipped,
            failures: self.ledger.failures,
            histogram: Histogram::nothing(),
            allocations: Allocations::default(),
        }
    }

    #[cold]
    fn create_anew(&mut self, create: impl FnOnce() -> Result<N>) -> Result<()> {
        let Ledger {
            name, on_failure, ..
        } = *self.ledger;
        match contain(name, create) {
            Ok(node) => {
                self.renew(node);
                Ok(())
            }
            Err(error) => {
                match on_failure {
                    OnFailure::Skip | OnFailure::Hold if !error.is_stopped() => {
                        // The next failure names the node itself.
                        let reason = Error::from(error.into_boxed()).to_string();
                        self.ledger.not_renewed = Some(reason);
                        self.noted = true;
                        Ok(())
                    }
                    on_failure => Err(error.of_node(name, Some(on_failure))),
                }
            }
        }
    }
}

impl Ledger {
    #[cold]
    #[inline(never)]
    fn failed(&mut self, error: Error, cycle: &Cycle) -> Error {
        let error = error.of_node(self.name, Some(self.on_failure));
        let error = error.in_cycle(cycle.number);
        if !ends_cycle(&error, cycle.in_setup) {
            self.count_failure();
            if self.is_told_here(cycle) {
                self.tell(&error);
            }
        }
        error
    }

    #[cold]
    #[inline(never)]
    fn unwind(&mut self) {
        self.count_failure();
        panics::unwind_from(self.name, self.on_failure);
    }

    /// Why a call cannot be made.
    fn refused(&self) -> Error {
        Error::new(match &self.not_renewed {
            Some(reason) => format!("it panicked and could not be created anew: {reason}"),
            None => "it panicked and was not created anew".to_owned(),
        })
    }

    fn count_failure(&mut self) {
        self.failures += 1;
        Tally::change(|tally| tally.failures += 1);
    }

    /// Whether the error ends here: what starts over, restarts or stops is told there.
    fn is_told_here(&self, cycle: &Cycle) -> bool {
        !cycle.in_setup && matches!(self.on_failure, OnFailure::Skip | OnFailure::Hold)
    }

    /// Every failure is counted; a node that fails in every cycle must not flood the terminal.
    fn tell(&self, error: &Error) {
        if self.failures.is_power_of_two() {
            let failures = self.failures;
            let failed = format_args!("{error} (failure {failures} of this node)");
            crate::logs::record(crate::logs::Level::ERROR, self.name, failed);
            match panics::inside() {
                Some(instance) => tell(format_args!("{instance}: {failed}")),
                None => tell(failed),
            }
        }
    }
}

/// While a node is called: its panic unwinds through here, whoever catches it.
struct Unwinding<'call> {
    broken: &'call mut bool,
    ledger: &'call mut Ledger,
}

impl Drop for Unwinding<'_> {
    // Inlined, so that the references need not lie in memory while the node runs.
    #[inline(always)]
    fn drop(&mut self) {
        *self.broken = true;
        self.ledger.unwind();
    }
}

impl<N: Serialize + DeserializeOwned> State for Guarded<N> {
    fn save(&self, serializer: &mut dyn erased_serde::Serializer) -> Result<()> {
        self.node.save(serializer)
    }

    fn load(&mut self, given: &Given<'_>) -> Result<()> {
        self.renew(given.read()?);
        self.ledger.good_at = None;
        Ok(())
    }

    fn condition(&self) -> Condition {
        Condition {
            broken: self.broken,
            not_renewed: self.ledger.not_renewed.clone(),
            good_at: self.ledger.good_at,
        }
    }

    fn set_condition(&mut self, condition: Condition) {
        self.broken = condition.broken;
        self.noted = condition.not_renewed.is_some() || condition.good_at.is_some();
        self.ledger.not_renewed = condition.not_renewed;
        self.ledger.good_at = condition.good_at;
    }
}

impl<T: Serialize + DeserializeOwned> State for T {
    fn save(&self, serializer: &mut dyn erased_serde::Serializer) -> Result<()> {
        Ok(erased_serde::Serialize::erased_serialize(self, serializer)?)
    }

    fn load(&mut self, given: &Given<'_>) -> Result<()> {
        *self = given.read()?;
        Ok(())
    }
}

/// Runs framework or generated code; a panic in it becomes an error, that of the node it comes from.
#[inline]
pub(crate) fn contain<T>(what: &'static str, run: impl FnOnce() -> Result<T>) -> Result<T> {
    let inside = panics::enter(what);
    let caught = catch_unwind(AssertUnwindSafe(run));
    drop(inside);
    match caught {
        Ok(returned) => returned,
        Err(payload) => Err(panics::of_caught(Err(payload))),
    }
}

/// A node begins in a cycle that is looked at closely.
///
/// # Errors
/// [`Stopped`], if only a part of the cycle runs and the node is not in it.
#[cold]
#[inline(never)]
fn begin(node: &'static str, cycle: &Cycle) -> Result<(), Stopped> {
    if cycle.partial {
        only::may_begin(node)?;
    }
    timing::start_lap(node);
    Ok(())
}

/// Whether the error is no failure of the node but says that this cycle is not to be.
///
/// Only setup nodes can find that nothing came: once a cycle has begun, it is about something.
fn ends_cycle(error: &Error, in_setup: bool) -> bool {
    error.is_stopped() || (in_setup && error.is_no_event())
}
