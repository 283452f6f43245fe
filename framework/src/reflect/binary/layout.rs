//! What stands where in the bytes of a value.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::super::{Content, FieldShape, Form, Leaf, Shape, VariantContent, VariantShape};

/// How a value of one type is laid out; enough to read it without knowing the type.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layout {
    pub root: LayoutContent,
    /// Types that contain themselves, by the name that a `reference` has.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub definitions: BTreeMap<String, LayoutContent>,
}

/// What a value consists of. Numbers are little-endian, nothing is padded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LayoutContent {
    /// No bytes: `null`.
    Unit,
    /// One byte, 0 or 1.
    Bool,
    /// A Unicode scalar value in 32 bits.
    Character,
    /// IEEE 754.
    Float {
        bits: u32,
    },
    /// Two's complement.
    Signed {
        bits: u32,
    },
    Unsigned {
        bits: u32,
    },
    /// Length in bytes (32 bits), UTF-8.
    Text,
    /// One byte, 0 or 1; then the content, if it is 1.
    Option {
        content: Box<LayoutContent>,
    },
    /// Number of items (32 bits), items.
    List {
        item: Box<LayoutContent>,
    },
    /// Always so many items, without their number.
    Array {
        item: Box<LayoutContent>,
        length: usize,
    },
    /// Number of entries (32 bits); each a text, the key, and a value.
    Map {
        value: Box<LayoutContent>,
    },
    /// Fields, one after the other.
    Struct {
        fields: Vec<LayoutField>,
    },
    /// Items, one after the other.
    Tuple {
        items: Vec<LayoutContent>,
    },
    /// Which variant (32 bits, from 0), its content.
    Enum {
        variants: Vec<LayoutVariant>,
    },
    /// Every part with its kind before it.
    Any,
    /// As the definition with this name.
    Reference {
        name: String,
    },
}

/// A field of a struct.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LayoutField {
    pub name: String,
    /// One byte, 0 or 1, stands before it; with 0 there is no such field.
    #[serde(default, skip_serializing_if = "is_false")]
    pub optional: bool,
    pub layout: LayoutContent,
}

/// A variant of an enum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LayoutVariant {
    pub name: String,
    /// None: the variant is its name alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub content: Option<LayoutContent>,
}

impl Shape {
    /// How [`super::encode`] writes a value of this shape.
    pub fn layout(&self) -> Layout {
        let mut definitions = BTreeMap::new();
        let root = Describe {
            definitions: &mut definitions,
        }
        .shape(self);
        Layout { root, definitions }
    }
}

struct Describe<'all> {
    definitions: &'all mut BTreeMap<String, LayoutContent>,
}

impl Describe<'_> {
    fn shape(&mut self, shape: &Shape) -> LayoutContent {
        if let Content::Recursive(expand) = &shape.content {
            let name = shape.type_name.to_owned();
            if !self.definitions.contains_key(&name) {
                // Known before its parts are, which refer to it.
                self.definitions.insert(name.clone(), LayoutContent::Any);
                let expanded = self.shape(&expand());
                self.definitions.insert(name.clone(), expanded);
            }
            return LayoutContent::Reference { name };
        }
        match shape.form {
            Form::Plain => self.content(&shape.content),
            Form::Open | Form::Tagged { .. } | Form::Adjacent { .. } | Form::Untagged => {
                LayoutContent::Any
            }
        }
    }

    fn content(&mut self, content: &Content) -> LayoutContent {
        match content {
            Content::Leaf(leaf) => leaf_layout(*leaf),
            Content::Option(inner) => LayoutContent::Option {
                content: Box::new(self.shape(inner)),
            },
            Content::List {
                item,
                length: Some(length),
                ..
            } => LayoutContent::Array {
                item: Box::new(self.shape(item)),
                length: *length,
            },
            Content::List { item, .. } | Content::Set(item) => LayoutContent::List {
                item: Box::new(self.shape(item)),
            },
            Content::Map(value) => LayoutContent::Map {
                value: Box::new(self.shape(value)),
            },
            Content::Struct(fields) => LayoutContent::Struct {
                fields: fields.iter().map(|field| self.field(field)).collect(),
            },
            Content::Tuple(items) => LayoutContent::Tuple {
                items: items.iter().map(|item| self.shape(item)).collect(),
            },
            Content::Enum(variants) => LayoutContent::Enum {
                variants: variants.iter().map(|it| self.variant(it)).collect(),
            },
            Content::Recursive(expand) => self.shape(&expand()),
        }
    }

    fn field(&mut self, field: &FieldShape) -> LayoutField {
        LayoutField {
            name: field.name.to_owned(),
            optional: field.optional,
            layout: self.shape(&field.shape),
        }
    }

    fn variant(&mut self, variant: &VariantShape) -> LayoutVariant {
        LayoutVariant {
            name: variant.name.to_owned(),
            content: match &variant.content {
                VariantContent::Unit => None,
                VariantContent::Value(shape) => Some(self.shape(shape)),
                VariantContent::Fields(content) => Some(self.content(content)),
            },
        }
    }
}

fn leaf_layout(leaf: Leaf) -> LayoutContent {
    match leaf {
        Leaf::Unit => LayoutContent::Unit,
        Leaf::Bool => LayoutContent::Bool,
        Leaf::Character => LayoutContent::Character,
        Leaf::Float { bits } => LayoutContent::Float { bits },
        Leaf::Signed { bits } => LayoutContent::Signed { bits },
        Leaf::Unsigned { bits } => LayoutContent::Unsigned { bits },
        Leaf::Text => LayoutContent::Text,
        Leaf::Opaque => LayoutContent::Any,
        Leaf::Duration => {
            let part = |name: &str, bits| LayoutField {
                name: name.to_owned(),
                optional: false,
                layout: LayoutContent::Unsigned { bits },
            };
            LayoutContent::Struct {
                fields: vec![part("secs", 64), part("nanos", 32)],
            }
        }
    }
}

fn is_false(value: &bool) -> bool {
    !value
}
