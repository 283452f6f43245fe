//! Values as CDR, the form in which ROS 2 exchanges messages: from the robot's own bytes or its JSON, and back to JSON.
//!
//! It is the little-endian form of version 1 (XCDR1): four bytes that say so, then all parts in their order, numbers
//! aligned to their size, counts and lengths in four bytes, texts ended by a zero. An `Option` is a sequence of at most
//! one; an enum of names alone is the number of its variant in four bytes; what has no parts is a zero, as in ROS 2.

mod bytes;
mod json;
mod read;

/// Says: CDR of version 1, little-endian.
const HEAD: [u8; 4] = [0, 1, 0, 0];

/// A longer value of CDR is none that a robot sends many times in a second.
const LONGEST: usize = 64 << 20;

/// CDR as far as it is written.
struct Cdr(Vec<u8>);

impl Cdr {
    fn new() -> Self {
        Self(HEAD.to_vec())
    }

    fn is_too_long(&self) -> bool {
        self.0.len() > LONGEST
    }

    /// A number, behind as many empty bytes as its alignment needs.
    fn number(&mut self, number: &[u8]) {
        let length = (self.0.len() - HEAD.len()).next_multiple_of(number.len());
        self.0.resize(HEAD.len() + length, 0);
        self.0.extend_from_slice(number);
    }

    fn count(&mut self, count: u32) {
        self.number(&count.to_le_bytes());
    }

    /// Nothing: it is longer than its length can say.
    fn text(&mut self, text: &[u8]) -> Option<()> {
        let length = u32::try_from(text.len()).ok()?.checked_add(1)?;
        self.count(length);
        self.0.extend_from_slice(text);
        self.0.push(0);
        Some(())
    }

    /// In place of what has no parts.
    fn nothing(&mut self) {
        self.0.push(0);
    }
}

/// What rmw_zenoh puts beside each message: the number of the message, when it was made in nanoseconds since 1970, and who
/// made it, with its length before it.
pub(crate) fn attachment(cycle: u64, time: u64, id: [u8; 16]) -> Vec<u8> {
    let mut bytes = cycle.to_le_bytes().to_vec();
    bytes.extend_from_slice(&time.to_le_bytes());
    bytes.push(16);
    bytes.extend_from_slice(&id);
    bytes
}

/// What stood beside a request of ROS 2.
#[derive(Debug, Eq, PartialEq)]
pub(crate) struct Beside {
    /// Of the request, by its client's count.
    pub(crate) number: u64,
    /// Of the client.
    pub(crate) id: [u8; 16],
}

impl Beside {
    /// `None`: it is not from there.
    pub(crate) fn read(bytes: &[u8]) -> Option<Self> {
        let (number, rest) = bytes.split_first_chunk()?;
        let (_time, rest) = rest.split_first_chunk::<8>()?;
        let (length, id) = rest.split_first()?;
        (*length == 16).then_some(())?;
        Some(Self {
            number: u64::from_le_bytes(*number),
            id: id.try_into().ok()?,
        })
    }
}

#[cfg(test)]
mod tests;
