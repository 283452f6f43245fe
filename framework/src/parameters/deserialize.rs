//! A tree of values as a type, with errors that name the file, the line and the key.

use std::collections::{BTreeMap, btree_map};
use std::fmt::{self, Display};
use std::slice;

use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;

use super::error::{Fault, Origin, ParameterError};
use super::live::Refusal;
use super::nearest::nearest;
use super::tree::{Layer, Tree, Value};

/// The type that the tree stands for.
pub(super) fn deserialize<T: DeserializeOwned>(tree: &Tree) -> Result<T, ParameterError> {
    T::deserialize(Node::of(tree)).map_err(|mistake| mistake.at(tree).finish())
}

/// A value, and what of it counts.
#[derive(Clone, Copy)]
pub(super) struct Node<'tree> {
    tree: &'tree Tree,
    /// Of tables only what this layer has.
    layer: Option<usize>,
}

impl<'tree> Node<'tree> {
    pub(super) fn of(tree: &'tree Tree) -> Self {
        Self { tree, layer: None }
    }

    fn entries(self, entries: &'tree BTreeMap<String, Tree>) -> Entries<'tree> {
        Entries {
            entries: entries.iter(),
            layer: self.layer,
            value: None,
        }
    }
}

/// What is wrong, with as much of the place as is known on the way out.
#[derive(Debug)]
pub(super) struct Mistake {
    fault: Fault,
    message: String,
    /// Innermost first.
    keys: Vec<String>,
    origin: Option<Origin>,
}

impl Mistake {
    /// It is in this value, unless a more exact place is known.
    fn at(mut self, tree: &Tree) -> Self {
        self.origin.get_or_insert_with(|| tree.origin.clone());
        self
    }

    fn below(mut self, key: impl Into<String>) -> Self {
        self.keys.push(key.into());
        self
    }

    fn finish(mut self) -> ParameterError {
        self.keys.reverse();
        let origin = self.origin.unwrap_or(Origin::Unknown);
        let message = match self.fault {
            Fault::Missing => format!("{}: no layer has it", self.message),
            Fault::Unknown | Fault::Invalid => self.message,
        };
        ParameterError {
            fault: self.fault,
            ..ParameterError::new(origin, self.keys.join("."), message)
        }
    }

    /// For whoever gave the value: no layer has it.
    pub(super) fn refusal(mut self) -> Refusal {
        self.keys.reverse();
        Refusal {
            path: self.keys.join("."),
            message: self.message,
        }
    }

    fn new(message: impl Into<String>) -> Self {
        Self {
            fault: Fault::Invalid,
            message: message.into(),
            keys: Vec::new(),
            origin: None,
        }
    }
}

impl de::Error for Mistake {
    fn custom<T: Display>(message: T) -> Self {
        Self::new(message.to_string())
    }

    fn missing_field(field: &'static str) -> Self {
        let mistake = Self::new("is missing").below(field);
        Self {
            fault: Fault::Missing,
            ..mistake
        }
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        let message = match (nearest(field, expected.iter().copied()), expected) {
            (Some(name), _) => format!("nothing reads it; did you mean `{name}`?"),
            (None, []) => "nothing reads it; nothing is expected here".to_owned(),
            (None, _) => format!("nothing reads it; expected are {}", expected.join(", ")),
        };
        Self {
            fault: Fault::Unknown,
            ..Self::new(message)
        }
    }

    fn unknown_variant(variant: &str, expected: &'static [&'static str]) -> Self {
        let message = match nearest(variant, expected.iter().copied()) {
            Some(name) => format!("no variant `{variant}`; did you mean `{name}`?"),
            None => format!(
                "no variant `{variant}`; expected one of {}",
                expected.join(", ")
            ),
        };
        Self::new(message)
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::new(match found {
            Unexpected::Unit => format!("expected {expected}, found nothing"),
            _ => format!("expected {expected}, found {found}"),
        })
    }
}

impl Display for Mistake {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.message)
    }
}

impl std::error::Error for Mistake {}

impl<'de> Deserializer<'de> for Node<'_> {
    type Error = Mistake;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        let result = match &self.tree.value {
            Value::Table(entries) => visitor.visit_map(self.entries(entries)),
            Value::Array(items) => {
                let mut items = Items {
                    items: items.iter(),
                    layer: self.layer,
                    index: 0,
                };
                let value = visitor.visit_seq(&mut items);
                match items.items.len() {
                    0 => value,
                    left if value.is_ok() => {
                        Err(Mistake::new(format!("has {left} more items than expected")))
                    }
                    _ => value,
                }
            }
            Value::String(text) | Value::Datetime(text) => visitor.visit_str(text),
            Value::Integer(integer) => visit_integer(*integer, visitor),
            Value::Float(float) => visitor.visit_f64(*float),
            Value::Boolean(boolean) => visitor.visit_bool(*boolean),
            Value::Absent => visitor.visit_unit(),
        };
        result.map_err(|mistake| mistake.at(self.tree))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match &self.tree.value {
            Value::Absent => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        visitor.visit_newtype_struct(self)
    }

    /// Tables of TOML would take nothing for an empty one.
    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match &self.tree.value {
            Value::Absent => Err(de::Error::invalid_type(Unexpected::Unit, &visitor)),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match &self.tree.value {
            Value::Table(entries) if entries.is_empty() => visitor.visit_unit(),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        self.deserialize_unit(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        let result = match &self.tree.value {
            Value::String(variant) => visitor.visit_enum(Variant {
                name: variant,
                content: None,
            }),
            // A later layer replaces the whole value, and its variant need not be the one from before.
            Value::Table(entries) => {
                let Layer { number, .. } = self.tree.layer;
                // Of one that is given in parts its last part says which variant it is.
                let mut last = entries
                    .iter()
                    .filter(|(_, tree)| tree.layer == self.tree.layer);
                match (last.next(), last.next()) {
                    (Some((name, tree)), None) => {
                        let layer = Some(number);
                        visit_variant(name, Node { tree, layer }, visitor)
                    }
                    _ => Err(Mistake::new("expected a table with one variant")),
                }
            }
            _ => Err(Mistake::new(format!(
                "expected a variant's name, found {}",
                self.tree.kind()
            ))),
        };
        result.map_err(|mistake| mistake.at(self.tree))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        let read = self.deserialize_any(visitor);
        match &self.tree.value {
            // Its items were taken for the fields in their order, which hardly anybody means.
            Value::Array(_) if !fields.is_empty() => read.map_err(|_| {
                let fields = fields.join(", ");
                Mistake::new(format!("expected a table of {fields}; found an array")).at(self.tree)
            }),
            _ => read,
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        seq tuple tuple_struct identifier ignored_any
    }
}

/// With the smallest type that holds it, which most visitors take.
fn visit_integer<'de, V: Visitor<'de>>(integer: i128, visitor: V) -> Result<V::Value, Mistake> {
    match (i64::try_from(integer), u64::try_from(integer)) {
        (Ok(integer), _) => visitor.visit_i64(integer),
        (Err(_), Ok(integer)) => visitor.visit_u64(integer),
        (Err(_), Err(_)) => visitor.visit_i128(integer),
    }
}

fn visit_variant<'de, V: Visitor<'de>>(
    name: &str,
    content: Node<'_>,
    visitor: V,
) -> Result<V::Value, Mistake> {
    let variant = Variant {
        name,
        content: Some(content),
    };
    visitor
        .visit_enum(variant)
        .map_err(|mistake| mistake.at(content.tree).below(name))
}

struct Entries<'tree> {
    entries: btree_map::Iter<'tree, String, Tree>,
    layer: Option<usize>,
    value: Option<(&'tree str, &'tree Tree)>,
}

impl<'tree> Iterator for Entries<'tree> {
    type Item = (&'tree str, &'tree Tree);

    fn next(&mut self) -> Option<Self::Item> {
        let layer = self.layer;
        let mut counting = self
            .entries
            .by_ref()
            .filter(|(_, tree)| layer.is_none_or(|layer| tree.layer.number == layer));
        counting.next().map(|(key, tree)| (key.as_str(), tree))
    }
}

impl<'de> MapAccess<'de> for Entries<'_> {
    type Error = Mistake;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Mistake> {
        let Some((key, tree)) = self.next() else {
            return Ok(None);
        };
        self.value = Some((key, tree));
        let key = seed
            .deserialize(Key(key))
            .map_err(|mistake| mistake.at(tree).below(key))?;
        Ok(Some(key))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Mistake> {
        let (key, tree) = self
            .value
            .take()
            .ok_or_else(|| Mistake::new("a value was asked for before its key"))?;
        let layer = self.layer;
        seed.deserialize(Node { tree, layer })
            .map_err(|mistake| mistake.at(tree).below(key))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.entries.len())
    }
}

/// Text, which may stand for a number or a truth value.
struct Key<'tree>(&'tree str);

/// Where the text is none, the visitor says so. Of several ways to write a number one counts, so that keys stay apart.
macro_rules! numbers {
    ($($deserialize:ident)*) => {$(
        fn $deserialize<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
            match self.0.parse::<i128>() {
                Ok(number) if number.to_string() == self.0 => visit_integer(number, visitor),
                _ => visitor.visit_str(self.0),
            }
        }
    )*};
}

impl<'de> Deserializer<'de> for Key<'_> {
    type Error = Mistake;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        visitor.visit_str(self.0)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mistake> {
        match self.0.parse() {
            Ok(flag) => visitor.visit_bool(flag),
            Err(_) => visitor.visit_str(self.0),
        }
    }

    numbers! {
        deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 deserialize_i128
        deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64 deserialize_u128
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        visitor.visit_enum(Variant {
            name: self.0,
            content: None,
        })
    }

    forward_to_deserialize_any! {
        f32 f64 char str string bytes byte_buf option unit unit_struct seq tuple tuple_struct map struct identifier
        ignored_any
    }
}

struct Items<'tree> {
    items: slice::Iter<'tree, Tree>,
    layer: Option<usize>,
    index: usize,
}

impl<'de> SeqAccess<'de> for Items<'_> {
    type Error = Mistake;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Mistake> {
        let Some(tree) = self.items.next() else {
            return Ok(None);
        };
        let index = self.index;
        self.index += 1;
        let layer = self.layer;
        let item = seed.deserialize(Node { tree, layer });
        item.map(Some)
            .map_err(|mistake| mistake.at(tree).below(index.to_string()))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

struct Variant<'tree> {
    name: &'tree str,
    content: Option<Node<'tree>>,
}

impl<'de> EnumAccess<'de> for Variant<'_> {
    type Error = Mistake;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Mistake> {
        let deserializer: StrDeserializer<'_, Mistake> = self.name.into_deserializer();
        Ok((seed.deserialize(deserializer)?, self))
    }
}

impl Variant<'_> {
    fn content(&self) -> Result<Node<'_>, Mistake> {
        self.content.ok_or_else(|| {
            Mistake::new(format!(
                "variant `{}` has a value: {{ {0} = … }}",
                self.name
            ))
        })
    }
}

impl<'de> VariantAccess<'de> for Variant<'_> {
    type Error = Mistake;

    fn unit_variant(self) -> Result<(), Mistake> {
        match self.content.map(|content| &content.tree.value) {
            None | Some(Value::Absent) => Ok(()),
            Some(_) => Err(Mistake::new(format!(
                "variant `{}` has no value",
                self.name
            ))),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Mistake> {
        seed.deserialize(self.content()?)
    }

    fn tuple_variant<V: Visitor<'de>>(
        self,
        _length: usize,
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        self.content()?.deserialize_any(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mistake> {
        self.content()?.deserialize_struct("", fields, visitor)
    }
}
