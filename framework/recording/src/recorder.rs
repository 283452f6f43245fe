//! The thread that owns the file.

use std::collections::VecDeque;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::block::Block;
use crate::pool::{Place, Pool};
use crate::rewrite::{Rewrites, rewritten};
use crate::track::{Counts, Track};
use hulkgen_mcap::{Description, Metadata, Writer, split_messages};

/// How often the writer looks for blocks: their memory must last so long.
const LOOK: Duration = Duration::from_millis(5);

/// After so many bytes of messages the writer rests, as long as it took for them and no longer than [`LOOK`]. Working on, it
/// would have its core for whole turns of the system's scheduler, 4 ms, longer than the cycle of a camera that waits for it.
const PIECE: usize = 512 << 10;

/// Sizes of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Bytes of chunks that the file keeps; more, and the oldest go.
    pub budget: u64,
    /// How many blocks there are, for all tracks together.
    pub blocks: usize,
    /// Bytes of one block: no frame is larger, but for what it leaves to the writer.
    pub block_bytes: usize,
    /// How many values cyclers may leave to the writer at a time ([`Writing::leave`](crate::Writing::leave)).
    pub late: usize,
    /// Bytes from which on a chunk is closed, not compressed.
    pub chunk_bytes: usize,
    /// How long frames stay in memory, about: by the cycles' own time while their instance has cycles, recorded or not, else by
    /// the clock on the wall.
    pub longest: Duration,
}

/// A recording on its way to the disk.
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    counts: Vec<(String, Arc<Counts>)>,
    is_ending: Arc<AtomicBool>,
    /// What else is said at the end.
    last: Arc<Mutex<Vec<Metadata>>>,
    thread: Option<JoinHandle<Option<io::Error>>>,
}

/// How a recording ended.
#[derive(Debug)]
pub struct Ended {
    pub path: PathBuf,
    /// Whether every frame is in the file, or was until the ring closed over it.
    pub is_complete: bool,
    /// What the disk said first.
    pub error: Option<io::Error>,
    /// The disk had not taken all of it when it was no longer waited for: how much it has, nobody knows.
    pub is_outstanding: bool,
}

impl Default for Settings {
    /// 64 blocks of 1 MiB, 32 values beside them, chunks of 4 MiB, a ring of 2 GiB.
    fn default() -> Self {
        Self {
            budget: 2 << 30,
            blocks: 64,
            block_bytes: 1 << 20,
            late: 32,
            chunk_bytes: 4 << 20,
            longest: Duration::from_secs(1),
        }
    }
}

impl Recorder {
    /// Creates the file, which must not exist, and a track for each of these instances.
    pub fn start(
        path: &Path,
        description: Description,
        instances: &[&str],
        settings: Settings,
    ) -> io::Result<(Self, Vec<Track>)> {
        Self::start_rewriting(path, description, instances, settings, Rewrites::new())
    }

    /// As [`start`](Self::start), with channels whose messages become others before they are written.
    pub fn start_rewriting(
        path: &Path,
        description: Description,
        instances: &[&str],
        settings: Settings,
        rewrites: Rewrites,
    ) -> io::Result<(Self, Vec<Track>)> {
        let writer = Writer::create(path, description, settings.budget)?;
        Self::start_writing(path, writer, instances, settings, rewrites)
    }

    /// As [`start_rewriting`](Self::start_rewriting), with a writer that has begun, and the path of what it writes.
    pub fn start_writing(
        path: &Path,
        writer: Writer,
        instances: &[&str],
        settings: Settings,
        rewrites: Rewrites,
    ) -> io::Result<(Self, Vec<Track>)> {
        let Settings {
            blocks,
            block_bytes,
            late,
            ..
        } = settings;
        let pool = Arc::new(Pool::new(blocks, block_bytes, late));
        let counts: Vec<_> = instances
            .iter()
            .map(|instance| ((*instance).to_owned(), Arc::<Counts>::default()))
            .collect();
        let begun: Vec<_> = counts.iter().map(|_| Begun::new()).collect();
        let tracks = counts.iter().zip(&begun).enumerate();
        let tracks = tracks.map(|(index, ((_, counts), begun))| {
            let place = begun.place.clone();
            Track::new(pool.clone(), counts.clone(), index, place, settings.longest)
        });
        let tracks = tracks.collect();
        let is_ending = Arc::new(AtomicBool::new(false));
        let last = Arc::<Mutex<Vec<Metadata>>>::default();
        let thread = Thread {
            writer,
            pool,
            settings,
            counts: counts.clone(),
            begun,
            is_ending: is_ending.clone(),
            last: last.clone(),
            open: Frames::new(),
            kept: VecDeque::new(),
            rewrites,
            whole: Vec::new(),
            rewritten: Vec::new(),
            since: Instant::now(),
            error: None,
        };
        let thread = std::thread::Builder::new()
            .name("recording".to_owned())
            .spawn(move || thread.run())?;
        let recorder = Self {
            path: path.to_owned(),
            counts,
            is_ending,
            last,
            thread: Some(thread),
        };
        Ok((recorder, tracks))
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What became of each instance's frames so far, to be read whenever somebody likes.
    pub fn counts(&self) -> impl Iterator<Item = (&str, &Arc<Counts>)> {
        self.counts
            .iter()
            .map(|(instance, counts)| (instance.as_str(), counts))
    }

    /// Writes what was handed over and ends the file. Tracks that are dropped before have handed over everything.
    pub fn end(self) -> Ended {
        self.end_with(Vec::new())
    }

    /// As [`end`](Self::end), with more to say there.
    pub fn end_with(mut self, metadata: Vec<Metadata>) -> Ended {
        self.say_last(metadata);
        let error = self.join();
        self.ended(error, false)
    }

    /// As [`end_with`](Self::end_with), but waits for the disk only as long as it is told to go on, which it asks again and again.
    pub fn end_while(
        mut self,
        metadata: Vec<Metadata>,
        mut goes_on: impl FnMut() -> bool,
    ) -> Ended {
        self.say_last(metadata);
        while self.thread.as_ref().is_some_and(|it| !it.is_finished()) {
            if !goes_on() {
                // Nobody can end a thread that waits for its disk: it goes on alone.
                drop(self.thread.take());
                return self.ended(None, true);
            }
            std::thread::sleep(LOOK);
        }
        let error = self.join();
        self.ended(error, false)
    }

    fn say_last(&self, metadata: Vec<Metadata>) {
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = metadata;
        // Release: the writer sees all blocks that this thread saw handed over.
        self.is_ending.store(true, Ordering::Release);
    }

    fn ended(&self, error: Option<io::Error>, is_outstanding: bool) -> Ended {
        let is_whole = self.counts.iter().all(|(_, counts)| counts.is_complete());
        Ended {
            path: self.path.clone(),
            is_complete: error.is_none() && is_whole && !is_outstanding,
            error,
            is_outstanding,
        }
    }

    fn join(&mut self) -> Option<io::Error> {
        self.is_ending.store(true, Ordering::Release);
        let thread = self.thread.take()?;
        thread
            .join()
            .unwrap_or_else(|_| Some(io::Error::other("the thread of the recording panicked")))
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.join();
    }
}

/// How many frames of which track, by its place.
type Frames = Vec<(usize, u64)>;

/// The block that a track has begun.
struct Begun {
    place: Arc<Place>,
    /// Frames of the track, when they were counted last.
    recorded: u64,
    /// When that number was another one.
    since: Instant,
}

impl Begun {
    fn new() -> Self {
        Self {
            place: Arc::default(),
            recorded: 0,
            since: Instant::now(),
        }
    }

    /// The block, if the track has had no frame for so long: its instance waits, or its cycle hangs.
    fn take_left(&mut self, recorded: u64, longest: Duration) -> Option<Block> {
        if self.recorded != recorded {
            (self.recorded, self.since) = (recorded, Instant::now());
        }
        let is_left = self.since.elapsed() >= longest;
        is_left.then(|| self.place.take()).flatten()
    }
}

struct Thread {
    writer: Writer,
    pool: Arc<Pool>,
    settings: Settings,
    counts: Vec<(String, Arc<Counts>)>,
    /// Of each track.
    begun: Vec<Begun>,
    is_ending: Arc<AtomicBool>,
    last: Arc<Mutex<Vec<Metadata>>>,
    /// Tracks and frames in the chunk that is open.
    open: Frames,
    /// Those of the chunks that the file has, oldest first.
    kept: VecDeque<Frames>,
    rewrites: Rewrites,
    /// The messages of a block with the values that it left to the writer.
    whole: Vec<u8>,
    /// The messages of a block that became others.
    rewritten: Vec<u8>,
    /// When the chunk that is open got its first block.
    since: Instant,
    error: Option<io::Error>,
}

impl Thread {
    fn run(mut self) -> Option<io::Error> {
        loop {
            // Acquire, and before the blocks: what was handed over before the end is found.
            let is_ending = self.is_ending.load(Ordering::Acquire);
            let is_idle = !self.take_blocks(self.settings.longest);
            let is_old = !self.open.is_empty() && self.since.elapsed() >= self.settings.longest;
            if is_ending {
                // What tracks that still live have begun; what they begin from here on is nobody's.
                for _ in 0..self.begun.len() {
                    self.take_blocks(Duration::ZERO);
                }
            }
            if is_old || is_ending {
                self.close_chunk();
            }
            if is_ending {
                break;
            }
            if is_idle {
                std::thread::sleep(LOOK);
            }
        }
        self.finish()
    }

    /// Whether there were any, with that of a track that has had no frame for so long and did not hand it over.
    fn take_blocks(&mut self, longest: Duration) -> bool {
        let mut begun = self.begun.iter_mut().zip(&self.counts);
        let mut left =
            begun.find_map(|(begun, (_, counts))| begun.take_left(counts.recorded(), longest));
        let mut is_any = left.is_some();
        // No more than there are: whoever hands over while others are written is looked at again soon.
        for _ in 0..self.pool.full() {
            let Some(block) = self.pool.take_full() else {
                break;
            };
            is_any = true;
            // What the track handed over before it is here, and what it did since may be.
            if let Some(left) = left.take_if(|left| left.is_before(&block)) {
                self.add(left);
            }
            self.add(block);
        }
        if let Some(left) = left {
            self.add(left);
        }
        is_any
    }

    fn add(&mut self, block: Block) {
        if self.open.is_empty() {
            self.since = Instant::now();
        }
        let (messages, mut frames) = block.whole(&mut self.whole);
        let messages = match self.rewrites.is_empty() {
            true => messages,
            false => {
                let lost = rewritten(messages, &self.rewrites, &mut self.rewritten);
                frames = frames.saturating_sub(lost);
                &self.rewritten
            }
        };
        // Relaxed: whether it is the end in earnest, the loop asks.
        let is_hurried = || self.pool.is_short() || self.is_ending.load(Ordering::Relaxed);
        write(&mut self.writer, messages, is_hurried);
        // Of nothing no chunk is made.
        if !messages.is_empty() {
            self.open.push((block.track, frames));
        }
        // Of a value without bytes also what stands behind, which may refer to what is not there.
        if frames < block.frames {
            self.count(&[(block.track, block.frames - frames)], |counts| {
                &counts.lost
            });
        }
        self.pool.give_back(block);
        if self.writer.open_bytes() >= self.settings.chunk_bytes {
            self.close_chunk();
        }
    }

    /// A disk that takes no chunk now may take the next one.
    fn close_chunk(&mut self) {
        let open = std::mem::take(&mut self.open);
        match self.writer.close_chunk() {
            Ok(()) if open.is_empty() => {}
            Ok(()) => self.kept.push_back(open),
            Err(error) => {
                self.count(&open, |counts| &counts.lost);
                self.error.get_or_insert(error);
            }
        }
        let kept = self.writer.kept_chunks();
        overwritten(&mut self.kept, kept, &self.counts);
    }

    fn count(&self, frames: &[(usize, u64)], as_what: impl Fn(&Counts) -> &AtomicU64) {
        count(&self.counts, frames, as_what);
    }

    fn finish(self) -> Option<io::Error> {
        let Self {
            writer,
            counts,
            last,
            mut kept,
            error,
            ..
        } = self;
        let said = std::mem::take(&mut *last.lock().unwrap_or_else(PoisonError::into_inner));
        let ended = writer.finish_saying(|chunks| {
            overwritten(&mut kept, chunks, &counts);
            let mut said = said.clone();
            said.push(end(&counts, error.is_some()));
            said
        });
        error.or(ended.err())
    }
}

/// Adds messages, with rests as long as nobody is in a hurry.
fn write(writer: &mut Writer, mut messages: &[u8], is_hurried: impl Fn() -> bool) {
    while !messages.is_empty() {
        let begun = Instant::now();
        let (piece, others) = split_messages(messages, PIECE);
        writer.add(piece);
        messages = others;
        if piece.len() >= PIECE && !is_hurried() {
            std::thread::sleep(begun.elapsed().min(LOOK));
        }
    }
}

/// How the run ended.
fn end(counts: &[(String, Arc<Counts>)], is_error: bool) -> Metadata {
    let is_whole = counts.iter().all(|(_, counts)| counts.is_complete());
    let state = match is_whole && !is_error {
        true => "COMPLETE",
        false => "INCOMPLETE",
    };
    let mut entries = vec![("state".to_owned(), state.to_owned())];
    for (instance, counts) in counts {
        let mut entry = |what: &str, count: u64| {
            entries.push((format!("{instance}.{what}"), count.to_string()));
        };
        entry("recorded", counts.recorded());
        entry("dropped", counts.dropped());
        entry("failed", counts.failed());
        entry("lost", counts.lost());
        entry("overwritten", counts.overwritten());
    }
    Metadata {
        name: "end".to_owned(),
        entries,
    }
}

/// Counts the frames of chunks that the file has no longer.
fn overwritten(kept: &mut VecDeque<Frames>, chunks: usize, counts: &[(String, Arc<Counts>)]) {
    while kept.len() > chunks {
        let gone = kept.pop_front().unwrap_or_default();
        count(counts, &gone, |counts| &counts.overwritten);
    }
}

fn count(
    of: &[(String, Arc<Counts>)],
    frames: &[(usize, u64)],
    as_what: impl Fn(&Counts) -> &AtomicU64,
) {
    for (track, frames) in frames {
        if let Some((_, counts)) = of.get(*track) {
            as_what(counts).fetch_add(*frames, Ordering::Relaxed);
        }
    }
}
