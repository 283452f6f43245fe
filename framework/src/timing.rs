//! How long things take, measured without allocating and only when somebody wants to know.
//!
//! What happens inside the calls of one cycle is added up per thread, in a [`Tally`], so that hardware interfaces and
//! nodes need not know which instance they work for.

mod allocations;
mod histogram;
mod spans;
mod ticks;

use std::cell::{Cell, RefCell};
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::{Duration, Instant};

pub use allocations::CountingAllocator;
pub(crate) use allocations::so_far as allocations_so_far;
pub use histogram::Histogram;
pub use spans::{KEPT, Span};
pub(crate) use spans::{SpanWriter, Spans};
pub(crate) use ticks::Ticks;

/// Every how many cycles is timed while nobody listens.
const SAMPLED_EVERY: u64 = 16;

/// Which cycles are timed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Timing {
    /// None; a deadline is watched all the same.
    Off,
    /// Every 16th: what it costs is hardly felt.
    #[default]
    Sampled,
    /// Every one, for whoever listens.
    Complete,
}

/// A [`Timing`].
static TIMING: AtomicU8 = AtomicU8::new(Timing::Sampled as u8);

thread_local! {
    static TALLY: Cell<Tally> = const { Cell::new(Tally::NOTHING) };
    /// Whether there is anything in the tally: mostly there is nothing to take.
    static TALLIED: Cell<bool> = const { Cell::new(false) };
    static LAPS: RefCell<Vec<Lap>> = const { RefCell::new(Vec::new()) };
}

/// The calls of nodes in a cycle that is timed. Noted as they begin, added up when nobody waits for the cycle any more.
#[derive(Debug, Default)]
pub(crate) struct Laps {
    laps: Vec<Lap>,
    /// Where the last one ended, until they are told.
    ends: Option<Mark>,
}

/// Where a node begins, in a cycle that is timed; it ends where the next one begins.
#[derive(Clone, Copy, Debug)]
struct Lap {
    node: &'static str,
    begins: Mark,
}

/// A moment of one thread.
#[derive(Clone, Copy, Debug)]
struct Mark {
    at: Ticks,
    /// How long the thread had been blocked by then.
    blocked: Duration,
    /// How often it had allocated by then.
    allocations: u64,
}

/// What a node took in a cycle that is timed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Took {
    /// Without what the thread was blocked.
    pub(crate) time: Duration,
    pub(crate) begins: Ticks,
    pub(crate) ends: Ticks,
    pub(crate) allocations: u64,
}

/// What one thread spent where since the tally was last taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tally {
    /// Blocked inside the hardware interface.
    pub blocked: Duration,
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

/// Times these cycles from now on, of all robots of the process.
pub fn set(timing: Timing) {
    TIMING.store(timing as u8, Ordering::Relaxed);
}

/// Which cycles are timed now.
#[inline]
pub fn current() -> Timing {
    const OFF: u8 = Timing::Off as u8;
    const SAMPLED: u8 = Timing::Sampled as u8;
    match TIMING.load(Ordering::Relaxed) {
        OFF => Timing::Off,
        SAMPLED => Timing::Sampled,
        _ => Timing::Complete,
    }
}

/// Whether the cycle with this number is timed.
#[inline]
pub(crate) fn is_timed(cycle: u64) -> bool {
    match current() {
        Timing::Off => false,
        Timing::Sampled => cycle.is_multiple_of(SAMPLED_EVERY),
        Timing::Complete => true,
    }
}

/// A node begins, and the one before ends: one look at the counter.
#[inline]
pub(crate) fn start_lap(node: &'static str) {
    let begins = Mark::now();
    LAPS.with_borrow_mut(|laps| laps.push(Lap { node, begins }));
}

impl Mark {
    #[inline]
    fn now() -> Self {
        Self {
            at: Ticks::now(),
            blocked: Tally::peek().blocked,
            allocations: allocations_so_far(),
        }
    }
}

impl Laps {
    /// Forgets what a cycle left that was given up, and makes room for so many nodes: none of them is to be blamed for it.
    pub(crate) fn prepare(&mut self, nodes: usize) {
        let make_room = |laps: &mut Vec<Lap>| {
            laps.clear();
            laps.reserve(nodes);
        };
        self.ends = None;
        make_room(&mut self.laps);
        LAPS.with_borrow_mut(make_room);
    }

    /// Ends the last lap, and takes all of this thread.
    #[inline]
    pub(crate) fn end(&mut self) {
        self.ends = Some(Mark::now());
        self.laps.clear();
        LAPS.with_borrow_mut(|laps| std::mem::swap(laps, &mut self.laps));
    }

    /// What each node took, once; the last one first.
    pub(crate) fn tell(&mut self, mut tell: impl FnMut(&'static str, Took)) {
        let Some(mut ends) = self.ends.take() else {
            return;
        };
        for Lap { node, begins } in self.laps.drain(..).rev() {
            let blocked = ends.blocked.saturating_sub(begins.blocked);
            let took = Took {
                time: ends.at.since(begins.at).saturating_sub(blocked),
                begins: begins.at,
                ends: ends.at,
                allocations: ends.allocations - begins.allocations,
            };
            tell(node, took);
            ends = begins;
        }
    }
}

impl Tally {
    const NOTHING: Self = Self {
        blocked: Duration::ZERO,
        failures: 0,
        skipped: 0,
    };

    /// Everything since the tally was last taken on this thread.
    #[inline]
    pub(crate) fn take() -> Self {
        if TALLIED.replace(false) {
            TALLY.replace(Self::NOTHING)
        } else {
            Self::NOTHING
        }
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
        TALLIED.set(true);
    }
}
