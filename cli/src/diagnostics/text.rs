//! Diagnostics for people: excerpts of every file concerned, with the place marked.

use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use camino::Utf8Path;

use super::{Code, Diagnostic, Diagnostics, Label, Severity};
use crate::workspace::Workspace;

/// Columns of a report.
const WIDTH: usize = 100;

/// All diagnostics as text for a terminal, in order, each followed by an empty line.
pub fn render(diagnostics: &Diagnostics, workspace: &Workspace, color: bool) -> String {
    let renderer = if color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let renderer = renderer.term_width(WIDTH);
    let mut text = String::new();
    for diagnostic in diagnostics.sorted() {
        // What rustc found in the author's own file needs no other picture.
        if !matches!(diagnostic.code, Code::Rustc | Code::RustcWarning) {
            text.push_str(&render_one(diagnostic, workspace, &renderer));
            text.push_str("\n\n");
        }
        if let Some(rustc) = &diagnostic.rustc {
            text.push_str(rustc);
            text.push_str("\n\n");
        }
    }
    text
}

/// One diagnostic without colours.
pub(super) fn render_plain(diagnostic: &Diagnostic, workspace: &Workspace) -> String {
    let renderer = Renderer::plain().term_width(WIDTH);
    format!("{}\n\n", render_one(diagnostic, workspace, &renderer))
}

fn render_one(diagnostic: &Diagnostic, workspace: &Workspace, renderer: &Renderer) -> String {
    let level = match diagnostic.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let excerpts = excerpts(diagnostic, workspace);
    let title = level
        .primary_title(diagnostic.message.as_str())
        .id(diagnostic.code.name());
    let mut group = Group::with_title(title);
    for excerpt in &excerpts {
        group = excerpt.add_to(group);
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    renderer.render(&[group])
}

/// The labels of one file with its text.
struct Excerpt<'a> {
    file: &'a Utf8Path,
    text: Option<Arc<str>>,
    labels: Vec<(bool, &'a Label)>,
}

/// Files in the order of their first label; only the very first label is primary.
fn excerpts<'a>(diagnostic: &'a Diagnostic, workspace: &Workspace) -> Vec<Excerpt<'a>> {
    let mut excerpts: Vec<Excerpt> = Vec::new();
    for (index, label) in diagnostic.spans.iter().enumerate() {
        let entry = (index == 0, label);
        match excerpts.iter_mut().find(|one| one.file == label.file) {
            Some(excerpt) => excerpt.labels.push(entry),
            None => excerpts.push(Excerpt {
                file: &label.file,
                text: workspace.text(&label.file),
                labels: vec![entry],
            }),
        }
    }
    excerpts
}

impl Excerpt<'_> {
    fn add_to<'b>(&'b self, group: Group<'b>) -> Group<'b> {
        let Some(text) = self.text.as_deref().filter(|text| !text.is_empty()) else {
            return group.element(Origin::path(self.file.as_str()));
        };
        let annotations = self.labels.iter().map(|(primary, label)| {
            let kind = if *primary {
                AnnotationKind::Primary
            } else {
                AnnotationKind::Context
            };
            let text_of_label = (!label.text.is_empty()).then_some(label.text.as_str());
            kind.span(clamped(text, label)).label(text_of_label)
        });
        group.element(
            Snippet::source(text)
                .path(self.file.as_str())
                .annotations(annotations),
        )
    }
}

/// The label's range as far as the text still has it: a file may have changed since it was read.
fn clamped(text: &str, label: &Label) -> std::ops::Range<usize> {
    let boundary = |byte: usize| {
        let byte = byte.min(text.len());
        (0..=byte)
            .rev()
            .find(|byte| text.is_char_boundary(*byte))
            .unwrap_or(0)
    };
    let start = boundary(label.range.start);
    start..boundary(label.range.end).max(start)
}
