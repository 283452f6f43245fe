//! What a value consists of, as the robot tells it (docs/protocol/binary.md).

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use crate::Result;

/// How deep parts of a value may lie in each other.
pub(crate) const DEEPEST: usize = 64;

/// How the bytes of a value are laid out, as docs/protocol/binary.md says.
#[derive(Debug, Deserialize)]
pub(crate) struct Layout {
    pub(crate) root: Part,
    #[serde(default)]
    pub(crate) definitions: BTreeMap<String, Part>,
}

#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum Part {
    Unit,
    Bool,
    Character,
    Float { bits: u32 },
    Signed { bits: u32 },
    Unsigned { bits: u32 },
    Text,
    Option { content: Box<Part> },
    List { item: Box<Part> },
    Array { item: Box<Part>, length: usize },
    Map,
    Struct { fields: Vec<Field> },
    Tuple { items: Vec<Part> },
    Enum { variants: Vec<Variant> },
    Any,
    Reference { name: String },
}

#[derive(Debug, Deserialize)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) layout: Part,
    #[serde(default)]
    pub(crate) optional: bool,
}

#[derive(Debug, Deserialize)]
pub(crate) struct Variant {
    pub(crate) name: String,
    pub(crate) content: Option<Box<Part>>,
}

impl Layout {
    /// From the robot's words.
    ///
    /// # Errors
    /// If it is none, or has a part that CDR has no form for.
    pub(crate) fn read(layout: Value) -> Result<Self> {
        let layout: Self = serde_json::from_value(layout)
            .map_err(|error| format!("the robot tells a layout that is none: {error}"))?;
        let parts = [&layout.root]
            .into_iter()
            .chain(layout.definitions.values());
        for part in parts {
            part.check("the value", 0)?;
        }
        Ok(layout)
    }
}

impl Part {
    /// Whether it has no parts, as a message of ROS 2 cannot: there it has a byte.
    pub(crate) fn is_empty(&self) -> bool {
        match self {
            Self::Unit | Self::Array { length: 0, .. } => true,
            Self::Struct { fields } => fields.is_empty(),
            Self::Tuple { items } => items.is_empty(),
            _ => false,
        }
    }

    fn check(&self, place: &str, depth: usize) -> Result<()> {
        let without = |what: &str| {
            Err(format!(
                "{place} is {what}, which has no form in CDR: write `encoding = \"json\"` at its `[[bridge]]`, or name a part of it"
            ))
        };
        if depth > DEEPEST {
            return Err(format!("{place} lies too deep"));
        }
        match self {
            Self::Unit | Self::Bool | Self::Text | Self::Reference { .. } => Ok(()),
            Self::Float { bits: 32 | 64 } => Ok(()),
            Self::Signed {
                bits: 8 | 16 | 32 | 64,
            }
            | Self::Unsigned {
                bits: 8 | 16 | 32 | 64,
            } => Ok(()),
            Self::Option { content: item } | Self::List { item } | Self::Array { item, .. } => {
                item.check(place, depth + 1)
            }
            Self::Struct { fields } => fields.iter().try_for_each(|field| {
                let place = format!("`{}`", field.name);
                field.layout.check(&place, depth + 1)
            }),
            Self::Tuple { items } => {
                let mut items = items.iter();
                items.try_for_each(|item| item.check(place, depth + 1))
            }
            Self::Enum { variants } => match variants.iter().find(|one| one.content.is_some()) {
                Some(variant) => without(&format!(
                    "an enum whose variant `{}` holds something",
                    variant.name
                )),
                None => Ok(()),
            },
            Self::Float { .. } | Self::Signed { .. } | Self::Unsigned { .. } => {
                without("a number of unusual size")
            }
            Self::Character => without("a letter"),
            Self::Map => without("a map"),
            Self::Any => without("of a kind that only its values tell"),
        }
    }
}
