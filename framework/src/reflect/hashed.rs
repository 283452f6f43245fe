//! Maps and sets of the standard library without an order of their own.

#![expect(
    clippy::disallowed_types,
    reason = "an author may exchange them; nothing here depends on their order"
)]

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, Hash};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::binary::{EncodeError, encode_count, encode_display, encode_text};
use super::collections::{counted_map, map, set};
use super::{Children, Content, Reflect, Segment, Shape, whole};

impl<V, S> Reflect for HashMap<String, V, S>
where
    V: Reflect + Serialize + DeserializeOwned,
    S: BuildHasher + Default,
{
    map!();
}

impl<T, S> Reflect for HashSet<T, S>
where
    T: Reflect + Serialize + DeserializeOwned + Eq + Hash,
    S: BuildHasher + Default,
{
    set!();
}

macro_rules! counted_maps {
    ($($key:ty)*) => {$(
        impl<V, S> Reflect for HashMap<$key, V, S>
        where
            V: Reflect + Serialize + DeserializeOwned,
            S: BuildHasher + Default,
        {
            counted_map!($key);
        }
    )*};
}

counted_maps! { i8 i16 i32 i64 isize u8 u16 u32 u64 usize }
