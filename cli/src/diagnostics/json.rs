//! Diagnostics for programs: the object of `check --format json`.

use serde_json::{Value, json};

use super::{Diagnostic, Diagnostics, Label, position};
use crate::workspace::Workspace;

/// The object of `check --format json`, version 1: lines and columns from 1.
pub fn to_json(diagnostics: &Diagnostics, workspace: &Workspace) -> Value {
    let diagnostics: Vec<Value> = diagnostics
        .sorted()
        .into_iter()
        .map(|diagnostic| diagnostic_to_json(diagnostic, workspace))
        .collect();
    json!({ "version": 1, "diagnostics": diagnostics })
}

fn diagnostic_to_json(diagnostic: &Diagnostic, workspace: &Workspace) -> Value {
    let spans: Vec<Value> = diagnostic
        .spans
        .iter()
        .map(|label| label_to_json(label, workspace))
        .collect();
    let mut value = json!({
        "code": diagnostic.code.name(),
        "severity": diagnostic.severity().name(),
        "message": diagnostic.message,
        "spans": spans,
        "help": diagnostic.help,
    });
    if let Some(text) = &diagnostic.rustc {
        value["rustc"] = text.as_str().into();
    }
    value
}

fn label_to_json(label: &Label, workspace: &Workspace) -> Value {
    let text = workspace.text(&label.file).unwrap_or_default();
    let start = position(&text, label.range.start);
    let end = position(&text, label.range.end);
    json!({
        "file": label.file.as_str(),
        "line": start.line,
        "column": start.column,
        "end_line": end.line,
        "end_column": end.column,
        "label": label.text,
    })
}
