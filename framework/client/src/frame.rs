//! Values in bytes.

use protocol::{BINARY_HEADER, BINARY_MAGIC};

/// A value in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// As the answer to `subscribe` said.
    pub subscription: u32,
    /// Number of the cycle that wrote it.
    pub cycle: u64,
    /// In nanoseconds of the robot's clock.
    pub time: u64,
    /// Empty: the part is not there in this cycle.
    pub value: Vec<u8>,
}

impl Frame {
    /// A binary message of a robot; `None` for anything else.
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let (head, value) = bytes.split_at_checked(BINARY_HEADER)?;
        let (magic, rest) = head.split_first_chunk()?;
        let (subscription, rest) = rest.split_first_chunk()?;
        let (cycle, rest) = rest.split_first_chunk()?;
        let (time, _) = rest.split_first_chunk()?;
        (*magic == BINARY_MAGIC).then(|| Self {
            subscription: u32::from_le_bytes(*subscription),
            cycle: u64::from_le_bytes(*cycle),
            time: u64::from_le_bytes(*time),
            value: value.to_vec(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Frame;

    #[test]
    fn a_frame_is_read_and_others_are_not() {
        let mut bytes = b"HKG1".to_vec();
        bytes.extend(7_u32.to_le_bytes());
        bytes.extend(812_u64.to_le_bytes());
        bytes.extend(9_744_000_000_u64.to_le_bytes());
        bytes.push(1);
        let frame = Frame {
            subscription: 7,
            cycle: 812,
            time: 9_744_000_000,
            value: vec![1],
        };
        assert_eq!(Frame::read(&bytes), Some(frame));
        assert_eq!(Frame::read(&bytes[..23]), None);
        bytes[0] = b'X';
        assert_eq!(Frame::read(&bytes), None);
    }
}
