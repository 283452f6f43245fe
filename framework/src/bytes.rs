//! `#[serde(with = "framework::bytes")]` for a `Vec<u8>`: written in one piece instead of byte by byte.
//!
//! Every format has what it had before (in JSON a list of numbers, in a recording their number and they), and `Reflect`
//! shows the same. Meant for images and packets: a recording takes them at the speed of memory.

use std::fmt;

use serde::de::{SeqAccess, Visitor};
use serde::{Deserializer, Serializer};

/// As bytes.
///
/// # Errors
/// If the format's own writing fails.
pub fn serialize<S: Serializer>(
    bytes: &impl AsRef<[u8]>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytes.as_ref())
}

/// From bytes, or from a list of numbers.
///
/// # Errors
/// If it is neither.
pub fn deserialize<'de, D, T>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: From<Vec<u8>>,
{
    deserializer.deserialize_byte_buf(Bytes).map(T::from)
}

struct Bytes;

impl<'de> Visitor<'de> for Bytes {
    type Value = Vec<u8>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("bytes")
    }

    fn visit_bytes<E>(self, bytes: &[u8]) -> Result<Vec<u8>, E> {
        Ok(bytes.to_vec())
    }

    fn visit_byte_buf<E>(self, bytes: Vec<u8>) -> Result<Vec<u8>, E> {
        Ok(bytes)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Vec<u8>, A::Error> {
        // The hint may be a lie.
        let mut bytes = Vec::with_capacity(numbers.size_hint().unwrap_or_default().min(1 << 20));
        while let Some(number) = numbers.next_element()? {
            bytes.push(number);
        }
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    use crate::Reflect;
    use crate::parameters::Given;
    use crate::reflect::{Path, at, binary};

    #[derive(Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
    struct Whole {
        #[serde(with = "crate::bytes")]
        bytes: Vec<u8>,
    }

    #[derive(Debug, Default, Deserialize, PartialEq, Reflect, Serialize)]
    struct Single {
        bytes: Vec<u8>,
    }

    #[test]
    fn every_format_has_what_it_had_before() {
        let whole = Whole {
            bytes: vec![0, 255, 7],
        };
        let single = Single {
            bytes: whole.bytes.clone(),
        };
        let json = serde_json::to_string(&whole).expect("it has a JSON form");
        assert_eq!(
            json,
            serde_json::to_string(&single).expect("it has a JSON form")
        );
        assert_eq!(
            serde_json::from_str::<Whole>(&json).expect("numbers"),
            whole
        );
        let recorded = postcard::to_stdvec(&whole).expect("it can be written");
        assert_eq!(
            recorded,
            postcard::to_stdvec(&single).expect("it can be written")
        );
        assert_eq!(
            postcard::from_bytes::<Whole>(&recorded).expect("bytes"),
            whole
        );
        let text = toml::to_string(&whole).expect("it has a TOML form");
        assert_eq!(toml::from_str::<Whole>(&text).expect("numbers"), whole);
    }

    #[test]
    fn clients_see_the_same() {
        let mut whole = Whole {
            bytes: vec![1, 2, 3],
        };
        let shape = |shape: crate::reflect::Shape| shape.at(&path("bytes")).map(|at| at.layout());
        assert_eq!(
            shape(Whole::shape()).ok(),
            shape(Single::shape()).ok(),
            "the layout of the bytes"
        );
        let third = at(&whole, &path("bytes.2")).expect("it is there");
        let mut bytes = Vec::new();
        binary::encode(third, &mut bytes).expect("a number");
        assert_eq!(bytes, [3]);
        let all = at(&whole, &path("bytes")).expect("it is there");
        let mut bytes = Vec::new();
        binary::encode(all, &mut bytes).expect("numbers");
        assert_eq!(bytes, [3, 0, 0, 0, 1, 2, 3]);
        let second = crate::reflect::at_mut(&mut whole, &path("bytes.1")).expect("it is there");
        second
            .deserialize_from(&Given::from(&serde_json::json!(9)))
            .expect("a number");
        assert_eq!(whole.bytes, [1, 9, 3]);
    }

    fn path(text: &str) -> Path {
        text.parse().expect("a path")
    }
}
