//! Flips one bit of one output of one node; `tests/tests/failures.rs` lets every node ask here for each of its outputs.

use std::cell::RefCell;

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Which output.
#[derive(Clone, Debug)]
pub struct Flip {
    pub node: String,
    pub output: String,
    /// Calls of the node that leave it as it is.
    pub after: u64,
}

/// What a node returns.
pub(crate) trait Outputs {
    fn flip(&mut self);
}

thread_local! {
    static FLIP: RefCell<Option<Flip>> = const { RefCell::new(None) };
}

/// A replay runs every node on this thread.
pub fn arm(flip: Flip) {
    FLIP.set(Some(flip));
}

/// Calls that would still leave it as it is; `None`: the bit was flipped.
pub fn left() -> Option<u64> {
    FLIP.with_borrow(|flip| flip.as_ref().map(|flip| flip.after))
}

pub(crate) fn flipped<O: Outputs, E>(mut outputs: O) -> Result<O, E> {
    outputs.flip();
    Ok(outputs)
}

/// The first call after those that are left as they are, whose value has a bit that can be flipped.
pub(crate) fn flip<T: Serialize + DeserializeOwned>(node: &str, output: &str, value: &mut T) {
    FLIP.with_borrow_mut(|armed| {
        let is_meant = |flip: &&mut Flip| flip.node == node && flip.output == output;
        let Some(flip) = armed.as_mut().filter(is_meant) else {
            return;
        };
        if flip.after > 0 {
            flip.after -= 1;
        } else if let Some(other) = other(value) {
            *value = other;
            *armed = None;
        }
    });
}

/// The value with one bit of it flipped; `None`: no other bit makes a value.
fn other<T: Serialize + DeserializeOwned>(value: &T) -> Option<T> {
    let bytes = postcard::to_stdvec(value).ok()?;
    let bits = (0..bytes.len()).rev().flat_map(|byte| (0..8).map(move |bit| (byte, bit)));
    bits.into_iter().find_map(|(byte, bit)| {
        let mut flipped = bytes.clone();
        flipped[byte] ^= 1 << bit;
        let (other, rest) = postcard::take_from_bytes::<T>(&flipped).ok()?;
        let is_other = postcard::to_stdvec(&other).ok()? == flipped;
        (rest.is_empty() && is_other).then_some(other)
    })
}
