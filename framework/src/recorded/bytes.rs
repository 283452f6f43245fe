//! Values of any type in a frame: postcard, without a copy on the way.

use std::fmt;

use hulkgen_recording::{Full, Writing};
use postcard::ser_flavors::{Flavor, Slice};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{Error, Result};

/// Values on their way into a frame.
#[derive(Debug)]
pub struct Saving<'a, 'block> {
    writing: &'a mut Writing<'block>,
}

/// Values on their way out of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Loading<'frame> {
    bytes: &'frame [u8],
}

/// Why a frame was not saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SaveError {
    /// The block has no room.
    Full,
    /// A value's own `Serialize` failed, or asks for what the format lacks.
    Value(String),
}

impl<'a, 'block> Saving<'a, 'block> {
    /// Into this message.
    pub fn new(writing: &'a mut Writing<'block>) -> Self {
        Self { writing }
    }

    /// Appends a value.
    pub fn put<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), SaveError> {
        let mut failure = None;
        let filled = self.writing.fill(|free| {
            let mut serializer = postcard::Serializer {
                output: Room::new(free),
            };
            let serialized = value.serialize(&mut serializer);
            // Whatever the value makes of a refusal.
            let length = serializer.output.finalize().ok()?;
            match serialized {
                Ok(()) => Some(length),
                Err(error) => {
                    failure = Some(SaveError::Value(error.to_string()));
                    Some(0)
                }
            }
        });
        filled?;
        failure.map_or(Ok(()), Err)
    }
}

impl<'frame> Loading<'frame> {
    /// Out of these bytes.
    pub fn new(bytes: &'frame [u8]) -> Self {
        Self { bytes }
    }

    /// The next value.
    ///
    /// # Errors
    /// If the bytes are none of this type.
    pub fn take<T: DeserializeOwned>(&mut self) -> Result<T> {
        let (value, rest) = postcard::take_from_bytes(self.bytes)
            .map_err(|error| Error::new(format!("the frame is damaged: {error}")))?;
        self.bytes = rest;
        Ok(value)
    }

    /// What was not taken yet.
    pub(crate) fn rest(&self) -> &'frame [u8] {
        self.bytes
    }

    /// Whether everything was taken.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }
}

/// What postcard writes into: once something had no room, nothing more has, and it has no end.
struct Room<'free> {
    free: Slice<'free>,
    is_full: bool,
}

impl<'free> Room<'free> {
    fn new(free: &'free mut [u8]) -> Self {
        Self {
            free: Slice::new(free),
            is_full: false,
        }
    }

    #[cold]
    fn refuse(&mut self) -> postcard::Error {
        (self.free, self.is_full) = (Slice::new(&mut []), true);
        postcard::Error::SerializeBufferFull
    }
}

impl Flavor for Room<'_> {
    /// How many bytes were written.
    type Output = usize;

    #[inline]
    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.free.try_push(byte).map_err(|_| self.refuse())
    }

    #[inline]
    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.free.try_extend(bytes).map_err(|_| self.refuse())
    }

    fn finalize(self) -> postcard::Result<usize> {
        match self.is_full {
            true => Err(postcard::Error::SerializeBufferFull),
            false => Ok(self.free.finalize()?.len()),
        }
    }
}

impl From<Full> for SaveError {
    fn from(_: Full) -> Self {
        Self::Full
    }
}

impl fmt::Display for SaveError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full => write!(formatter, "{Full}"),
            Self::Value(message) => formatter.write_str(message),
        }
    }
}

impl std::error::Error for SaveError {}

#[cfg(test)]
mod tests {
    use serde::Serializer;
    use serde::ser::SerializeTuple as _;

    use super::*;

    /// As types do that are written as text.
    struct Shown;

    impl Serialize for Shown {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_str("eight be")
        }
    }

    /// Takes no refusal for an answer.
    struct Stubborn;

    impl Serialize for Stubborn {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let mut tuple = serializer.serialize_tuple(2)?;
            let _ = tuple.serialize_element(&[0_u8; 16]);
            tuple.serialize_element(&1_u8)?;
            tuple.end()
        }
    }

    fn put(value: impl Serialize, room: usize) -> (Result<(), SaveError>, usize) {
        let mut bytes = vec![0; room];
        let mut writing = Writing::new(&mut bytes);
        let put = Saving::new(&mut writing).put(&value);
        (put, writing.length())
    }

    #[test]
    fn what_has_no_room_is_told_as_that_however_the_value_writes_itself() {
        assert_eq!(put(Shown, 9), (Ok(()), 9));
        assert_eq!(put(Shown, 8), (Err(SaveError::Full), 0));
        assert_eq!(put(Stubborn, 17), (Ok(()), 17));
        assert_eq!(put(Stubborn, 8), (Err(SaveError::Full), 0));
    }
}
