//! What hulkgen has to say about a robot: errors and warnings with the place where an author mends them.
//!
//! Every stage adds to one [`Diagnostics`] and goes on as long as it can, so that all mistakes of a stage come at once.
//! A stage that cannot hand on its result returns [`Reported`], which only exists once an error was added.

mod catalogue;
mod json;
mod nearest;
mod position;
mod rustc_json;
mod text;

use std::fmt;
use std::ops::Range;

use camino::{Utf8Path, Utf8PathBuf};

use crate::workspace::Workspace;

pub use catalogue::{Code, Severity};
pub use json::to_json;
pub use nearest::{listed, nearest, suggestion};
pub use position::{Position, byte, position};
pub use rustc_json::to_rustc_json;
pub use text::render;

/// One error or warning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    pub code: Code,
    /// A lower-case fragment with names in backticks and no full stop.
    pub message: String,
    /// Where it is mended stands first; other places that matter follow.
    pub spans: Vec<Label>,
    /// A deed that mends it.
    pub help: Option<String>,
    /// What rustc says about it, as rustc shows it.
    pub rustc: Option<String>,
}

/// A place in a file of the workspace, and what is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Relative to the workspace root.
    pub file: Utf8PathBuf,
    /// In bytes.
    pub range: Range<usize>,
    /// What to know about this place; may be empty.
    pub text: String,
}

/// Everything found so far.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    found: Vec<Diagnostic>,
}

/// Proof that at least one error is in the [`Diagnostics`]: a stage cannot fail silently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reported(());

impl Diagnostic {
    /// A diagnostic without a place yet.
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
            spans: Vec::new(),
            help: None,
            rustc: None,
        }
    }

    /// Adds a place; the first is where the author mends it.
    #[must_use]
    pub fn at(mut self, file: &Utf8Path, range: Range<usize>, text: impl Into<String>) -> Self {
        self.spans.push(Label {
            file: file.to_owned(),
            range,
            text: text.into(),
        });
        self
    }

    /// Says what to do.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Says what to do, if there is something to say.
    #[must_use]
    pub fn help_if(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
        self
    }

    /// Adds what rustc says about it.
    #[must_use]
    pub fn rustc(mut self, text: String) -> Self {
        self.rustc = Some(text);
        self
    }

    /// Error or warning, by its code.
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}

impl Diagnostics {
    /// Nothing found yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds what a stage found.
    pub fn add(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Adds an error after which the stage cannot go on. The code must be one of an error.
    pub fn fail(&mut self, error: Diagnostic) -> Reported {
        assert_eq!(error.severity(), Severity::Error, "only errors end a stage");
        self.add(error);
        Reported(())
    }

    /// The end of a stage: `Err` if there is an error by now.
    pub fn stop_at_errors(&self) -> Result<(), Reported> {
        if self.has_errors() {
            Err(Reported(()))
        } else {
            Ok(())
        }
    }

    /// Adds everything that was found elsewhere.
    pub fn extend(&mut self, others: Self) {
        self.found.extend(others.found);
    }

    /// Whether there is an error.
    pub fn has_errors(&self) -> bool {
        self.has(Severity::Error)
    }

    /// Whether there is a warning.
    pub fn has_warnings(&self) -> bool {
        self.has(Severity::Warning)
    }

    fn has(&self, severity: Severity) -> bool {
        self.found.iter().any(|one| one.severity() == severity)
    }

    /// Removes warnings that the author allows with `hulkgen: allow(CODE) reason` in a comment of that line or the line
    /// above. A reason has to be there.
    pub fn silence(&mut self, workspace: &Workspace) {
        self.found
            .retain(|one| one.severity() == Severity::Error || !is_allowed(one, workspace));
    }

    /// Every diagnostic once, by file and position; those without a place come first.
    pub fn sorted(&self) -> Vec<&Diagnostic> {
        let mut all: Vec<&Diagnostic> = self.found.iter().collect();
        all.sort_by_cached_key(|diagnostic| order(diagnostic));
        all.dedup();
        all
    }
}

fn is_allowed(warning: &Diagnostic, workspace: &Workspace) -> bool {
    let Some(label) = warning.spans.first() else {
        return false;
    };
    let text = workspace.text(&label.file).unwrap_or_default();
    let line = position(&text, label.range.start).line;
    let allow = format!("hulkgen: allow({})", warning.code.name());
    text.lines()
        .skip(line.saturating_sub(2))
        .take(line.min(2))
        .any(|line| {
            let reason = line.split_once(&allow).map(|(_, reason)| reason);
            reason.is_some_and(|reason| !reason.trim().is_empty())
        })
}

/// The key of the order in which diagnostics are shown.
fn order(diagnostic: &Diagnostic) -> impl Ord + use<'_> {
    let place = |label: &'_ Label| {
        (
            label.file.as_str().to_owned(),
            label.range.start,
            label.range.end,
        )
    };
    let places: Vec<_> = diagnostic.spans.iter().map(place).collect();
    let texts: Vec<&str> = diagnostic
        .spans
        .iter()
        .map(|label| label.text.as_str())
        .collect();
    (
        places,
        diagnostic.code.name(),
        &diagnostic.message,
        texts,
        &diagnostic.help,
        &diagnostic.rustc,
    )
}

impl fmt::Display for Reported {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("there are errors in the diagnostics")
    }
}

impl std::error::Error for Reported {}

#[cfg(test)]
mod tests;
