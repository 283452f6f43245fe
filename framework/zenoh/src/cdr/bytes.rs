//! From the robot's own bytes to CDR.

use super::Cdr;
use crate::Result;
use crate::layout::{DEEPEST, Layout, Part};

/// Parts that have no bytes, of which a count may claim any number.
const MOST_EMPTY: usize = 1 << 16;

impl Layout {
    /// The value in these bytes as CDR.
    ///
    /// # Errors
    /// If the bytes are not laid out so.
    pub(crate) fn to_cdr(&self, bytes: &[u8]) -> Result<Vec<u8>> {
        let mut writer = Writer {
            layout: self,
            rest: bytes,
            out: Cdr::new(),
            empty: 0,
        };
        let written = writer.write(&self.root, 0);
        match written {
            Some(()) if writer.rest.is_empty() => Ok(writer.out.0),
            _ => Err("a value of the robot is not laid out as the robot says".to_owned()),
        }
    }
}

/// `None` everywhere: the bytes end early or say what they cannot.
struct Writer<'bytes> {
    layout: &'bytes Layout,
    rest: &'bytes [u8],
    out: Cdr,
    empty: usize,
}

impl<'bytes> Writer<'bytes> {
    fn write(&mut self, part: &'bytes Part, depth: usize) -> Option<()> {
        if depth > DEEPEST || self.out.is_too_long() {
            return None;
        }
        if part.is_empty() {
            self.out.nothing();
            self.empty += 1;
            return (self.empty <= MOST_EMPTY).then_some(());
        }
        match part {
            Part::Bool => self.copy(1),
            Part::Float { bits } | Part::Signed { bits } | Part::Unsigned { bits } => {
                self.copy(usize::try_from(bits / 8).ok()?)
            }
            Part::Text => {
                let length = usize::try_from(self.count()?).ok()?;
                let (text, rest) = self.rest.split_at_checked(length)?;
                self.rest = rest;
                self.out.text(text)
            }
            Part::Option { content } => self.optional(content, depth),
            Part::List { item } => {
                let count = self.count()?;
                self.out.count(count);
                (0..count).try_for_each(|_| self.write(item, depth + 1))
            }
            Part::Array { item, length } => {
                (0..*length).try_for_each(|_| self.write(item, depth + 1))
            }
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
                self.out.count(variant);
                Some(())
            }
            Part::Reference { name } => self.write(self.layout.definitions.get(name)?, depth + 1),
            // The first is written above, the others were refused when the layout was read.
            Part::Unit | Part::Character | Part::Map | Part::Any => None,
        }
    }

    fn optional(&mut self, content: &'bytes Part, depth: usize) -> Option<()> {
        let (is_there, rest) = self.rest.split_first()?;
        self.rest = rest;
        match is_there {
            0 => self.out.count(0),
            1 => {
                self.out.count(1);
                self.write(content, depth + 1)?;
            }
            _ => return None,
        }
        Some(())
    }

    fn copy(&mut self, size: usize) -> Option<()> {
        let (number, rest) = self.rest.split_at_checked(size)?;
        self.rest = rest;
        self.out.number(number);
        Some(())
    }

    fn count(&mut self) -> Option<u32> {
        let (count, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(u32::from_le_bytes(*count))
    }
}
