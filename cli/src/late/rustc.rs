//! What cargo and rustc say with `--message-format=json`.

use serde::Deserialize;

/// A line of cargo's output.
#[derive(Debug, Deserialize)]
pub struct Line {
    pub reason: String,
    /// Of `compiler-message`.
    pub message: Option<Message>,
    /// Of `compiler-artifact`.
    pub target: Option<Target>,
    /// Of `compiler-artifact`, if it is a program.
    pub executable: Option<String>,
}

/// What cargo has compiled.
#[derive(Debug, Deserialize)]
pub struct Target {
    pub name: String,
}

/// An error or a warning.
#[derive(Clone, Debug, Deserialize)]
pub struct Message {
    pub message: String,
    pub level: Level,
    pub spans: Vec<Span>,
    /// Notes and helps to it.
    #[serde(default)]
    pub children: Vec<Note>,
    /// As rustc shows it on a terminal.
    #[serde(default)]
    pub rendered: String,
}

/// A note or a help to an error.
#[derive(Clone, Debug, Deserialize)]
pub struct Note {
    pub message: String,
    pub level: Level,
    pub spans: Vec<Span>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    #[serde(alias = "error: internal compiler error")]
    Error,
    Warning,
    Note,
    #[serde(other)]
    Other,
}

/// A place in a file.
#[derive(Clone, Debug, Deserialize)]
pub struct Span {
    /// Relative to the folder of cargo's workspace, for its own packages.
    pub file_name: String,
    pub byte_start: usize,
    pub byte_end: usize,
    /// From 1.
    pub line_start: usize,
    /// From 1, in characters.
    pub column_start: usize,
    pub is_primary: bool,
    pub label: Option<String>,
    pub expansion: Option<Box<Expansion>>,
}

/// The macro that made what is at a place.
#[derive(Clone, Debug, Deserialize)]
pub struct Expansion {
    /// Where it is called.
    pub span: Span,
}

impl Message {
    /// Where it is; `None` for what concerns no file, as the linker's errors.
    pub(super) fn primary(&self) -> Option<&Span> {
        self.spans.iter().find(|span| span.is_primary)
    }

    /// Places besides the first, each with what is said about it: of the error itself, then of its notes.
    pub(super) fn others(&self) -> impl Iterator<Item = (&Span, &str)> {
        let own = self.spans.iter().filter(|span| !span.is_primary);
        let own = own.map(|span| (span, span.label.as_deref().unwrap_or_default()));
        let notes = self.notes().flat_map(|note| {
            let spans = note.spans.iter();
            spans.map(|span| (span, note.message.as_str()))
        });
        own.chain(notes)
    }

    /// What is said besides, without what rustc would write instead.
    pub(super) fn notes(&self) -> impl Iterator<Item = &Note> {
        let children = self.children.iter();
        children.filter(|child| child.level == Level::Note)
    }

    /// "aborting due to 2 previous errors", "1 warning emitted": said of the others.
    pub(super) fn is_summary(&self) -> bool {
        let message = &self.message;
        self.spans.is_empty()
            && (message.starts_with("aborting due to") || message.ends_with(" emitted"))
    }
}

impl Span {
    /// This place, then where the macro is called that made it, and so on outwards.
    pub(super) fn calls(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |span| {
            span.expansion.as_ref().map(|expansion| &expansion.span)
        })
    }
}
