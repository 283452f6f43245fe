//! What serde says of a value, as a tree.

use std::collections::BTreeMap;
use std::fmt::Display;

use serde::ser::{
    self, Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant,
    SerializeTuple, SerializeTupleStruct, SerializeTupleVariant, Serializer,
};

use crate::parameters::tree::{Tree, Value};

pub(super) struct Exactly;

/// Why a value has no such form.
#[derive(Debug)]
pub(super) struct NoForm(String);

/// Items, and the variant that has them.
pub(super) struct Items {
    variant: Option<&'static str>,
    items: Vec<Tree>,
}

/// Fields, and the variant that has them.
pub(super) struct Entries {
    variant: Option<&'static str>,
    key: String,
    entries: BTreeMap<String, Tree>,
}

impl Items {
    fn of(variant: Option<&'static str>) -> Self {
        Self {
            variant,
            items: Vec::new(),
        }
    }

    fn add<T: Serialize + ?Sized>(&mut self, item: &T) -> Result<(), NoForm> {
        self.items.push(item.serialize(Exactly)?);
        Ok(())
    }

    fn finish(self) -> Tree {
        within(self.variant, Value::Array(self.items).into())
    }
}

impl Entries {
    fn of(variant: Option<&'static str>) -> Self {
        Self {
            variant,
            key: String::new(),
            entries: BTreeMap::new(),
        }
    }

    fn add<T: Serialize + ?Sized>(&mut self, key: &str, value: &T) -> Result<(), NoForm> {
        self.entries
            .insert(key.to_owned(), value.serialize(Exactly)?);
        Ok(())
    }

    fn finish(self) -> Tree {
        within(self.variant, Value::Table(self.entries).into())
    }
}

fn within(variant: Option<&'static str>, content: Tree) -> Tree {
    match variant {
        Some(variant) => Value::Table(BTreeMap::from([(variant.to_owned(), content)])).into(),
        None => content,
    }
}

macro_rules! integers {
    ($($name:ident: $type:ty;)*) => {$(
        fn $name(self, value: $type) -> Result<Tree, NoForm> {
            Ok(Value::Integer(value.into()).into())
        }
    )*};
}

impl Serializer for Exactly {
    type Ok = Tree;
    type Error = NoForm;
    type SerializeSeq = Items;
    type SerializeTuple = Items;
    type SerializeTupleStruct = Items;
    type SerializeTupleVariant = Items;
    type SerializeMap = Entries;
    type SerializeStruct = Entries;
    type SerializeStructVariant = Entries;

    integers! {
        serialize_i8: i8;
        serialize_i16: i16;
        serialize_i32: i32;
        serialize_i64: i64;
        serialize_i128: i128;
        serialize_u8: u8;
        serialize_u16: u16;
        serialize_u32: u32;
        serialize_u64: u64;
    }

    fn serialize_u128(self, value: u128) -> Result<Tree, NoForm> {
        let value = i128::try_from(value).map_err(ser::Error::custom)?;
        self.serialize_i128(value)
    }

    fn serialize_bool(self, value: bool) -> Result<Tree, NoForm> {
        Ok(Value::Boolean(value).into())
    }

    fn serialize_f32(self, value: f32) -> Result<Tree, NoForm> {
        // By way of text: `0.1` of 32 bits stays `0.1`.
        let value = value.to_string().parse().map_err(ser::Error::custom)?;
        self.serialize_f64(value)
    }

    fn serialize_f64(self, value: f64) -> Result<Tree, NoForm> {
        Ok(Value::Float(value).into())
    }

    fn serialize_char(self, value: char) -> Result<Tree, NoForm> {
        self.serialize_str(value.encode_utf8(&mut [0; 4]))
    }

    fn serialize_str(self, value: &str) -> Result<Tree, NoForm> {
        Ok(Value::String(value.to_owned()).into())
    }

    fn serialize_bytes(self, value: &[u8]) -> Result<Tree, NoForm> {
        self.collect_seq(value)
    }

    fn serialize_none(self) -> Result<Tree, NoForm> {
        Ok(Value::Absent.into())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<Tree, NoForm> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<Tree, NoForm> {
        // As files write it.
        Ok(Entries::of(None).finish())
    }

    fn serialize_unit_struct(self, _name: &'static str) -> Result<Tree, NoForm> {
        self.serialize_unit()
    }

    fn serialize_unit_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
    ) -> Result<Tree, NoForm> {
        self.serialize_str(variant)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        value: &T,
    ) -> Result<Tree, NoForm> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<Tree, NoForm> {
        Ok(within(Some(variant), value.serialize(self)?))
    }

    fn serialize_seq(self, _length: Option<usize>) -> Result<Items, NoForm> {
        Ok(Items::of(None))
    }

    fn serialize_tuple(self, _length: usize) -> Result<Items, NoForm> {
        Ok(Items::of(None))
    }

    fn serialize_tuple_struct(self, _name: &'static str, _length: usize) -> Result<Items, NoForm> {
        Ok(Items::of(None))
    }

    fn serialize_tuple_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Items, NoForm> {
        Ok(Items::of(Some(variant)))
    }

    fn serialize_map(self, _length: Option<usize>) -> Result<Entries, NoForm> {
        Ok(Entries::of(None))
    }

    fn serialize_struct(self, _name: &'static str, _length: usize) -> Result<Entries, NoForm> {
        Ok(Entries::of(None))
    }

    fn serialize_struct_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        _length: usize,
    ) -> Result<Entries, NoForm> {
        Ok(Entries::of(Some(variant)))
    }
}

macro_rules! items {
    ($($trait:ident: $method:ident;)*) => {$(
        impl $trait for Items {
            type Ok = Tree;
            type Error = NoForm;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NoForm> {
                self.add(value)
            }

            fn end(self) -> Result<Tree, NoForm> {
                Ok(self.finish())
            }
        }
    )*};
}

items! {
    SerializeSeq: serialize_element;
    SerializeTuple: serialize_element;
    SerializeTupleStruct: serialize_field;
    SerializeTupleVariant: serialize_field;
}

macro_rules! fields {
    ($($trait:ident;)*) => {$(
        impl $trait for Entries {
            type Ok = Tree;
            type Error = NoForm;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                key: &'static str,
                value: &T,
            ) -> Result<(), NoForm> {
                self.add(key, value)
            }

            fn end(self) -> Result<Tree, NoForm> {
                Ok(self.finish())
            }
        }
    )*};
}

fields! {
    SerializeStruct;
    SerializeStructVariant;
}

impl SerializeMap for Entries {
    type Ok = Tree;
    type Error = NoForm;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), NoForm> {
        self.key = match key.serialize(Exactly)?.value {
            Value::String(text) => text,
            Value::Integer(integer) => integer.to_string(),
            Value::Boolean(flag) => flag.to_string(),
            _ => return Err(ser::Error::custom("a key of a map is no text")),
        };
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NoForm> {
        let key = std::mem::take(&mut self.key);
        self.add(&key, value)
    }

    fn end(self) -> Result<Tree, NoForm> {
        Ok(self.finish())
    }
}

impl ser::Error for NoForm {
    fn custom<T: Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

impl Display for NoForm {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for NoForm {}
