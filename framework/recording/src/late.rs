//! Values that the writer's thread writes: what a cycler has a handle of, it need not copy.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A value that does not change while anybody has a handle of it.
pub trait Late: Send + Sync {
    /// Appends its bytes, the same each time; false: it has none, and what was appended is forgotten. On the writer's thread, which
    /// a panic would end.
    fn write(&self, bytes: &mut Vec<u8>) -> bool;

    /// A recording has a handle of it from now on.
    fn keep(&self) {}

    /// It has this one no more.
    fn let_go(self: Arc<Self>) {}
}

/// A handle that the recording has; nothing, once it is let go.
struct Kept(Option<Arc<dyn Late>>);

/// A value among the bytes of a block.
#[derive(Debug)]
struct Part {
    /// How many of the bytes stand before it; until [`Parts::place`], of its message's data.
    at: usize,
    place: Place,
    value: Kept,
}

/// To what a value belongs, by places in the bytes of the block.
#[derive(Clone, Copy, Debug)]
struct Place {
    message: usize,
    frame: usize,
    /// How many frames stand before.
    frames: u64,
}

/// Behind everything, as long as its message is not whole.
const NOWHERE: Place = Place {
    message: usize::MAX,
    frame: usize::MAX,
    frames: u64::MAX,
};

/// What a block left to the writer, in order of place.
#[derive(Debug)]
pub(crate) struct Parts {
    parts: Vec<Part>,
    room: Arc<Room>,
}

/// How many more values a recording takes; what has none is copied, and nobody's pool of values runs dry for a slow disk.
#[derive(Debug)]
pub(crate) struct Room(AtomicUsize);

/// With so many a block goes to the writer behind the end of its frame, or before the next one: they are not held for long, and
/// the writer gets no large pieces. One frame may have more.
const LADEN: usize = 4;

impl Room {
    pub(crate) fn of(values: usize) -> Self {
        Self(AtomicUsize::new(values))
    }

    /// Relaxed: a count, with which no other memory comes.
    fn take(&self) -> bool {
        let take = |left: usize| left.checked_sub(1);
        self.0
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, take)
            .is_ok()
    }

    fn left(&self) -> usize {
        self.0.load(Ordering::Relaxed)
    }

    fn give_back(&self, values: usize) {
        self.0.fetch_add(values, Ordering::Relaxed);
    }
}

impl Kept {
    fn new(value: Arc<dyn Late>) -> Self {
        value.keep();
        Self(Some(value))
    }

    fn write(&self, bytes: &mut Vec<u8>) -> bool {
        self.0.as_ref().is_some_and(|value| value.write(bytes))
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        if let Some(value) = self.0.take() {
            value.let_go();
        }
    }
}

impl fmt::Debug for Kept {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("Kept")
    }
}

impl Parts {
    pub(crate) fn new(room: Arc<Room>) -> Self {
        Self {
            // All that the recording takes may be of one frame.
            parts: Vec::with_capacity(room.left()),
            room,
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.parts.len()
    }

    pub(crate) fn is_laden(&self) -> bool {
        self.count() >= LADEN
    }

    /// At this place of the message that is being written; false: there is no room.
    pub(crate) fn add(&mut self, at: usize, value: Arc<dyn Late>) -> bool {
        if !self.room.take() {
            return false;
        }
        self.parts.push(Part {
            at,
            place: NOWHERE,
            value: Kept::new(value),
        });
        true
    }

    /// Those behind the first so many are of the message that begins here and has its data behind `head` bytes.
    pub(crate) fn place(
        &mut self,
        first: usize,
        (message, head): (usize, usize),
        (frame, frames): (usize, u64),
    ) {
        for part in &mut self.parts[first..] {
            part.at += message + head;
            part.place = Place {
                message,
                frame,
                frames,
            };
        }
    }

    /// Keeps the first so many.
    pub(crate) fn truncate(&mut self, count: usize) {
        let gone = self.count().saturating_sub(count);
        // Most blocks have none.
        if gone > 0 {
            self.parts.truncate(count);
            self.room.give_back(gone);
        }
    }

    /// Keeps those whose messages begin before this place.
    pub(crate) fn truncate_to(&mut self, place: usize) {
        let kept = self
            .parts
            .partition_point(|part| part.place.message < place);
        self.truncate(kept);
    }

    /// These messages with all values at their places, up to the frame that has one without bytes; how many frames stand before
    /// it, `None` where there is no such frame. `length_at` is where a message has its length, in 8 bytes.
    pub(crate) fn write(
        &self,
        messages: &[u8],
        length_at: usize,
        into: &mut Vec<u8>,
    ) -> Option<u64> {
        into.clear();
        let mut done = 0;
        // What it belongs to, and where both begin in what is written.
        let (mut last, mut begun) = (NOWHERE, NOWHERE);
        for Part { at, place, value } in &self.parts {
            into.extend_from_slice(messages.get(done..*at).unwrap_or_default());
            // Between messages of one frame and between frames nothing was added: it is as far from here as in the block.
            let here = |place: usize| (into.len() + place).saturating_sub(*at);
            if place.message != last.message {
                begun.message = here(place.message);
            }
            if place.frame != last.frame {
                begun.frame = here(place.frame);
            }
            (done, last) = (*at, *place);
            let before = into.len();
            if !value.write(into) {
                into.truncate(begun.frame);
                return Some(place.frames);
            }
            let more = into.len() - before;
            lengthen(into, begun.message + length_at, more);
        }
        into.extend_from_slice(messages.get(done..).unwrap_or_default());
        None
    }
}

/// Adds to a number of 8 bytes that stands there.
fn lengthen(bytes: &mut [u8], at: usize, more: usize) {
    if let Some(length) = bytes.get_mut(at..).and_then(<[u8]>::first_chunk_mut) {
        *length = (u64::from_le_bytes(*length) + more as u64).to_le_bytes();
    }
}

impl Drop for Parts {
    fn drop(&mut self) {
        self.truncate(0);
    }
}
