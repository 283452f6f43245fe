//! The loop that turns a body, whichever driver asks.

mod failure;
mod loaded;
mod stopwatch;

use std::sync::Arc;
use std::time::Duration;

use super::restarts::Restarts;
use super::{
    Body, Counters, Cycle, Finished, Instance, InstanceDescription, Kind, Reference, Restarted,
    Slots, Waited,
};
use crate::buffer::Writer;
use crate::clock::Clock;
use crate::error::{Error, Result};
use crate::guarded::{OnFailure, State, contain};
use crate::logs;
use crate::recorded::{self, Capture, Digests, Forms, Head, Recorded, SaveError, Saving, Types};
use crate::reflect::Reflect;
use crate::report::{InstanceReport, NodeReport, SlotsReport};
use crate::subscriptions::Subscriptions;
use crate::tap::{Reports, Tap, Taps};
use crate::time::{CycleTime, Timestamp};
use crate::timing::{self, SpanWriter, Tally};
use failure::Consequence;
use stopwatch::Stopwatch;

/// One instance: its generated body, and the writer of what others read.
pub struct Cycler<B: Body> {
    description: InstanceDescription,
    body: B,
    writer: Writer<B::Shared>,
    clock: Clock,
    cycle: Cycle,
    /// Number of the last finished cycle.
    finished: u64,
    /// Given by a setup node in the `wait` that is over.
    captured: Option<Timestamp>,
    /// Whether the cycle that `wait` prepares is timed.
    timed: bool,
    phase: Phase,
    /// Of the cycle that began, until `finish`.
    failure: Option<Error>,
    restarts: Restarts,
    counters: Arc<Counters>,
    stopwatch: Stopwatch,
    /// Where a server looks on.
    taps: Option<Taps>,
    /// Of nodes that were replaced in a restart.
    retired: Vec<NodeReport>,
}

/// What the instance has behind it; each cycle begins and ends, a restart starts over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Just created: there is no cycle before.
    Fresh { restarted: bool },
    /// Between `begin` and `finish`.
    Begun { restarted: bool },
    /// At least one cycle began since the nodes were created.
    Between { restarted: bool },
}

impl<B: Recorded> Cycler<B> {
    /// An instance whose nodes were just created.
    pub fn new(
        description: InstanceDescription,
        body: B,
        writer: Writer<B::Shared>,
        clock: Clock,
    ) -> Self {
        let mut nodes = Vec::new();
        body.nodes(&mut |node| nodes.push(node.node));
        let stopwatch = Stopwatch::new(&clock, description.deadline, nodes.into_iter());
        Self {
            stopwatch,
            description,
            body,
            writer,
            clock,
            cycle: Cycle::default(),
            finished: 0,
            captured: None,
            timed: false,
            phase: Phase::Fresh { restarted: false },
            failure: None,
            restarts: Restarts::default(),
            counters: Arc::default(),
            taps: None,
            retired: Vec::new(),
        }
    }

    /// The body, for tests.
    pub fn body(&self) -> &B {
        &self.body
    }

    /// A capture time that would break the order of time is replaced.
    #[inline]
    fn timestamp(&mut self, now: Timestamp) -> Timestamp {
        let oldest = self.description.oldest_capture();
        let usable = |captured: &Timestamp| *captured <= now && now - *captured <= oldest;
        let captured = self.captured.take();
        let mut start = captured.filter(usable).unwrap_or(now);
        if self.cycle.number > 0 {
            start = start.max(self.cycle.time.start.next());
        }
        self.counters.corrected.add(u64::from(
            captured.is_some_and(|captured| captured != start),
        ));
        start
    }

    fn count(&self, tally: &Tally) {
        self.counters.failures.add(tally.failures);
        self.counters.skipped.add(tally.skipped);
    }

    fn publish(&mut self) -> Finished {
        let Cycle {
            number,
            time,
            timed,
            ..
        } = self.cycle;
        self.writer.complete(number, time.start);
        self.finished = number;
        self.counters.cycles.add(1);
        self.counters.end();
        let is_overrun = self.stopwatch.finish(number, timed);
        self.counters.overruns.add(u64::from(is_overrun));
        if self.phase.restarted() {
            self.phase = Phase::Between { restarted: false };
            Finished::Recovered
        } else {
            Finished::Completed
        }
    }

    #[cold]
    fn send_report(&self) {
        if let Some(taps) = &self.taps {
            taps.report(|report| self.fill(report));
        }
    }

    /// What the instance did so far, in place of what the report said: in memory that it has already.
    fn fill(&self, report: &mut InstanceReport) {
        let mut known = 0;
        self.body.nodes(&mut |mut node| {
            self.add_retired(&mut node);
            match report.nodes.get_mut(known) {
                Some(there) => there.count_as(&node),
                None => report.nodes.push(node),
            }
            known += 1;
        });
        report.nodes.truncate(known);
        for node in &mut report.nodes {
            self.stopwatch.complete(node);
        }
        report.queues.clear();
        self.body.queues(&mut |queue| report.queues.push(queue));
        let (number, bytes) = self.writer.size();
        report.slots = SlotsReport { number, bytes };
        report.counts = self.counters.read();
        if report.granted.as_ref() != self.counters.granted() {
            report.granted = self.counters.granted().cloned();
        }
        report.slowest.clear();
        report.slowest.extend_from_slice(self.stopwatch.slowest());
        report.durations.clone_from(self.stopwatch.durations());
        report.allocations = self.stopwatch.allocations();
    }

    fn add_retired(&self, node: &mut NodeReport) {
        let mut retired = self.retired.iter();
        if let Some(retired) = retired.find(|retired| retired.node == node.node) {
            node.merge(retired);
        }
    }

    /// Keeps what the nodes counted; they are about to be replaced.
    fn nodes_so_far(&self) -> Vec<NodeReport> {
        let mut nodes = Vec::new();
        self.body.nodes(&mut |mut node| {
            self.add_retired(&mut node);
            nodes.push(node);
        });
        nodes
    }
}

impl<B: Recorded> Instance for Cycler<B> {
    fn description(&self) -> &InstanceDescription {
        &self.description
    }

    fn cycle(&self) -> Cycle {
        self.cycle
    }

    #[inline]
    fn wait(&mut self) -> Result<Waited> {
        let number = self.cycle.number + 1;
        logs::enter(self.description.name, number);
        self.timed = timing::is_timed(number) || self.stopwatch.looks_closely();
        let cycle = Cycle {
            number,
            time: self.cycle.time,
            timed: self.timed,
            in_setup: true,
            partial: false,
        };
        let Self {
            body,
            writer,
            stopwatch,
            ..
        } = self;
        let (current, previous) = writer.slots();
        // What this thread did in between is nobody's.
        Tally::take();
        if cycle.timed {
            stopwatch.start_waiting();
        }
        let result = contain(self.description.name, || {
            body.wait(Slots { current, previous }, cycle)
        });
        let tally = Tally::take();
        stopwatch.end_waiting(number, &tally);
        self.count(&tally);
        match result {
            Ok(captured) => {
                self.captured = captured;
                Ok(Waited::Ready)
            }
            Err(error) if error.is_no_event() && !error.is_stopped() => {
                self.counters.no_events.add(1);
                Ok(Waited::NoEvent)
            }
            Err(error) => Ok(
                match self.judge(error.in_cycle(number), self.description.on_failure)? {
                    Consequence::Stopped => Waited::Stopped,
                    Consequence::StartOver => Waited::Failed,
                    Consequence::Restart { at } => Waited::Restarting { at },
                },
            ),
        }
    }

    #[inline]
    fn begin(&mut self) {
        self.abandon();
        let now = self.clock.now();
        let start = self.timestamp(now);
        self.stopwatch.begin(self.timed, now - start);
        let since_last = match self.phase {
            Phase::Fresh { .. } => Duration::ZERO,
            Phase::Begun { .. } | Phase::Between { .. } => start - self.cycle.time.start,
        };
        self.cycle = Cycle {
            number: self.cycle.number + 1,
            time: CycleTime { start, since_last },
            timed: self.timed,
            in_setup: false,
            partial: false,
        };
        self.phase = Phase::Begun {
            restarted: self.phase.restarted(),
        };
        self.counters.begin(now);
        if self.description.kind == Kind::Perception {
            self.writer.announce(start);
        }
        let Self {
            body,
            writer,
            cycle,
            ..
        } = self;
        let (current, previous) = writer.slots();
        let begun = contain(self.description.name, || {
            body.begin(Slots { current, previous }, *cycle);
            Ok(())
        });
        self.failure = begun.err();
    }

    #[inline]
    fn run(&mut self) {
        logs::enter(self.description.name, self.cycle.number);
        if self.failure.is_none() && self.phase.begun() {
            let Self {
                body,
                writer,
                cycle,
                ..
            } = self;
            let (current, previous) = writer.slots();
            let ran = contain(self.description.name, || {
                body.run(Slots { current, previous }, *cycle)
            });
            self.failure = ran.err();
        }
        let tally = Tally::take();
        self.stopwatch
            .end_running(self.cycle.number, self.cycle.timed, &tally);
        self.count(&tally);
    }

    #[inline]
    fn finish(&mut self) -> Result<Finished> {
        if !self.phase.begun() {
            return Ok(Finished::Abandoned);
        }
        self.stopwatch.resume();
        let Self {
            body,
            writer,
            cycle,
            taps,
            ..
        } = self;
        let mut wants_report = false;
        let result = match self.failure.take() {
            Some(error) => Err(error),
            None => contain(self.description.name, || {
                let shared = writer.slots().0;
                body.finish(shared, *cycle);
                if let Some(taps) = taps {
                    let look = taps.look();
                    wants_report = look.wants_report;
                    if look.is_open {
                        body.outputs(shared, cycle.number, &mut taps.copying(*cycle));
                    }
                }
                Ok(())
            }),
        };
        self.phase = Phase::Between {
            restarted: self.phase.restarted(),
        };
        let Err(error) = result else {
            let finished = self.publish();
            if wants_report {
                self.send_report();
            }
            return Ok(finished);
        };
        let number = self.cycle.number;
        self.give_up();
        Ok(
            match self.judge(error.in_cycle(number), self.description.on_failure)? {
                Consequence::Stopped => Finished::Stopped,
                Consequence::StartOver => Finished::Abandoned,
                Consequence::Restart { at } => Finished::Restarting { at },
            },
        )
    }

    fn abandon(&mut self) {
        if self.phase.begun() {
            self.phase = Phase::Between {
                restarted: self.phase.restarted(),
            };
            self.failure = None;
            self.give_up();
        }
    }

    fn restart(&mut self) -> Result<Restarted> {
        logs::enter(self.description.name, self.cycle.number + 1);
        self.abandon();
        self.counters.restarts.add(1);
        let nodes = self.nodes_so_far();
        match contain(self.description.name, || self.body.create()) {
            Ok(()) => {
                self.retired = nodes;
                self.phase = Phase::Fresh { restarted: true };
                Ok(Restarted::Done)
            }
            Err(error) => Ok(match self.judge(error, OnFailure::Restart)? {
                Consequence::Stopped => Restarted::Stopped,
                Consequence::Restart { at } => Restarted::Again { at },
                Consequence::StartOver => Restarted::Again {
                    at: self.clock.now() + super::PAUSE_AFTER_SETUP_FAILURE,
                },
            }),
        }
    }

    fn counters(&self) -> &Arc<Counters> {
        &self.counters
    }

    fn report(&self) -> InstanceReport {
        let mut report = InstanceReport::empty(self.description);
        self.fill(&mut report);
        report
    }

    fn main_outputs(&self) -> &'static [&'static str] {
        self.body.main_outputs()
    }

    fn main_output(&self, name: &str) -> Option<&dyn Reflect> {
        self.body.main_output(&self.writer.newest().value, name)
    }

    fn additional_output(&self, name: &str) -> Option<&dyn Reflect> {
        self.body.additional_output(name, self.finished)
    }

    fn tap(&mut self, subscriptions: &Subscriptions) -> (Vec<Tap>, Reports) {
        let (body, shared) = (&self.body, &self.writer.newest().value);
        let first = Box::new(self.report());
        let (ends, taps, reports) =
            Taps::new(body.main_outputs(), subscriptions, first, |builder| {
                body.outputs(shared, 0, builder);
            });
        let spans = SpanWriter::new(reports.spans().clone(), self.clock.clone());
        self.stopwatch.trace(spans);
        self.taps = Some(ends);
        (taps, reports)
    }

    fn forms(&self, forms: &mut Forms) {
        self.body.outputs(&self.writer.newest().value, 0, forms);
    }

    fn references(&self, visit: &mut dyn FnMut(Reference)) {
        self.body.references(visit);
    }

    fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn State)) {
        self.body.states(visit);
    }

    fn restore(&mut self) -> Result<()> {
        self.body.restore()
    }

    fn save(&mut self, capture: &mut Capture<'_, '_>) -> Result<(), SaveError> {
        let cycle = self.cycle;
        self.body.values(&mut capture.values(cycle.time.start))?;
        let head = Head {
            number: cycle.number,
            start: cycle.time.start,
            since_last: cycle.time.since_last,
            restarted: self.phase.restarted(),
            whole: false,
        };
        capture.frame(head, |since, out| self.save_alone(since, out))
    }

    fn save_alone(&mut self, since: Option<Timestamp>, out: &mut Saving<'_, '_>) {
        let (current, previous) = self.writer.slots();
        let slots = Slots { current, previous };
        self.body.save(self.cycle.number, slots, since, out);
    }

    fn types(&self) -> Types {
        recorded::describe::<B>()
    }

    fn save_digests(&self, digests: &mut Digests<'_, '_>) {
        self.body.digests(&self.writer.newest().value, digests);
    }

    fn digested(&self) -> &'static [(&'static str, &'static str)] {
        B::DIGESTED
    }
}

impl Phase {
    #[inline]
    fn begun(self) -> bool {
        matches!(self, Self::Begun { .. })
    }

    #[inline]
    fn restarted(self) -> bool {
        match self {
            Self::Fresh { restarted } | Self::Begun { restarted } | Self::Between { restarted } => {
                restarted
            }
        }
    }
}
