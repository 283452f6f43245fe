//! Cyclers, their instances and their nodes.

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use crate::either::{deserialize_either, either};
use crate::length::Duration;
use crate::spelling::{CyclerName, InstanceName, InstanceSuffix, NodePath};

/// Nodes that a driver runs again and again, one thread per instance or in lockstep.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Cycler {
    /// UpperCamelCase name.
    pub name: CyclerName,
    /// How its cycles are handed on.
    pub kind: CyclerKind,
    /// Running copies. Left out: one, named like the cycler.
    #[serde(default)]
    #[schemars(length(min = 1))]
    pub instances: Option<Vec<Instance>>,
    /// Nodes that run first and wait for the data of the cycle.
    #[serde(default)]
    pub setup_nodes: Vec<NodeEntry>,
    /// All other nodes; they run in this order as far as their inputs allow.
    #[serde(default)]
    pub nodes: Vec<NodeEntry>,
    /// A longer cycle is an overrun, for example "12ms". Left out: none.
    #[serde(default)]
    pub deadline: Option<Duration>,
    /// Perception: an announcement older than this is no longer waited for. Left out: "1s".
    #[serde(default)]
    pub pending_timeout: Option<Duration>,
    /// Perception: entries that a consumer may lag behind. Left out: 32.
    #[serde(default)]
    #[schemars(range(min = 1, max = 4096))]
    pub queue: Option<usize>,
    /// Real-time: safe state if a cycle that has begun is not finished after this. Left out: "300ms".
    #[serde(default)]
    pub watchdog: Option<Duration>,
    /// Real-time: how far historic inputs reach back. Left out: the longest `pending_timeout`.
    #[serde(default)]
    pub history: Option<Duration>,
    /// What follows when a node fails.
    #[serde(default)]
    pub on_failure: OnFailure,
    /// Of the threads of its instances. Left out: the system's.
    #[serde(default)]
    pub scheduling: Option<Scheduling>,
    /// How long a cycle takes in lockstep. Left out: nothing for a real-time cycler, `deadline` for a perception cycler.
    #[serde(default)]
    pub lockstep_duration: Option<Duration>,
    /// Which cycles are recorded. Left out: all of them.
    #[serde(default)]
    pub record: Option<Record>,
    /// Perception: another machine runs it and feeds this robot with its cycles. Left out: it runs here.
    #[serde(default)]
    pub remote: bool,
}

/// How the cycles of a cycler are handed on.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CyclerKind {
    /// Its cycles are announced and consumed in order.
    Perception,
    /// Consumes what perception cyclers see, and runs at the pace of the body.
    RealTime,
}

/// What follows when a node returns an error or panics.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnFailure {
    /// The robot stops in order.
    #[default]
    Stop,
    /// The instance's nodes and states are made anew.
    Restart,
    /// The node's outputs take their defaults for this cycle.
    Skip,
    /// The node's last good outputs stay for at most 100 ms.
    Hold,
}

/// A running copy: its suffix, or a table where it has settings of its own.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum Instance {
    /// Suffix: `Top` of `Vision` is called `VisionTop`.
    Suffix(InstanceSuffix),
    /// Suffix and settings.
    Table(InstanceTable),
}

/// An instance with settings of its own.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct InstanceTable {
    /// Suffix: `Top` of `Vision` is called `VisionTop`.
    pub name: InstanceSuffix,
    /// Of its thread, in place of the whole one of the cycler. Left out: the cycler's.
    #[serde(default)]
    pub scheduling: Option<Scheduling>,
    /// A longer cycle is an overrun. Left out: the cycler's.
    #[serde(default)]
    pub deadline: Option<Duration>,
    /// Which cycles are recorded. Left out: the cycler's.
    #[serde(default)]
    pub record: Option<Record>,
}

/// A node: its path, or a table where it has settings of its own.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum NodeEntry {
    /// `crate::module::path`.
    Path(NodePath),
    /// Path and settings.
    Table(NodeTable),
}

/// A node with settings of its own.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct NodeTable {
    /// `crate::module::path`.
    pub node: NodePath,
    /// What follows when this node fails. Left out: the cycler's.
    #[serde(default)]
    pub on_failure: Option<OnFailure>,
}

/// Scheduling of a thread.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Scheduling {
    /// Left out: the system's.
    #[serde(default)]
    pub policy: Option<Policy>,
    /// 1 (least urgent) to 99: `fifo` and `round-robin` need one, without `policy` it has no effect.
    #[serde(default)]
    #[schemars(range(min = 1, max = 99))]
    pub priority: Option<u8>,
    /// Cores on which it may run, counted from 0. Left out: all.
    #[serde(default)]
    pub cores: Vec<usize>,
}

/// How the system chooses among threads of real-time priority.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Policy {
    /// Runs until it waits.
    Fifo,
    /// Takes turns with threads of its priority.
    RoundRobin,
}

/// Which cycles are recorded.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
pub enum Record {
    /// All or none.
    Switch(Switch),
    /// Some.
    Some(RecordSome),
}

/// All or none.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Switch {
    /// All cycles.
    On,
    /// No cycle.
    Off,
}

/// Some cycles.
#[derive(Clone, Debug, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum RecordSome {
    /// Every so many cycles one.
    Every(#[schemars(range(min = 1))] u32),
    /// Cycles that begin while this output of the newest finished cycle is true.
    While(String),
}

/// The keys of [`RecordSome`]: an enum alone would take the first and pass over the other.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RecordKeys {
    #[serde(default, deserialize_with = "cycles")]
    every: Option<u32>,
    #[serde(default, rename = "while")]
    condition: Option<String>,
}

impl<'de> Deserialize<'de> for RecordSome {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let keys = RecordKeys::deserialize(deserializer)?;
        match (keys.every, keys.condition) {
            (Some(cycles), None) => Ok(Self::Every(cycles)),
            (None, Some(output)) => Ok(Self::While(output)),
            (Some(_), Some(_)) => Err(D::Error::custom(
                "`every` together with `while` is no choice of cycles: remove one of the two",
            )),
            (None, None) => Err(D::Error::custom("missing field `every` or `while`")),
        }
    }
}

fn cycles<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    let written = i64::deserialize(deserializer)?;
    let cycles = u32::try_from(written).ok().filter(|cycles| *cycles > 0);
    match cycles {
        Some(cycles) => Ok(Some(cycles)),
        None => Err(D::Error::custom(format!(
            "`{written}` is no number of cycles: write a whole number from 1 to {}",
            u32::MAX
        ))),
    }
}

impl NodeEntry {
    /// The node's path.
    pub fn path(&self) -> &NodePath {
        match self {
            Self::Path(path) => path,
            Self::Table(table) => &table.node,
        }
    }

    /// What follows when this node fails, if it says so itself.
    pub fn on_failure(&self) -> Option<OnFailure> {
        match self {
            Self::Path(_) => None,
            Self::Table(table) => table.on_failure,
        }
    }
}

impl Instance {
    /// What follows the cycler's name.
    pub fn suffix(&self) -> &InstanceSuffix {
        match self {
            Self::Suffix(suffix) => suffix,
            Self::Table(table) => &table.name,
        }
    }

    /// Its own settings, if any.
    pub fn table(&self) -> Option<&InstanceTable> {
        match self {
            Self::Suffix(_) => None,
            Self::Table(table) => Some(table),
        }
    }
}

impl Cycler {
    /// Names of its instances, in manifest order.
    pub fn instance_names(&self) -> Vec<InstanceName> {
        match &self.instances {
            None => vec![InstanceName::of_cycler(&self.name)],
            Some(instances) => instances
                .iter()
                .map(|instance| InstanceName::joined(&self.name, instance.suffix()))
                .collect(),
        }
    }
}

deserialize_either!(Instance, "a suffix or a table", Suffix, Table);
deserialize_either!(NodeEntry, "`crate::module::path` or a table", Path, Table);
deserialize_either!(Record, "\"on\", \"off\", or a table", Switch, Some);
