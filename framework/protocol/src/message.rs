//! What a robot says.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Answer, Level};

/// One message of a robot.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Message {
    /// The first message of every connection.
    Welcome(Welcome),
    /// To a request.
    Answer(Answer),
    /// A value of a subscription, as JSON.
    Update(Update),
    /// Updates that this client did not get.
    Lost(Lost),
    /// To `logs`.
    Log(Log),
    /// Somebody changed parameters, or their files; every client is told.
    ParametersChanged(ParametersChanged),
}

/// Who speaks.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Welcome {
    /// [`crate::VERSION`].
    pub version: u32,
    /// The robot's name.
    pub robot: String,
    /// The target that runs.
    pub target: String,
    /// Its instances, in manifest order.
    pub instances: Vec<String>,
    /// Whether this connection may write; after `authenticate` if `needs_token`.
    pub can_write: bool,
    /// Whether `authenticate` comes before anything that writes.
    pub needs_token: bool,
    /// The robot's clock now, in nanoseconds.
    pub time: u64,
    /// Of the robot's run: the same text on each connection as long as it goes on, another one after a restart. Absent: a
    /// robot of an earlier version, which does not tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run: Option<String>,
    /// Other robots as browsers name them, `HOST:PORT`, which the robot's page may show beside it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub peers: Vec<String>,
}

impl Welcome {
    /// Whether both are of one run, of which clock, counts and parameters go on. `None`: robots of an earlier version said
    /// both, and nobody can tell.
    pub fn is_same_run(&self, other: &Self) -> Option<bool> {
        (self.run.is_some() || other.run.is_some()).then(|| self.run == other.run)
    }
}

/// A value of a subscription.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Update<V = serde_json::Value> {
    /// As the answer to `subscribe` said.
    pub subscription: u32,
    /// Number of the cycle that wrote it; of parameters their version.
    pub cycle: u64,
    /// Timestamp of that cycle, in nanoseconds of the robot's clock.
    pub time: u64,
    /// Null: the part is not there in this cycle.
    pub value: V,
    /// Whether a client has put it in place of what the node wrote.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub injected: bool,
}

/// Updates that a client did not take in time.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Lost {
    /// Of this subscription; absent: log messages.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subscription: Option<u32>,
    /// How many since the last message of this kind.
    pub updates: u64,
}

/// A log message.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Log {
    /// Counts all messages of the run; a gap is a message that was left out.
    pub number: u64,
    /// In nanoseconds of the robot's clock.
    pub time: u64,
    /// How severe it is.
    pub level: Level,
    /// The instance whose thread said it, if it was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instance: Option<String>,
    /// The node that was running, if there was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
    /// The cycle that was running, if there was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycle: Option<u64>,
    /// What was said.
    pub message: String,
    /// What was said with it, by name.
    #[serde(default, skip_serializing_if = "serde_json::Map::is_empty")]
    pub fields: serde_json::Map<String, serde_json::Value>,
}

/// Parameters are not what they were.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct ParametersChanged {
    /// The newest.
    pub version: u64,
}
