//! Where the time of one instance's cycles goes.

use std::time::Duration;

use crate::clock::Clock;
use crate::report::{Allocations, CycleAllocations, Durations, NodeReport};
use crate::timing::{self, Histogram, SpanWriter, Tally, Ticks};

/// Measures the cycles that are timed, and all if there is a deadline.
#[derive(Debug)]
pub(super) struct Stopwatch {
    /// On a stepped clock `finish` comes long after `run` and nothing can be late.
    stepped: bool,
    deadline: Option<Duration>,
    waiting: Lap,
    blocked: Duration,
    cycle: Lap,
    /// Blocked while the nodes of the cycle ran.
    blocked_in_cycle: Duration,
    /// In the nodes of the cycle, without what they were blocked.
    in_nodes: Duration,
    /// The node of the cycle that took longest, if they were timed.
    longest: Option<(&'static str, Duration)>,
    /// Allocations of the nodes of the cycle.
    allocations_in_nodes: u64,
    /// Of each node, in manifest order.
    nodes: Vec<OfNode>,
    /// The cycle after an overrun is timed, so that there is somebody to blame.
    overran: bool,
    durations: Durations,
    allocations: CycleAllocations,
    slowest: Vec<(&'static str, u64)>,
    /// For a server that may be asked for a trace.
    spans: Option<SpanWriter>,
    /// The cycle.
    began: Option<Ticks>,
    /// On a stepped clock: when its nodes were done.
    ran: Option<Ticks>,
}

#[derive(Debug)]
struct OfNode {
    node: &'static str,
    times: Histogram,
    allocations: Allocations,
}

#[derive(Debug, Default)]
struct Lap {
    since: Option<(Ticks, u64)>,
    spent: Duration,
    allocations: u64,
}

impl Stopwatch {
    pub(super) fn new(
        clock: &Clock,
        deadline: Option<Duration>,
        nodes: impl Iterator<Item = &'static str>,
    ) -> Self {
        Ticks::calibrate();
        Self {
            stepped: clock.is_stepped(),
            deadline: deadline.filter(|_| !clock.is_stepped()),
            waiting: Lap::default(),
            blocked: Duration::ZERO,
            cycle: Lap::default(),
            blocked_in_cycle: Duration::ZERO,
            in_nodes: Duration::ZERO,
            longest: None,
            allocations_in_nodes: 0,
            nodes: nodes
                .map(|node| OfNode {
                    node,
                    times: Histogram::default(),
                    allocations: Allocations::default(),
                })
                .collect(),
            overran: false,
            durations: Durations::default(),
            allocations: CycleAllocations::default(),
            slowest: Vec::new(),
            spans: None,
            began: None,
            ran: None,
        }
    }

    /// From now on timed cycles leave their spans, too.
    pub(super) fn trace(&mut self, spans: SpanWriter) {
        self.spans = Some(spans);
    }

    #[inline]
    pub(super) fn looks_closely(&self) -> bool {
        self.overran
    }

    pub(super) fn start_waiting(&mut self) {
        timing::prepare_laps(self.nodes.len());
        if let Some(spans) = &mut self.spans {
            spans.start();
        }
        self.waiting.start();
    }

    #[inline]
    pub(super) fn end_waiting(&mut self, cycle: u64, tally: &Tally) {
        if self.waiting.since.is_some() {
            self.end_laps(cycle);
            self.waiting.pause();
            self.blocked += tally.blocked;
        }
    }

    /// `late`: how old the data of the cycle is.
    #[inline]
    pub(super) fn begin(&mut self, timed: bool, late: Duration) {
        if timed {
            self.durations.lateness.record(late);
        }
        if timed || self.deadline.is_some() {
            self.in_nodes = Duration::ZERO;
            self.allocations_in_nodes = 0;
            self.longest = None;
            self.cycle.start();
            self.began = self.cycle.since.map(|(began, _)| began);
        }
    }

    #[inline]
    pub(super) fn end_running(&mut self, cycle: u64, timed: bool, tally: &Tally) {
        if timed {
            self.end_laps(cycle);
            self.blocked_in_cycle = tally.blocked;
        }
        if self.stepped && self.cycle.since.is_some() {
            self.ran = Some(Ticks::now());
            self.cycle.pause();
        }
    }

    #[cold]
    fn end_laps(&mut self, cycle: u64) {
        let mut before = self.nodes.len();
        timing::end_laps(|node, took| {
            // Mostly nodes run in manifest order.
            let expected = before.wrapping_sub(1);
            let is_node = |place: &usize| {
                self.nodes
                    .get(*place)
                    .is_some_and(|there| there.node == node)
            };
            let place = Some(expected).filter(is_node);
            let place = place.or_else(|| (0..self.nodes.len()).find(is_node));
            if let Some(place) = place {
                self.nodes[place].times.record(took.time);
                self.nodes[place].allocations.record(took.allocations);
                before = place;
            }
            if let Some(spans) = &mut self.spans {
                spans.write(Some(node), cycle, took.begins, took.ends);
            }
            self.in_nodes += took.time;
            self.allocations_in_nodes += took.allocations;
            if self.longest.is_none_or(|(_, longest)| took.time > longest) {
                self.longest = Some((node, took.time));
            }
        });
    }

    #[inline]
    pub(super) fn resume(&mut self) {
        if self.stepped && !self.cycle.spent.is_zero() {
            self.cycle.start();
        }
    }

    /// The cycle was published; whether it took too long.
    #[inline]
    pub(super) fn finish(&mut self, cycle: u64, timed: bool) -> bool {
        if !timed && self.deadline.is_none() {
            self.overran = false;
            return false;
        }
        self.end(cycle, timed)
    }

    fn end(&mut self, cycle: u64, timed: bool) -> bool {
        let (took, allocations) = self.cycle.take();
        let (waited, _) = self.waiting.take();
        let blocked = std::mem::take(&mut self.blocked);
        if timed {
            let elsewhere = self.in_nodes + self.blocked_in_cycle;
            if let (Some(spans), Some(began)) = (&mut self.spans, self.began.take()) {
                let ends = self.ran.take().unwrap_or_else(Ticks::now);
                spans.write(None, cycle, began, ends);
            }
            self.durations.cycle.record(took);
            self.durations
                .framework
                .record(took.saturating_sub(elsewhere));
            self.allocations.cycle.record(allocations);
            let framework = allocations.saturating_sub(self.allocations_in_nodes);
            self.allocations.framework.record(framework);
            self.durations.wait.record(blocked);
            self.durations.setup.record(waited.saturating_sub(blocked));
        }
        self.overran = self.deadline.is_some_and(|deadline| took > deadline);
        if self.overran {
            self.blame();
        }
        self.overran
    }

    pub(super) fn discard(&mut self) {
        self.waiting.take();
        self.cycle.take();
        self.blocked = Duration::ZERO;
    }

    pub(super) fn durations(&self) -> &Durations {
        &self.durations
    }

    pub(super) fn allocations(&self) -> CycleAllocations {
        self.allocations
    }

    /// Adds what is known of the calls of a node that were timed.
    pub(super) fn complete(&self, report: &mut NodeReport) {
        let found = self.nodes.iter().find(|there| there.node == report.node);
        if let Some(OfNode {
            times, allocations, ..
        }) = found
        {
            report.histogram.clone_from(times);
            report.allocations = *allocations;
        }
    }

    pub(super) fn slowest(&self) -> &[(&'static str, u64)] {
        &self.slowest
    }

    #[cold]
    fn blame(&mut self) {
        let Some((node, _)) = self.longest else {
            return;
        };
        match self.slowest.iter_mut().find(|(known, _)| *known == node) {
            Some((_, overruns)) => *overruns += 1,
            None => self.slowest.push((node, 1)),
        }
    }
}

impl Lap {
    #[inline]
    fn start(&mut self) {
        self.since = Some((Ticks::now(), timing::allocations_so_far()));
    }

    #[inline]
    fn pause(&mut self) {
        if let Some((since, allocations)) = self.since.take() {
            self.spent += Ticks::now().since(since);
            self.allocations += timing::allocations_so_far() - allocations;
        }
    }

    #[inline]
    fn take(&mut self) -> (Duration, u64) {
        self.pause();
        let spent = std::mem::take(&mut self.spent);
        (spent, std::mem::take(&mut self.allocations))
    }
}
