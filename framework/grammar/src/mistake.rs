//! What is wrong in a node file.

use proc_macro2::Span;

/// One thing that an author has to mend.
#[derive(Clone, Debug)]
pub struct Mistake {
    pub rule: Rule,
    /// A lower-case fragment with names in backticks and without a full stop.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// The literal, the kind, the field or the part of a signature that is wrong.
    pub span: Span,
}

/// Which rule of the grammar a [`Mistake`] breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// Several types of one file have `new(CreationContext)` and `cycle(CycleContext)`.
    AmbiguousNode,
    /// The struct itself: private, generic, or without named fields.
    InvalidContext,
    /// A field's type: wrong number or sort of arguments, or nothing the grammar knows.
    InvalidField,
    /// A name in a literal that is no identifier: instance or procedure.
    InvalidName,
    /// A data path that cannot be read, or `$cycler_instance` where it has no meaning.
    InvalidPath,
    /// `new`, `cycle` or `restore` in another form than the contract's.
    InvalidSignature,
    /// A kind in a context where it has no meaning.
    MisplacedKind,
    /// No type of the file has `new` and `cycle`.
    MissingNode,
    /// `?` and the written type disagree.
    OptionMismatch,
    /// A field whose type is no kind.
    UnknownKind,
}

impl Mistake {
    /// A mistake without help.
    pub fn new(rule: Rule, span: Span, message: impl Into<String>) -> Self {
        Self {
            rule,
            message: message.into(),
            help: None,
            span,
        }
    }

    /// The same with a deed that mends it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}
