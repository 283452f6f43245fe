//! What a cycler writes its frames into: memory that is reserved once.

use std::fmt;
use std::io;

use hulkgen_mcap::{ChannelId, MESSAGE_HEAD, RECORD_HEAD, opcode};

/// Whole frames of one instance, each some messages, as they will stand in a chunk.
#[derive(Debug)]
pub(crate) struct Block {
    bytes: Vec<u8>,
    /// Of the frame that is not whole yet.
    frame: usize,
    /// How many frames are whole.
    pub(crate) frames: u64,
    /// The track whose frames these are.
    pub(crate) track: usize,
    /// Times of the first and the last message, in nanoseconds of the run.
    pub(crate) times: Option<(u64, u64)>,
}

/// There is no room: nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Full;

/// The data of one message, being written; never longer than there is room.
#[derive(Debug)]
pub struct Writing<'block> {
    bytes: &'block mut Vec<u8>,
    limit: usize,
    is_full: bool,
}

impl Block {
    pub(crate) fn with_capacity(bytes: usize) -> Self {
        Self {
            bytes: Vec::with_capacity(bytes),
            frame: 0,
            frames: 0,
            track: 0,
            times: None,
        }
    }

    /// Of whole frames.
    pub(crate) fn whole(&self) -> &[u8] {
        &self.bytes[..self.frame]
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.frame == 0
    }

    pub(crate) fn clear(&mut self) {
        self.bytes.clear();
        (self.frame, self.frames, self.times) = (0, 0, None);
    }

    /// Forgets the frame that is not whole.
    pub(crate) fn roll_back(&mut self) {
        self.bytes.truncate(self.frame);
    }

    pub(crate) fn end_frame(&mut self, time: u64) {
        self.frame = self.bytes.len();
        self.frames += 1;
        let (first, last) = self.times.unwrap_or((time, time));
        self.times = Some((first.min(time), last.max(time)));
    }

    /// One message of the frame; `keep` bytes stay free behind it.
    pub(crate) fn message<E>(
        &mut self,
        (channel, sequence, time): (ChannelId, u32, u64),
        keep: usize,
        write: impl FnOnce(&mut Writing<'_>) -> Result<(), E>,
    ) -> Result<Result<(), E>, Full> {
        let start = self.bytes.len();
        let limit = self.bytes.capacity().saturating_sub(keep);
        if start + RECORD_HEAD + MESSAGE_HEAD > limit {
            return Err(Full);
        }
        self.bytes.push(opcode::MESSAGE);
        self.bytes.extend(0_u64.to_le_bytes());
        self.bytes.extend(channel.number().to_le_bytes());
        self.bytes.extend(sequence.to_le_bytes());
        self.bytes.extend(time.to_le_bytes());
        self.bytes.extend(time.to_le_bytes());
        let mut writing = Writing {
            bytes: &mut self.bytes,
            limit,
            is_full: false,
        };
        let written = write(&mut writing);
        if writing.is_full {
            self.bytes.truncate(start);
            return Err(Full);
        }
        if written.is_err() {
            self.bytes.truncate(start);
            return Ok(written);
        }
        let length = (self.bytes.len() - start - RECORD_HEAD) as u64;
        self.bytes[start + 1..start + RECORD_HEAD].copy_from_slice(&length.to_le_bytes());
        Ok(Ok(()))
    }
}

impl<'block> Writing<'block> {
    /// Into memory that grows, for whoever wants the bytes alone.
    pub fn growing(bytes: &'block mut Vec<u8>) -> Self {
        Self {
            bytes,
            limit: usize::MAX,
            is_full: false,
        }
    }

    /// Appends, unless there is no room: then nothing more is written, and the message is not.
    #[inline]
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), Full> {
        if self.is_full || self.bytes.len() + bytes.len() > self.limit {
            self.is_full = true;
            return Err(Full);
        }
        self.bytes.extend_from_slice(bytes);
        Ok(())
    }

    /// How many bytes the message has so far, beside those before it in the block.
    pub fn position(&self) -> usize {
        self.bytes.len()
    }

    /// Replaces what was written at a [`position`](Self::position) before.
    pub fn replace(&mut self, position: usize, bytes: &[u8]) {
        if let Some(place) = self.bytes.get_mut(position..position + bytes.len()) {
            place.copy_from_slice(bytes);
        }
    }
}

impl io::Write for Writing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.put(bytes)
            .map_err(|Full| io::Error::from(io::ErrorKind::StorageFull))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl fmt::Display for Full {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("there is no room in the block")
    }
}

impl std::error::Error for Full {}
