//! [`Clear`] for maps and sets of the standard library without an order of their own.

#![expect(
    clippy::disallowed_types,
    reason = "an author may exchange them; nothing here depends on their order"
)]

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, Hash};

use super::Clear;
use super::standard::collection;

collection! {
    HashMap<K, V, S> where [K: Eq + Hash, V, S: BuildHasher];
    HashSet<T, S> where [T: Eq + Hash, S: BuildHasher];
}
