//! Bytes as JSON, by the layout alone.

use std::fmt;

use serde_json::{Map, Value};

use super::any::kind;
use super::layout::{Layout, LayoutContent, LayoutField, LayoutVariant};

/// Types that contain themselves, and parts that tell their own kind, are followed no deeper.
const DEPTH: usize = 128;
/// Parts without bytes of their own (structs, units) that a byte may have around it.
const PARTS_PER_BYTE: usize = 64;
/// Parts that a value may have however few bytes it has.
const PARTS: usize = 65_536;

/// Bytes that are no value of the layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DecodeError {
    /// Counted from 0.
    pub position: usize,
    pub message: String,
}

/// The value that the bytes stand for, as its serde form in JSON: a number that JSON does not have is null, one of more
/// than 64 bits a text.
pub fn decode(layout: &Layout, bytes: &[u8]) -> Result<Value, DecodeError> {
    let mut decoder = Decoder {
        layout,
        bytes,
        position: 0,
        depth: 0,
        parts_left: bytes
            .len()
            .saturating_mul(PARTS_PER_BYTE)
            .saturating_add(PARTS),
    };
    let value = decoder.content(&layout.root)?;
    match bytes.len() - decoder.position {
        0 => Ok(value),
        rest => Err(decoder.error(format!("{rest} bytes more than the value has"))),
    }
}

struct Decoder<'all> {
    layout: &'all Layout,
    bytes: &'all [u8],
    position: usize,
    depth: usize,
    /// Against layouts that make much of few bytes.
    parts_left: usize,
}

impl Decoder<'_> {
    fn content(&mut self, content: &LayoutContent) -> Result<Value, DecodeError> {
        self.enter()?;
        let value = match content {
            LayoutContent::Unit => Value::Null,
            LayoutContent::Bool => self.flag()?.into(),
            LayoutContent::Character => self.character()?.to_string().into(),
            LayoutContent::Float { bits } => self.float(*bits)?,
            LayoutContent::Signed { bits } => self.signed(*bits)?,
            LayoutContent::Unsigned { bits } => self.unsigned(*bits)?,
            LayoutContent::Text => self.text()?.into(),
            LayoutContent::Option { content } => match self.flag()? {
                true => self.content(content)?,
                false => Value::Null,
            },
            LayoutContent::List { item } => {
                let count = self.count()?;
                self.items(count, |decoder| decoder.content(item))?
            }
            LayoutContent::Array { item, length } => {
                self.items(*length, |decoder| decoder.content(item))?
            }
            LayoutContent::Map { value } => self.map(|decoder| decoder.content(value))?,
            LayoutContent::Struct { fields } => self.fields(fields)?,
            LayoutContent::Tuple { items } => {
                let items = items.iter().map(|item| self.content(item));
                items.collect::<Result<Vec<_>, _>>()?.into()
            }
            LayoutContent::Enum { variants } => self.variant(variants)?,
            LayoutContent::Any => self.any()?,
            LayoutContent::Reference { name } => match self.layout.definitions.get(name) {
                Some(content) => self.content(content)?,
                None => return Err(self.error(format!("the layout does not define `{name}`"))),
            },
        };
        self.depth -= 1;
        Ok(value)
    }

    fn enter(&mut self) -> Result<(), DecodeError> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(self.error(format!("more than {DEPTH} parts inside of each other")));
        }
        match self.parts_left.checked_sub(1) {
            Some(left) => self.parts_left = left,
            None => return Err(self.error("too many parts for so few bytes".to_owned())),
        }
        Ok(())
    }

    fn fields(&mut self, fields: &[LayoutField]) -> Result<Value, DecodeError> {
        let mut object = Map::new();
        for field in fields {
            if !field.optional || self.flag()? {
                object.insert(field.name.clone(), self.content(&field.layout)?);
            }
        }
        Ok(object.into())
    }

    fn variant(&mut self, variants: &[LayoutVariant]) -> Result<Value, DecodeError> {
        let tag = u32::from_le_bytes(self.take()?);
        let variant = usize::try_from(tag).ok().and_then(|tag| variants.get(tag));
        let Some(LayoutVariant { name, content }) = variant else {
            return Err(self.error(format!("no variant {tag}")));
        };
        match content {
            None => Ok(name.clone().into()),
            Some(content) => {
                let content = self.content(content)?;
                Ok(Map::from_iter([(name.clone(), content)]).into())
            }
        }
    }

    fn any(&mut self) -> Result<Value, DecodeError> {
        self.enter()?;
        let [kind] = self.take()?;
        let value = match kind {
            kind::NULL => Value::Null,
            kind::FALSE => false.into(),
            kind::TRUE => true.into(),
            kind::SIGNED => i64::from_le_bytes(self.take()?).into(),
            kind::UNSIGNED => u64::from_le_bytes(self.take()?).into(),
            kind::FLOAT => f64::from_le_bytes(self.take()?).into(),
            kind::TEXT => self.text()?.into(),
            kind::LIST => {
                let count = self.count()?;
                self.items(count, Self::any)?
            }
            kind::MAP => self.map(Self::any)?,
            kind => return Err(self.error(format!("no kind {kind}"))),
        };
        self.depth -= 1;
        Ok(value)
    }

    fn items(
        &mut self,
        count: usize,
        mut item: impl FnMut(&mut Self) -> Result<Value, DecodeError>,
    ) -> Result<Value, DecodeError> {
        // Not reserved: the count may be a lie.
        let mut items = Vec::new();
        for _ in 0..count {
            items.push(item(self)?);
        }
        Ok(items.into())
    }

    fn map(
        &mut self,
        mut value: impl FnMut(&mut Self) -> Result<Value, DecodeError>,
    ) -> Result<Value, DecodeError> {
        let mut entries = Map::new();
        for _ in 0..self.count()? {
            let key = self.text()?.to_owned();
            entries.insert(key, value(self)?);
        }
        Ok(entries.into())
    }

    fn float(&mut self, bits: u32) -> Result<Value, DecodeError> {
        match bits {
            32 => Ok(f32::from_le_bytes(self.take()?).into()),
            64 => Ok(f64::from_le_bytes(self.take()?).into()),
            _ => Err(self.error(format!("no float has {bits} bits"))),
        }
    }

    fn signed(&mut self, bits: u32) -> Result<Value, DecodeError> {
        let number = match bits {
            8 => i8::from_le_bytes(self.take()?).into(),
            16 => i16::from_le_bytes(self.take()?).into(),
            32 => i32::from_le_bytes(self.take()?).into(),
            64 => i64::from_le_bytes(self.take()?).into(),
            128 => i128::from_le_bytes(self.take()?),
            _ => return Err(self.error(format!("no number has {bits} bits"))),
        };
        Ok(i64::try_from(number).map_or_else(|_| number.to_string().into(), Value::from))
    }

    fn unsigned(&mut self, bits: u32) -> Result<Value, DecodeError> {
        let number = match bits {
            8 => u8::from_le_bytes(self.take()?).into(),
            16 => u16::from_le_bytes(self.take()?).into(),
            32 => u32::from_le_bytes(self.take()?).into(),
            64 => u64::from_le_bytes(self.take()?).into(),
            128 => u128::from_le_bytes(self.take()?),
            _ => return Err(self.error(format!("no number has {bits} bits"))),
        };
        Ok(u64::try_from(number).map_or_else(|_| number.to_string().into(), Value::from))
    }

    fn flag(&mut self) -> Result<bool, DecodeError> {
        match self.take()? {
            [0] => Ok(false),
            [1] => Ok(true),
            [other] => Err(self.error(format!("expected 0 or 1, found {other}"))),
        }
    }

    fn character(&mut self) -> Result<char, DecodeError> {
        let number = u32::from_le_bytes(self.take()?);
        char::from_u32(number).ok_or_else(|| self.error(format!("no character {number}")))
    }

    fn text(&mut self) -> Result<&str, DecodeError> {
        let length = self.count()?;
        let start = self.position;
        let bytes = self.bytes.get(start..).and_then(|rest| rest.get(..length));
        let Some(bytes) = bytes else {
            return Err(self.error(format!("a text of {length} bytes goes beyond the end")));
        };
        self.position += length;
        std::str::from_utf8(bytes).map_err(|error| DecodeError {
            position: start + error.valid_up_to(),
            message: "the text is no UTF-8".to_owned(),
        })
    }

    fn count(&mut self) -> Result<usize, DecodeError> {
        let count = u32::from_le_bytes(self.take()?);
        usize::try_from(count).map_err(|error| self.error(error.to_string()))
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        let Some(bytes) = rest.first_chunk() else {
            return Err(self.error(format!("expected {N} bytes, {} are left", rest.len())));
        };
        self.position += N;
        Ok(*bytes)
    }

    fn error(&self, message: String) -> DecodeError {
        DecodeError {
            position: self.position,
            message,
        }
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "byte {}: {}", self.position, self.message)
    }
}

impl std::error::Error for DecodeError {}
