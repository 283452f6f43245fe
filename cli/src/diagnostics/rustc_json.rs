//! Diagnostics for editors: the messages of `cargo check --message-format json`, by which rust-analyzer shows ours.
//!
//! Columns count characters from 1, as rustc's do.

use camino::Utf8Path;
use serde_json::{Value, json};

use super::text::render_plain;
use super::{Code, Diagnostic, Diagnostics, Label, position};
use crate::workspace::{MANIFEST, Workspace, normalized};

/// One line for each diagnostic, and a last one that says whether all is well.
pub fn to_rustc_json(diagnostics: &Diagnostics, workspace: &Workspace, success: bool) -> String {
    let messages = diagnostics.sorted().into_iter().map(|diagnostic| {
        json!({
            "reason": "compiler-message",
            "package_id": format!("path+file://{}#hulk", workspace.root()),
            "manifest_path": workspace.root().join("Cargo.toml").as_str(),
            "target": target(workspace),
            "message": message(diagnostic, workspace),
        })
    });
    let last = json!({ "reason": "build-finished", "success": success });
    let lines = messages.chain([last]).map(|line| format!("{line}\n"));
    lines.collect()
}

/// Readers of the format ask what was compiled: it is the manifest.
fn target(workspace: &Workspace) -> Value {
    json!({
        "kind": ["custom-build"],
        "crate_types": ["bin"],
        "name": "hulk",
        "src_path": workspace.root().join(MANIFEST).as_str(),
        "edition": "2024",
        "doc": false,
        "doctest": false,
        "test": false,
    })
}

fn message(diagnostic: &Diagnostic, workspace: &Workspace) -> Value {
    let mut spans: Vec<Value> = diagnostic
        .spans
        .iter()
        .enumerate()
        .map(|(index, label)| span(label, index == 0, workspace))
        .collect();
    if spans.is_empty() {
        // What has no place is not shown: the manifest's beginning is the place of the whole robot.
        let whole = Label {
            file: Utf8Path::new(MANIFEST).to_owned(),
            range: 0..0,
            text: String::new(),
        };
        spans.push(span(&whole, true, workspace));
    }
    let help = diagnostic.help.iter().map(|help| child("help", help));
    let of_author = matches!(diagnostic.code, Code::Rustc | Code::RustcWarning);
    let rustc = diagnostic.rustc.as_deref();
    let (rendered, note) = match rustc.filter(|_| of_author) {
        // As rustc itself would show it.
        Some(text) => (format!("{text}\n\n"), None),
        None => (render_plain(diagnostic, workspace), rustc),
    };
    let note = note.map(|text| child("note", text));
    let children: Vec<Value> = help.chain(note).collect();
    json!({
        "$message_type": "diagnostic",
        "message": diagnostic.message,
        "code": { "code": diagnostic.code.name(), "explanation": diagnostic.code.title() },
        "level": diagnostic.severity().name(),
        "spans": spans,
        "children": children,
        "rendered": rendered,
    })
}

/// rustc gives it no type of its own.
fn child(level: &str, message: &str) -> Value {
    json!({
        "message": message,
        "code": null,
        "level": level,
        "spans": [],
        "children": [],
        "rendered": null,
    })
}

fn span(label: &Label, is_primary: bool, workspace: &Workspace) -> Value {
    let text = workspace.text(&label.file).unwrap_or_default();
    let start = position(&text, label.range.start);
    let end = position(&text, label.range.end.max(label.range.start));
    let lines = text
        .lines()
        .enumerate()
        .take(end.line)
        .skip(start.line - 1)
        .map(|(index, line)| {
            let first = if index + 1 == start.line {
                start.column
            } else {
                1
            };
            let last = if index + 1 == end.line {
                end.column
            } else {
                line.chars().count() + 1
            };
            json!({ "text": line, "highlight_start": first, "highlight_end": last })
        });
    json!({
        // Editors look for a relative one below the root of cargo's workspace, which may be above the robot's.
        "file_name": normalized(&workspace.root().join(&label.file)).as_str(),
        "byte_start": label.range.start.min(text.len()),
        "byte_end": label.range.end.min(text.len()),
        "line_start": start.line,
        "line_end": end.line,
        "column_start": start.column,
        "column_end": end.column,
        "is_primary": is_primary,
        "text": lines.collect::<Vec<Value>>(),
        "label": (!label.text.is_empty()).then_some(label.text.as_str()),
        "suggested_replacement": null,
        "suggestion_applicability": null,
        "expansion": null,
    })
}
