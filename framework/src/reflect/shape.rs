//! What values of a type look like, without a value: for lists of paths, schemas and editors.

use std::borrow::Cow;
use std::cell::RefCell;

use serde::Serialize;

use super::{Limits, Pixels, Reflect};

/// The name of no type: variants differ there.
pub(super) const UNTOLD: &str = "";

/// A type as its serde form shows it.
#[derive(Clone, Debug, Serialize)]
pub struct Shape {
    /// Full name of the type, for people.
    pub type_name: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub docs: &'static str,
    pub content: Content,
    #[serde(skip_serializing_if = "Form::is_plain")]
    pub form: Form,
    /// Its values are images; [`Shape::image`] sees through an `Option`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pixels: Option<Pixels>,
}

/// How a serde form differs from what the content alone would tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Not at all.
    #[default]
    Plain,
    /// It has parts that the content does not know: flattened, hidden, or written by functions of the author's own.
    Open,
    /// The variant's name stands among its fields: `#[serde(tag)]`.
    Tagged { tag: &'static str },
    /// The variant's name stands beside its content: `#[serde(tag, content)]`.
    Adjacent {
        tag: &'static str,
        content: &'static str,
    },
    /// The variant has no name: `#[serde(untagged)]`.
    Untagged,
}

/// What a value consists of.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// Nothing below it.
    Leaf(Leaf),
    /// Content, or null.
    Option(Box<Shape>),
    /// Elements of one type; `names` are other words for the indices, as `x`, `y`, `z`.
    List {
        item: Box<Shape>,
        #[serde(skip_serializing_if = "Option::is_none")]
        length: Option<usize>,
        #[serde(skip_serializing_if = "<[_]>::is_empty")]
        names: &'static [&'static str],
    },
    /// Values of one type, each once, without an index.
    Set(Box<Shape>),
    /// Values of one type by key; keys are texts.
    Map(Box<Shape>),
    /// In the order of the source.
    Struct(Vec<FieldShape>),
    /// Elements of several types.
    Tuple(Vec<Shape>),
    /// In the order of the source.
    Enum(Vec<VariantShape>),
    /// A type inside of itself: its content is that of the outer one.
    #[serde(serialize_with = "nothing")]
    Recursive(fn() -> Shape),
}

/// A value without parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Leaf {
    Bool,
    Character,
    /// Whole seconds and nanoseconds.
    Duration,
    Float {
        bits: u32,
    },
    /// Something with a serde form of its own.
    Opaque,
    Signed {
        bits: u32,
    },
    Text,
    Unit,
    Unsigned {
        bits: u32,
    },
}

/// A field of a struct.
#[derive(Clone, Debug, Serialize)]
pub struct FieldShape {
    /// As serde names it.
    pub name: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub docs: &'static str,
    /// From `#[reflect(unit = "…")]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<&'static str>,
    /// From `#[reflect(range = …)]`: where every number in it must lie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<Limits>,
    /// It may be left out of the serde form.
    #[serde(skip_serializing_if = "is_false")]
    pub optional: bool,
    /// From `#[reflect(creation_only)]`: read once, when nodes are created.
    #[serde(skip_serializing_if = "is_false")]
    pub creation_only: bool,
    pub shape: Shape,
}

/// A variant of an enum.
#[derive(Clone, Debug, Serialize)]
pub struct VariantShape {
    /// As serde names it.
    pub name: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub docs: &'static str,
    pub content: VariantContent,
}

/// What a variant holds.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum VariantContent {
    Unit,
    /// One field without a name: a value of its own.
    Value(Shape),
    /// Any other fields, [`Content::Struct`] or [`Content::Tuple`]: they are parts of the enum itself.
    Fields(Content),
}

impl FieldShape {
    /// A field without anything that attributes or documentation say.
    pub fn new(name: &'static str, shape: Shape) -> Self {
        Self {
            name,
            docs: "",
            unit: None,
            range: None,
            optional: false,
            creation_only: false,
            shape,
        }
    }
}

impl Form {
    /// Whether the content tells all.
    pub fn is_plain(&self) -> bool {
        *self == Self::Plain
    }
}

impl Shape {
    /// The shape of `T`, as its content tells.
    pub fn new<T>(content: Content) -> Self {
        Self {
            type_name: std::any::type_name::<T>(),
            docs: "",
            content,
            form: Form::Plain,
            pixels: None,
        }
    }

    /// The shape of `T`, which may lie in itself.
    pub fn of<T: Reflect>(shape: impl FnOnce() -> Self) -> Self {
        let type_name = std::any::type_name::<T>();
        match Entered::new(type_name) {
            Some(_entered) => Self {
                type_name,
                ..shape()
            },
            None => Self::new::<T>(Content::Recursive(T::shape)),
        }
    }

    /// The shape of `T`, which has no parts.
    pub fn leaf<T>(leaf: Leaf) -> Self {
        Self::new::<T>(Content::Leaf(leaf))
    }

    /// What there is inside of all options and types that lie in themselves; `None` of an option of itself.
    pub fn opened(&self) -> Option<Cow<'_, Self>> {
        let mut shape = Cow::Borrowed(self);
        let mut expanded = Vec::new();
        loop {
            shape = match shape {
                Cow::Borrowed(Self {
                    content: Content::Option(inner),
                    ..
                }) => Cow::Borrowed(inner),
                Cow::Owned(Self {
                    content: Content::Option(inner),
                    ..
                }) => Cow::Owned(*inner),
                other => match other.content {
                    Content::Recursive(_) if expanded.contains(&other.type_name) => return None,
                    Content::Recursive(expand) => {
                        expanded.push(other.type_name);
                        Cow::Owned(expand())
                    }
                    _ => return Some(other),
                },
            };
        }
    }

    /// Whether the type does not tell what its values look like.
    pub fn is_opaque(&self) -> bool {
        matches!(self.content, Content::Leaf(Leaf::Opaque))
    }
}

impl VariantShape {
    /// Whether nothing is below it.
    pub(super) fn is_unit(&self) -> bool {
        matches!(self.content, VariantContent::Unit)
    }
}

thread_local! {
    /// Types whose shape is being made, outermost first.
    static OPEN: RefCell<Vec<&'static str>> = const { RefCell::new(Vec::new()) };
}

/// A type whose shape is being made, until dropped.
struct Entered;

impl Entered {
    /// `None` if it is being made already.
    fn new(type_name: &'static str) -> Option<Self> {
        OPEN.with_borrow_mut(|open| {
            let entered = !open.contains(&type_name);
            entered.then(|| {
                open.push(type_name);
                Self
            })
        })
    }
}

impl Drop for Entered {
    fn drop(&mut self) {
        OPEN.with_borrow_mut(Vec::pop);
    }
}

fn is_false(value: &bool) -> bool {
    !value
}

fn nothing<S: serde::Serializer>(
    _expand: &fn() -> Shape,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.serialize_unit()
}
