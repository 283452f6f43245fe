//! What the robot's program says about its parameter files: mistakes that only serde can see.

use std::collections::BTreeMap;
use std::ops::Range;

use camino::Utf8PathBuf;
use serde::Deserialize;
use toml::de::{DeTable, DeValue};

use crate::diagnostics::{Code, Diagnostic, position};
use crate::workspace::{Workspace, normalized};

/// The answer to `--check-parameters --format json`.
#[derive(Debug, Deserialize)]
pub struct Answer {
    pub mistakes: Vec<Mistake>,
}

/// Why a robot would not start.
#[derive(Debug, Deserialize)]
pub struct Mistake {
    /// As the program opened it.
    file: Option<Utf8PathBuf>,
    /// From 1.
    line: Option<usize>,
    /// Empty where no value is meant.
    key: String,
    fault: Fault,
    message: String,
    /// The first robot that has it.
    identities: BTreeMap<String, String>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Fault {
    Missing,
    Unknown,
    Invalid,
}

impl Mistake {
    /// Whether it concerns only robots that run there.
    pub fn is_of_location(&self) -> bool {
        self.fault == Fault::Missing
    }

    /// Whether it is in the table that the target's hardware reads.
    pub fn is_of_hardware(&self) -> bool {
        self.key.split('.').next() == Some("hardware")
    }

    /// At its line; the program was started in the robot's root.
    pub fn diagnostic(&self, workspace: &Workspace, location: Option<&str>) -> Diagnostic {
        let code = match self.fault {
            Fault::Missing => Code::MissingParameter,
            Fault::Unknown => Code::UnknownParameter,
            Fault::Invalid => Code::MistypedParameter,
        };
        let message = match self.key.as_str() {
            "" => self.message.clone(),
            key => format!("`{key}`: {}", self.message),
        };
        let error = Diagnostic::new(code, message).help(match self.fault {
            Fault::Missing => format!("add `{} = …`", self.key),
            Fault::Unknown => "remove it, or mend its name".to_owned(),
            Fault::Invalid => "write what its type takes: no robot starts with this".to_owned(),
        });
        let (Some(file), Some(line)) = (&self.file, self.line) else {
            return error;
        };
        let file = normalized(file);
        let place = match workspace.read(&file) {
            Ok(text) => place(&text, line, &self.key),
            Err(_) => 0..0,
        };
        error.at(&file, place, self.robots(location))
    }

    /// "at `field`, for head P1"; empty for all.
    fn robots(&self, location: Option<&str>) -> String {
        let location = location.map(|location| format!("at `{location}`"));
        let identities = self.identities.iter();
        let identities = identities.map(|(name, id)| format!("for {name} {id}"));
        let parts: Vec<String> = location.into_iter().chain(identities).collect();
        parts.join(", ")
    }
}

/// The value with this key, if it stands at this line, or else what stands there.
fn place(text: &str, line: usize, key: &str) -> Range<usize> {
    let is_there = |range: &Range<usize>| position(text, range.start).line == line;
    let value = DeTable::parse(text).ok().and_then(|table| {
        let mut table = table.get_ref();
        let mut place = None;
        for name in key.split('.') {
            let Some((key, value)) = table.get_key_value(name) else {
                break;
            };
            place = Some((key.span(), value.span()));
            match value.get_ref() {
                DeValue::Table(below) => table = below,
                _ => break,
            }
        }
        place
    });
    match value {
        Some((key, value)) if is_there(&key) && is_there(&value) => value,
        Some((key, _)) if is_there(&key) => key,
        _ => whole_line(text, line),
    }
}

fn whole_line(text: &str, line: usize) -> Range<usize> {
    let before = text.split_inclusive('\n').take(line.saturating_sub(1));
    let start: usize = before.map(str::len).sum();
    let line = text[start..].lines().next().unwrap_or_default();
    let indent = line.len() - line.trim_start().len();
    start + indent..start + line.trim_end().len().max(indent)
}

#[cfg(test)]
mod tests {
    use super::{Mistake, place};
    use crate::diagnostics::Diagnostics;
    use crate::diagnostics::to_json;
    use crate::workspace::Workspace;

    const TEXT: &str = "a = 1\n\n[filter]\n  gain = -1.5  # none\n\n[other]\nlist = [\n  1,\n]\n";

    #[test]
    fn the_place_is_the_value_or_the_line() {
        let at = |line, key| &TEXT[place(TEXT, line, key)];
        assert_eq!(at(4, "filter.gain"), "-1.5");
        assert_eq!(at(4, "filter.gain.0"), "-1.5");
        // The line of another layer's file, or of a table.
        assert_eq!(at(4, "a"), "gain = -1.5  # none");
        assert_eq!(at(3, "filter.missing"), "[filter]");
        assert_eq!(at(8, "other.list.0"), "1,");
        assert_eq!(at(99, "a"), "");
    }

    #[test]
    fn a_mistake_is_a_diagnostic_for_some_robots() {
        let mistake: Mistake = serde_json::from_value(serde_json::json!({
            "file": "parameters/./default.toml", "line": 4, "key": "filter.gain", "fault": "invalid",
            "message": "expected a positive number", "text": "", "identities": { "head": "P1" },
        }))
        .expect("it is one");
        let workspace = Workspace::in_memory([("parameters/default.toml", TEXT)]);
        let mut found = Diagnostics::new();
        found.add(mistake.diagnostic(&workspace, Some("field")));
        let answer = to_json(&found, &workspace);
        let one = &answer["diagnostics"][0];
        assert_eq!(one["code"], "mistyped-parameter");
        assert_eq!(one["message"], "`filter.gain`: expected a positive number");
        assert_eq!(one["spans"][0]["file"], "parameters/default.toml");
        assert_eq!(one["spans"][0]["column"], 10);
        assert_eq!(one["spans"][0]["label"], "at `field`, for head P1");
        assert!(!mistake.is_of_hardware());
    }
}
