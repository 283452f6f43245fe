//! Values that are a string or a table, with errors that say which of the two is wrong.

use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{Deserializer, MapAccess, Visitor};

/// A string or a table.
pub(crate) enum Either<S, T> {
    String(S),
    Table(T),
}

/// Reads a string as `S` or a table as `T`; unlike an untagged enum it keeps the error of the one that it is.
pub(crate) fn either<'de, D, S, T>(
    deserializer: D,
    expecting: &'static str,
) -> Result<Either<S, T>, D::Error>
where
    D: Deserializer<'de>,
    S: Deserialize<'de>,
    T: Deserialize<'de>,
{
    deserializer.deserialize_any(StringOrTable {
        expecting,
        kinds: PhantomData,
    })
}

struct StringOrTable<S, T> {
    expecting: &'static str,
    kinds: PhantomData<(S, T)>,
}

impl<'de, S: Deserialize<'de>, T: Deserialize<'de>> Visitor<'de> for StringOrTable<S, T> {
    type Value = Either<S, T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.expecting)
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Self::Value, E> {
        S::deserialize(StrDeserializer::new(text)).map(Either::String)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(Either::Table)
    }
}

/// `Deserialize` for an enum of two newtype variants: the first from a string, the second from a table.
macro_rules! deserialize_either {
    ($name:ident, $expecting:literal, $string:ident, $table:ident) => {
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Ok(match either(deserializer, $expecting)? {
                    $crate::either::Either::String(string) => Self::$string(string),
                    $crate::either::Either::Table(table) => Self::$table(table),
                })
            }
        }
    };
}

pub(crate) use deserialize_either;
