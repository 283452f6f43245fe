//! The chunk that is being filled: compressed as its messages come, in memory that stays.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write as _};
use std::mem;

use lz4_flex::frame::{BlockSize, FrameEncoder, FrameInfo};

use crate::format::{CHUNK_HEAD, COMPRESSION, Put, RECORD_HEAD, opcode};

/// So much is compressed at a time: what goes in and what comes out stay in a core's own cache, and nobody waits long for the core.
const PIECE: BlockSize = BlockSize::Max256KB;

/// Bytes of a chunk's record before its messages.
const HEAD: usize = RECORD_HEAD + CHUNK_HEAD;

/// A chunk that lies in the file.
#[derive(Clone, Debug)]
pub(crate) struct ChunkIndex {
    pub(crate) start: u64,
    /// Of the chunk's record.
    length: u64,
    /// Of the records that list its messages.
    index_length: u64,
    pub(super) times: (u64, u64),
    uncompressed: u64,
    /// Where the list of each channel's messages lies, and how many there are.
    pub(super) lists: BTreeMap<u16, (u64, u64)>,
}

impl ChunkIndex {
    /// With the lists of its messages.
    pub(crate) fn bytes(&self) -> u64 {
        self.length + self.index_length
    }

    pub(super) fn put(&self, out: &mut Vec<u8>) {
        out.put_record(opcode::CHUNK_INDEX, |content| {
            content.put_u64(self.times.0);
            content.put_u64(self.times.1);
            content.put_u64(self.start);
            content.put_u64(self.length);
            content.put_list(|map| {
                for (channel, (offset, _)) in &self.lists {
                    map.put_u16(*channel);
                    map.put_u64(*offset);
                }
            });
            content.put_u64(self.index_length);
            content.put_text(COMPRESSION);
            content.put_u64(self.length - HEAD as u64);
            content.put_u64(self.uncompressed);
        });
    }
}

/// Messages that are not in the file yet.
#[derive(Debug)]
pub(super) struct OpenChunk {
    /// Writes behind room for the head.
    encoder: FrameEncoder<Vec<u8>>,
    uncompressed: usize,
    sum: crc32fast::Hasher,
    times: Option<(u64, u64)>,
    /// When each channel's messages were, and where they begin.
    messages: BTreeMap<u16, Vec<(u64, u64)>>,
    /// What stands once per chunk and is in this one.
    known: BTreeSet<(u16, u32)>,
    /// Why it cannot be written.
    error: Option<io::Error>,
}

impl OpenChunk {
    pub(super) fn new() -> Self {
        let piece = FrameInfo::new().block_size(PIECE);
        Self {
            encoder: FrameEncoder::with_frame_info(piece, vec![0; HEAD]),
            uncompressed: 0,
            sum: crc32fast::Hasher::new(),
            times: None,
            messages: BTreeMap::new(),
            known: BTreeSet::new(),
            error: None,
        }
    }

    /// Bytes of its messages, not compressed.
    pub(super) fn bytes(&self) -> usize {
        self.uncompressed
    }

    /// Adds the record of a message of this channel and time.
    pub(super) fn add(&mut self, record: &[u8], channel: u16, time: u64) {
        let place = (time, self.uncompressed as u64);
        self.messages.entry(channel).or_default().push(place);
        let (first, last) = self.times.unwrap_or((time, time));
        self.times = Some((first.min(time), last.max(time)));
        self.uncompressed += record.len();
        self.sum.update(record);
        if let Err(error) = self.encoder.write_all(record) {
            self.error.get_or_insert(error);
        }
    }

    /// Whether nothing of this channel and number was asked for before.
    pub(super) fn is_new(&mut self, channel: u16, sequence: u32) -> bool {
        self.known.insert((channel, sequence))
    }

    /// The chunk as it will stand at this place of the file, with the lists of its messages; nothing, if it has none. Before anything
    /// is added, [`begin`](Self::begin) gives the memory back.
    pub(super) fn close(&mut self, start: u64) -> io::Result<Option<(ChunkIndex, Vec<u8>)>> {
        let Some(times) = self.times else {
            return Ok(None);
        };
        let finished = self.encoder.try_finish().map_err(io::Error::from);
        if let Some(error) = self.error.take().or(finished.err()) {
            *self = Self::new();
            return Err(error);
        }
        let mut out = mem::take(self.encoder.get_mut());
        self.write_head(&mut out, times);
        let mut index = ChunkIndex {
            start,
            length: out.len() as u64,
            index_length: 0,
            times,
            uncompressed: self.uncompressed as u64,
            lists: BTreeMap::new(),
        };
        for (number, mut places) in mem::take(&mut self.messages) {
            places.sort_unstable();
            let offset = start + out.len() as u64;
            index.lists.insert(number, (offset, places.len() as u64));
            out.put_record(opcode::MESSAGE_INDEX, |content| {
                content.put_u16(number);
                content.put_list(|list| {
                    for (time, offset) in places {
                        list.put_u64(time);
                        list.put_u64(offset);
                    }
                });
            });
        }
        index.index_length = out.len() as u64 - index.length;
        Ok(Some((index, out)))
    }

    fn write_head(&self, out: &mut [u8], times: (u64, u64)) {
        let mut head = Vec::with_capacity(HEAD);
        head.put_u8(opcode::CHUNK);
        head.put_u64((out.len() - RECORD_HEAD) as u64);
        head.put_u64(times.0);
        head.put_u64(times.1);
        head.put_u64(self.uncompressed as u64);
        head.put_u32(self.sum.clone().finalize());
        head.put_text(COMPRESSION);
        head.put_u64((out.len() - HEAD) as u64);
        out[..HEAD].copy_from_slice(&head);
    }

    /// Begins the next chunk in the memory of one that was closed.
    pub(super) fn begin(&mut self, mut memory: Vec<u8>) {
        memory.clear();
        memory.resize(HEAD, 0);
        *self.encoder.get_mut() = memory;
        self.uncompressed = 0;
        self.sum = crc32fast::Hasher::new();
        self.times = None;
        self.known.clear();
    }
}
