//! From the robot's JSON to CDR: of what it tells in no other form.

use serde_json::Value;

use super::Cdr;
use crate::Result;
use crate::layout::{DEEPEST, Layout, Part};

impl Layout {
    /// The value as CDR; `None`: it is `null`, and nothing of this layout is.
    ///
    /// # Errors
    /// If it is not laid out so.
    pub(crate) fn json_to_cdr(&self, value: &Value) -> Result<Option<Vec<u8>>> {
        if value.is_null() && !matches!(self.root, Part::Unit | Part::Option { .. }) {
            return Ok(None);
        }
        let mut writer = Writer {
            layout: self,
            out: Cdr::new(),
        };
        match writer.write(&self.root, value, 0) {
            Some(()) => Ok(Some(writer.out.0)),
            None => Err("a value of the robot is not laid out as the robot says".to_owned()),
        }
    }
}

/// `None` everywhere: the value is of another type.
struct Writer<'layout> {
    layout: &'layout Layout,
    out: Cdr,
}

impl<'layout> Writer<'layout> {
    fn write(&mut self, part: &'layout Part, value: &Value, depth: usize) -> Option<()> {
        if depth > DEEPEST || self.out.is_too_long() {
            return None;
        }
        if part.is_empty() {
            self.out.nothing();
            return Some(());
        }
        match part {
            Part::Bool => self.out.number(&[u8::from(value.as_bool()?)]),
            Part::Float { bits } => self.float(*bits, value)?,
            Part::Signed { bits } => self.signed(*bits, value.as_i64()?)?,
            Part::Unsigned { bits } => self.unsigned(*bits, value.as_u64()?)?,
            Part::Text => self.out.text(value.as_str()?.as_bytes())?,
            Part::Option { content } => self.optional(content, value, depth)?,
            Part::List { item } => {
                let items = value.as_array()?;
                self.out.count(u32::try_from(items.len()).ok()?);
                let mut items = items.iter();
                items.try_for_each(|value| self.write(item, value, depth + 1))?;
            }
            Part::Array { item, length } => {
                let items = value.as_array().filter(|items| items.len() == *length)?;
                let mut items = items.iter();
                items.try_for_each(|value| self.write(item, value, depth + 1))?;
            }
            Part::Struct { fields } => {
                for field in fields {
                    match value.as_object()?.get(&field.name) {
                        None if field.optional => self.out.count(0),
                        Some(value) if field.optional => {
                            self.out.count(1);
                            self.write(&field.layout, value, depth + 1)?;
                        }
                        value => self.write(&field.layout, value?, depth + 1)?,
                    }
                }
            }
            Part::Tuple { items } => {
                let values = value.as_array().filter(|it| it.len() == items.len())?;
                let mut both = items.iter().zip(values);
                both.try_for_each(|(item, value)| self.write(item, value, depth + 1))?;
            }
            Part::Enum { variants } => {
                let name = value.as_str()?;
                let variant = variants.iter().position(|one| one.name == name)?;
                self.out.count(u32::try_from(variant).ok()?);
            }
            Part::Reference { name } => {
                self.write(self.layout.definitions.get(name)?, value, depth + 1)?;
            }
            // The first is written above, the others were refused when the layout was read.
            Part::Unit | Part::Character | Part::Map | Part::Any => return None,
        }
        Some(())
    }

    fn optional(&mut self, content: &'layout Part, value: &Value, depth: usize) -> Option<()> {
        if value.is_null() {
            self.out.count(0);
            return Some(());
        }
        self.out.count(1);
        self.write(content, value, depth + 1)
    }

    /// JSON has no NaN and no infinity: both are `null` there, and NaN here.
    fn float(&mut self, bits: u32, value: &Value) -> Option<()> {
        let number = match value {
            Value::Null => f64::NAN,
            value => value.as_f64()?,
        };
        match bits {
            32 => {
                #[expect(clippy::cast_possible_truncation, reason = "the robot has an f32")]
                let number = number as f32;
                self.out.number(&number.to_le_bytes());
            }
            _ => self.out.number(&number.to_le_bytes()),
        }
        Some(())
    }

    fn signed(&mut self, bits: u32, number: i64) -> Option<()> {
        let shift = 64_u32.checked_sub(bits)?;
        ((number << shift) >> shift == number).then(|| self.lowest(bits, number.to_le_bytes()))
    }

    fn unsigned(&mut self, bits: u32, number: u64) -> Option<()> {
        let shift = 64_u32.checked_sub(bits)?;
        ((number << shift) >> shift == number).then(|| self.lowest(bits, number.to_le_bytes()))
    }

    fn lowest(&mut self, bits: u32, bytes: [u8; 8]) {
        let size = usize::try_from(bits / 8).unwrap_or(bytes.len());
        self.out.number(&bytes[..size.min(bytes.len())]);
    }
}
