//! What a run was like: counts and durations of instances, nodes and queues.

mod json;
mod text;

use std::fmt;
use std::io::Write;
use std::time::Duration;

use crate::cycler::{Counts, InstanceDescription};
use crate::robot::Robot;
use crate::scheduling::Granted;
use crate::temporal::QueueCounts;
use crate::timing::Histogram;

/// A whole run.
#[derive(Clone, Debug)]
pub struct RobotReport {
    /// Name of the target that ran.
    pub target: &'static str,
    /// How long the driver ran.
    pub duration: Duration,
    /// In manifest order.
    pub instances: Vec<InstanceReport>,
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
    /// Of the overruns: how many had this node as the one that took longest, as far as they were timed.
    pub slowest: Vec<(&'static str, u64)>,
    /// Durations of timed cycles.
    pub durations: Durations,
    /// In manifest order.
    pub nodes: Vec<NodeReport>,
    /// In manifest order of the instances that it consumes.
    pub queues: Vec<QueueReport>,
}

/// Where the time of an instance's timed cycles went.
#[derive(Clone, Debug, Default)]
pub struct Durations {
    /// From the capture point to the end of the cycle.
    pub cycle: Histogram,
    /// Blocked inside the hardware interface before the capture point.
    pub wait: Histogram,
    /// The rest before the capture point.
    pub setup: Histogram,
    /// From the capture point to the end, without the nodes.
    pub framework: Histogram,
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
}

/// What one consumer got of one perception instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QueueReport {
    /// The perception instance.
    pub from: &'static str,
    /// Its cycles, as far as this consumer is concerned.
    pub counts: QueueCounts,
}

/// Tells whoever watches standard error, in one piece; if nobody can read it, the robot goes on.
pub(crate) fn tell(message: fmt::Arguments<'_>) {
    let text = format!("{message}\n");
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
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
        }
    }
}

impl InstanceReport {
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
    /// Adds what another copy of the same node did before.
    pub fn merge(&mut self, other: &Self) {
        self.calls += other.calls;
        self.skipped += other.skipped;
        self.failures += other.failures;
        self.histogram.merge(&other.histogram);
    }
}
