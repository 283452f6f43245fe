//! A budget of bytes: the oldest chunks go, their place on the disk is given back.

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
    budget: u64,
    gone: u64,
}

impl Ring {
    pub(crate) fn new(budget: u64) -> Self {
        Self {
            chunks: VecDeque::new(),
            bytes: 0,
            budget,
            gone: 0,
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
    pub(crate) fn add(&mut self, file: &mut dyn Storage, chunk: ChunkIndex) -> io::Result<()> {
        self.bytes += chunk.bytes();
        self.chunks.push_back(chunk);
        while self.bytes > self.budget && self.chunks.len() > 1 {
            let Some(oldest) = self.chunks.pop_front() else {
                break;
            };
            self.bytes -= oldest.bytes();
            remove(file, &oldest)?;
            self.gone += 1;
        }
        Ok(())
    }
}

/// Makes one record of a private kind out of a chunk and the lists of its messages.
fn remove(file: &mut dyn Storage, chunk: &ChunkIndex) -> io::Result<()> {
    let content = chunk.bytes() - RECORD_HEAD as u64;
    let mut head = [opcode::GONE; RECORD_HEAD];
    head[1..].copy_from_slice(&content.to_le_bytes());
    file.seek(SeekFrom::Start(chunk.start))?;
    file.write_all(&head)?;
    file.give_back(chunk.start + RECORD_HEAD as u64, content);
    Ok(())
}
