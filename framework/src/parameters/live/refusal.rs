//! Why a parameter is not changed, read or stored.

use std::fmt;

use serde::Serialize;

use crate::parameters::exact;
use crate::reflect::{Path, Reflect, Shape};

/// What is wrong with one path, or with the value for it, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Refusal {
    /// As it was given, with the way to the part that is wrong; empty where no single path is meant.
    pub path: String,
    pub message: String,
}

/// Everything that is wrong with what was asked for; nothing of it was done.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Refusals(pub Vec<Refusal>);

impl Refusal {
    pub(super) fn new(path: &str, message: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            message: message.into(),
        }
    }

    pub(super) fn parse(path: &str) -> Result<Path, Self> {
        if path == "hardware" || path.starts_with("hardware.") {
            let message = "is the hardware's, which reads it once, at the start: change its file and start again";
            return Err(Self::new(path, message));
        }
        path.parse()
            .map_err(|error| Self::new(path, format!("{error}")))
    }
}

impl From<Refusal> for Refusals {
    fn from(refusal: Refusal) -> Self {
        Self(vec![refusal])
    }
}

/// Every number that is not in the range of its field.
pub(super) fn out_of_range(shape: &Shape, values: &dyn Reflect) -> Vec<Refusal> {
    let json = match exact::of(values) {
        Ok(tree) => tree.to_json(),
        Err(error) => return vec![Refusal::new("", error.to_string())],
    };
    let found = shape.out_of_range(&json, None).into_iter();
    found
        .map(|outside| Refusal::new(&outside.path, outside.to_string()))
        .collect()
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, message } = self;
        match path.as_str() {
            "" => formatter.write_str(message),
            _ => write!(formatter, "`{path}`: {message}"),
        }
    }
}

impl fmt::Display for Refusals {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, refusal) in self.0.iter().enumerate() {
            let separator = if position == 0 { "" } else { "\n" };
            write!(formatter, "{separator}{refusal}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Refusal {}

impl std::error::Error for Refusals {}
