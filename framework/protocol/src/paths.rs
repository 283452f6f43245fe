//! What can be named.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something with a path.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Entry {
    /// Whole, from the root.
    pub path: String,
    /// What can be done with it.
    pub kind: EntryKind,
    /// Of the value, as people write it; absent where there is no value.
    #[serde(default, skip_serializing_if = "Option::is_none", rename = "type")]
    pub type_name: Option<String>,
    /// What its author says about it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub documentation: Option<String>,
    /// Of its numbers, e.g. `m/s`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Where its numbers must lie.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<Range>,
    /// Whether there is something below it.
    pub has_children: bool,
    /// Of a list: how many elements it has, where the type says so. They are named `0`, `1`, ….
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<u64>,
    /// Of an enum whose variants are names alone: all of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<String>,
    /// Of an image, which can be had as JPEG: its pixels, `gray`, `rgb` or `yuyv`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<String>,
    /// Of a procedure: the type of its argument.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request: Option<String>,
    /// Of a procedure: the type of what it answers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response: Option<String>,
}

/// What can be done with something.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EntryKind {
    /// Only holds others.
    Folder,
    /// A main output, or a part of one: read, subscribe; whole: inject.
    MainOutput,
    /// An additional output, or a part of one: read, subscribe.
    AdditionalOutput,
    /// Parameters: read, subscribe, write, store.
    Parameter,
    /// Call.
    Procedure,
    /// What clients send, or a part of it, for forms: what a procedure is asked or answers, and, by the name of its instance,
    /// what a cycle of another machine writes. Only its schema can be had.
    Message,
}

/// Numbers from `minimum` to `maximum`; absent: without bound.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
pub struct Range {
    /// The least.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub minimum: Option<f64>,
    /// The greatest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maximum: Option<f64>,
    /// Whether `maximum` itself is outside.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_half_open: bool,
}
