//! Serde forms that no layout tells: every part with its kind before it.

use serde::Serialize;
use serde::ser::{
    SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};

use super::{Counted, EncodeError, encode_display, encode_text};

/// What stands before a part.
pub mod kind {
    pub const NULL: u8 = 0;
    pub const FALSE: u8 = 1;
    pub const TRUE: u8 = 2;
    /// 64 bits.
    pub const SIGNED: u8 = 3;
    /// 64 bits.
    pub const UNSIGNED: u8 = 4;
    /// 64 bits.
    pub const FLOAT: u8 = 5;
    pub const TEXT: u8 = 6;
    pub const LIST: u8 = 7;
    /// Keys are texts.
    pub const MAP: u8 = 8;
}

/// Appends the serde form of a value, as a format for people has it.
pub fn encode_any<T: Serialize + ?Sized>(
    value: &T,
    bytes: &mut Vec<u8>,
) -> Result<(), EncodeError> {
    value.serialize(Any { bytes })
}

struct Any<'bytes> {
    bytes: &'bytes mut Vec<u8>,
}

/// A list or map that is being written.
struct Parts<'bytes> {
    bytes: &'bytes mut Vec<u8>,
    counted: Counted,
    count: usize,
}

impl<'bytes> Any<'bytes> {
    fn number(self, kind: u8, number: [u8; 8]) {
        self.bytes.push(kind);
        self.bytes.extend_from_slice(&number);
    }

    fn parts(self, kind: u8) -> Parts<'bytes> {
        self.bytes.push(kind);
        Parts {
            counted: Counted::start(self.bytes),
            bytes: self.bytes,
            count: 0,
        }
    }

    /// A map with one key, whose value follows.
    fn variant(self, variant: &str) -> Result<Self, EncodeError> {
        self.bytes.push(kind::MAP);
        self.bytes.extend_from_slice(&1_u32.to_le_bytes());
        encode_text(variant, self.bytes)?;
        Ok(self)
    }
}

impl Parts<'_> {
    fn part<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), EncodeError> {
        self.count += 1;
        encode_any(value, self.bytes)
    }

    fn field<T: Serialize + ?Sized>(&mut self, key: &str, value: &T) -> Result<(), EncodeError> {
        encode_text(key, self.bytes)?;
        self.part(value)
    }

    fn close(self) -> Result<(), EncodeError> {
        self.counted.end(self.count, self.bytes)
    }
}

macro_rules! numbers {
    ($($function:ident($number:ty) => $kind:ident as $wide:ty;)*) => {$(
        fn $function(self, number: $number) -> Result<(), EncodeError> {
            self.number(kind::$kind, <$wide>::from(number).to_le_bytes());
            Ok(())
        }
    )*};
}

impl<'bytes> Serializer for Any<'bytes> {
    type Ok = ();
    type Error = EncodeError;
    type SerializeSeq = Parts<'bytes>;
    type SerializeTuple = Parts<'bytes>;
    type SerializeTupleStruct = Parts<'bytes>;
    type SerializeTupleVariant = Parts<'bytes>;
    type SerializeMap = Parts<'bytes>;
    type SerializeStruct = Parts<'bytes>;
    type SerializeStructVariant = Parts<'bytes>;

    numbers! {
        serialize_i8(i8) => SIGNED as i64;
        serialize_i16(i16) => SIGNED as i64;
        serialize_i32(i32) => SIGNED as i64;
        serialize_i64(i64) => SIGNED as i64;
        serialize_u8(u8) => UNSIGNED as u64;
        serialize_u16(u16) => UNSIGNED as u64;
        serialize_u32(u32) => UNSIGNED as u64;
        serialize_u64(u64) => UNSIGNED as u64;
        serialize_f32(f32) => FLOAT as f64;
        serialize_f64(f64) => FLOAT as f64;
    }

    fn serialize_i128(self, number: i128) -> Result<(), EncodeError> {
        match i64::try_from(number) {
            Ok(number) => self.serialize_i64(number),
            Err(_) => self.collect_str(&number),
        }
    }

    fn serialize_u128(self, number: u128) -> Result<(), EncodeError> {
        match u64::try_from(number) {
            Ok(number) => self.serialize_u64(number),
            Err(_) => self.collect_str(&number),
        }
    }

    fn serialize_bool(self, value: bool) -> Result<(), EncodeError> {
        self.bytes
            .push(if value { kind::TRUE } else { kind::FALSE });
        Ok(())
    }

    fn serialize_char(self, character: char) -> Result<(), EncodeError> {
        self.serialize_str(character.encode_utf8(&mut [0; 4]))
    }

    fn serialize_str(self, text: &str) -> Result<(), EncodeError> {
        self.bytes.push(kind::TEXT);
        encode_text(text, self.bytes)
    }

    fn collect_str<T: std::fmt::Display + ?Sized>(self, text: &T) -> Result<(), EncodeError> {
        self.bytes.push(kind::TEXT);
        encode_display(&text, self.bytes)
    }

    fn serialize_bytes(self, items: &[u8]) -> Result<(), EncodeError> {
        let mut parts = self.parts(kind::LIST);
        items.iter().try_for_each(|item| parts.part(item))?;
        parts.close()
    }

    fn serialize_none(self) -> Result<(), EncodeError> {
        self.serialize_unit()
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), EncodeError> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), EncodeError> {
        self.bytes.push(kind::NULL);
        Ok(())
    }

    fn serialize_unit_struct(self, _name: &'static str) -> Result<(), EncodeError> {
        self.serialize_unit()
    }

    fn serialize_unit_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
    ) -> Result<(), EncodeError> {
        self.serialize_str(variant)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        value: &T,
    ) -> Result<(), EncodeError> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), EncodeError> {
        value.serialize(self.variant(variant)?)
    }

    fn serialize_seq(self, _length: Option<usize>) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.parts(kind::LIST))
    }

    fn serialize_tuple(self, _length: usize) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.parts(kind::LIST))
    }

    fn serialize_tuple_struct(
        self,
        _name: &'static str,
        _length: usize,
    ) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.parts(kind::LIST))
    }

    fn serialize_tuple_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.variant(variant)?.parts(kind::LIST))
    }

    fn serialize_map(self, _length: Option<usize>) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.parts(kind::MAP))
    }

    fn serialize_struct(
        self,
        _name: &'static str,
        _length: usize,
    ) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.parts(kind::MAP))
    }

    fn serialize_struct_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Parts<'bytes>, EncodeError> {
        Ok(self.variant(variant)?.parts(kind::MAP))
    }
}

macro_rules! items {
    ($($interface:ident::$function:ident;)*) => {$(
        impl $interface for Parts<'_> {
            type Ok = ();
            type Error = EncodeError;

            fn $function<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), EncodeError> {
                self.part(value)
            }

            fn end(self) -> Result<(), EncodeError> {
                self.close()
            }
        }
    )*};
}

items! {
    SerializeSeq::serialize_element;
    SerializeTuple::serialize_element;
    SerializeTupleStruct::serialize_field;
    SerializeTupleVariant::serialize_field;
}

macro_rules! fields {
    ($($interface:ident;)*) => {$(
        impl $interface for Parts<'_> {
            type Ok = ();
            type Error = EncodeError;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                key: &'static str,
                value: &T,
            ) -> Result<(), EncodeError> {
                self.field(key, value)
            }

            fn end(self) -> Result<(), EncodeError> {
                self.close()
            }
        }
    )*};
}

fields! {
    SerializeStruct;
    SerializeStructVariant;
}

impl SerializeMap for Parts<'_> {
    type Ok = ();
    type Error = EncodeError;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), EncodeError> {
        // As JSON has it: texts, and what can be written as one.
        let start = self.bytes.len();
        encode_any(key, self.bytes)?;
        keys::make_text(start, self.bytes)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), EncodeError> {
        self.part(value)
    }

    fn end(self) -> Result<(), EncodeError> {
        self.close()
    }
}

mod keys {
    use super::super::{EncodeError, encode_text};
    use super::kind;

    /// What stands from `start` on becomes a text with its length, and without its kind.
    pub(super) fn make_text(start: usize, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        let number = |bytes: &[u8]| <[u8; 8]>::try_from(bytes.get(start + 1..)?).ok();
        let text = match (bytes.get(start).copied(), number(bytes)) {
            (Some(kind::TEXT), _) => {
                bytes.remove(start);
                return Ok(());
            }
            (Some(kind::SIGNED), Some(number)) => i64::from_le_bytes(number).to_string(),
            (Some(kind::UNSIGNED), Some(number)) => u64::from_le_bytes(number).to_string(),
            (Some(kind::FALSE), _) => "false".to_owned(),
            (Some(kind::TRUE), _) => "true".to_owned(),
            _ => return Err(EncodeError::new("a key must be a text".to_owned())),
        };
        bytes.truncate(start);
        encode_text(&text, bytes)
    }
}
