//! What a cycler writes its frames into: memory that is reserved once.

use std::sync::Arc;
use std::{fmt, io, mem};

use hulkgen_mcap::{ChannelId, MESSAGE_HEAD, RECORD_HEAD, opcode};

use crate::late::{Late, Parts, Room};

/// Bytes before the data of a message.
const HEAD: usize = RECORD_HEAD + MESSAGE_HEAD;
/// Where a message has its length, behind its opcode.
const LENGTH_AT: usize = 1;

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
    /// What the writer's thread adds to the messages.
    late: Parts,
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
    late: Option<&'block mut Parts>,
}

impl Block {
    /// The memory is written, so that the system gives it now.
    pub(crate) fn of_bytes(bytes: usize, room: Arc<Room>) -> Self {
        Self {
            bytes: vec![u8::MAX; bytes].into(),
            length: 0,
            frame: 0,
            frames: 0,
            track: 0,
            number: 0,
            times: None,
            late: Parts::new(room),
        }
    }

    /// Of whole frames, and how many they are: those before one of which a value has no bytes. `memory` is for blocks that left
    /// something to the writer.
    pub(crate) fn whole<'a>(&'a self, memory: &'a mut Vec<u8>) -> (&'a [u8], u64) {
        let whole = &self.bytes[..self.frame];
        if self.late.count() == 0 {
            return (whole, self.frames);
        }
        let ends = self.late.write(whole, LENGTH_AT, memory);
        (memory, ends.unwrap_or(self.frames))
    }

    /// Whether it should go to the writer for the values that it left to it.
    pub(crate) fn is_laden(&self) -> bool {
        self.late.is_laden()
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
        self.late.truncate(0);
    }

    /// Forgets the frame that is not whole.
    pub(crate) fn roll_back(&mut self) {
        self.length = self.frame;
        self.late.truncate_to(self.frame);
    }

    pub(crate) fn end_frame(&mut self, time: u64) {
        self.frame = self.length;
        self.frames += 1;
        let (first, last) = self.times.unwrap_or((time, time));
        self.times = Some((first.min(time), last.max(time)));
    }

    /// One message of the frame; `keep` bytes stay free behind it. Whether it may leave values to the writer's thread.
    pub(crate) fn message<E>(
        &mut self,
        (channel, sequence, time): (ChannelId, u32, u64),
        keep: usize,
        may_leave: bool,
        write: impl FnOnce(&mut Writing<'_>) -> Result<(), E>,
    ) -> Result<Result<(), E>, Full> {
        let limit = self.bytes.len().saturating_sub(keep);
        let free = self.bytes.get_mut(self.length..limit).unwrap_or_default();
        let Some((head, data)) = free.split_at_mut_checked(HEAD) else {
            return Err(Full);
        };
        let late = self.late.count();
        let mut writing = Writing {
            late: may_leave.then_some(&mut self.late),
            ..Writing::new(data)
        };
        let written = write(&mut writing);
        let (length, is_full) = (writing.length(), writing.is_full);
        if is_full || written.is_err() {
            self.late.truncate(late);
        }
        if is_full {
            return Err(Full);
        }
        if written.is_ok() {
            let mut head = Writing::new(head);
            head.add([opcode::MESSAGE]);
            head.add(((MESSAGE_HEAD + length) as u64).to_le_bytes());
            head.add(channel.number().to_le_bytes());
            head.add(sequence.to_le_bytes());
            head.add(time.to_le_bytes());
            head.add(time.to_le_bytes());
            let frame = (self.frame, self.frames);
            self.late.place(late, (self.length, HEAD), frame);
            self.length += HEAD + length;
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
            late: None,
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

    /// Appends these bytes, and leaves it to the writer's thread to append those of the value. False: there is no room for that, or
    /// nobody to leave it to, and nothing was appended.
    #[inline(never)]
    pub fn leave(&mut self, before: &[u8], value: Arc<dyn Late>) -> bool {
        let at = self.length() + before.len();
        let is_left = self.late.as_mut().is_some_and(|late| late.add(at, value));
        if is_left {
            self.add_all(before);
        }
        is_left
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
