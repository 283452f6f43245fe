//! Owns the reading and writing of values one behind the other, little endian, without padding.

use types::game::PLAYER_COUNT;

use crate::error::{DecodeError, EncodeError};

const FINITE: &str = "a finite number";
const AGE: &str = "a number of seconds";
const SHIRTS: &str = "a shirt's number from 1 to 20";

/// Takes values from the front of a message whose length has been checked.
pub(crate) struct Reader<'bytes> {
    rest: &'bytes [u8],
}

impl<'bytes> Reader<'bytes> {
    /// Refuses every length but one; a reader may then read so many bytes and no more.
    pub(crate) fn exactly(length: usize, bytes: &'bytes [u8]) -> Result<Self, DecodeError> {
        if bytes.len() == length {
            Ok(Self { rest: bytes })
        } else {
            Err(DecodeError::WrongLength {
                expected: length,
                found: bytes.len(),
            })
        }
    }

    pub(crate) fn array<const LENGTH: usize>(&mut self) -> [u8; LENGTH] {
        let (value, rest) = self
            .rest
            .split_first_chunk()
            .expect("no message reads more bytes than the length that it has checked");
        self.rest = rest;
        *value
    }

    pub(crate) fn u8(&mut self) -> u8 {
        let [value] = self.array();
        value
    }

    pub(crate) fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.array())
    }

    pub(crate) fn i16(&mut self) -> i16 {
        i16::from_le_bytes(self.array())
    }

    /// A finite number.
    pub(crate) fn f32(&mut self, field: &'static str) -> Result<f32, DecodeError> {
        let found = f32::from_le_bytes(self.array());
        if found.is_finite() {
            Ok(found)
        } else {
            let expected = FINITE;
            Err(DecodeError::OutOfRange {
                field,
                expected,
                found,
            })
        }
    }

    /// Seconds since something.
    pub(crate) fn age(&mut self, field: &'static str) -> Result<f32, DecodeError> {
        let found = self.f32(field)?;
        if found >= 0.0 {
            return Ok(found);
        }
        Err(DecodeError::OutOfRange {
            field,
            expected: AGE,
            found,
        })
    }

    pub(crate) fn boolean(&mut self, field: &'static str) -> Result<bool, DecodeError> {
        match self.u8() {
            0 => Ok(false),
            1 => Ok(true),
            found => Err(DecodeError::UnknownValue {
                field,
                expected: "0 or 1",
                found,
            }),
        }
    }

    /// The number of a shirt.
    pub(crate) fn shirt(&mut self, field: &'static str) -> Result<u8, DecodeError> {
        let found = self.u8();
        if is_shirt(found) {
            Ok(found)
        } else {
            Err(DecodeError::UnknownValue {
                field,
                expected: SHIRTS,
                found,
            })
        }
    }

    pub(crate) fn header(&mut self, expected: [u8; 4]) -> Result<(), DecodeError> {
        match self.array() {
            found if found == expected => Ok(()),
            found => Err(DecodeError::WrongHeader { expected, found }),
        }
    }

    pub(crate) fn version(&mut self, expected: u8) -> Result<(), DecodeError> {
        match self.u8() {
            found if found == expected => Ok(()),
            found => Err(DecodeError::WrongVersion { expected, found }),
        }
    }
}

/// Writes values one behind the other into a message that has room for all of them.
pub(crate) struct Writer<'bytes> {
    bytes: &'bytes mut [u8],
    written: usize,
}

impl<'bytes> Writer<'bytes> {
    pub(crate) fn new(bytes: &'bytes mut [u8]) -> Self {
        Self { bytes, written: 0 }
    }

    /// How many bytes have been written.
    pub(crate) fn written(&self) -> usize {
        self.written
    }

    pub(crate) fn bytes(&mut self, value: &[u8]) {
        let end = self.written + value.len();
        self.bytes[self.written..end].copy_from_slice(value);
        self.written = end;
    }

    pub(crate) fn u8(&mut self, value: u8) {
        self.bytes(&[value]);
    }

    pub(crate) fn u16(&mut self, value: u16) {
        self.bytes(&value.to_le_bytes());
    }

    pub(crate) fn i16(&mut self, value: i16) {
        self.bytes(&value.to_le_bytes());
    }

    /// A finite number.
    pub(crate) fn f32(&mut self, field: &'static str, found: f32) -> Result<(), EncodeError> {
        if !found.is_finite() {
            let expected = FINITE;
            return Err(EncodeError {
                field,
                expected,
                found,
            });
        }
        self.bytes(&found.to_le_bytes());
        Ok(())
    }

    /// Seconds since something.
    pub(crate) fn age(&mut self, field: &'static str, found: f32) -> Result<(), EncodeError> {
        if found < 0.0 {
            return Err(EncodeError {
                field,
                expected: AGE,
                found,
            });
        }
        self.f32(field, found)
    }

    /// The number of a shirt.
    pub(crate) fn shirt(&mut self, field: &'static str, number: u8) -> Result<(), EncodeError> {
        if !is_shirt(number) {
            return Err(EncodeError {
                field,
                expected: SHIRTS,
                found: number.into(),
            });
        }
        self.u8(number);
        Ok(())
    }
}

fn is_shirt(number: u8) -> bool {
    (1..=PLAYER_COUNT).contains(&usize::from(number))
}
