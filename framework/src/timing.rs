//! How long things take, measured without allocating and only when somebody wants to know.
//!
//! What happens inside the calls of one cycle is added up per thread, in a [`Tally`], so that hardware interfaces and
//! nodes need not know which instance they work for.

mod histogram;

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

pub use histogram::Histogram;

/// Every how many cycles is timed while nobody listens.
pub const SAMPLED_EVERY: u64 = 16;

/// Whether somebody listens: then every cycle is timed.
static COMPLETE: AtomicBool = AtomicBool::new(false);

thread_local! {
    static TALLY: Cell<Tally> = const { Cell::new(Tally::NOTHING) };
}

/// What one thread spent where since the tally was last taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally {
    /// Blocked inside the hardware interface.
    pub blocked: Duration,
    /// In timed nodes, without what they were blocked.
    pub in_nodes: Duration,
    /// The node that took longest, if nodes were timed.
    pub slowest: Option<(&'static str, Duration)>,
    /// Calls of nodes that failed.
    pub failures: u64,
    /// Nodes that were skipped because a required input was absent.
    pub skipped: u64,
}

/// Marks the time that `wait` spends blocked inside the hardware interface; implementations put it around what blocks.
///
/// Reported as `wait_us`. Inside a node it does not count as the node's time. A wait within a wait counts once.
#[inline]
pub fn blocking<T>(wait: impl FnOnce() -> T) -> T {
    let before = Tally::peek().blocked;
    let started = Instant::now();
    let result = wait();
    // What waits inside have added is part of this wait.
    Tally::change(|tally| tally.blocked = before + started.elapsed());
    result
}

/// Times every cycle from now on (`true`), or a sample again. Holds for all robots of the process.
pub fn time_every_cycle(complete: bool) {
    COMPLETE.store(complete, Ordering::Relaxed);
}

/// Whether the cycle with this number is timed.
#[inline]
pub(crate) fn is_timed(cycle: u64) -> bool {
    cycle.is_multiple_of(SAMPLED_EVERY) || COMPLETE.load(Ordering::Relaxed)
}

impl Tally {
    const NOTHING: Self = Self {
        blocked: Duration::ZERO,
        in_nodes: Duration::ZERO,
        slowest: None,
        failures: 0,
        skipped: 0,
    };

    /// Everything since the tally was last taken on this thread.
    #[inline]
    pub(crate) fn take() -> Self {
        TALLY.replace(Self::NOTHING)
    }

    /// What there is so far on this thread.
    #[inline]
    pub(crate) fn peek() -> Self {
        TALLY.get()
    }

    #[inline]
    pub(crate) fn change(change: impl FnOnce(&mut Self)) {
        let mut tally = TALLY.get();
        change(&mut tally);
        TALLY.set(tally);
    }

    /// Adds one timed call of a node.
    #[inline]
    pub(crate) fn add_node(node: &'static str, took: Duration) {
        Self::change(|tally| {
            tally.in_nodes += took;
            if tally.slowest.is_none_or(|(_, longest)| took > longest) {
                tally.slowest = Some((node, took));
            }
        });
    }
}
