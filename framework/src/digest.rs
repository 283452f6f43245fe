//! A number that stands for bits: the same run twice gives the same digest.

use std::fmt;

use hulkgen_mcap::Fnv;
use serde::Serialize;
use serde::ser::{
    self, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant,
};

use crate::cycler::Instance;

/// FNV-1a over serialised values, bit for bit: unlike in text, every NaN is itself.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Digest(Fnv);

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
        self.0.value()
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

    fn bytes(&mut self, bytes: &[u8]) {
        self.0.add(bytes);
    }

    /// Lengths and variants, so that neighbours cannot exchange parts.
    fn mark(&mut self, number: usize) {
        self.bytes(&(number as u64).to_le_bytes());
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
    ($($name:ident: $number:ty,)+) => {
        $(fn $name(self, value: $number) -> Result<(), DigestError> {
            self.bytes(&value.to_le_bytes());
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
        serialize_i8: i8,
        serialize_i16: i16,
        serialize_i32: i32,
        serialize_i64: i64,
        serialize_i128: i128,
        serialize_u8: u8,
        serialize_u16: u16,
        serialize_u32: u32,
        serialize_u64: u64,
        serialize_u128: u128,
        serialize_f32: f32,
        serialize_f64: f64,
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
        self.bytes(&[1]);
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
        self.bytes(&index.to_le_bytes());
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
        self.bytes(&index.to_le_bytes());
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
        self.bytes(&index.to_le_bytes());
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
