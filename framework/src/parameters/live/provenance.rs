//! Where values come from.

use std::fmt;

use serde::Serialize;
use serde_json::Value;

use super::refusal::Refusal;
use super::values::plain;
use super::{State, Version};
use crate::parameters::Origin;
use crate::reflect::{self, Path};

/// A value with where it comes from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reading {
    pub value: Value,
    pub version: Version,
    /// Everything in it that is replaced whole, by path; the value itself if it is such a part.
    pub leaves: Vec<Leaf>,
}

/// A part that layers replace whole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Leaf {
    /// From the root of the parameters.
    pub path: String,
    pub provenance: Provenance,
}

/// Where a value was given last.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "from", rename_all = "snake_case")]
pub enum Provenance {
    /// A line of a layer's file, counted from 1.
    File { file: String, line: usize },
    /// An environment variable.
    Environment { variable: String },
    /// `--set` on the command line.
    Setting { setting: String },
    /// A change while the robot runs, with the version that brought it.
    Live { version: Version },
    /// No layer has it by this name: a default of its type, or an alias.
    Nowhere,
}

impl From<&Origin> for Provenance {
    fn from(origin: &Origin) -> Self {
        match origin {
            Origin::File { path, line } => Self::File {
                file: path.to_string(),
                line: *line,
            },
            Origin::Environment(variable) => Self::Environment {
                variable: variable.to_string(),
            },
            Origin::Setting(setting) => Self::Setting {
                setting: setting.to_string(),
            },
            Origin::Unknown => Self::Nowhere,
        }
    }
}

impl State {
    pub(super) fn read(&self, path: &str) -> Result<Reading, Refusal> {
        let parsed = Refusal::parse(path)?;
        let current = self.values.current();
        reflect::at(current, &parsed).map_err(|unknown| Refusal::new(path, unknown.to_string()))?;
        let value =
            plain(current, &parsed).ok_or_else(|| Refusal::new(path, "it has no serde form"))?;
        let mut leaves = Vec::new();
        self.leaves(path.to_owned(), &value, &mut leaves);
        Ok(Reading {
            value,
            version: self.version,
            leaves,
        })
    }

    fn leaves(&self, path: String, value: &Value, leaves: &mut Vec<Leaf>) {
        match value {
            Value::Object(entries) if !entries.is_empty() => {
                for (key, value) in entries {
                    let separator = if path.is_empty() { "" } else { "." };
                    self.leaves(format!("{path}{separator}{key}"), value, leaves);
                }
            }
            _ => leaves.push(Leaf {
                provenance: self.provenance(&path),
                path,
            }),
        }
    }

    fn provenance(&self, path: &str) -> Provenance {
        let parsed: Path = path.parse().unwrap_or_default();
        let changed = self
            .changes
            .iter()
            .find(|(changed, _)| parsed.starts_with(changed) || changed.starts_with(&parsed));
        if let Some((_, version)) = changed {
            return Provenance::Live { version: *version };
        }
        let files = self.files.as_ref();
        let origin = files.and_then(|files| files.loaded.origin(path));
        origin.map_or(Provenance::Nowhere, Provenance::from)
    }
}

impl fmt::Display for Provenance {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { file, line } => write!(formatter, "{file}:{line}"),
            Self::Environment { variable } => write!(formatter, "environment {variable}"),
            Self::Setting { setting } => write!(formatter, "--set {setting}"),
            Self::Live { version } => write!(formatter, "live change {}", version.0),
            Self::Nowhere => formatter.write_str("no layer"),
        }
    }
}
