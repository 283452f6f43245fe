//! From CDR of others to JSON for the robot. Whoever reaches the bridge may have written it: no byte is taken at its word.

use serde_json::{Map, Number, Value};

use crate::Result;
use crate::layout::{DEEPEST, Field, Layout, Part};

/// Of a value that comes in; the memory that JSON takes for one is many times the bytes of CDR.
const MOST_PARTS: usize = 1 << 18;

/// Some writers fill their last four bytes.
const FILLED: usize = 3;

impl Layout {
    /// The value in this CDR, of either byte order.
    ///
    /// # Errors
    /// If it is no CDR of version 1, or not of these parts: what is wrong, and where.
    pub(crate) fn read_cdr(&self, cdr: &[u8]) -> Result<Value> {
        let is_little = match cdr {
            [0, 0, _, _, ..] => false,
            [0, 1, _, _, ..] => true,
            [_, _, _, _, ..] => {
                return Err("the payload is no CDR of version 1 (XCDR1)".to_owned());
            }
            _ => return Err("the payload is too short for CDR".to_owned()),
        };
        let mut reader = Reader {
            layout: self,
            all: &cdr[4..],
            rest: &cdr[4..],
            is_little,
            parts: 0,
        };
        // Not everybody writes the byte of what has no parts.
        if self.root.is_empty() && reader.rest.is_empty() {
            return Ok(nothing(&self.root));
        }
        let value = reader.read(&self.root, 0).map_err(|wrong| wrong.told())?;
        match reader.rest.len() {
            0..=FILLED => Ok(value),
            more => Err(format!(
                "the payload goes on for {more} bytes behind its last part: is it another message?"
            )),
        }
    }
}

/// What is wrong, and the way to it, last part first.
struct Wrong {
    what: String,
    way: Vec<String>,
}

impl Wrong {
    fn new(what: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            way: Vec::new(),
        }
    }

    fn below(mut self, part: impl Into<String>) -> Self {
        self.way.push(part.into());
        self
    }

    fn told(self) -> String {
        let Self { what, mut way } = self;
        way.reverse();
        match way.as_slice() {
            [] => format!("the payload {what}"),
            way => format!("`{}` of the payload {what}", way.join(".")),
        }
    }
}

type Read<T> = std::result::Result<T, Wrong>;

struct Reader<'cdr> {
    layout: &'cdr Layout,
    /// Without the head: alignment counts from there.
    all: &'cdr [u8],
    rest: &'cdr [u8],
    is_little: bool,
    parts: usize,
}

impl<'cdr> Reader<'cdr> {
    fn read(&mut self, part: &'cdr Part, depth: usize) -> Read<Value> {
        self.parts += 1;
        if self.parts > MOST_PARTS {
            let what = format!("has more than {MOST_PARTS} parts, which no robot is sent");
            return Err(Wrong::new(what));
        }
        if depth > DEEPEST {
            return Err(Wrong::new("lies too deep"));
        }
        if part.is_empty() {
            self.take(1)?;
            return Ok(nothing(part));
        }
        Ok(match part {
            Part::Bool => match self.take(1)? {
                [0] => false.into(),
                [1] => true.into(),
                other => return Err(Wrong::new(format!("is no bool but {}", other[0]))),
            },
            Part::Float { bits: 32 } => float(f32::from_le_bytes(self.number()?).into())?,
            Part::Float { .. } => float(f64::from_le_bytes(self.number()?))?,
            Part::Signed { bits: 8 } => i8::from_le_bytes(self.number()?).into(),
            Part::Signed { bits: 16 } => i16::from_le_bytes(self.number()?).into(),
            Part::Signed { bits: 32 } => i32::from_le_bytes(self.number()?).into(),
            Part::Signed { .. } => i64::from_le_bytes(self.number()?).into(),
            Part::Unsigned { bits: 8 } => u8::from_le_bytes(self.number()?).into(),
            Part::Unsigned { bits: 16 } => u16::from_le_bytes(self.number()?).into(),
            Part::Unsigned { bits: 32 } => u32::from_le_bytes(self.number()?).into(),
            Part::Unsigned { .. } => u64::from_le_bytes(self.number()?).into(),
            Part::Text => self.text()?.into(),
            Part::Option { content } => self.optional(content, depth)?.unwrap_or(Value::Null),
            Part::List { item } => {
                let count = self.count()?;
                self.items(item, count, depth)?
            }
            Part::Array { item, length } => self.items(item, *length, depth)?,
            Part::Struct { fields } => self.fields(fields, depth)?,
            Part::Tuple { items } => {
                let items = items.iter().enumerate();
                let items = items.map(|(index, item)| self.below(index, item, depth));
                Value::Array(items.collect::<Read<_>>()?)
            }
            Part::Enum { variants } => {
                let variant = u32::from_le_bytes(self.number()?);
                let found = usize::try_from(variant).ok();
                match found.and_then(|found| variants.get(found)) {
                    Some(variant) => variant.name.clone().into(),
                    None => {
                        let most = variants.len().saturating_sub(1);
                        let what = format!("is {variant}: its variants are 0 to {most}");
                        return Err(Wrong::new(what));
                    }
                }
            }
            Part::Reference { name } => match self.layout.definitions.get(name) {
                Some(part) => self.read(part, depth + 1)?,
                None => return Err(Wrong::new("is of a type that the robot does not tell")),
            },
            Part::Unit | Part::Character | Part::Map | Part::Any => {
                return Err(Wrong::new("has no form in CDR"));
            }
        })
    }

    fn below(&mut self, index: usize, part: &'cdr Part, depth: usize) -> Read<Value> {
        let value = self.read(part, depth + 1);
        value.map_err(|wrong| wrong.below(index.to_string()))
    }

    fn items(&mut self, item: &'cdr Part, count: usize, depth: usize) -> Read<Value> {
        // Every part has a byte at least.
        if count > self.rest.len() {
            let left = self.rest.len();
            let what = format!("has {count} items, and {left} bytes are left");
            return Err(Wrong::new(what));
        }
        let items = (0..count).map(|index| self.below(index, item, depth));
        Ok(Value::Array(items.collect::<Read<_>>()?))
    }

    fn fields(&mut self, fields: &'cdr [Field], depth: usize) -> Read<Value> {
        let mut object = Map::new();
        for field in fields {
            let value = if field.optional {
                self.optional(&field.layout, depth)
            } else {
                self.read(&field.layout, depth + 1).map(Some)
            };
            let value = value.map_err(|wrong| wrong.below(field.name.as_str()))?;
            if let Some(value) = value {
                object.insert(field.name.clone(), value);
            }
        }
        Ok(Value::Object(object))
    }

    fn optional(&mut self, content: &'cdr Part, depth: usize) -> Read<Option<Value>> {
        match self.count()? {
            0 => Ok(None),
            1 => self.read(content, depth + 1).map(Some),
            more => Err(Wrong::new(format!(
                "is there {more} times, and can be there once"
            ))),
        }
    }

    fn text(&mut self) -> Read<&'cdr str> {
        let length = self.count()?;
        let text = self.take(length)?;
        // Some writers leave out the zero of a text without letters.
        let text = match text {
            [] => text,
            [text @ .., 0] => text,
            _ => return Err(Wrong::new("is a text that does not end with a zero")),
        };
        std::str::from_utf8(text).map_err(|_| Wrong::new("is a text that is no UTF-8"))
    }

    fn count(&mut self) -> Read<usize> {
        let count = u32::from_le_bytes(self.number()?);
        usize::try_from(count).map_err(|_| Wrong::new("is too long for this machine"))
    }

    /// Its bytes, lowest first, from behind those that align it.
    fn number<const SIZE: usize>(&mut self) -> Read<[u8; SIZE]> {
        let begun = self.all.len() - self.rest.len();
        self.take(begun.next_multiple_of(SIZE) - begun)?;
        let bytes = self.take(SIZE)?;
        let mut number = [0; SIZE];
        number.copy_from_slice(bytes);
        if !self.is_little {
            number.reverse();
        }
        Ok(number)
    }

    fn take(&mut self, size: usize) -> Read<&'cdr [u8]> {
        match self.rest.split_at_checked(size) {
            Some((taken, rest)) => {
                self.rest = rest;
                Ok(taken)
            }
            None => Err(Wrong::new(format!(
                "wants {size} bytes, and {} are left",
                self.rest.len()
            ))),
        }
    }
}

/// JSON of what has no parts.
fn nothing(part: &Part) -> Value {
    match part {
        Part::Struct { .. } => Value::Object(Map::new()),
        Part::Tuple { .. } | Part::Array { .. } => Value::Array(Vec::new()),
        _ => Value::Null,
    }
}

/// JSON has no NaN and no infinity.
fn float(number: f64) -> Read<Value> {
    let finite = Number::from_f64(number);
    finite.map_or_else(
        || Err(Wrong::new(format!("is {number}, which no robot is sent"))),
        |number| Ok(Value::Number(number)),
    )
}
