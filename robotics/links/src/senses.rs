//! Cameras and microphones of another process, over Unix stream sockets: what stands before each message.
//!
//! Everything is little endian. Each message has a header of 24 bytes: `NAOI` (image) or `NAOS` (sound); the length of what
//! follows (u32); the time of the exposure or of the last sample, in ns of the sender's clock (u64); for images width
//! and height (2 u32), for sound samples and channels (2 u32). An image is YUYV, sound is interleaved 32-bit floats. Nothing is ever
//! sent in the other direction.

/// What stands before each message, in bytes.
pub const HEADER_LENGTH: usize = 24;

/// What a message brings.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Kind {
    /// An image in YUYV.
    Image,
    /// Sound in interleaved 32-bit floats.
    Sound,
}

/// What stands before a message.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Header {
    /// What follows.
    pub kind: Kind,
    /// How many bytes follow.
    pub length: u32,
    /// When it was taken, in ns of the sender's clock.
    pub at: u64,
    /// Width and height in px, or samples and channels.
    pub size: [u32; 2],
}

impl Kind {
    const ALL: [Self; 2] = [Self::Image, Self::Sound];

    fn letters(self) -> [u8; 4] {
        match self {
            Self::Image => *b"NAOI",
            Self::Sound => *b"NAOS",
        }
    }

    /// Bytes of one pixel, or of one sample of one channel.
    fn unit(self) -> u64 {
        match self {
            Self::Image => 2,
            Self::Sound => 4,
        }
    }
}

impl Header {
    /// The header of a message of that size.
    pub fn new(kind: Kind, at: u64, size: [u32; 2]) -> Self {
        let length = size.map(u64::from).iter().product::<u64>() * kind.unit();
        Self {
            kind,
            // Nobody has images of 4 GiB.
            length: u32::try_from(length).unwrap_or(u32::MAX),
            at,
            size,
        }
    }

    /// As it stands on the wire.
    pub fn encode(&self) -> [u8; HEADER_LENGTH] {
        let mut bytes = [0; HEADER_LENGTH];
        bytes[..4].copy_from_slice(&self.kind.letters());
        bytes[4..8].copy_from_slice(&self.length.to_le_bytes());
        bytes[8..16].copy_from_slice(&self.at.to_le_bytes());
        bytes[16..20].copy_from_slice(&self.size[0].to_le_bytes());
        bytes[20..].copy_from_slice(&self.size[1].to_le_bytes());
        bytes
    }

    /// What the bytes say; `None` where they are no header, or its length is not that of its size.
    pub fn decode(bytes: &[u8; HEADER_LENGTH]) -> Option<Self> {
        let kind = Kind::ALL
            .into_iter()
            .find(|kind| bytes[..4] == kind.letters())?;
        let number = |at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|byte| bytes[at + byte]));
        let at = u64::from(number(8)) | u64::from(number(12)) << 32;
        let header = Self::new(kind, at, [number(16), number(20)]);
        (header.length == number(4)).then_some(header)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_survives_the_wire() {
        let header = Header::new(Kind::Image, u64::MAX - 5, [640, 480]);
        assert_eq!(header.length, 614_400);
        assert_eq!(Header::decode(&header.encode()), Some(header));
        let header = Header::new(Kind::Sound, 7, [2048, 4]);
        assert_eq!(header.length, 32_768);
        assert_eq!(Header::decode(&header.encode()), Some(header));
    }

    #[test]
    fn what_is_no_header_is_refused() {
        let bytes = Header::new(Kind::Image, 1, [640, 480]).encode();
        for place in (0..8).chain(16..HEADER_LENGTH) {
            let mut wrong = bytes;
            wrong[place] ^= 1;
            assert_eq!(Header::decode(&wrong), None, "byte {place}");
        }
        assert_eq!(Header::decode(&[0xff; HEADER_LENGTH]), None);
    }
}
