//! One connection, as its socket and the one who serves it share it: whether it may stay, and how much of it may be held.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

use crate::limits::Limits;

/// Bytes of a client's frame before what it says: two, and the mask.
const FRAME_HEAD: usize = 6;

/// A connection. Clones are of the same one; only the server's thread uses them.
#[derive(Clone, Debug)]
pub(crate) struct Guest(Arc<State>);

#[derive(Debug)]
struct State {
    stays: AtomicBool,
    may_change: AtomicBool,
    /// Bytes that came since its last whole message.
    held: AtomicUsize,
    is_refused: AtomicBool,
    room: Arc<Room>,
}

/// Where messages are that are not whole.
#[derive(Debug)]
pub(crate) struct Room {
    /// Bytes that each connection may have.
    alone: usize,
    /// Bytes beyond these, of all connections.
    together: usize,
    /// How many of the latter there are.
    taken: AtomicUsize,
}

impl Room {
    pub(crate) fn new(limits: &Limits) -> Arc<Self> {
        Arc::new(Self {
            alone: limits.stranger_bytes,
            together: limits.arriving_bytes,
            taken: AtomicUsize::new(0),
        })
    }
}

impl Guest {
    pub(crate) fn new(room: Arc<Room>) -> Self {
        Self(Arc::new(State {
            stays: AtomicBool::new(false),
            may_change: AtomicBool::new(false),
            held: AtomicUsize::new(0),
            is_refused: AtomicBool::new(false),
            room,
        }))
    }

    /// It has become a WebSocket: from now on it has no deadline.
    pub(crate) fn stay(&self) {
        self.0.stays.store(true, Relaxed);
    }

    pub(crate) fn is_staying(&self) -> bool {
        self.0.stays.load(Relaxed)
    }

    /// Whether it may change anything, and so has a reason for long messages.
    pub(crate) fn may_change(&self, may: bool) {
        self.0.may_change.store(may, Relaxed);
    }

    /// How many bytes may come now. With none it is refused: what it says is longer than that.
    pub(crate) fn may_come(&self) -> usize {
        let State { held, room, .. } = &*self.0;
        let alone = room.alone.saturating_sub(held.load(Relaxed));
        let together = match self.0.may_change.load(Relaxed) {
            true => room.together.saturating_sub(room.taken.load(Relaxed)),
            false => 0,
        };
        let all = alone.saturating_add(together);
        self.0.is_refused.fetch_or(all == 0, Relaxed);
        all
    }

    pub(crate) fn came(&self, bytes: usize) {
        self.0.hold(self.0.held.load(Relaxed).saturating_add(bytes));
    }

    /// A message is whole, and no longer here.
    pub(crate) fn is_heard(&self) {
        self.0.hold(0);
    }

    /// As [`is_heard`](Self::is_heard), of a sign of life, which may come amid a message.
    pub(crate) fn is_alive(&self, bytes: usize) {
        let held = self.0.held.load(Relaxed);
        self.0.hold(held.saturating_sub(bytes + FRAME_HEAD));
    }

    /// Why it was refused.
    pub(crate) fn refusal(&self) -> Option<&'static str> {
        let is_refused = self.0.is_refused.load(Relaxed);
        is_refused.then(|| match self.0.may_change.load(Relaxed) {
            true => "too many long messages at a time: say it again later",
            false => "too long a message of a client that may change nothing: authenticate first",
        })
    }
}

impl State {
    fn hold(&self, bytes: usize) {
        let beyond = |bytes: usize| bytes.saturating_sub(self.room.alone);
        let before = self.held.swap(bytes, Relaxed);
        let taken = self.room.taken.load(Relaxed) - beyond(before) + beyond(bytes);
        self.room.taken.store(taken, Relaxed);
    }
}

impl Drop for State {
    fn drop(&mut self) {
        self.hold(0);
    }
}
