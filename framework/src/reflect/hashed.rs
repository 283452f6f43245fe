//! Maps and sets of the standard library without an order of their own.

#![expect(
    clippy::disallowed_types,
    reason = "an author may exchange them; nothing here depends on their order"
)]

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, Hash};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::collections::map;
use super::{Children, Content, Leaf, Reflect, Segment, Shape, whole};

impl<V, S> Reflect for HashMap<String, V, S>
where
    V: Reflect + Serialize + DeserializeOwned,
    S: BuildHasher + Default,
{
    map!();
}

impl<T, S> Reflect for HashSet<T, S>
where
    T: Serialize + DeserializeOwned + Eq + Hash,
    S: BuildHasher + Default,
{
    fn shape() -> Shape {
        Shape::leaf::<Self>(Leaf::Opaque)
    }

    whole!();
}
