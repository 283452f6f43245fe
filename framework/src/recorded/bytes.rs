//! Values of any type in a frame: postcard, without a copy on the way.

use std::fmt;

use hulkgen_recording::{Full, Writing};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::body::Output;
use super::encode::{EncodeError, Encoder};
#[cfg(feature = "yardstick")]
use super::yardstick::Slice;
use crate::error::{Error, Result};
use crate::pool::Handle;

/// Values on their way into a frame. What goes wrong is told once, by [`Self::end`].
#[derive(Debug)]
pub struct Saving<'a, 'block> {
    sink: Sink<'a, 'block>,
    /// What the first value said that could not be serialised.
    refused: Option<Reason>,
}

/// Where the bytes go.
#[derive(Debug)]
enum Sink<'a, 'block> {
    Message(&'a mut Writing<'block>),
    #[cfg(feature = "yardstick")]
    Slice(&'a mut Slice<'block>),
}

/// Values on their way out of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Loading<'frame> {
    bytes: &'frame [u8],
}

/// As an `Option` of an `Option` begins that has something.
const SOME: [u8; 2] = [1; 2];

/// Why a frame was not saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SaveError {
    /// The block has no room.
    Full,
    /// A value's own `Serialize` failed, or asks for what the format lacks.
    Value(Reason),
}

/// What a value's own `Serialize` says. One pointer wide: all that saves something has it in its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason(Box<Text>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Text(String);

impl<'a, 'block> Saving<'a, 'block> {
    /// Into this message.
    pub fn new(writing: &'a mut Writing<'block>) -> Self {
        Self {
            sink: Sink::Message(writing),
            refused: None,
        }
    }

    /// Into this slice, as postcard itself writes them.
    #[cfg(feature = "yardstick")]
    pub(crate) fn by_postcard(slice: &'a mut Slice<'block>) -> Self {
        Self {
            sink: Sink::Slice(slice),
            refused: None,
        }
    }

    /// Appends a value.
    #[inline(never)]
    pub fn put<T: Serialize + ?Sized>(&mut self, value: &T) {
        self.put_here(value);
    }

    /// As [`Self::put`], for values of which there are many types, each with little in it.
    #[inline]
    pub(super) fn put_here<T: Serialize + ?Sized>(&mut self, value: &T) {
        let put = match &mut self.sink {
            Sink::Message(writing) => value
                .serialize(Encoder(writing))
                .map_err(|EncodeError(reason)| reason),
            #[cfg(feature = "yardstick")]
            Sink::Slice(slice) => slice.put(value),
        };
        if let Err(reason) = put {
            self.refuse(reason);
        }
    }

    /// Appends an output, or what a client puts in its place. Of a handle the recording keeps another one, and the thread that owns
    /// the file writes the value.
    #[inline]
    pub fn output<T: Output>(&mut self, value: &T) {
        if !self.leave(value.handle()) {
            self.put(value);
        }
    }

    /// False: there is none, or nobody to leave it to.
    #[inline]
    pub(super) fn leave(&mut self, handle: Option<Handle>) -> bool {
        match (handle, &mut self.sink) {
            (Some(handle), Sink::Message(writing)) => SOME
                .get(..handle.options)
                .is_some_and(|before| writing.leave(before, handle.value)),
            _ => false,
        }
    }

    /// Appends these bytes.
    #[inline]
    pub(super) fn add<const BYTES: usize>(&mut self, bytes: [u8; BYTES]) {
        match &mut self.sink {
            Sink::Message(writing) => writing.add(bytes),
            #[cfg(feature = "yardstick")]
            Sink::Slice(_) => bytes.iter().for_each(|byte| self.put_here(byte)),
        }
    }

    #[cold]
    #[inline(never)]
    fn refuse(&mut self, reason: Reason) {
        self.refused.get_or_insert(reason);
    }

    /// Whether all of it was saved.
    ///
    /// # Errors
    /// If there was no room, or a value could not be serialised.
    pub fn end(self) -> Result<(), SaveError> {
        let is_full = match &self.sink {
            Sink::Message(writing) => writing.is_full(),
            #[cfg(feature = "yardstick")]
            Sink::Slice(_) => false,
        };
        match self.refused {
            // Whatever a value makes of a refusal.
            _ if is_full => Err(SaveError::Full),
            Some(reason) => Err(SaveError::Value(reason)),
            None => Ok(()),
        }
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

impl Reason {
    #[cold]
    pub(super) fn new(text: String) -> Self {
        Self(Box::new(Text(text)))
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0.0)
    }
}

impl SaveError {
    #[cold]
    pub(super) fn value(reason: String) -> Self {
        Self::Value(Reason::new(reason))
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
            Self::Value(reason) => reason.fmt(formatter),
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
        let mut saving = Saving::new(&mut writing);
        saving.put(&value);
        let put = saving.end();
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
