//! What a cycler writes its frames into: memory that is reserved once.

use std::{fmt, io, mem};

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
    /// Its place among the blocks of the track.
    pub(crate) number: u64,
    /// Times of the first and the last message, in nanoseconds of the run.
    pub(crate) times: Option<(u64, u64)>,
}

/// There is no room: nothing was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Full;

/// The data of one message, being written; never longer than there is room.
#[derive(Debug)]
pub struct Writing<'block> {
    /// Behind what was written; nothing, once something had no room.
    free: &'block mut [u8],
    /// How much was free in the beginning.
    room: usize,
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
            number: 0,
            times: None,
        }
    }

    /// Of whole frames.
    pub(crate) fn whole(&self) -> &[u8] {
        &self.bytes[..self.frame]
    }

    /// Whether the same track wrote it before the other one.
    pub(crate) fn is_before(&self, other: &Self) -> bool {
        self.track == other.track && self.number < other.number
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
            let length = writing.length();
            let mut head = Writing::new(head);
            head.add([opcode::MESSAGE]);
            head.add(((MESSAGE_HEAD + length) as u64).to_le_bytes());
            head.add(channel.number().to_le_bytes());
            head.add(sequence.to_le_bytes());
            head.add(time.to_le_bytes());
            head.add(time.to_le_bytes());
            self.length += RECORD_HEAD + MESSAGE_HEAD + length;
        }
        Ok(written)
    }
}

impl<'block> Writing<'block> {
    /// From the beginning of this memory on.
    #[inline]
    pub fn new(bytes: &'block mut [u8]) -> Self {
        Self {
            room: bytes.len(),
            free: bytes,
            is_full: false,
        }
    }

    /// How many bytes were written; none, once something had no room.
    #[inline]
    pub fn length(&self) -> usize {
        self.room - self.free.len()
    }

    /// Whether something had no room: then nothing is written any more, and the message is not.
    #[inline]
    pub fn is_full(&self) -> bool {
        self.is_full
    }

    /// Appends so many bytes. Whether they had room, [`Self::is_full`] tells: whoever writes many asks once.
    #[inline]
    pub fn add<const BYTES: usize>(&mut self, bytes: [u8; BYTES]) {
        self.add_all(&bytes);
    }

    /// As [`Self::add`].
    #[inline]
    pub fn add_all(&mut self, bytes: &[u8]) {
        // Asked before anything is taken, it is less code.
        if self.free.len() < bytes.len() {
            return self.refuse();
        }
        let (place, free) = mem::take(&mut self.free).split_at_mut(bytes.len());
        place.copy_from_slice(bytes);
        self.free = free;
    }

    /// As [`Self::add`].
    ///
    /// # Errors
    /// If there is no room, or there was none for something before.
    #[inline]
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), Full> {
        self.add_all(bytes);
        match self.is_full {
            true => Err(Full),
            false => Ok(()),
        }
    }

    #[cold]
    #[inline(never)]
    fn refuse(&mut self) {
        (self.free, self.room, self.is_full) = (&mut [], 0, true);
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
