//! Late errors: what rustc finds in the generated crate, shown at the field or line of the manifest that it comes from.
//!
//! Nothing in the generated code is there for this. Where rustc points to is looked up in the text that was generated: the
//! function, field or binding around it, and the nodes that its comments name, say which part of the robot it is.
//!
//! Invariant: no error of rustc is lost. What cannot be brought home is shown as rustc shows it.

mod origin;
pub mod parameters;
pub mod rustc;
mod surroundings;

use camino::{Utf8Path, Utf8PathBuf};

use crate::diagnostics::{Code, Diagnostic, Diagnostics, byte};
use crate::manifest::Manifest;
use crate::model::RuntimeModel;
use crate::render::GeneratedFiles;
use crate::resolve::robot::Robot;
use crate::workspace::Workspace;

use rustc::{Level, Message, Span};
use surroundings::Surroundings;

/// What an error of the generated crate may come from.
pub struct Home<'a> {
    pub workspace: &'a Workspace,
    pub manifest: &'a Manifest,
    pub robot: &'a Robot,
    pub model: &'a RuntimeModel,
    /// As rustc has read them.
    pub files: &'a GeneratedFiles,
}

/// What rustc said, with the places where an author mends it.
pub fn diagnose(messages: &[Message], home: &Home<'_>) -> Diagnostics {
    let mut all: Vec<Diagnostic> = Vec::new();
    let said = messages.iter().filter(|message| !message.is_summary());
    for diagnostic in said.filter_map(|message| home.diagnostic(message)) {
        match all.iter_mut().find(|one| is_same(one, &diagnostic)) {
            // One mistake, found at several places of the generated code.
            Some(one) => one.rustc = joined(one.rustc.take(), diagnostic.rustc),
            None => all.push(diagnostic),
        }
    }
    let mut found = Diagnostics::new();
    all.into_iter().for_each(|one| found.add(one));
    found
}

fn is_same(one: &Diagnostic, other: &Diagnostic) -> bool {
    let parts = |one: &Diagnostic| (one.code, one.message.clone(), one.spans.clone());
    one.code == Code::LeftToRustc && parts(one) == parts(other)
}

fn joined(one: Option<String>, other: Option<String>) -> Option<String> {
    match (one, other) {
        (Some(one), Some(other)) if one != other => Some(format!("{one}\n\n{other}")),
        (one, _) => one,
    }
}

impl Home<'_> {
    fn diagnostic(&self, message: &Message) -> Option<Diagnostic> {
        let place = message.primary().and_then(|span| self.place(span));
        let generated = place.as_ref().and_then(|(file, span)| {
            let text = self.files.get(file)?;
            Some((
                file,
                Surroundings::of(text, span.line_start, span.column_start),
                *span,
            ))
        });
        let diagnostic = match (message.level, generated) {
            (Level::Error, Some((file, surroundings, span))) => {
                let place = format!("{file}:{}", span.line_start);
                let error = Diagnostic::new(Code::LeftToRustc, message.message.clone());
                let error = self.at_origin(error, file, &surroundings, message);
                error.rustc(format!(
                    "rustc about `{place}`:\n{}",
                    indented(&message.rendered)
                ))
            }
            (Level::Error, None) => self.of_author(Code::Rustc, message, place),
            (Level::Warning, _) => self.of_author(Code::RustcWarning, message, place),
            (Level::Note | Level::Other, _) => return None,
        };
        Some(diagnostic)
    }

    /// As rustc renders it; the place is for programs.
    fn of_author(
        &self,
        code: Code,
        message: &Message,
        place: Option<(Utf8PathBuf, &Span)>,
    ) -> Diagnostic {
        let mut diagnostic = Diagnostic::new(code, message.message.clone());
        if let Some((file, span)) = place {
            let text = self.workspace.read(&file).unwrap_or_default();
            let label = span.label.clone().unwrap_or_default();
            // Rustc's bytes count a byte order mark, which the text does not have.
            let start = byte(&text, span.line_start, span.column_start);
            let length = span.byte_end.saturating_sub(span.byte_start);
            diagnostic = diagnostic.at(&file, start..start + length, label);
        }
        diagnostic.rustc(message.rendered.trim_end().to_owned())
    }

    /// The file of a span relative to the robot's root; of what a macro of a foreign crate made, the place where it is
    /// called.
    fn place<'s>(&self, span: &'s Span) -> Option<(Utf8PathBuf, &'s Span)> {
        span.calls().find_map(|span| {
            let file = self
                .workspace
                .below_cargo_root(Utf8Path::new(&span.file_name));
            let is_own = self.files.contains_key(&file) || self.workspace.is_file(&file);
            (is_own && file.is_relative()).then_some((file, span))
        })
    }
}

fn indented(text: &str) -> String {
    let lines = text.trim_end().lines();
    lines
        .map(|line| format!("  {line}").trim_end().to_owned() + "\n")
        .collect::<String>()
        .trim_end()
        .to_owned()
}

#[cfg(test)]
mod tests;
