//! A budget of bytes, and a disk that has less: the oldest chunks go, their place on the disk is given back.

use std::collections::VecDeque;
use std::io::{self, SeekFrom};

use crate::file::ChunkIndex;
use crate::format::{RECORD_HEAD, opcode};
use crate::storage::Storage;

/// The chunks that a file has, oldest first.
#[derive(Debug)]
pub(crate) struct Ring {
    chunks: VecDeque<ChunkIndex>,
    bytes: u64,
    /// The most bytes that they had.
    most: u64,
    budget: u64,
    gone: u64,
    /// Whether places in the file are given back; `None` before anybody has asked.
    gives_back: Option<bool>,
}

impl Ring {
    pub(crate) fn new(budget: u64) -> Self {
        Self {
            chunks: VecDeque::new(),
            bytes: 0,
            most: 0,
            budget,
            gone: 0,
            gives_back: None,
        }
    }

    /// How many chunks it closed over.
    pub(crate) fn gone(&self) -> u64 {
        self.gone
    }

    /// How many chunks the file has.
    pub(crate) fn len(&self) -> usize {
        self.chunks.len()
    }

    pub(crate) fn chunks(&self) -> impl Iterator<Item = &ChunkIndex> {
        self.chunks.iter()
    }

    /// Keeps a chunk that was just written, and removes as many old ones as the budget asks for; the newest stays.
    pub(crate) fn add(&mut self, file: &mut dyn Storage, chunk: ChunkIndex) {
        self.bytes += chunk.bytes();
        self.chunks.push_back(chunk);
        while self.bytes > self.budget && self.chunks.len() > 1 {
            // It stays, whole, and goes with the next one that is added: nothing is lost by it.
            if self.remove_oldest(file).is_err() {
                break;
            }
        }
        self.most = self.most.max(self.bytes);
    }

    /// Removes the oldest chunk of a disk that is full; whether there is more room now. Half of the most that there was stays:
    /// others may have filled the disk, and would fill it again.
    pub(crate) fn make_room(&mut self, file: &mut dyn Storage) -> bool {
        let oldest = self.chunks.front().map_or(0, ChunkIndex::bytes);
        let is_enough_left = self.chunks.len() > 1 && self.bytes - oldest >= self.most / 2;
        // Who gave no budget wants all of it, or an error.
        let is_ring = self.budget < u64::MAX;
        is_ring
            && is_enough_left
            && self.gives_back(file)
            && self.remove_oldest(file).is_ok_and(|gives_back| gives_back)
    }

    /// Asked before the first chunk goes, which would be for nothing.
    fn gives_back(&mut self, file: &mut dyn Storage) -> bool {
        *self.gives_back.get_or_insert_with(|| {
            // Behind the end there is nothing to lose.
            let end = file.seek(SeekFrom::End(0));
            end.is_ok_and(|end| file.give_back(end, 1))
        })
    }

    /// Whether its place was given back; on an error it is still there.
    fn remove_oldest(&mut self, file: &mut dyn Storage) -> io::Result<bool> {
        let Some(oldest) = self.chunks.front() else {
            return Ok(false);
        };
        let gives_back = remove(file, oldest)?;
        self.gives_back = Some(gives_back);
        self.bytes -= oldest.bytes();
        self.chunks.pop_front();
        self.gone += 1;
        Ok(gives_back)
    }
}

/// Makes one record of a private kind out of a chunk and the lists of its messages; whether their place was given back.
fn remove(file: &mut dyn Storage, chunk: &ChunkIndex) -> io::Result<bool> {
    let content = chunk.bytes() - RECORD_HEAD as u64;
    let mut head = [opcode::GONE; RECORD_HEAD];
    head[1..].copy_from_slice(&content.to_le_bytes());
    file.seek(SeekFrom::Start(chunk.start))?;
    file.write_all(&head)?;
    Ok(file.give_back(chunk.start + RECORD_HEAD as u64, content))
}
