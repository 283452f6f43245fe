//! Owns what can be wrong with bytes from the other side.

/// Why bytes are no message.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
pub enum DecodeError {
    /// The message goes on where the bytes end.
    #[error("the message is cut off after {at} bytes")]
    Truncated {
        /// How many bytes there are.
        at: usize,
    },
    /// Another type of value than the key asks for, or a byte that starts no value at all.
    #[error("expected {expected} at byte {at}, found marker {marker:#04x}")]
    Unexpected {
        /// What had to stand there.
        expected: &'static str,
        /// The byte that stands there.
        marker: u8,
        /// Its place.
        at: usize,
    },
    /// More or fewer values than the key has.
    #[error("`{key}` has {found} values instead of {expected}")]
    WrongLength {
        /// The key.
        key: &'static str,
        /// How many it has.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A value that this key cannot have: infinite, no number, or out of range.
    #[error("a value of `{key}` is out of range")]
    OutOfRange {
        /// The key.
        key: &'static str,
    },
    /// A key stands twice in the map.
    #[error("`{key}` stands there twice")]
    Duplicate {
        /// The key.
        key: &'static str,
    },
    /// A state without one of its keys.
    #[error("`{key}` is missing")]
    Missing {
        /// The key.
        key: &'static str,
    },
    /// A text that is not UTF-8.
    #[error("the text at byte {at} is not UTF-8")]
    NotUtf8 {
        /// Where it begins.
        at: usize,
    },
    /// The message ends before the bytes do.
    #[error("{bytes} bytes follow the message")]
    Trailing {
        /// How many.
        bytes: usize,
    },
}

/// A serial number or version whose length would give a state another size than LoLA's.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[error("{name} must have {expected} characters, not {found}")]
pub struct WrongIdentifier {
    /// Which one.
    pub name: &'static str,
    /// How many characters it must have.
    pub expected: usize,
    /// How many it has.
    pub found: usize,
}
