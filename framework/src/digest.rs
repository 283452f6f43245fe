//! A number that stands for bits: the same run twice gives the same digest.

use std::fmt;

use serde::Serialize;
use serde::ser::{
    self, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant,
};

use crate::cycler::Instance;
use crate::split_mix::{STEP, mixed};

/// Of serialised values, bit for bit: unlike in text, every NaN is itself.
///
/// The sum of all numbers, each mixed with its place, of which the processor mixes several at once. Two sequences of one length that
/// differ in one number have different digests, others the same with the chance of two random numbers of 64 bits. It tells
/// accidents, not attempts to deceive. Widths of numbers are no part of it, and of shapes only lengths and variants.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Digest {
    sum: u64,
    place: u64,
}

/// Why a value cannot be part of a digest: its own `Serialize` failed.
#[derive(Debug)]
pub struct DigestError(String);

impl Digest {
    /// The digest of nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// What was added so far, as a number.
    pub fn value(self) -> u64 {
        mixed(self.sum ^ self.place)
    }

    /// Adds one value.
    pub fn add(&mut self, value: &(impl Serialize + ?Sized)) -> Result<(), DigestError> {
        value.serialize(self)
    }

    /// Adds the timestamp and all main outputs of the instance's last finished cycle.
    pub fn add_cycle(&mut self, instance: &dyn Instance) -> Result<(), DigestError> {
        self.add(instance.description().name)?;
        self.add(&instance.cycle().time.start.as_nanos())?;
        for name in instance.main_outputs() {
            if let Some(output) = instance.main_output(name) {
                self.add(output.as_serialize())?;
            }
        }
        Ok(())
    }

    #[inline]
    fn number(&mut self, number: u64) {
        self.place = self.place.wrapping_add(STEP);
        self.sum = self.sum.wrapping_add(mixed(number ^ self.place));
    }

    /// Lengths and variants, so that neighbours cannot exchange parts.
    fn mark(&mut self, number: usize) {
        self.number(number as u64);
    }

    /// Eight at a time; how many they are is marked by whoever adds them.
    fn bytes(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks();
        for word in words {
            self.number(u64::from_le_bytes(*word));
        }
        if !rest.is_empty() {
            let mut word = [0; 8];
            word[..rest.len()].copy_from_slice(rest);
            self.number(u64::from_le_bytes(word));
        }
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{self}")
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:016x}", self.value())
    }
}

impl fmt::Display for DigestError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.0)
    }
}

impl std::error::Error for DigestError {}

impl ser::Error for DigestError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

macro_rules! serialize_numbers {
    ($($name:ident: $number:ty => $bits:expr;)+) => {
        $(#[inline]
        fn $name(self, value: $number) -> Result<(), DigestError> {
            self.number(($bits)(value));
            Ok(())
        })+
    };
}

impl ser::Serializer for &mut Digest {
    type Ok = ();
    type Error = DigestError;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    serialize_numbers! {
        serialize_i8: i8 => |value| value as u64;
        serialize_i16: i16 => |value| value as u64;
        serialize_i32: i32 => |value| value as u64;
        serialize_i64: i64 => |value| value as u64;
        serialize_u8: u8 => u64::from;
        serialize_u16: u16 => u64::from;
        serialize_u32: u32 => u64::from;
        serialize_u64: u64 => u64::from;
        serialize_f32: f32 => |value: f32| value.to_bits().into();
        serialize_f64: f64 => f64::to_bits;
    }

    fn serialize_i128(self, value: i128) -> Result<(), DigestError> {
        self.bytes(&value.to_le_bytes());
        Ok(())
    }

    fn serialize_u128(self, value: u128) -> Result<(), DigestError> {
        self.bytes(&value.to_le_bytes());
        Ok(())
    }

    fn serialize_bool(self, value: bool) -> Result<(), DigestError> {
        self.serialize_u8(value.into())
    }

    fn serialize_char(self, value: char) -> Result<(), DigestError> {
        self.serialize_u32(value.into())
    }

    fn serialize_str(self, value: &str) -> Result<(), DigestError> {
        self.serialize_bytes(value.as_bytes())
    }

    fn serialize_bytes(self, value: &[u8]) -> Result<(), DigestError> {
        self.mark(value.len());
        self.bytes(value);
        Ok(())
    }

    fn serialize_none(self) -> Result<(), DigestError> {
        self.serialize_u8(0)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), DigestError> {
        self.number(1);
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), DigestError> {
        Ok(())
    }

    fn serialize_unit_struct(self, _name: &'static str) -> Result<(), DigestError> {
        Ok(())
    }

    fn serialize_unit_variant(
        self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
    ) -> Result<(), DigestError> {
        self.serialize_u32(index)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        value: &T,
    ) -> Result<(), DigestError> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
        value: &T,
    ) -> Result<(), DigestError> {
        self.number(index.into());
        value.serialize(self)
    }

    fn serialize_seq(self, length: Option<usize>) -> Result<Self, DigestError> {
        self.mark(length.unwrap_or(usize::MAX));
        Ok(self)
    }

    fn serialize_tuple(self, _length: usize) -> Result<Self, DigestError> {
        Ok(self)
    }

    fn serialize_tuple_struct(
        self,
        _name: &'static str,
        _length: usize,
    ) -> Result<Self, DigestError> {
        Ok(self)
    }

    fn serialize_tuple_variant(
        self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
        _length: usize,
    ) -> Result<Self, DigestError> {
        self.number(index.into());
        Ok(self)
    }

    fn serialize_map(self, length: Option<usize>) -> Result<Self, DigestError> {
        self.mark(length.unwrap_or(usize::MAX));
        Ok(self)
    }

    fn serialize_struct(self, _name: &'static str, _length: usize) -> Result<Self, DigestError> {
        Ok(self)
    }

    fn serialize_struct_variant(
        self,
        _name: &'static str,
        index: u32,
        _variant: &'static str,
        _length: usize,
    ) -> Result<Self, DigestError> {
        self.number(index.into());
        Ok(self)
    }
}

macro_rules! compounds {
    ($($compound:ident::$add:ident,)+) => {
        $(impl $compound for &mut Digest {
            type Ok = ();
            type Error = DigestError;

            fn $add<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), DigestError> {
                value.serialize(&mut **self)
            }

            fn end(self) -> Result<(), DigestError> {
                Ok(())
            }
        })+
    };
}

compounds! {
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field,
}

macro_rules! structs {
    ($($compound:ident,)+) => {
        $(impl $compound for &mut Digest {
            type Ok = ();
            type Error = DigestError;

            fn serialize_field<T: Serialize + ?Sized>(&mut self, _key: &'static str, value: &T) -> Result<(), DigestError> {
                value.serialize(&mut **self)
            }

            fn end(self) -> Result<(), DigestError> {
                Ok(())
            }
        })+
    };
}

structs! {
    SerializeStruct,
    SerializeStructVariant,
}

impl SerializeMap for &mut Digest {
    type Ok = ();
    type Error = DigestError;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), DigestError> {
        key.serialize(&mut **self)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), DigestError> {
        value.serialize(&mut **self)
    }

    fn end(self) -> Result<(), DigestError> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: impl Serialize) -> u64 {
        let mut digest = Digest::new();
        digest.add(&value).unwrap();
        digest.value()
    }

    /// As a list of bytes that knows it is one.
    struct Bytes(&'static [u8]);

    impl Serialize for Bytes {
        fn serialize<S: ser::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.serialize_bytes(self.0)
        }
    }

    #[test]
    fn other_bits_are_another_digest() {
        let nans = [f32::NAN, f32::from_bits(f32::NAN.to_bits() ^ 1)];
        let pairs = [
            (of([1.0_f32, 2.0]), of([2.0_f32, 1.0])),
            (of([0.0_f32, 1.0]), of([-0.0_f32, 1.0])),
            (of(nans[0]), of(nans[1])),
            (of(vec![vec![1_u8], vec![]]), of(vec![vec![], vec![1_u8]])),
            (of(("ab", "c")), of(("a", "bc"))),
            (of(Bytes(b"12345678")), of(Bytes(b"12345678\0"))),
            (of(Bytes(b"12345678a")), of(Bytes(b"12345678b"))),
            (of(u128::MAX), of(u128::MAX >> 64)),
            (of(Some(0_u8)), of(None::<u8>)),
        ];
        for (index, (one, other)) in pairs.into_iter().enumerate() {
            assert_ne!(one, other, "pair {index}");
        }
    }

    #[test]
    fn each_of_many_numbers_counts() {
        let numbers: Vec<f32> = (0..1000).map(|number| number as f32 * 0.1).collect();
        let mut seen = std::collections::BTreeSet::from([of(&numbers)]);
        for index in 0..numbers.len() {
            for bit in 0..32 {
                let mut changed = numbers.clone();
                changed[index] = f32::from_bits(changed[index].to_bits() ^ (1 << bit));
                assert!(seen.insert(of(&changed)), "number {index}, bit {bit}");
            }
        }
    }
}
