//! Where the time of one instance's cycles goes.

use std::time::{Duration, Instant};

use crate::clock::Clock;
use crate::report::Durations;
use crate::timing::Tally;

/// Measures the cycles that are timed, and all if there is a deadline.
#[derive(Debug)]
pub(super) struct Stopwatch {
    /// On a stepped clock `finish` comes long after `run` and nothing can be late.
    stepped: bool,
    deadline: Option<Duration>,
    waiting: Lap,
    blocked: Duration,
    cycle: Lap,
    /// Of the nodes of the cycle.
    tally: Option<Tally>,
    /// The cycle after an overrun is timed, so that there is somebody to blame.
    overran: bool,
    durations: Durations,
    slowest: Vec<(&'static str, u64)>,
}

#[derive(Debug, Default)]
struct Lap {
    since: Option<Instant>,
    spent: Duration,
}

impl Stopwatch {
    pub(super) fn new(clock: &Clock, deadline: Option<Duration>) -> Self {
        Self {
            stepped: clock.is_stepped(),
            deadline: deadline.filter(|_| !clock.is_stepped()),
            waiting: Lap::default(),
            blocked: Duration::ZERO,
            cycle: Lap::default(),
            tally: None,
            overran: false,
            durations: Durations::default(),
            slowest: Vec::new(),
        }
    }

    #[inline]
    pub(super) fn looks_closely(&self) -> bool {
        self.overran
    }

    #[inline]
    pub(super) fn start_waiting(&mut self, timed: bool) {
        if timed {
            self.waiting.start();
        }
    }

    #[inline]
    pub(super) fn end_waiting(&mut self, tally: &Tally) {
        self.waiting.pause();
        self.blocked += tally.blocked;
    }

    #[inline]
    pub(super) fn begin(&mut self, timed: bool, now: Option<Instant>) {
        if timed || self.deadline.is_some() {
            self.cycle.since = Some(now.unwrap_or_else(Instant::now));
        }
    }

    #[inline]
    pub(super) fn end_running(&mut self, tally: Tally) {
        self.tally = Some(tally);
        if self.stepped {
            self.cycle.pause();
        }
    }

    #[inline]
    pub(super) fn resume(&mut self) {
        if self.stepped && !self.cycle.spent.is_zero() {
            self.cycle.start();
        }
    }

    /// The cycle was published; whether it took too long.
    #[inline]
    pub(super) fn finish(&mut self, timed: bool) -> bool {
        let took = self.cycle.take();
        let waited = self.waiting.take();
        let blocked = std::mem::take(&mut self.blocked);
        let tally = self.tally.take();
        if timed {
            let elsewhere = tally.map_or(Duration::ZERO, |tally| tally.in_nodes + tally.blocked);
            self.durations.cycle.record(took);
            self.durations
                .framework
                .record(took.saturating_sub(elsewhere));
            self.durations.wait.record(blocked);
            self.durations.setup.record(waited.saturating_sub(blocked));
        }
        self.overran = self.deadline.is_some_and(|deadline| took > deadline);
        if self.overran {
            self.blame(tally.and_then(|tally| tally.slowest));
        }
        self.overran
    }

    pub(super) fn discard(&mut self) {
        self.waiting.take();
        self.cycle.take();
        self.blocked = Duration::ZERO;
        self.tally = None;
    }

    pub(super) fn durations(&self) -> &Durations {
        &self.durations
    }

    pub(super) fn slowest(&self) -> &[(&'static str, u64)] {
        &self.slowest
    }

    #[cold]
    fn blame(&mut self, slowest: Option<(&'static str, Duration)>) {
        let Some((node, _)) = slowest else { return };
        match self.slowest.iter_mut().find(|(known, _)| *known == node) {
            Some((_, overruns)) => *overruns += 1,
            None => self.slowest.push((node, 1)),
        }
    }
}

impl Lap {
    #[inline]
    fn start(&mut self) {
        self.since = Some(Instant::now());
    }

    #[inline]
    fn pause(&mut self) {
        if let Some(since) = self.since.take() {
            self.spent += since.elapsed();
        }
    }

    #[inline]
    fn take(&mut self) -> Duration {
        self.pause();
        std::mem::take(&mut self.spent)
    }
}
