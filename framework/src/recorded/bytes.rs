//! Values of any type in a frame: postcard, without a copy on the way.

use std::fmt;

use hulkgen_recording::{Full, Writing};
use postcard::ser_flavors::Flavor;
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
        let mut serializer = postcard::Serializer {
            output: Into(self.writing),
        };
        value
            .serialize(&mut serializer)
            .map_err(|error| match error {
                postcard::Error::SerializeBufferFull => SaveError::Full,
                other => SaveError::Value(other.to_string()),
            })
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

/// What postcard writes into.
struct Into<'a, 'block>(&'a mut Writing<'block>);

impl Flavor for Into<'_, '_> {
    type Output = ();

    #[inline]
    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.try_extend(&[byte])
    }

    #[inline]
    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.0
            .put(bytes)
            .map_err(|Full| postcard::Error::SerializeBufferFull)
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
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
