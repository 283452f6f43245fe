//! Finds the commands in what a client sends, and passes over everything else.

use lola::{Command, DecodeError};

/// No command is longer than this.
const LONGEST: usize = 8192;

/// Bytes that have come and are not understood yet.
#[derive(Debug, Default)]
pub(super) struct CommandStream {
    bytes: Vec<u8>,
    rejected: u64,
}

impl CommandStream {
    /// Appends what has come.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// Forgets what is not understood.
    pub(super) fn clear(&mut self) {
        self.bytes.clear();
    }

    /// How often something came that is no command.
    pub(super) fn rejected(&self) -> u64 {
        self.rejected
    }

    /// Obeys the next command; whether there was a complete one.
    pub(super) fn next(&mut self, command: &mut Command) -> bool {
        let mut skipped = 0;
        let length = loop {
            let rest = &self.bytes[skipped..];
            match lola::command::decode(rest, command) {
                Ok(length) => break Some(length),
                Err(DecodeError::Truncated { .. }) if rest.len() <= LONGEST => break None,
                // Something else; a command may begin behind its first byte.
                Err(_) => skipped += 1,
            }
        };
        self.rejected += u64::from(skipped > 0);
        self.bytes.drain(..skipped + length.unwrap_or(0));
        length.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message() -> Vec<u8> {
        let mut command = Command::default();
        command.motors.positions.head_yaw = 0.5;
        let mut bytes = Vec::new();
        lola::command::encode(&command, &mut bytes);
        bytes
    }

    fn all(stream: &mut CommandStream) -> Vec<f32> {
        let mut command = Command::default();
        std::iter::from_fn(|| {
            stream
                .next(&mut command)
                .then_some(command.motors.positions.head_yaw)
        })
        .collect()
    }

    #[test]
    fn a_command_is_obeyed_as_soon_as_it_is_complete() {
        let mut stream = CommandStream::default();
        let message = message();
        for byte in &message[..message.len() - 1] {
            stream.push(&[*byte]);
            assert!(all(&mut stream).is_empty());
        }
        stream.push(&message[message.len() - 1..]);
        assert_eq!((all(&mut stream), stream.rejected()), (vec![0.5], 0));
    }

    #[test]
    fn garbage_before_a_command_is_skipped_and_counted_once() {
        let mut stream = CommandStream::default();
        stream.push(b"\xc1 hello \xff\x00");
        stream.push(&message());
        stream.push(&message());
        assert_eq!((all(&mut stream), stream.rejected()), (vec![0.5, 0.5], 1));
    }

    #[test]
    fn a_command_with_a_number_that_is_none_is_refused() {
        let mut bytes = message();
        let value = bytes
            .windows(4)
            .position(|window| window == 0.5_f32.to_be_bytes())
            .unwrap();
        bytes[value..value + 4].copy_from_slice(&f32::NAN.to_be_bytes());
        let mut stream = CommandStream::default();
        stream.push(&bytes);
        stream.push(&message());
        assert_eq!(all(&mut stream).last(), Some(&0.5));
        assert!(stream.rejected() > 0);
    }

    #[test]
    fn endless_garbage_does_not_fill_the_memory() {
        let mut stream = CommandStream::default();
        for _ in 0..100 {
            stream.push(&[0x81; 1024]);
            all(&mut stream);
            assert!(stream.bytes.len() <= LONGEST);
        }
        assert!(stream.rejected() > 0);
    }
}
