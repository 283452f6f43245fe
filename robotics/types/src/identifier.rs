//! Owns short texts of the hardware that fit in place, without heap.

use std::fmt;
use std::str::FromStr;

use framework::reflect::binary::encode_text;
use framework::reflect::{EncodeError, Leaf, Shape};
use framework::{Clear, Given, Reflect};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The longest text that fits, in bytes: serial numbers of the NAO have 20 characters.
pub const IDENTIFIER_LENGTH: usize = 20;

/// A text of at most [`IDENTIFIER_LENGTH`] bytes, such as a serial number or a version.
#[derive(Clone, Copy, Default, Eq, Hash, Ord, PartialEq, PartialOrd)]
pub struct Identifier {
    bytes: [u8; IDENTIFIER_LENGTH],
    length: u8,
}

/// A text that has more than [`IDENTIFIER_LENGTH`] bytes.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct TooLong;

impl Identifier {
    /// The text.
    pub fn as_str(&self) -> &str {
        let length = usize::from(self.length).min(IDENTIFIER_LENGTH);
        std::str::from_utf8(&self.bytes[..length]).unwrap_or_default()
    }
}

impl FromStr for Identifier {
    type Err = TooLong;

    fn from_str(text: &str) -> Result<Self, TooLong> {
        let mut identifier = Self::default();
        let bytes = identifier.bytes.get_mut(..text.len()).ok_or(TooLong)?;
        bytes.copy_from_slice(text.as_bytes());
        identifier.length = u8::try_from(text.len()).map_err(|_| TooLong)?;
        Ok(identifier)
    }
}

impl fmt::Display for Identifier {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

impl fmt::Debug for Identifier {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.as_str(), formatter)
    }
}

impl fmt::Display for TooLong {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "more than {IDENTIFIER_LENGTH} bytes")
    }
}

impl std::error::Error for TooLong {}

impl Clear for Identifier {}

impl Reflect for Identifier {
    fn shape() -> Shape {
        Shape::leaf::<Self>(Leaf::Text)
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodeError> {
        encode_text(self.as_str(), bytes)
    }

    fn as_serialize(&self) -> &dyn erased_serde::Serialize {
        self
    }

    fn deserialize_from(&mut self, given: &Given<'_>) -> framework::Result<()> {
        *self = given.read()?;
        Ok(())
    }
}

impl Serialize for Identifier {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.as_str())
    }
}

impl<'de> Deserialize<'de> for Identifier {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?
            .parse()
            .map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_serial_number_fits() {
        let identifier: Identifier = "P0000073A03S83I00011".parse().unwrap();
        assert_eq!(identifier.as_str(), "P0000073A03S83I00011");
        assert_eq!(identifier.to_string().len(), IDENTIFIER_LENGTH);
    }

    #[test]
    fn a_longer_text_is_refused() {
        assert_eq!("P0000073A03S83I000111".parse::<Identifier>(), Err(TooLong));
    }
}
