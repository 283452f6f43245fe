//! Where a value comes from, and what is wrong with it.

use std::fmt;
use std::sync::Arc;

use serde::Serialize;

/// The place that a value was written at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A line of a file, counted from 1.
    File {
        /// As it was opened.
        path: Arc<str>,
        /// Of the value's key.
        line: usize,
    },
    /// An environment variable.
    Environment(Arc<str>),
    /// A `--set` on the command line.
    Setting(Arc<str>),
    /// A table without a file.
    Unknown,
}

/// What kind of mistake it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Fault {
    /// No layer has the value.
    Missing,
    /// Nothing reads the value.
    Unknown,
    /// The value is not what its reader takes, or a file cannot be read.
    Invalid,
}

/// A value that is missing, superfluous or of the wrong type, or a file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterError {
    /// The place, as far as there is one.
    pub origin: Origin,
    /// The full path of the value, empty for the whole tree.
    pub key: String,
    /// What kind of mistake it is.
    pub fault: Fault,
    /// What is wrong and what would be right.
    pub message: String,
}

impl ParameterError {
    pub(super) fn new(origin: Origin, key: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            origin,
            key: key.into(),
            fault: Fault::Invalid,
            message: message.into(),
        }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, line } => write!(formatter, "{path}:{line}"),
            Self::Environment(variable) => write!(formatter, "environment {variable}"),
            Self::Setting(setting) => write!(formatter, "--set {setting}"),
            Self::Unknown => write!(formatter, "parameters"),
        }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: ", self.origin)?;
        if !self.key.is_empty() {
            write!(formatter, "`{}`: ", self.key)?;
        }
        write!(formatter, "{}", self.message)
    }
}

impl std::error::Error for ParameterError {}
