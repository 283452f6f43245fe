//! Values of any type as postcard writes them, with as little code as that takes.
//!
//! A robot's cycle comes out of cold caches, the code that saves it included, of which every type has its own. So no number asks
//! whether the one before had room: what had none is told once, at the end of the message, and nothing else can fail in most types.
//!
//! Invariant: the bytes are those of [`postcard::to_slice`].

use std::fmt::{self, Write as _};

use hulkgen_recording::Writing;
use serde::Serialize;
use serde::ser::{
    self, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant,
};

use super::Reason;

/// What values are written into.
pub(super) struct Encoder<'a, 'block>(pub(super) &'a mut Writing<'block>);

/// Why a value has no form: as its own `Serialize` says, or because it has a length that it does not tell.
#[derive(Debug)]
pub(super) struct EncodeError(pub(super) Reason);

impl<'block> Encoder<'_, 'block> {
    /// For what stands before something else.
    #[inline]
    fn again(&mut self) -> Encoder<'_, 'block> {
        Encoder(self.0)
    }

    #[inline]
    fn add<const BYTES: usize>(&mut self, bytes: [u8; BYTES]) {
        self.0.add(bytes);
    }

    #[inline]
    fn byte(&mut self, byte: u8) {
        self.add([byte]);
    }

    /// Seven bits a byte, the lowest first; all but the last have the eighth.
    #[inline]
    fn number(&mut self, number: u64) {
        if number < 0x80 {
            self.byte(number as u8);
        } else {
            self.long_number(number);
        }
    }

    #[inline(never)]
    fn long_number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.byte(number as u8 | 0x80);
            number >>= 7;
        }
        self.byte(number as u8);
    }

    #[inline(never)]
    fn longest_number(&mut self, mut number: u128) {
        while number >= 0x80 {
            self.byte(number as u8 | 0x80);
            number >>= 7;
        }
        self.byte(number as u8);
    }

    /// Small ones of either sign are short.
    #[inline]
    fn signed(&mut self, number: i64) {
        self.number(((number << 1) ^ (number >> 63)) as u64);
    }

    #[inline(never)]
    fn bytes(&mut self, bytes: &[u8]) {
        self.number(bytes.len() as u64);
        self.0.add_all(bytes);
    }

    fn length(&mut self, length: Option<usize>) -> Result<(), EncodeError> {
        match length {
            Some(length) => {
                self.number(length as u64);
                Ok(())
            }
            None => Err(unknown_length()),
        }
    }
}

#[cold]
fn unknown_length() -> EncodeError {
    ser::Error::custom("a sequence or map does not tell its length before its elements")
}

impl fmt::Display for EncodeError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl std::error::Error for EncodeError {}

impl ser::Error for EncodeError {
    #[cold]
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(Reason::new(message.to_string()))
    }
}

macro_rules! serialize_numbers {
    ($($name:ident: $number:ty => |$encoder:ident, $value:ident| $write:expr;)+) => {
        $(#[inline]
        fn $name(self, $value: $number) -> Result<(), EncodeError> {
            let mut $encoder = self;
            $write;
            Ok(())
        })+
    };
}

impl ser::Serializer for Encoder<'_, '_> {
    type Ok = ();
    type Error = EncodeError;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    serialize_numbers! {
        serialize_bool: bool => |encoder, value| encoder.byte(value.into());
        serialize_i8: i8 => |encoder, value| encoder.add(value.to_le_bytes());
        serialize_i16: i16 => |encoder, value| encoder.signed(value.into());
        serialize_i32: i32 => |encoder, value| encoder.signed(value.into());
        serialize_i64: i64 => |encoder, value| encoder.signed(value);
        serialize_i128: i128 => |encoder, value| encoder.longest_number(((value << 1) ^ (value >> 127)) as u128);
        serialize_u8: u8 => |encoder, value| encoder.byte(value);
        serialize_u16: u16 => |encoder, value| encoder.number(value.into());
        serialize_u32: u32 => |encoder, value| encoder.number(value.into());
        serialize_u64: u64 => |encoder, value| encoder.number(value);
        serialize_u128: u128 => |encoder, value| encoder.longest_number(value);
        serialize_f32: f32 => |encoder, value| encoder.add(value.to_le_bytes());
        serialize_f64: f64 => |encoder, value| encoder.add(value.to_le_bytes());
        serialize_char: char => |encoder, value| encoder.bytes(value.encode_utf8(&mut [0; 4]).as_bytes());
        serialize_str: &str => |encoder, value| encoder.bytes(value.as_bytes());
        serialize_bytes: &[u8] => |encoder, value| encoder.bytes(value);
    }

    fn serialize_none(self) -> Result<(), EncodeError> {
        self.serialize_bool(false)
    }

    fn serialize_some<T: Serialize + ?Sized>(mut self, value: &T) -> Result<(), EncodeError> {
        self.byte(1);
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), EncodeError> {
        Ok(())
    }

    fn serialize_unit_struct(self, _name: &'static str) -> Result<(), EncodeError> {
        Ok(())
    }

    fn serialize_unit_variant(
        self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
    ) -> Result<(), EncodeError> {
        self.serialize_u32(index)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        value: &T,
    ) -> Result<(), EncodeError> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        mut self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
        value: &T,
    ) -> Result<(), EncodeError> {
        self.number(index.into());
        value.serialize(self)
    }

    fn serialize_seq(mut self, length: Option<usize>) -> Result<Self, EncodeError> {
        self.length(length)?;
        Ok(self)
    }

    fn serialize_tuple(self, _length: usize) -> Result<Self, EncodeError> {
        Ok(self)
    }

    fn serialize_tuple_struct(
        self,
        _name: &'static str,
        _length: usize,
    ) -> Result<Self, EncodeError> {
        Ok(self)
    }

    fn serialize_tuple_variant(
        mut self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
        _length: usize,
    ) -> Result<Self, EncodeError> {
        self.number(index.into());
        Ok(self)
    }

    fn serialize_map(mut self, length: Option<usize>) -> Result<Self, EncodeError> {
        self.length(length)?;
        Ok(self)
    }

    fn serialize_struct(self, _name: &'static str, _length: usize) -> Result<Self, EncodeError> {
        Ok(self)
    }

    fn serialize_struct_variant(
        mut self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
        _length: usize,
    ) -> Result<Self, EncodeError> {
        self.number(index.into());
        Ok(self)
    }

    /// Written twice: its length comes first, and nothing is allocated.
    fn collect_str<T: fmt::Display + ?Sized>(mut self, value: &T) -> Result<(), EncodeError> {
        let mut length = Length(0);
        let measured = write!(length, "{value}");
        self.number(length.0);
        let written = write!(Text(self.again()), "{value}");
        measured.and(written).map_err(ser::Error::custom)
    }

    fn is_human_readable(&self) -> bool {
        false
    }
}

macro_rules! compounds {
    ($($compound:ident::$add:ident($($key:ty)?),)+) => {
        $(impl $compound for Encoder<'_, '_> {
            type Ok = ();
            type Error = EncodeError;

            fn $add<T: Serialize + ?Sized>(&mut self, $(_: $key,)? value: &T) -> Result<(), EncodeError> {
                value.serialize(self.again())
            }

            fn end(self) -> Result<(), EncodeError> {
                Ok(())
            }
        })+
    };
}

compounds! {
    SerializeSeq::serialize_element(),
    SerializeTuple::serialize_element(),
    SerializeTupleStruct::serialize_field(),
    SerializeTupleVariant::serialize_field(),
    SerializeStruct::serialize_field(&'static str),
    SerializeStructVariant::serialize_field(&'static str),
}

impl SerializeMap for Encoder<'_, '_> {
    type Ok = ();
    type Error = EncodeError;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), EncodeError> {
        key.serialize(self.again())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), EncodeError> {
        value.serialize(self.again())
    }

    fn end(self) -> Result<(), EncodeError> {
        Ok(())
    }
}

/// Counts what is shown.
struct Length(u64);

/// Writes what is shown.
struct Text<'a, 'block>(Encoder<'a, 'block>);

impl fmt::Write for Length {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0 += text.len() as u64;
        Ok(())
    }
}

impl fmt::Write for Text<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.0.add_all(text.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(Serialize)]
    enum Some {
        Unit,
        New(u16),
        Tuple(i8, i64),
        Struct { text: &'static str, sign: char },
    }

    #[derive(Serialize)]
    struct Unit;

    #[derive(Serialize)]
    struct Pair(f32, f64);

    /// As types do that are written as text.
    struct Shown;

    impl Serialize for Shown {
        fn serialize<S: ser::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_str(&format_args!("{} {:>200}", "ä", 7))
        }
    }

    /// As lists of bytes do that know what they are.
    struct Bytes(&'static [u8]);

    impl Serialize for Bytes {
        fn serialize<S: ser::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.serialize_bytes(self.0)
        }
    }

    /// Does not say how many it has.
    struct Endless;

    impl Serialize for Endless {
        fn serialize<S: ser::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.serialize_seq(None)?.end()
        }
    }

    fn assert_as_postcard(value: &impl Serialize) {
        let (mut ours, mut theirs) = ([0xaa; 2048], [0xaa; 2048]);
        let theirs = postcard::to_slice(value, &mut theirs).expect("there is room");
        for room in 0..=theirs.len() {
            let mut writing = Writing::new(&mut ours[..room]);
            assert!(value.serialize(Encoder(&mut writing)).is_ok());
            assert_eq!(writing.is_full(), room < theirs.len(), "{theirs:?}");
        }
        assert_eq!(&ours[..theirs.len()], theirs);
        assert_eq!(ours[theirs.len()], 0xaa);
    }

    #[test]
    fn every_kind_of_value_is_written_as_postcard_does() {
        for shift in 0..128 {
            let bit = 1_u128 << shift;
            for number in [bit, bit - 1, bit | 1, !bit] {
                assert_as_postcard(&(number, number as i128, -(number as i64 >> 1)));
                assert_as_postcard(&(number as u64, number as i64, number as u32, number as i32));
                assert_as_postcard(&(number as u16, number as i16, number as u8, number as i8));
                let floats = (f32::from_bits(number as u32), f64::from_bits(number as u64));
                assert_as_postcard(&Pair(floats.0, floats.1));
            }
        }
        assert_as_postcard(&(true, false, 'a', 'ä', "", "some text", Shown, Unit, ()));
        assert_as_postcard(&(
            None::<u8>,
            Some(Some(3_u8)),
            [[1.0_f32; 3]; 2],
            Bytes(&[9; 300]),
        ));
        let map = BTreeMap::from([(1_u32, vec![1_u64, 200, 40_000]), (300, vec![])]);
        assert_as_postcard(&map);
        let (text, sign) = ("text", 'z');
        let all = [
            Some::Unit,
            Some::New(512),
            Some::Tuple(-3, i64::MIN),
            Some::Struct { text, sign },
        ];
        assert_as_postcard(&all.as_slice());
    }

    #[test]
    fn what_does_not_tell_its_length_is_refused() {
        let mut bytes = [0; 8];
        let mut writing = Writing::new(&mut bytes);
        let refused = Endless.serialize(Encoder(&mut writing));
        let error = refused.unwrap_err().to_string();
        assert!(error.contains("length"), "{error}");
    }
}
