//! What a running robot and its clients say to each other over a WebSocket: types that serde fills and that describe
//! themselves. No sockets and no robot.
//!
//! ```text
//! robot:  { "welcome": { "version": 1, "robot": "lamp", … } }
//! client: { "id": 1, "ask": { "subscribe": { "path": "Control.main_outputs.level", "rate": 10 } } }
//! robot:  { "answer": { "id": 1, "ok": { "subscribed": { "subscription": 1, … } } } }
//! robot:  { "update": { "subscription": 1, "cycle": 812, "time": 9744000000, "value": 0.5 } }
//! ```
//! A client's messages are [`Request`]s, the robot's are [`Message`]s. Unknown keys are errors in requests, and to be
//! ignored in messages, so that a robot may say more than its client knows.

#![warn(missing_docs)]

mod answer;
mod message;
mod parameters;
mod paths;
mod request;
mod timings;

pub use answer::{Answer, Failure, Good, Outcome, Refusal, Subscribed, Value};
pub use message::{Log, Lost, Message, ParametersChanged, Update, Welcome};
pub use parameters::{Leaf, Provenance, Reading, Stored, Unstored, UnstoredChange};
pub use paths::{Entry, EntryKind, Range};
pub use request::{Ask, Change, Encoding, Level, Request};
pub use timings::{
    Durations, Granted, InstanceTimings, NodeTimings, QueueTimings, RecordingCounts, RemoteTimings,
    Timings,
};

/// What both sides have to agree on. A robot may say more in a later version of the same number, never something else.
pub const VERSION: u32 = 1;

/// Path of the WebSocket on the robot's server.
pub const SOCKET: &str = "/socket";

/// Port on which a robot listens unless it is told otherwise.
pub const PORT: u16 = 4857;

/// First four bytes of a binary frame: the layout of the header has this version.
pub const BINARY_MAGIC: [u8; 4] = *b"HKG1";

/// Bytes in front of the value in a binary frame, all little-endian: [`BINARY_MAGIC`], the subscription (`u32`), the cycle
/// number (`u64`), the timestamp (`u64`, nanoseconds of the robot's clock).
pub const BINARY_HEADER: usize = 24;

/// First four bytes of a binary message of several frames, for a client that asked for [`Ask::Bundle`]. Behind them stands each
/// frame with its length in front (`u32`, little-endian).
pub const BUNDLE_MAGIC: [u8; 4] = *b"HKGS";

/// JSON schemas of all messages: of what clients send and of what a robot sends.
pub fn json_schemas() -> (serde_json::Value, serde_json::Value) {
    (
        schemars::schema_for!(Request).to_value(),
        schemars::schema_for!(Message).to_value(),
    )
}

#[cfg(test)]
mod tests;
