//! Values as little-endian bytes, laid out as [`Shape::layout`] tells; the page docs/protocol/binary.md says it for clients.
//!
//! A value writes itself part by part ([`Reflect::encode`]), as its serde form has them. What has no layout of its own, for
//! its serde form is not known before it is there, is written with the kind of each part before it ([`any`]).

pub mod any;
mod decode;
mod layout;

use std::fmt;

pub use any::encode_any;
pub use decode::{DecodeError, decode};
pub use layout::{Layout, LayoutContent, LayoutField, LayoutVariant};

use super::{Reflect, Shape};

/// A value that cannot be written: its serde form fails, or something in it has more than 2³² - 1 parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EncodeError {
    message: String,
}

/// Appends a value; on an error nothing is appended.
pub fn encode(value: &dyn Reflect, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
    let start = bytes.len();
    let encoded = value.encode(bytes);
    if encoded.is_err() {
        bytes.truncate(start);
    }
    encoded
}

/// As [`encode`], for a part of a value whose shape was found by its path ([`Shape::at`]): where a type alone cannot tell
/// what stands there, the shape is opaque, and the part tells its kind.
pub fn encode_as(
    shape: &Shape,
    value: &dyn Reflect,
    bytes: &mut Vec<u8>,
) -> Result<(), EncodeError> {
    if !shape.is_opaque() {
        return encode(value, bytes);
    }
    let start = bytes.len();
    let encoded = encode_any(value.as_serialize(), bytes);
    if encoded.is_err() {
        bytes.truncate(start);
    }
    encoded
}

/// How many elements, entries or bytes follow.
pub fn encode_count(count: usize, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
    let count = u32::try_from(count)
        .map_err(|_| EncodeError::new(format!("{count} elements are too many")))?;
    bytes.extend_from_slice(&count.to_le_bytes());
    Ok(())
}

/// A text with its length in bytes.
pub fn encode_text(text: &str, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
    encode_count(text.len(), bytes)?;
    bytes.extend_from_slice(text.as_bytes());
    Ok(())
}

/// A text with its length in bytes, written in place.
pub fn encode_display(text: &dyn fmt::Display, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
    struct Tail<'bytes>(&'bytes mut Vec<u8>);
    impl fmt::Write for Tail<'_> {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0.extend_from_slice(text.as_bytes());
            Ok(())
        }
    }
    let start = Counted::start(bytes);
    fmt::Write::write_fmt(&mut Tail(bytes), format_args!("{text}"))
        .map_err(|error| EncodeError::new(error.to_string()))?;
    start.end(bytes.len() - start.position - size_of::<u32>(), bytes)
}

/// A field that serde leaves out now and then: whether it is there, and then itself.
pub fn encode_unless<T: Reflect + ?Sized>(
    is_left_out: bool,
    value: &T,
    bytes: &mut Vec<u8>,
) -> Result<(), EncodeError> {
    bytes.push(u8::from(!is_left_out));
    if is_left_out {
        return Ok(());
    }
    value.encode(bytes)
}

/// The number of an enum's variant, counted as its layout lists them.
pub fn encode_tag(tag: u32, bytes: &mut Vec<u8>) {
    bytes.extend_from_slice(&tag.to_le_bytes());
}

/// A variant that serde skips cannot be written.
pub fn skipped_variant() -> EncodeError {
    EncodeError::new("its active variant has no serde form".to_owned())
}

/// Numbers one after the other, without their count.
pub(super) fn encode_numbers<T: Copy, const N: usize>(
    numbers: &[T],
    to_bytes: impl Fn(T) -> [u8; N],
    bytes: &mut Vec<u8>,
) {
    let start = bytes.len();
    bytes.resize(start + numbers.len() * N, 0);
    if let Some(places) = bytes.get_mut(start..) {
        for (place, number) in places.chunks_exact_mut(N).zip(numbers) {
            place.copy_from_slice(&to_bytes(*number));
        }
    }
}

/// A count that is known when everything that it counts is written.
#[derive(Clone, Copy, Debug)]
struct Counted {
    position: usize,
}

impl Counted {
    fn start(bytes: &mut Vec<u8>) -> Self {
        let position = bytes.len();
        bytes.extend_from_slice(&[0; size_of::<u32>()]);
        Self { position }
    }

    fn end(self, count: usize, bytes: &mut [u8]) -> Result<(), EncodeError> {
        let count = u32::try_from(count)
            .map_err(|_| EncodeError::new(format!("{count} elements are too many")))?;
        let place = self.position..self.position + size_of::<u32>();
        if let Some(place) = bytes.get_mut(place) {
            place.copy_from_slice(&count.to_le_bytes());
        }
        Ok(())
    }
}

impl EncodeError {
    pub(super) fn new(message: String) -> Self {
        Self { message }
    }
}

impl fmt::Display for EncodeError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)
    }
}

impl std::error::Error for EncodeError {}

impl serde::ser::Error for EncodeError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message.to_string())
    }
}
