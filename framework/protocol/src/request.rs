//! What a client may ask.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// One message of a client. The robot gives exactly one answer to each, in any order.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// Chosen by the client; the answer has the same.
    pub id: u32,
    /// What is asked.
    pub ask: Ask,
}

/// What is asked.
///
/// Paths: `INSTANCE.main_outputs.NAME…`, `INSTANCE.additional_outputs.NAME…`, `INSTANCE.procedures.NAME`, `parameters…`,
/// `framework.procedures.NAME`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Ask {
    /// Proves that this client may write; needed once per connection where the robot has a token. Answer: `done`.
    Authenticate {
        /// As the robot was started with.
        token: String,
    },
    /// What lies below a path, to this depth. Answer: `paths`.
    Paths {
        /// Empty: the root.
        #[serde(default)]
        below: String,
        /// Levels below it; absent: 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        depth: Option<u8>,
    },
    /// JSON schema (draft-07) of the values at a path. Answer: `schema`.
    Schema {
        /// An output, a part of one, or parameters.
        path: String,
    },
    /// How values at a path are laid out as bytes, as docs/protocol/binary.md says. Answer: `layout`.
    Layout {
        /// An output, a part of one, parameters, or what a procedure is asked or answers.
        path: String,
    },
    /// The newest value at a path; of an output that nobody subscribed, that of the next cycle. Answer: `value`.
    Read {
        /// An output, a part of one, or parameters.
        path: String,
    },
    /// The value at a path, again and again. Answer: `subscribed`, then updates.
    ///
    /// An additional output is computed only while somebody is subscribed. In a cycle that left it empty it has no value,
    /// and there is no update.
    Subscribe {
        /// An output, a part of one, or parameters (an update with each change).
        path: String,
        /// At most so many updates per second; absent: every cycle.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        rate: Option<f64>,
        /// How values are written; absent: `json`.
        #[serde(default)]
        encoding: Encoding,
    },
    /// No more updates. Answer: `done`.
    Unsubscribe {
        /// As the answer to `subscribe` said.
        subscription: u32,
    },
    /// From now on what is sent at the same time comes in one piece: texts as a JSON array of messages, binary frames one behind
    /// the other as [`crate::BUNDLE_MAGIC`] says. One alone comes as ever. Answer: `done`.
    Bundle {},
    /// Changes parameters, all of them at once or none. Answer: `written`.
    Write {
        /// In this order, where they lie in each other.
        changes: Vec<Change>,
    },
    /// Parameters at a path, and where everything in them comes from. Answer: `parameters`.
    Parameters {
        /// Below the parameters, without `parameters.` in front; empty: all of them.
        #[serde(default)]
        path: String,
    },
    /// What would be lost at the next start, and into which layers it can be stored. Answer: `unstored`.
    Unstored {},
    /// Writes parameters into the file of a layer. Answer: `stored`.
    Store {
        /// One of those that `unstored` names.
        layer: String,
        /// Below the parameters; without any: everything that was changed and not stored.
        #[serde(default)]
        paths: Vec<String>,
    },
    /// Takes what the files of the parameters say now; changes that were not stored are gone. Answer: `written`.
    Reload {},
    /// Puts a value in place of a main output until it is released or the connection ends. Answer: `done`.
    Inject {
        /// A whole main output.
        path: String,
        /// In JSON.
        value: Value,
    },
    /// Gives a main output back to its node. Answer: `done`.
    Release {
        /// As it was injected.
        path: String,
    },
    /// Calls a procedure and waits for what its node says. Answer: `called`.
    Call {
        /// `INSTANCE.procedures.NAME` or `framework.procedures.NAME`.
        path: String,
        /// In JSON; absent: null.
        #[serde(default)]
        argument: Value,
        /// Seconds until the call counts as failed; absent: 5.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        timeout: Option<f64>,
    },
    /// A cycle of an instance that another machine runs has begun: who reads in order of time waits for it. Answer: `done`.
    ///
    /// One client at a time feeds an instance, until it disconnects or has said nothing of it for its `pending_timeout`.
    /// A cycle that was announced before is abandoned.
    Announce {
        /// One that another machine runs, of kind `message` in `paths`.
        instance: String,
        /// When its data was taken, in nanoseconds of the robot's clock: not in the future, after the cycle before.
        time: u64,
    },
    /// What that cycle wrote; one that was not announced begins and ends at once. Answer: `done`.
    Complete {
        /// As in `announce`.
        instance: String,
        /// As in `announce`.
        time: u64,
        /// In JSON: an object of the main outputs that the robot reads; others are ignored.
        outputs: Value,
    },
    /// That cycle writes nothing: nobody waits for it any more. Answer: `done`.
    Abandon {
        /// As in `announce`.
        instance: String,
        /// As in `announce`.
        time: u64,
    },
    /// Log messages from now on, after those of the last minutes. Answer: `done`, then logs.
    Logs {
        /// At least this severe; absent: `info`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        level: Option<Level>,
    },
    /// From now on messages are kept that are at least so severe. Answer: `done`.
    SetLogLevel {
        /// `INSTANCE`, `INSTANCE.crate::module` (one node); absent: everything.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        of: Option<String>,
        /// Less severe ones are not made.
        level: Level,
    },
    /// How long cycles and nodes took since the start, and how often they failed. Answer: `timings`.
    Timings {},
    /// The last seconds as a trace that Perfetto and Chrome open (Trace Event Format). Answer: `trace`.
    Trace {
        /// How many; what is older than the robot keeps is left out.
        seconds: f64,
    },
    /// The data-flow graph, as `hulkgen graph --format json` prints it. Answer: `graph`.
    Graph {},
}

/// A parameter with its new value.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// Below the parameters, without `parameters.` in front.
    pub path: String,
    /// In JSON.
    pub value: Value,
}

/// How values of a subscription are written.
#[derive(
    Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, PartialOrd, Serialize,
)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Encoding {
    /// In messages `update`.
    #[default]
    Json,
    /// In binary frames, laid out as the answer says.
    Binary,
    /// Of images: in binary frames, each a JPEG file.
    Jpeg {
        /// 1 (small) to 100 (good).
        quality: u8,
    },
}

/// How severe a log message is.
#[derive(
    Clone, Copy, Debug, Deserialize, Eq, JsonSchema, Ord, PartialEq, PartialOrd, Serialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Everything.
    Trace,
    /// For those who look for a mistake.
    Debug,
    /// What happens.
    Info,
    /// Something is not as it should be.
    Warn,
    /// Something failed.
    Error,
}
