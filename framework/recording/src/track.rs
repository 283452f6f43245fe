//! The frames of one instance, on its way from the cycler to the file.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use crate::block::{Block, Full, Writing};
use crate::pool::{Place, Pool};
use hulkgen_mcap::ChannelId;

/// What became of the frames of one instance so far, to be read while it runs.
#[derive(Debug, Default)]
pub struct Counts {
    wanted: AtomicU64,
    pub(crate) recorded: AtomicU64,
    pub(crate) dropped: AtomicU64,
    pub(crate) failed: AtomicU64,
    pub(crate) lost: AtomicU64,
    pub(crate) overwritten: AtomicU64,
}

impl Counts {
    /// Frames that were asked for, whatever became of them.
    pub fn wanted(&self) -> u64 {
        self.wanted.load(Ordering::Relaxed)
    }

    /// Whole frames that were handed over, or are about to be.
    pub fn recorded(&self) -> u64 {
        self.recorded.load(Ordering::Relaxed)
    }

    /// Frames for which there was no block, or that are larger than one.
    pub fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    /// Frames of which something could not be encoded.
    pub fn failed(&self) -> u64 {
        self.failed.load(Ordering::Relaxed)
    }

    /// Recorded frames that the disk did not take, or whose values have no bytes.
    pub fn lost(&self) -> u64 {
        self.lost.load(Ordering::Relaxed)
    }

    /// Recorded frames that the ring has closed over.
    pub fn overwritten(&self) -> u64 {
        self.overwritten.load(Ordering::Relaxed)
    }

    /// Frames that are not in the file and never were: dropped, failed or lost.
    pub fn missing(&self) -> u64 {
        self.dropped() + self.failed() + self.lost()
    }

    /// Whether every frame is in the file, or was until the ring closed over it, as far as is known now.
    pub fn is_complete(&self) -> bool {
        self.missing() == 0
    }
}

/// The recording end of one instance; on its cycler's thread.
#[derive(Debug)]
pub struct Track {
    pool: Arc<Pool>,
    counts: Arc<Counts>,
    index: usize,
    /// Has the block that was begun, unless the writer took it.
    place: Arc<Place>,
    /// The time of the first frame of the block that was begun, whoever has it.
    since: Option<u64>,
    /// How many blocks were begun.
    blocks: u64,
    longest: Duration,
}

/// A frame that is being written; it counts when it is whole.
#[derive(Debug)]
pub struct Frame<'track> {
    block: &'track mut Block,
    keep: usize,
    is_first: bool,
    /// Whether it is the end of one.
    is_end: bool,
    is_full: bool,
}

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recorded<E> {
    Whole,
    /// No block was empty, or the frame is larger than one.
    Dropped,
    /// Nothing of it is recorded.
    Failed(E),
}

/// On the track's thread alone. Relaxed: a count, and nobody else counts: no locked instruction, which would wait for all that was written before.
#[inline]
fn add_one(count: &AtomicU64) {
    let more = count.load(Ordering::Relaxed) + 1;
    count.store(more, Ordering::Relaxed);
}

impl Track {
    pub(crate) fn new(
        pool: Arc<Pool>,
        counts: Arc<Counts>,
        index: usize,
        place: Arc<Place>,
        longest: Duration,
    ) -> Self {
        Self {
            pool,
            counts,
            index,
            place,
            since: None,
            blocks: 0,
            longest,
        }
    }

    /// Its counts.
    pub fn counts(&self) -> &Arc<Counts> {
        &self.counts
    }

    /// Counts a frame that is asked for.
    #[inline]
    pub fn want(&mut self) {
        add_one(&self.counts.wanted);
    }

    /// Writes one frame, at a time in nanoseconds of the run, and leaves `keep` bytes free for what its
    /// [`end`](Self::end) adds.
    ///
    /// Called again with a new block where the frame does not fit into the rest of the old one: what it wrote there is
    /// forgotten, and [`Frame::is_first`] is true.
    pub fn frame<E>(
        &mut self,
        time: u64,
        keep: usize,
        mut write: impl FnMut(&mut Frame<'_>) -> Result<(), E>,
    ) -> Recorded<E> {
        self.pass(time);
        let mut begun = self.place.take();
        if let Some(laden) = begun.take_if(|block| block.is_laden()) {
            self.pool.hand_over(laden);
        }
        loop {
            let is_new = begun.is_none();
            let Some(mut block) = begun.take().or_else(|| self.begin()) else {
                return self.dropped();
            };
            let mut frame = Frame {
                is_first: block.is_empty(),
                block: &mut block,
                keep,
                is_end: false,
                is_full: false,
            };
            let written = panic::catch_unwind(AssertUnwindSafe(|| write(&mut frame)));
            let is_full = frame.is_full;
            match written {
                Err(panic) => self.go_on_panicking(block, panic),
                Ok(Ok(())) if !is_full => {
                    if is_new {
                        self.since = Some(time);
                    }
                    block.end_frame(time);
                    add_one(&self.counts.recorded);
                    self.place.leave(block);
                    return Recorded::Whole;
                }
                Ok(Err(error)) if !is_full => {
                    self.roll_back(block);
                    self.counts.failed.fetch_add(1, Ordering::Relaxed);
                    return Recorded::Failed(error);
                }
                _ => {
                    self.roll_back(block);
                    self.hand_over();
                }
            }
            if is_new {
                return self.dropped();
            }
        }
    }

    /// Adds to the frame before what only its end tells; there must have been kept room, and nothing is left to the writer.
    /// Where the writer did not wait for it, it is alone in a block.
    pub fn end<E>(
        &mut self,
        time: u64,
        write: impl FnOnce(&mut Frame<'_>) -> Result<(), E>,
    ) -> Recorded<E> {
        if self.since.is_none() {
            return Recorded::Dropped;
        }
        let begun = self.place.take();
        let is_alone = begun.is_none();
        let Some(mut block) = begun.or_else(|| self.begin()) else {
            return self.dropped();
        };
        let mut frame = Frame {
            is_first: false,
            block: &mut block,
            keep: 0,
            is_end: true,
            is_full: false,
        };
        let written = panic::catch_unwind(AssertUnwindSafe(|| write(&mut frame)));
        let is_full = frame.is_full;
        let ended = match written {
            Err(panic) => self.go_on_panicking(block, panic),
            Ok(Ok(())) if !is_full => {
                let frames = block.frames;
                block.end_frame(time);
                block.frames = frames;
                Recorded::Whole
            }
            Ok(Err(error)) if !is_full => {
                self.counts.failed.fetch_add(1, Ordering::Relaxed);
                Recorded::Failed(error)
            }
            _ => self.dropped(),
        };
        // The writer takes long for what was left to it: better now, while the cycler waits, than in the next cycle.
        let is_laden = block.is_laden();
        self.roll_back(block);
        // Alone: the next frame must not refer to what the writer has.
        if is_alone || is_laden {
            self.hand_over();
        }
        ended
    }

    fn begin(&mut self) -> Option<Block> {
        self.since = None;
        let mut block = self.pool.take_empty()?;
        self.blocks += 1;
        (block.track, block.number) = (self.index, self.blocks);
        Some(block)
    }

    fn dropped<E>(&self) -> Recorded<E> {
        self.counts.dropped.fetch_add(1, Ordering::Relaxed);
        Recorded::Dropped
    }

    /// Told of a cycle without a frame, at a time in nanoseconds of the run: what was written before does not wait
    /// for one that may never be wanted.
    #[inline]
    pub fn pass(&mut self, time: u64) {
        if self.is_old(time) {
            self.hand_over();
        }
    }

    // By the frames' own time: to look at the clock for each of them takes longer than to write some.
    fn is_old(&self, time: u64) -> bool {
        let lasts = |since| Duration::from_nanos(time.saturating_sub(since));
        self.since.is_some_and(|since| lasts(since) >= self.longest)
    }

    /// Leaves what is whole of a block.
    fn roll_back(&mut self, mut block: Block) {
        block.roll_back();
        match block.is_empty() {
            true => {
                self.since = None;
                self.pool.give_back(block);
            }
            false => self.place.leave(block),
        }
    }

    /// A value's own code panicked while it was written: the frames before it stay.
    #[cold]
    fn go_on_panicking(&mut self, block: Block, panic: Box<dyn Any + Send>) -> ! {
        self.roll_back(block);
        self.counts.failed.fetch_add(1, Ordering::Relaxed);
        panic::resume_unwind(panic)
    }

    /// Gives what is whole to the writer; the next frame is the first of a block.
    pub fn hand_over(&mut self) {
        self.since = None;
        if let Some(block) = self.place.take() {
            self.pool.hand_over(block);
        }
    }
}

impl Drop for Track {
    fn drop(&mut self) {
        self.hand_over();
    }
}

impl Frame<'_> {
    /// Whether it is the first of its block, so that it must not refer to what stands before it.
    pub fn is_first(&self) -> bool {
        self.is_first
    }

    /// Writes one message of the frame.
    pub fn message<E: From<Full>>(
        &mut self,
        channel: ChannelId,
        sequence: u32,
        time: u64,
        write: impl FnOnce(&mut Writing<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let written = self
            .block
            .message((channel, sequence, time), self.keep, !self.is_end, write);
        written.unwrap_or_else(|full| {
            self.is_full = true;
            Err(full.into())
        })
    }
}
