//! Values as CDR, the form in which ROS 2 exchanges messages: from the robot's own bytes and their layout.
//!
//! It is the little-endian form of version 1 (XCDR1): four bytes that say so, then all parts in their order, numbers
//! aligned to their size, counts and lengths in four bytes, texts ended by a zero. An `Option` is a sequence of at most
//! one; an enum of names alone is the number of its variant in four bytes.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use crate::Result;

/// Says: CDR of version 1, little-endian.
const HEAD: [u8; 4] = [0, 1, 0, 0];

/// How deep parts of a value may lie in each other.
const DEEPEST: usize = 64;

/// A longer value of CDR is none that a robot sends many times in a second.
const LONGEST: usize = 64 << 20;

/// How the bytes of a value are laid out, as docs/protocol/binary.md says.
#[derive(Debug, Deserialize)]
pub(crate) struct Layout {
    root: Part,
    #[serde(default)]
    definitions: BTreeMap<String, Part>,
}

#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Part {
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
struct Field {
    name: String,
    layout: Part,
    #[serde(default)]
    optional: bool,
}

#[derive(Debug, Deserialize)]
struct Variant {
    name: String,
    content: Option<Box<Part>>,
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

    /// The value in these bytes as CDR.
    ///
    /// # Errors
    /// If the bytes are not laid out so.
    pub(crate) fn to_cdr(&self, bytes: &[u8]) -> Result<Vec<u8>> {
        let mut writer = Writer {
            layout: self,
            rest: bytes,
            out: HEAD.to_vec(),
        };
        let written = writer.write(&self.root, 0);
        match written {
            Some(()) if writer.rest.is_empty() => Ok(writer.out),
            _ => Err("a value of the robot is not laid out as the robot says".to_owned()),
        }
    }
}

impl Part {
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

/// From the robot's bytes to CDR. `None` everywhere: the bytes end early or say what they cannot.
struct Writer<'bytes> {
    layout: &'bytes Layout,
    rest: &'bytes [u8],
    out: Vec<u8>,
}

impl<'bytes> Writer<'bytes> {
    fn write(&mut self, part: &'bytes Part, depth: usize) -> Option<()> {
        if depth > DEEPEST || self.out.len() > LONGEST {
            return None;
        }
        match part {
            Part::Unit => Some(()),
            Part::Bool => self.copy(1),
            Part::Float { bits } | Part::Signed { bits } | Part::Unsigned { bits } => {
                self.copy(usize::try_from(bits / 8).ok()?)
            }
            Part::Text => {
                let length = self.count()?;
                let (text, rest) = self.rest.split_at_checked(usize::try_from(length).ok()?)?;
                self.rest = rest;
                self.number(length.checked_add(1)?);
                self.out.extend_from_slice(text);
                self.out.push(0);
                Some(())
            }
            Part::Option { content } => self.optional(content, depth),
            Part::List { item } => {
                let count = self.count()?;
                self.number(count);
                self.repeat(item, u64::from(count), depth)
            }
            Part::Array { item, length } => self.repeat(item, u64::try_from(*length).ok()?, depth),
            Part::Struct { fields } => fields.iter().try_for_each(|field| {
                if field.optional {
                    self.optional(&field.layout, depth)
                } else {
                    self.write(&field.layout, depth + 1)
                }
            }),
            Part::Tuple { items } => {
                let mut items = items.iter();
                items.try_for_each(|item| self.write(item, depth + 1))
            }
            Part::Enum { variants } => {
                let variant = self.count()?;
                variants.get(usize::try_from(variant).ok()?)?;
                self.number(variant);
                Some(())
            }
            Part::Reference { name } => self.write(self.layout.definitions.get(name)?, depth + 1),
            // Refused when the layout was read.
            Part::Character | Part::Map | Part::Any => None,
        }
    }

    fn repeat(&mut self, item: &'bytes Part, count: u64, depth: usize) -> Option<()> {
        for _ in 0..count {
            let before = self.rest.len();
            self.write(item, depth + 1)?;
            // Items without bytes are all the same, however many a count claims.
            if self.rest.len() == before {
                return Some(());
            }
        }
        Some(())
    }

    fn optional(&mut self, content: &'bytes Part, depth: usize) -> Option<()> {
        let (is_there, rest) = self.rest.split_first()?;
        self.rest = rest;
        match is_there {
            0 => self.number(0),
            1 => {
                self.number(1);
                self.write(content, depth + 1)?;
            }
            _ => return None,
        }
        Some(())
    }

    /// A number of so many bytes, behind as many empty ones as its alignment needs.
    fn copy(&mut self, size: usize) -> Option<()> {
        let (number, rest) = self.rest.split_at_checked(size)?;
        self.rest = rest;
        self.align(size);
        self.out.extend_from_slice(number);
        Some(())
    }

    fn number(&mut self, number: u32) {
        self.align(4);
        self.out.extend_from_slice(&number.to_le_bytes());
    }

    /// Counts from behind the head.
    fn align(&mut self, size: usize) {
        let length = (self.out.len() - HEAD.len()).next_multiple_of(size);
        self.out.resize(HEAD.len() + length, 0);
    }

    fn count(&mut self) -> Option<u32> {
        let (count, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(u32::from_le_bytes(*count))
    }
}

/// What rmw_zenoh puts beside each message: the number of the message, when it was made in nanoseconds since 1970, and who
/// made it, with its length before it.
pub(crate) fn attachment(cycle: u64, time: u64, id: [u8; 16]) -> Vec<u8> {
    let mut bytes = cycle.to_le_bytes().to_vec();
    bytes.extend_from_slice(&time.to_le_bytes());
    bytes.push(16);
    bytes.extend_from_slice(&id);
    bytes
}

#[cfg(test)]
mod tests;
