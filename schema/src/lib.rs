//! What a manifest, `hulk.toml`, may say. No logic and no files: types that serde fills and that describe themselves.
//!
//! ```toml
//! [robot]
//! name = "nao"
//!
//! [[cycler]]
//! name = "Control"
//! kind = "real-time"
//! setup_nodes = ["control::sensor_data_receiver"]
//! nodes = ["control::orientation_filter", "control::command_sender"]
//! deadline = "12ms"
//!
//! [[target]]
//! name = "simulated"
//! hardware = "simulated_nao::Hardware"
//! ```
//!
//! The documentation of every item becomes the text that an editor shows: `hulk.schema.json` beside this crate's sources is
//! written from these types, and a test keeps the two equal.

#![warn(missing_docs)]

mod bridge;
mod cycler;
mod deploy;
mod either;
mod length;
mod robot;
mod spelling;

pub use bridge::{Bridge, BridgeEncoding, Direction};
pub use cycler::{
    Cycler, CyclerKind, Instance, InstanceTable, NodeEntry, NodeTable, OnFailure, Policy, Record,
    RecordSome, Scheduling, Switch,
};
pub use deploy::Deploy;
pub use length::{Duration, Size};
pub use robot::{Manifest, Robot, Target};
pub use spelling::{
    BridgeKey, CyclerName, HardwarePath, IdentityName, InstanceName, InstanceSuffix, NodePath,
    RobotName, SpellingError, TargetName, is_identifier, snake_case, upper_camel_case,
};

/// The JSON schema of the manifest as text, as it stands in `hulk.schema.json`.
pub fn json_schema() -> String {
    let schema = schemars::schema_for!(Manifest);
    let mut text =
        serde_json::to_string_pretty(&schema).expect("a schema is made of strings and numbers");
    text.push('\n');
    text
}

#[cfg(test)]
mod tests;
