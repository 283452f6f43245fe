//! What a robot answers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Encoding, Entry, Reading, Stored, Timings, Unstored};

/// The answer to one request.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Answer {
    /// That of the request; absent where the message was so wrong that it could not be read.
    pub id: Option<u32>,
    /// What came of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of a request.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It was done.
    Ok(Box<Good>),
    /// It was not done, and nothing changed.
    Error(Failure),
}

/// What was asked for.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Good {
    /// Nothing more to say.
    Done {},
    /// To `paths`: in the order of the robot's manifest and types.
    Paths(Vec<Entry>),
    /// To `schema`: a JSON schema.
    Schema(serde_json::Value),
    /// To `layout`: as in the answer to `subscribe`.
    Layout(serde_json::Value),
    /// To `read`.
    Value(Value),
    /// To `subscribe`.
    Subscribed(Subscribed),
    /// To `write` and `reload`.
    Written {
        /// Of the parameters: every instance has them from its next `begin` on.
        version: u64,
    },
    /// To `parameters`.
    Parameters(Reading),
    /// To `unstored`.
    Unstored(Unstored),
    /// To `store`.
    Stored(Stored),
    /// To `call`: the response of the node.
    Called(serde_json::Value),
    /// To `timings`.
    Timings(Timings),
    /// To `trace`: an object with `traceEvents`.
    Trace(serde_json::Value),
    /// To `graph`.
    Graph(serde_json::Value),
}

/// Why something was not done.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Failure {
    /// For people: what happened and what to do.
    pub message: String,
    /// Where several things were asked at once: what is wrong with each that is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub refusals: Vec<Refusal>,
}

/// What is wrong with one of several things.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Refusal {
    /// Of the thing.
    pub path: String,
    /// For people.
    pub message: String,
}

/// A value of one cycle.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Value<V = serde_json::Value> {
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

/// A subscription that was made.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Subscribed {
    /// Updates carry this number.
    pub subscription: u32,
    /// As it was asked for.
    pub encoding: Encoding,
    /// Of binary values: their layout, as docs/protocol/binary.md says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layout: Option<serde_json::Value>,
}
