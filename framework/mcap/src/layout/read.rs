//! Values out of bytes by their layout.

use std::fmt;

use serde_json::{Map, Value};

use super::{Enum, Layout, Struct};

/// Parts inside of each other; more are an error, as the stack is not endless.
const DEPTH: usize = 200;

/// Parts that may be read without a byte, ...
const FREE_PARTS: u64 = 1 << 16;

/// ... and for each byte: one, and structs around it.
const PARTS_PER_BYTE: u64 = 32;

/// Bytes of recorded values, one after the other.
#[derive(Clone, Debug)]
pub struct Values<'bytes> {
    bytes: &'bytes [u8],
    position: usize,
    /// That were read. Counts, and layouts, may be lies where parts have no bytes.
    parts: u64,
}

/// Why bytes are no value of a layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// In the bytes.
    pub position: usize,
    pub message: &'static str,
}

type Read<T> = Result<T, Unreadable>;

impl<'bytes> Values<'bytes> {
    /// From the first of these bytes.
    pub fn new(bytes: &'bytes [u8]) -> Self {
        Self {
            bytes,
            position: 0,
            parts: 0,
        }
    }

    /// How many bytes were read.
    pub fn position(&self) -> usize {
        self.position
    }

    /// Whether all bytes were read.
    pub fn is_empty(&self) -> bool {
        self.position >= self.bytes.len()
    }

    /// The next value as serde would give it in JSON.
    ///
    /// # Errors
    /// If the bytes are none of this layout.
    pub fn take(&mut self, layout: &Layout) -> Result<Value, Unreadable> {
        self.one(layout, true)
    }

    /// Goes behind the next value; gives its length in bytes.
    ///
    /// # Errors
    /// As [`Self::take`].
    pub fn skip(&mut self, layout: &Layout) -> Result<usize, Unreadable> {
        let start = self.position;
        self.one(layout, false)?;
        Ok(self.position - start)
    }

    fn one(&mut self, layout: &Layout, keep: bool) -> Read<Value> {
        let mut walk = Walk {
            values: self,
            keep,
            depth: 0,
        };
        walk.value(layout, &mut Vec::new())
    }
}

struct Walk<'walk, 'bytes> {
    values: &'walk mut Values<'bytes>,
    /// Whether the value itself is wanted.
    keep: bool,
    depth: usize,
}

/// Structs and enums around a part.
type Around<'layout> = Vec<&'layout Layout>;

impl<'bytes> Walk<'_, 'bytes> {
    fn value<'l>(&mut self, layout: &'l Layout, around: &mut Around<'l>) -> Read<Value> {
        self.depth += 1;
        if self.depth > DEPTH {
            return self.error("too many parts inside of each other");
        }
        self.values.parts += 1;
        let bytes = self.values.position as u64;
        if self.values.parts > FREE_PARTS + PARTS_PER_BYTE * bytes {
            return self.error("too many parts for so few bytes");
        }
        let value = match layout {
            Layout::Unknown => return self.error("how it is laid out is not known"),
            Layout::Unit => Value::Null,
            Layout::Bool => self.flag()?.into(),
            Layout::Signed(bits) => self.signed(*bits)?,
            Layout::Unsigned(bits) => self.unsigned(*bits)?,
            Layout::Float(32) => f32::from_le_bytes(self.array()?).into(),
            Layout::Float(_) => f64::from_le_bytes(self.array()?).into(),
            Layout::Character | Layout::Text => self.text()?,
            Layout::Bytes => self.bytes()?,
            Layout::Option(inner) => match self.flag()? {
                true => self.value(inner, around)?,
                false => Value::Null,
            },
            Layout::List(item) => self.list(item, around)?,
            Layout::Map(both) => self.map(both, around)?,
            Layout::Tuple(items) => {
                let items = items.iter().map(|item| self.value(item, around));
                items.collect::<Read<Vec<_>>>()?.into()
            }
            Layout::Struct(Struct { fields, .. }) => {
                around.push(layout);
                let fields = self.fields(fields, around);
                around.pop();
                fields?
            }
            Layout::Enum(of) => {
                around.push(layout);
                let variant = self.variant(of, around);
                around.pop();
                variant?
            }
            Layout::Again(up) => self.again(*up, around)?,
        };
        self.depth -= 1;
        Ok(value)
    }

    fn again<'l>(&mut self, up: usize, around: &Around<'l>) -> Read<Value> {
        let place = around.len().checked_sub(up).filter(|_| up > 0);
        let Some((place, same)) = place.and_then(|place| Some((place, *around.get(place)?))) else {
            return self.error("its layout goes beyond itself");
        };
        self.value(same, &mut around[..place].to_vec())
    }

    fn fields<'l>(
        &mut self,
        fields: &'l [(String, Layout)],
        around: &mut Around<'l>,
    ) -> Read<Value> {
        let mut object = Map::new();
        for (name, layout) in fields {
            let value = self.value(layout, around)?;
            if self.keep {
                object.insert(name.clone(), value);
            }
        }
        Ok(object.into())
    }

    fn variant<'l>(&mut self, of: &'l Enum, around: &mut Around<'l>) -> Read<Value> {
        let number = usize::try_from(self.varint(32)?).unwrap_or(usize::MAX);
        let Some((name, layout)) = of.variants.get(number) else {
            return self.error("it has no such variant");
        };
        if *layout == Layout::Unit {
            return Ok(name.as_str().into());
        }
        // The content of a variant stands in the enum, not in a struct of its own.
        let value = match layout {
            Layout::Struct(Struct { fields, .. }) => {
                around.push(layout);
                let fields = self.fields(fields, around);
                around.pop();
                fields?
            }
            layout => self.value(layout, around)?,
        };
        Ok(Map::from_iter([(name.clone(), value)]).into())
    }

    fn list<'l>(&mut self, item: &'l Layout, around: &mut Around<'l>) -> Read<Value> {
        if *item == Layout::Unsigned(8) {
            return self.bytes();
        }
        let count = self.varint(64)?;
        let mut items = Vec::new();
        for _ in 0..count {
            let value = self.value(item, around)?;
            if self.keep {
                items.push(value);
            }
        }
        Ok(items.into())
    }

    fn map<'l>(&mut self, both: &'l (Layout, Layout), around: &mut Around<'l>) -> Read<Value> {
        let mut entries = Map::new();
        for _ in 0..self.varint(64)? {
            let key = self.value(&both.0, around)?;
            let value = self.value(&both.1, around)?;
            if self.keep {
                let key = match key {
                    Value::String(text) => text,
                    other => other.to_string(),
                };
                entries.insert(key, value);
            }
        }
        Ok(entries.into())
    }

    fn bytes(&mut self) -> Read<Value> {
        let bytes = self.counted()?;
        Ok(match self.keep {
            true => bytes.into(),
            false => Value::Null,
        })
    }

    fn text(&mut self) -> Read<Value> {
        let bytes = self.counted()?;
        match std::str::from_utf8(bytes) {
            Ok(text) if self.keep => Ok(text.into()),
            Ok(_) => Ok(Value::Null),
            Err(_) => self.error("the text is no UTF-8"),
        }
    }

    fn counted(&mut self) -> Read<&'bytes [u8]> {
        let count = self.varint(64)?;
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        let rest = self.values.bytes.get(self.values.position..);
        let Some(bytes) = rest.and_then(|rest| rest.get(..count)) else {
            return self.error("it goes beyond the end");
        };
        self.values.position += count;
        Ok(bytes)
    }

    fn flag(&mut self) -> Read<bool> {
        match self.array()? {
            [0] => Ok(false),
            [1] => Ok(true),
            _ => self.error("expected 0 or 1"),
        }
    }

    fn signed(&mut self, bits: u8) -> Read<Value> {
        if bits == 8 {
            return Ok(i8::from_le_bytes(self.array()?).into());
        }
        let number = self.varint(bits)?;
        let number = (number >> 1) as i128 ^ -((number & 1) as i128);
        Ok(i64::try_from(number).map_or_else(|_| number.to_string().into(), Value::from))
    }

    fn unsigned(&mut self, bits: u8) -> Read<Value> {
        if bits == 8 {
            return Ok(u8::from_le_bytes(self.array()?).into());
        }
        let number = self.varint(bits)?;
        Ok(u64::try_from(number).map_or_else(|_| number.to_string().into(), Value::from))
    }

    /// Seven bits a byte, the lowest first.
    fn varint(&mut self, bits: u8) -> Read<u128> {
        let mut number = 0_u128;
        // A layout that was damaged may ask for more bits than there are.
        let bits = u32::from(bits).min(u128::BITS);
        for place in 0..bits.div_ceil(7) {
            let [byte] = self.array()?;
            number |= u128::from(byte & 0x7f) << (7 * place);
            if byte & 0x80 == 0 {
                return Ok(number);
            }
        }
        self.error("the number is too long")
    }

    fn array<const N: usize>(&mut self) -> Read<[u8; N]> {
        let rest = self.values.bytes.get(self.values.position..);
        let Some(bytes) = rest.and_then(|rest| rest.first_chunk()) else {
            return self.error("it goes beyond the end");
        };
        self.values.position += N;
        Ok(*bytes)
    }

    fn error<T>(&self, message: &'static str) -> Read<T> {
        Err(Unreadable {
            position: self.values.position,
            message,
        })
    }
}

impl fmt::Display for Unreadable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "byte {}: {}", self.position, self.message)
    }
}

impl std::error::Error for Unreadable {}
