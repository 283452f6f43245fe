//! Owns reading: values are taken from bytes that nobody vouches for.

use crate::error::DecodeError;

/// Takes values from the front of bytes, never allocates, and never panics.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// How many bytes have been taken.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    /// Nothing may follow.
    pub(crate) fn finish(&self) -> Result<(), DecodeError> {
        match self.bytes.len() - self.at {
            0 => Ok(()),
            bytes => Err(DecodeError::Trailing { bytes }),
        }
    }

    /// The head of a map: how many keys follow, each before its value.
    pub(crate) fn map(&mut self) -> Result<usize, DecodeError> {
        match self.marker()? {
            marker @ 0x80..=0x8f => Ok(usize::from(marker & 0x0f)),
            0xde => self.length::<2>(),
            0xdf => self.length::<4>(),
            marker => Err(self.unexpected("a map", marker)),
        }
    }

    /// The head of an array that must have `expected` values.
    pub(crate) fn array(&mut self, key: &'static str, expected: usize) -> Result<(), DecodeError> {
        let found = match self.marker()? {
            marker @ 0x90..=0x9f => usize::from(marker & 0x0f),
            0xdc => self.length::<2>()?,
            0xdd => self.length::<4>()?,
            marker => return Err(self.unexpected("an array", marker)),
        };
        if found == expected {
            Ok(())
        } else {
            Err(DecodeError::WrongLength {
                key,
                expected,
                found,
            })
        }
    }

    pub(crate) fn text(&mut self) -> Result<&'a str, DecodeError> {
        let length = match self.marker()? {
            marker @ 0xa0..=0xbf => usize::from(marker & 0x1f),
            0xd9 => self.length::<1>()?,
            0xda => self.length::<2>()?,
            0xdb => self.length::<4>()?,
            marker => return Err(self.unexpected("a text", marker)),
        };
        let at = self.at;
        std::str::from_utf8(self.take(length)?).map_err(|_| DecodeError::NotUtf8 { at })
    }

    /// A finite number of any kind, as a float.
    pub(crate) fn float(&mut self, key: &'static str) -> Result<f32, DecodeError> {
        let value = match self.marker()? {
            0xca => f32::from_be_bytes(self.fixed()?),
            0xcb => f64::from_be_bytes(self.fixed()?) as f32,
            marker => self.integer_after(marker, "a number")? as f32,
        };
        if value.is_finite() {
            Ok(value)
        } else {
            Err(DecodeError::OutOfRange { key })
        }
    }

    /// An integer from 0 to 255, however it was written.
    pub(crate) fn byte(&mut self, key: &'static str) -> Result<u8, DecodeError> {
        let marker = self.marker()?;
        let value = self.integer_after(marker, "an integer")?;
        u8::try_from(value).map_err(|_| DecodeError::OutOfRange { key })
    }

    pub(crate) fn boolean(&mut self) -> Result<bool, DecodeError> {
        match self.marker()? {
            0xc2 => Ok(false),
            0xc3 => Ok(true),
            marker => Err(self.unexpected("a boolean", marker)),
        }
    }

    /// Takes one value of any type with everything inside of it; nested as deep as it likes.
    pub(crate) fn skip(&mut self) -> Result<(), DecodeError> {
        // Every value has at least one byte, so the count ends the loop or the bytes do.
        let mut values: u64 = 1;
        while values > 0 {
            values -= 1;
            values += self.skip_flat()?;
        }
        Ok(())
    }

    /// Takes one value and says how many values it contains.
    fn skip_flat(&mut self) -> Result<u64, DecodeError> {
        let marker = self.marker()?;
        let (bytes, values) = match marker {
            0x00..=0x7f | 0xc0 | 0xc2 | 0xc3 | 0xe0..=0xff => (0, 0),
            0x80..=0x8f => (0, 2 * usize::from(marker & 0x0f)),
            0x90..=0x9f => (0, usize::from(marker & 0x0f)),
            0xa0..=0xbf => (usize::from(marker & 0x1f), 0),
            0xc4 | 0xd9 => (self.length::<1>()?, 0),
            0xc5 | 0xda => (self.length::<2>()?, 0),
            0xc6 | 0xdb => (self.length::<4>()?, 0),
            0xc7 => (self.length::<1>()?.saturating_add(1), 0),
            0xc8 => (self.length::<2>()?.saturating_add(1), 0),
            0xc9 => (self.length::<4>()?.saturating_add(1), 0),
            0xcc | 0xd0 => (1, 0),
            0xcd | 0xd1 | 0xd4 => (2, 0),
            0xd5 => (3, 0),
            0xca | 0xce | 0xd2 => (4, 0),
            0xd6 => (5, 0),
            0xcb | 0xcf | 0xd3 => (8, 0),
            0xd7 => (9, 0),
            0xd8 => (17, 0),
            0xdc => (0, self.length::<2>()?),
            0xdd => (0, self.length::<4>()?),
            0xde => (0, self.length::<2>()?.saturating_mul(2)),
            0xdf => (0, self.length::<4>()?.saturating_mul(2)),
            0xc1 => return Err(self.unexpected("a value", marker)),
        };
        self.take(bytes)?;
        Ok(values as u64)
    }

    fn integer_after(&mut self, marker: u8, expected: &'static str) -> Result<i128, DecodeError> {
        Ok(match marker {
            0x00..=0x7f => i128::from(marker),
            0xe0..=0xff => i128::from(marker.cast_signed()),
            0xcc => i128::from(u8::from_be_bytes(self.fixed()?)),
            0xcd => i128::from(u16::from_be_bytes(self.fixed()?)),
            0xce => i128::from(u32::from_be_bytes(self.fixed()?)),
            0xcf => i128::from(u64::from_be_bytes(self.fixed()?)),
            0xd0 => i128::from(i8::from_be_bytes(self.fixed()?)),
            0xd1 => i128::from(i16::from_be_bytes(self.fixed()?)),
            0xd2 => i128::from(i32::from_be_bytes(self.fixed()?)),
            0xd3 => i128::from(i64::from_be_bytes(self.fixed()?)),
            marker => return Err(self.unexpected(expected, marker)),
        })
    }

    fn marker(&mut self) -> Result<u8, DecodeError> {
        Ok(u8::from_be_bytes(self.fixed()?))
    }

    fn length<const BYTES: usize>(&mut self) -> Result<usize, DecodeError> {
        let bytes: [u8; BYTES] = self.fixed()?;
        Ok(bytes
            .iter()
            .fold(0, |length, byte| length << 8 | usize::from(*byte)))
    }

    fn fixed<const BYTES: usize>(&mut self) -> Result<[u8; BYTES], DecodeError> {
        let mut fixed = [0; BYTES];
        fixed.copy_from_slice(self.take(BYTES)?);
        Ok(fixed)
    }

    fn take(&mut self, bytes: usize) -> Result<&'a [u8], DecodeError> {
        let truncated = DecodeError::Truncated {
            at: self.bytes.len(),
        };
        let end = self.at.checked_add(bytes).ok_or(truncated)?;
        let taken = self.bytes.get(self.at..end).ok_or(truncated)?;
        self.at = end;
        Ok(taken)
    }

    fn unexpected(&self, expected: &'static str, marker: u8) -> DecodeError {
        DecodeError::Unexpected {
            expected,
            marker,
            at: self.at - 1,
        }
    }
}
