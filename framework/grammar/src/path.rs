//! Data paths and names: what the string literals of a context field say.

use std::fmt;

use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::parse::Parser;
use syn::{Ident, LitStr};

use crate::mistake::{Mistake, Rule};

const CYCLER_INSTANCE: &str = "$cycler_instance";

/// An identifier written as a string literal: an instance, a cycler, a procedure.
#[derive(Clone, Debug)]
pub struct Name {
    pub text: String,
    /// The literal.
    pub span: Span,
}

/// Where a value lies below an output, a state or the parameters: `lamp.position?.x`.
///
/// `Display` gives the written form.
#[derive(Clone, Debug)]
pub struct DataPath {
    /// Never empty.
    pub segments: Vec<Segment>,
    /// The literal.
    pub span: Span,
}

/// One name of a [`DataPath`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    pub name: SegmentName,
    /// `?` stands behind it: the field is an `Option` that is looked into.
    pub optional: bool,
}

/// What a [`Segment`] names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SegmentName {
    Field(String),
    /// `$cycler_instance`: the snake_case name of the instance.
    CyclerInstance,
}

impl DataPath {
    /// Whether a `?` stands anywhere in it.
    pub fn is_optional(&self) -> bool {
        self.segments.iter().any(|segment| segment.optional)
    }

    /// How often it names `$cycler_instance`.
    pub fn cycler_instances(&self) -> usize {
        let instances = self
            .segments
            .iter()
            .filter(|segment| segment.name == SegmentName::CyclerInstance);
        instances.count()
    }

    /// Reads a literal; what of it cannot be read is left out and told.
    pub(crate) fn read(literal: &LitStr, mistakes: &mut Vec<Mistake>) -> Self {
        let text = literal.value();
        let span = literal.span();
        let mut segments = Vec::new();
        for part in text.split('.') {
            match read_segment(part) {
                Ok(segment) => segments.push(segment),
                Err(reason) => {
                    mistakes.push(invalid(span, &text, &reason));
                    break;
                }
            }
        }
        Self { segments, span }
    }
}

impl Name {
    /// Reads a literal that must be an identifier; `what` says whose name it is.
    pub(crate) fn read(literal: &LitStr, what: &str, mistakes: &mut Vec<Mistake>) -> Self {
        let text = literal.value();
        let span = literal.span();
        if !is_identifier(&text) {
            let message = format!("`{text}` is no name of {what}: expected one identifier");
            mistakes.push(Mistake::new(Rule::InvalidName, span, message));
        }
        Self { text, span }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.text)
    }
}

impl fmt::Display for DataPath {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, segment) in self.segments.iter().enumerate() {
            let separator = if position == 0 { "" } else { "." };
            write!(formatter, "{separator}{segment}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Segment {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mark = if self.optional { "?" } else { "" };
        write!(formatter, "{}{mark}", self.name)
    }
}

impl fmt::Display for SegmentName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Field(name) => name,
            Self::CyclerInstance => CYCLER_INSTANCE,
        })
    }
}

/// A keyword since edition 2024, that of the generated crate; syn takes it for a name.
pub(crate) const LATEST_KEYWORD: &str = "gen";

/// Whether a field, an instance or a procedure may be called so.
pub(crate) fn is_identifier(text: &str) -> bool {
    is_bare(text) && text != LATEST_KEYWORD && syn::parse_str::<Ident>(text).is_ok()
}

fn is_keyword(text: &str) -> bool {
    let is_word = text != "_" && is_bare(text) && Ident::parse_any.parse_str(text).is_ok();
    is_word && !is_identifier(text)
}

/// The parser alone would forgive blanks and comments around a name.
fn is_bare(text: &str) -> bool {
    let bare = |character: char| character.is_alphanumeric() || character == '_';
    text.chars().all(bare)
}

fn read_segment(part: &str) -> Result<Segment, String> {
    let (name, optional) = match part.strip_suffix('?') {
        Some(name) => (name, true),
        None => (part, false),
    };
    let name = match name {
        CYCLER_INSTANCE if optional => {
            return Err(format!(
                "`{CYCLER_INSTANCE}` is always there, it takes no `?`"
            ));
        }
        CYCLER_INSTANCE => SegmentName::CyclerInstance,
        "" => return Err("a name is missing".into()),
        name if name.starts_with('$') => {
            return Err(format!(
                "`{name}` is not known, only `{CYCLER_INSTANCE}` is"
            ));
        }
        name if name.contains('?') => return Err("at most one `?` ends a name".into()),
        name if is_identifier(name) => SegmentName::Field(name.into()),
        name if is_keyword(name) => return Err(format!("`{name}` is a keyword of Rust")),
        name => return Err(format!("`{name}` is no identifier")),
    };
    Ok(Segment { name, optional })
}

fn invalid(span: Span, text: &str, reason: &str) -> Mistake {
    let message = format!("`{text}` is no path: {reason}");
    Mistake::new(Rule::InvalidPath, span, message)
        .help("write field names joined by `.`, with `?` behind each that is an `Option`")
}
