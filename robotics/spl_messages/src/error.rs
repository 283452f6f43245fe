//! Owns what can be wrong with a message: with bytes that came, and with values that shall be sent.

/// Why bytes are no message.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DecodeError {
    /// More or fewer bytes than the message has.
    #[error("the message has {found} bytes instead of {expected}")]
    WrongLength {
        /// How many it must have.
        expected: usize,
        /// How many it has.
        found: usize,
    },
    /// Another kind of message.
    #[error("the header is \"{}\" instead of \"{}\"", found.escape_ascii(), expected.escape_ascii())]
    WrongHeader {
        /// What has to stand in front.
        expected: [u8; 4],
        /// What stands there.
        found: [u8; 4],
    },
    /// Another version of the message.
    #[error("the version is {found} instead of {expected}")]
    WrongVersion {
        /// The only one that is understood.
        expected: u8,
        /// That of the message.
        found: u8,
    },
    /// A number that stands for nothing.
    #[error("`{field}` is {found} instead of {expected}")]
    UnknownValue {
        /// Which field.
        field: &'static str,
        /// What it can be.
        expected: &'static str,
        /// What it is.
        found: u8,
    },
    /// A number that the field cannot have: infinite, none at all, or out of range.
    #[error("`{field}` is {found} instead of {expected}")]
    OutOfRange {
        /// Which field.
        field: &'static str,
        /// What it can be.
        expected: &'static str,
        /// What it is.
        found: f32,
    },
}

/// Why values cannot be sent.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("`{field}` is {found} instead of {expected}")]
pub struct EncodeError {
    /// Which field.
    pub field: &'static str,
    /// What it can be.
    pub expected: &'static str,
    /// What it is.
    pub found: f32,
}
