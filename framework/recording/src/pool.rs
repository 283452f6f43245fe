//! Blocks on their way between cyclers and the writer; nobody waits, nothing is allocated.

use std::sync::Arc;

use crossbeam_queue::ArrayQueue;

use crate::block::Block;
use crate::late::Room;

/// All blocks of a recording.
#[derive(Debug)]
pub(crate) struct Pool {
    empty: ArrayQueue<Block>,
    full: ArrayQueue<Block>,
}

/// Where a track leaves the block that it has begun, whenever it writes nothing: a cycle that hangs keeps no frame to itself.
#[derive(Debug)]
pub(crate) struct Place(ArrayQueue<Block>);

impl Default for Place {
    fn default() -> Self {
        Self(ArrayQueue::new(1))
    }
}

impl Place {
    /// For the track, or for the writer where the track has nothing more for long.
    pub(crate) fn take(&self) -> Option<Block> {
        self.0.pop()
    }

    pub(crate) fn leave(&self, block: Block) {
        // The track has one block at a time.
        let left = self.0.push(block);
        debug_assert!(left.is_ok(), "two blocks of one track");
    }
}

impl Pool {
    /// So many blocks of so many bytes, whose memory is touched now and not in a cycle; in all of them up to so many values that
    /// the writer writes.
    pub(crate) fn new(blocks: usize, bytes: usize, late: usize) -> Self {
        let blocks = blocks.max(1);
        let room = Arc::new(Room::of(late));
        let pool = Self {
            empty: ArrayQueue::new(blocks),
            full: ArrayQueue::new(blocks),
        };
        for _ in 0..blocks {
            pool.give_back(Block::of_bytes(bytes, room.clone()));
        }
        pool
    }

    pub(crate) fn take_empty(&self) -> Option<Block> {
        self.empty.pop()
    }

    /// For the writer.
    pub(crate) fn hand_over(&self, block: Block) {
        // There is room for all blocks there are.
        let handed = self.full.push(block);
        debug_assert!(handed.is_ok(), "a block from elsewhere");
    }

    pub(crate) fn take_full(&self) -> Option<Block> {
        self.full.pop()
    }

    /// Whether blocks wait for the writer while it has one, or cyclers may soon have none.
    pub(crate) fn is_short(&self) -> bool {
        self.full() >= 2 || self.empty.is_empty()
    }

    /// How many wait for the writer.
    pub(crate) fn full(&self) -> usize {
        self.full.len()
    }

    pub(crate) fn give_back(&self, mut block: Block) {
        block.clear();
        let given = self.empty.push(block);
        debug_assert!(given.is_ok(), "a block from elsewhere");
    }
}
