//! How long things take.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// All instances since the start.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Timings {
    /// The robot's clock, in nanoseconds: what lies between two of these happened between their times.
    pub time: u64,
    /// In manifest order.
    pub instances: Vec<InstanceTimings>,
    /// Instances that other machines run, in manifest order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remotes: Vec<RemoteTimings>,
    /// What became of the frames of a recording: by instance in manifest order, then values of outputs, then log messages; absent
    /// where nothing is recorded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recording: Vec<RecordingCounts>,
}

/// One instance.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct InstanceTimings {
    /// Its name.
    pub name: String,
    /// Finished cycles.
    pub cycles: u64,
    /// Cycles that took longer than the deadline.
    pub overruns: u64,
    /// Cycles that failed.
    pub failures: u64,
    /// How long a cycle may take, in microseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deadline: Option<f64>,
    /// From the capture point to the end; absent where nothing was timed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycle: Option<Durations>,
    /// From the capture time of the data to the begin of the cycle; absent where nothing was timed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateness: Option<Durations>,
    /// Of `cycle`, what was not spent in nodes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub framework: Option<Durations>,
    /// What the system granted its thread; absent where nothing was asked: by the manifest, or on a simulated target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scheduling: Option<Granted>,
    /// In the order in which they run.
    pub nodes: Vec<NodeTimings>,
    /// Perception instances that it consumes.
    pub queues: Vec<QueueTimings>,
}

/// What holds for a thread, as the system says itself.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Granted {
    /// `other`, `fifo` or `round-robin`; absent: one that no manifest can ask for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub policy: Option<String>,
    /// 1 to 99 with a real-time policy, else 0.
    pub priority: u8,
    /// The cores it may run on, counted from 0.
    pub cores: Vec<u32>,
    /// Whether this thread has locked the memory of the process.
    pub memory_locked: bool,
}

/// One node of an instance.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct NodeTimings {
    /// Its path in the manifest.
    pub node: String,
    /// How often it ran.
    pub calls: u64,
    /// How often it did not, because a required input was absent.
    pub skipped: u64,
    /// How often it failed.
    pub failures: u64,
    /// Of timed calls; absent where nothing was timed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub durations: Option<Durations>,
}

/// Cycles of a perception instance, as far as one consumer is concerned.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct QueueTimings {
    /// The perception instance.
    pub from: String,
    /// Cycles that came.
    pub delivered: u64,
    /// Cycles that came after the consumer had gone on without them.
    pub late: u64,
    /// Cycles that found no place.
    pub dropped: u64,
}

/// An instance that another machine runs. Every cycle that began was completed, was abandoned, or is announced.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct RemoteTimings {
    /// Its name.
    pub name: String,
    /// Whether a client feeds it.
    pub is_fed: bool,
    /// Cycles that are complete.
    pub completed: u64,
    /// Of those: never announced, so that nobody waited for them.
    pub unannounced: u64,
    /// Cycles that were announced and not completed: withdrawn, ended by the next, or left by the client.
    pub abandoned: u64,
    /// Messages that were refused.
    pub refused: u64,
}

/// What became of the frames of one instance in a recording, until now.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct RecordingCounts {
    /// The instance; `INSTANCE.outputs`: values of its outputs; `logs`: log messages.
    pub of: String,
    /// Whole frames that were handed over to be written.
    pub recorded: u64,
    /// Frames for which there was no room.
    pub dropped: u64,
    /// Frames of which something could not be encoded.
    pub failed: u64,
    /// Of those recorded: the disk did not take them, or a value could not be written.
    pub lost: u64,
    /// Of those recorded: older ones that went because the file has no room for more.
    pub overwritten: u64,
}

impl RecordingCounts {
    /// Frames that are not in the file and never were.
    pub fn missing(&self) -> u64 {
        let parts = [self.dropped, self.failed, self.lost];
        parts.into_iter().fold(0, u64::saturating_add)
    }
}

/// Durations in microseconds.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Durations {
    /// Half are shorter.
    pub p50: f64,
    /// Of 100, 99 are shorter.
    pub p99: f64,
    /// The longest.
    pub max: f64,
}
