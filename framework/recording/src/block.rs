//! What a cycler writes its frames into: memory that is reserved once.

use std::fmt;
use std::io;

use hulkgen_mcap::{ChannelId, MESSAGE_HEAD, RECORD_HEAD, opcode};

/// Whole frames of one instance, each some messages, as they will stand in a chunk.
#[derive(Debug)]
pub(crate) struct Block {
    bytes: Box<[u8]>,
    /// Where the messages end.
    length: usize,
    /// Where whole frames end.
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
    bytes: &'block mut [u8],
    length: usize,
    is_full: bool,
}

impl Block {
    /// The memory is written, so that the system gives it now.
    pub(crate) fn of_bytes(bytes: usize) -> Self {
        Self {
            bytes: vec![u8::MAX; bytes].into(),
            length: 0,
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
        (self.length, self.frame, self.frames, self.times) = (0, 0, 0, None);
    }

    /// Forgets the frame that is not whole.
    pub(crate) fn roll_back(&mut self) {
        self.length = self.frame;
    }

    pub(crate) fn end_frame(&mut self, time: u64) {
        self.frame = self.length;
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
        let limit = self.bytes.len().saturating_sub(keep);
        let free = self.bytes.get_mut(self.length..limit).unwrap_or_default();
        let Some((head, data)) = free.split_at_mut_checked(RECORD_HEAD + MESSAGE_HEAD) else {
            return Err(Full);
        };
        let mut writing = Writing::new(data);
        let written = write(&mut writing);
        if writing.is_full {
            return Err(Full);
        }
        if written.is_ok() {
            let length = writing.length;
            let mut head = Writing::new(head);
            head.put(&[opcode::MESSAGE])?;
            head.put(&((MESSAGE_HEAD + length) as u64).to_le_bytes())?;
            head.put(&channel.number().to_le_bytes())?;
            head.put(&sequence.to_le_bytes())?;
            head.put(&time.to_le_bytes())?;
            head.put(&time.to_le_bytes())?;
            self.length += RECORD_HEAD + MESSAGE_HEAD + length;
        }
        Ok(written)
    }
}

impl<'block> Writing<'block> {
    /// From the beginning of this memory on.
    pub fn new(bytes: &'block mut [u8]) -> Self {
        Self {
            bytes,
            length: 0,
            is_full: false,
        }
    }

    /// How many bytes were written.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Appends, unless there is no room: then nothing more is written, and the message is not.
    #[inline]
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), Full> {
        self.fill(|free| {
            let place = free.get_mut(..bytes.len())?;
            place.copy_from_slice(bytes);
            Some(bytes.len())
        })
    }

    /// Lets `write` append into what is free. It tells how many bytes it has written from the beginning; `None`, or more than
    /// there are, where there is no room for all of them: then the message is not.
    ///
    /// # Errors
    /// If there is no room, or there was none for something before.
    #[inline]
    pub fn fill(&mut self, write: impl FnOnce(&mut [u8]) -> Option<usize>) -> Result<(), Full> {
        let free = self.bytes.get_mut(self.length..).unwrap_or_default();
        let free_bytes = free.len();
        let written = match self.is_full {
            true => None,
            false => write(free).filter(|written| *written <= free_bytes),
        };
        match written {
            Some(written) => {
                self.length += written;
                Ok(())
            }
            None => {
                self.is_full = true;
                Err(Full)
            }
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
