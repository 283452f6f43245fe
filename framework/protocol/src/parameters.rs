//! Parameters with where they come from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Parameters at a path.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Reading {
    /// What every instance has from its next `begin` on.
    pub value: Value,
    /// Of all parameters.
    pub version: u64,
    /// Everything in it that layers replace whole, by path; the value itself if it is such a part.
    pub leaves: Vec<Leaf>,
}

/// A part that layers replace whole.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Leaf {
    /// From the root of the parameters.
    pub path: String,
    /// Where it was given last.
    pub provenance: Provenance,
}

/// Where a value was given last.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "from", rename_all = "snake_case")]
pub enum Provenance {
    /// A line of a layer's file, counted from 1.
    File {
        /// Its path.
        file: String,
        /// From 1.
        line: u64,
    },
    /// An environment variable.
    Environment {
        /// Its name.
        variable: String,
    },
    /// `--set` on the command line.
    Setting {
        /// As it was written.
        setting: String,
    },
    /// A change while the robot runs.
    Live {
        /// The version that brought it.
        version: u64,
    },
    /// No layer has it by this name: a default of its type, or an alias.
    Nowhere,
}

/// What would be lost at the next start.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Unstored {
    /// Of the parameters.
    pub version: u64,
    /// By path.
    pub changes: Vec<UnstoredChange>,
    /// Where they can be stored; later ones win.
    pub layers: Vec<String>,
    /// Parameters that nodes read only when they are created: a change waits for that.
    pub creation_only: Vec<String>,
}

/// A change that no file has.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct UnstoredChange {
    /// From the root of the parameters.
    pub path: String,
    /// Now.
    pub value: Value,
    /// What the layers say; null where they say nothing.
    pub stored: Value,
    /// The version that brought it.
    pub version: u64,
}

/// What was written into a file.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
pub struct Stored {
    /// Its path.
    pub file: String,
    /// What it now says; a list or an enum is always stored whole.
    pub paths: Vec<String>,
    /// Values that a later layer gives, too: they have no effect at the next start.
    pub warnings: Vec<String>,
}
