//! What a run was like: counts and durations of instances, nodes and queues.

mod json;
mod standard_error;
mod text;

use std::time::Duration;

use crate::cycler::{Counts, InstanceDescription};
use crate::recorded::RecordingReport;
use crate::robot::Robot;
use crate::scheduling::Granted;
use crate::temporal::QueueCounts;
use crate::timing::{CountingAllocator, Histogram};

pub(crate) use standard_error::{flush, keep_from_robot, tell, tell_test};
pub(crate) use text::plural;

/// A whole run.
#[derive(Debug)]
pub struct RobotReport {
    /// Name of the target that ran.
    pub target: &'static str,
    /// How long the driver ran.
    pub duration: Duration,
    /// In manifest order.
    pub instances: Vec<InstanceReport>,
    /// What was recorded, if anything was.
    pub recording: Option<RecordingReport>,
}

/// What one instance did.
#[derive(Clone, Debug)]
pub struct InstanceReport {
    /// What the manifest says about it.
    pub description: InstanceDescription,
    /// Its counts so far.
    pub counts: Counts,
    /// What the system gave its thread, where something was asked.
    pub granted: Option<Granted>,
    /// Slots of what others read of it.
    pub slots: SlotsReport,
    /// Of the overruns: how many had this node as the one that took longest, as far as they were timed.
    pub slowest: Vec<(&'static str, u64)>,
    /// Durations of timed cycles.
    pub durations: Durations,
    /// Allocations of timed cycles.
    pub allocations: CycleAllocations,
    /// In manifest order.
    pub nodes: Vec<NodeReport>,
    /// In manifest order of the instances that it consumes.
    pub queues: Vec<QueueReport>,
}

/// The slots of one instance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SlotsReport {
    /// How many: enough for its readers and consumers.
    pub number: usize,
    /// Of all together, without what values own on the heap.
    pub bytes: usize,
}

/// Where the time of an instance's timed cycles went.
#[derive(Debug, Default)]
pub struct Durations {
    /// From the capture point to the end of the cycle.
    pub cycle: Histogram,
    /// From the capture time that a setup node gave to the begin of the cycle; zero where none gives one.
    pub lateness: Histogram,
    /// Blocked inside the hardware interface before the capture point.
    pub wait: Histogram,
    /// The rest before the capture point.
    pub setup: Histogram,
    /// From the capture point to the end, without the nodes.
    pub framework: Histogram,
}

/// How often something allocated; zeros where nobody counts: see [`CountingAllocator`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Allocations {
    /// How many times it was looked at.
    pub looks: u64,
    /// All together.
    pub total: u64,
    /// The most in one look.
    pub most: u64,
}

/// From the capture point to the end of a timed cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CycleAllocations {
    /// Of nodes and framework.
    pub cycle: Allocations,
    /// Of the framework alone.
    pub framework: Allocations,
}

/// What one node did.
#[derive(Clone, Debug)]
pub struct NodeReport {
    /// Its path in the manifest.
    pub node: &'static str,
    /// How often it was called.
    pub calls: u64,
    /// How often it was not, because a required input was absent.
    pub skipped: u64,
    /// Calls that ended in an error or a panic.
    pub failures: u64,
    /// Durations of timed calls, without what they were blocked inside the hardware interface.
    pub histogram: Histogram,
    /// Allocations of timed calls.
    pub allocations: Allocations,
}

/// What one consumer got of one perception instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QueueReport {
    /// The perception instance.
    pub from: &'static str,
    /// Its cycles, as far as this consumer is concerned.
    pub counts: QueueCounts,
}

impl RobotReport {
    /// What all instances did so far.
    pub fn new<P>(target: &'static str, duration: Duration, robot: &Robot<P>) -> Self {
        let instances = robot
            .instances
            .iter()
            .map(|instance| instance.report())
            .collect();
        Self {
            target,
            duration,
            instances,
            recording: None,
        }
    }
}

/// [`Clone::clone_from`] keeps the memory of the histograms.
impl Clone for Durations {
    fn clone(&self) -> Self {
        let mut durations = Self::default();
        durations.clone_from(self);
        durations
    }

    fn clone_from(&mut self, other: &Self) {
        let Self {
            cycle,
            lateness,
            wait,
            setup,
            framework,
        } = self;
        cycle.clone_from(&other.cycle);
        lateness.clone_from(&other.lateness);
        wait.clone_from(&other.wait);
        setup.clone_from(&other.setup);
        framework.clone_from(&other.framework);
    }
}

impl InstanceReport {
    /// Of an instance that has done nothing.
    pub(crate) fn empty(description: InstanceDescription) -> Self {
        Self {
            description,
            counts: Counts::default(),
            granted: None,
            slots: SlotsReport::default(),
            slowest: Vec::new(),
            durations: Durations::default(),
            allocations: CycleAllocations::default(),
            nodes: Vec::new(),
            queues: Vec::new(),
        }
    }

    /// Finished cycles per second of the run.
    pub fn rate(&self, duration: Duration) -> f64 {
        if duration.is_zero() {
            0.0
        } else {
            self.counts.cycles as f64 / duration.as_secs_f64()
        }
    }
}

impl NodeReport {
    /// Counts what `other` counted; histogram and allocations stay.
    pub(crate) fn count_as(&mut self, other: &Self) {
        self.node = other.node;
        self.calls = other.calls;
        self.skipped = other.skipped;
        self.failures = other.failures;
    }

    /// Adds what another copy of the same node did before.
    pub fn merge(&mut self, other: &Self) {
        self.calls += other.calls;
        self.skipped += other.skipped;
        self.failures += other.failures;
        self.histogram.merge(&other.histogram);
        self.allocations.merge(&other.allocations);
    }
}

impl Allocations {
    /// On average in one look; `None` without a look, and where nobody counts.
    pub fn mean(&self) -> Option<f64> {
        CountingAllocator::of_this_thread()?;
        (self.looks > 0).then(|| self.total as f64 / self.looks as f64)
    }

    pub(crate) fn record(&mut self, allocations: u64) {
        self.looks += 1;
        self.total += allocations;
        self.most = self.most.max(allocations);
    }

    fn merge(&mut self, other: &Self) {
        self.looks += other.looks;
        self.total += other.total;
        self.most = self.most.max(other.most);
    }
}
