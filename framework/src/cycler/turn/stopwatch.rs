//! Where the time of one instance's cycles goes.

use std::time::Duration;

use crate::clock::Clock;
use crate::report::{Allocations, CycleAllocations, Durations, NodeReport};
use crate::timing::{self, Histogram, Laps, SpanWriter, Tally, Ticks};

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
    /// Of the nodes that ran, until they are counted.
    laps: Laps,
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
            laps: Laps::default(),
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
        self.laps.prepare(self.nodes.len());
        if let Some(spans) = &mut self.spans {
            spans.start();
        }
        self.waiting.start();
    }

    #[inline]
    pub(super) fn end_waiting(&mut self, cycle: u64, tally: &Tally) {
        if self.waiting.since.is_some() {
            self.laps.end();
            self.waiting.pause();
            self.count_laps(cycle);
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
            self.laps.end();
            self.blocked_in_cycle = tally.blocked;
        }
        if self.stepped && self.cycle.since.is_some() {
            self.ran = Some(Ticks::now());
            self.cycle.pause();
            // Who asks before `finish` finds them counted.
            self.count_laps(cycle);
        }
    }

    /// Touches memory of every node that nothing else does, several microseconds of it at the pace of a body.
    #[cold]
    fn count_laps(&mut self, cycle: u64) {
        let mut before = self.nodes.len();
        self.laps.tell(|node, took| {
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
            let ended = self.ran.take().unwrap_or_else(Ticks::now);
            // The cycle is published and over: nobody waits for this.
            self.count_laps(cycle);
            let elsewhere = self.in_nodes + self.blocked_in_cycle;
            if let (Some(spans), Some(began)) = (&mut self.spans, self.began.take()) {
                spans.write(None, cycle, began, ended);
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

    /// The cycle was given up: of what it took, that of its nodes alone counts.
    pub(super) fn discard(&mut self, cycle: u64) {
        self.count_laps(cycle);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timing::Spans;

    const WORK: Duration = Duration::from_millis(2);

    /// How often the node was timed.
    fn count(stopwatch: &Stopwatch, node: &str) -> u64 {
        let mut nodes = stopwatch.nodes.iter();
        let found = nodes.find(|there| there.node == node);
        found.map_or(0, |there| there.times.count())
    }

    /// Three cycles of a setup node and two others; the nodes of their spans.
    fn turn(
        clock: Clock,
        mut ran: impl FnMut(&Stopwatch, u64),
        mut end: impl FnMut(&mut Stopwatch, u64),
    ) -> (Stopwatch, Vec<Option<&'static str>>) {
        let nodes = ["setup", "first", "second"];
        let mut stopwatch = Stopwatch::new(&clock, None, nodes.into_iter());
        let spans = Spans::new();
        stopwatch.trace(SpanWriter::new(spans.clone(), clock));
        for cycle in 1..=3 {
            stopwatch.start_waiting();
            timing::start_lap("setup");
            stopwatch.end_waiting(cycle, &Tally::take());
            assert_eq!(count(&stopwatch, "setup"), cycle);
            stopwatch.begin(true, Duration::ZERO);
            for node in ["first", "second"] {
                timing::start_lap(node);
                std::thread::sleep(WORK);
            }
            stopwatch.end_running(cycle, true, &Tally::take());
            ran(&stopwatch, cycle);
            end(&mut stopwatch, cycle);
            assert_eq!(
                ["first", "second"].map(|node| count(&stopwatch, node)),
                [cycle; 2]
            );
        }
        let spans = std::iter::from_fn(|| spans.take());
        let nodes = spans.map(|span| span.node).collect();
        (stopwatch, nodes)
    }

    fn finish(stopwatch: &mut Stopwatch, cycle: u64) {
        stopwatch.resume();
        assert!(!stopwatch.finish(cycle, true), "there is no deadline");
    }

    #[test]
    fn nodes_are_counted_after_their_cycle() {
        let not_yet = |stopwatch: &Stopwatch, cycle| {
            assert_eq!(count(stopwatch, "first"), cycle - 1);
        };
        let (stopwatch, spans) = turn(Clock::wall(), not_yet, finish);
        assert_eq!(
            spans,
            [Some("setup"), Some("second"), Some("first"), None].repeat(3)
        );
        let Durations {
            cycle, framework, ..
        } = stopwatch.durations();
        assert_eq!((cycle.count(), framework.count()), (3, 3));
        assert!(cycle.longest() >= 2 * WORK);
        let outside = cycle.longest().saturating_sub(framework.longest());
        assert!(outside >= WORK, "the nodes are not the framework's");
    }

    #[test]
    fn on_a_stepped_clock_nodes_are_counted_when_they_ran() {
        let counted = |stopwatch: &Stopwatch, cycle| assert_eq!(count(stopwatch, "first"), cycle);
        let (stopwatch, _) = turn(Clock::stepped(), counted, finish);
        assert_eq!(stopwatch.durations().framework.count(), 3);
    }

    #[test]
    fn nodes_of_a_cycle_that_is_given_up_are_counted() {
        let (stopwatch, spans) = turn(Clock::wall(), |_, _| (), Stopwatch::discard);
        assert_eq!(
            spans,
            [Some("setup"), Some("second"), Some("first")].repeat(3)
        );
        assert_eq!(stopwatch.durations().cycle.count(), 0);
    }
}
