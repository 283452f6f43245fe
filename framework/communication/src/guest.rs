//! One connection, as its socket and the one who serves it share it: whether it may stay, and how much of it may be held.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use crate::limits::Limits;

/// A connection. Clones are of the same one; only the server's thread uses them.
#[derive(Clone, Debug)]
pub(crate) struct Guest(Arc<State>);

#[derive(Debug)]
struct State {
    stays: AtomicBool,
    is_dismissed: AtomicBool,
    may_change: AtomicBool,
    /// Bytes of what it says that is not whole: what it announced, for which there is room already.
    held: AtomicUsize,
    refusal: Mutex<Option<&'static str>>,
    /// When it said something last, of a message that is not whole, too.
    said: Mutex<Instant>,
    /// When it took bytes last.
    took: Mutex<Instant>,
    room: Arc<Room>,
}

/// Where messages are that are not whole.
#[derive(Debug)]
pub(crate) struct Room {
    /// Bytes of one message.
    whole: usize,
    /// Bytes that each connection may have.
    alone: usize,
    /// Bytes beyond these, of all connections.
    together: usize,
    /// How many of the latter there are.
    taken: AtomicUsize,
    /// What whoever may change nothing is told of what is longer than `alone`.
    refusal: &'static str,
}

impl Room {
    pub(crate) fn new(limits: &Limits, is_read_only: bool) -> Arc<Self> {
        Arc::new(Self {
            refusal: match is_read_only {
                true => "too long a message to a robot that may only be read",
                false => {
                    "too long a message of a client that may change nothing: authenticate first"
                }
            },
            whole: limits.message_bytes,
            alone: limits.stranger_bytes,
            together: limits.arriving_bytes,
            taken: AtomicUsize::new(0),
        })
    }

    fn beyond(&self, bytes: usize) -> usize {
        bytes.saturating_sub(self.alone)
    }
}

impl Guest {
    pub(crate) fn new(room: Arc<Room>) -> Self {
        Self(Arc::new(State {
            stays: AtomicBool::new(false),
            is_dismissed: AtomicBool::new(false),
            may_change: AtomicBool::new(false),
            held: AtomicUsize::new(0),
            refusal: Mutex::default(),
            said: Mutex::new(Instant::now()),
            took: Mutex::new(Instant::now()),
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

    /// It was told why it has to go.
    pub(crate) fn dismiss(&self) {
        self.0.is_dismissed.store(true, Relaxed);
    }

    pub(crate) fn is_dismissed(&self) -> bool {
        self.0.is_dismissed.load(Relaxed)
    }

    /// Whether it may change anything, and so has a reason for long messages.
    pub(crate) fn may_change(&self, may: bool) {
        self.0.may_change.store(may, Relaxed);
    }

    /// Whether so much may be held of it. What it said in front of this was heard.
    pub(crate) fn fits(&self, bytes: usize) -> Result<(), &'static str> {
        let State { held, room, .. } = &*self.0;
        let others = room.taken.load(Relaxed) - room.beyond(held.load(Relaxed));
        let beyond = room.beyond(bytes);
        if beyond > 0 && !self.0.may_change.load(Relaxed) {
            return Err(room.refusal);
        }
        if bytes > room.whole {
            return Err("too long a message");
        }
        if beyond > 0 && others.saturating_add(beyond) > room.together {
            return Err("too many long messages at a time: say it again later");
        }
        Ok(())
    }

    /// So much is held of it from now on.
    pub(crate) fn hold(&self, bytes: usize) {
        self.0.hold(bytes);
    }

    pub(crate) fn refuse(&self, why: &'static str) {
        *locked(&self.0.refusal) = Some(why);
    }

    /// It says something now.
    pub(crate) fn say(&self) {
        *locked(&self.0.said) = Instant::now();
    }

    /// When it said something last.
    pub(crate) fn said(&self) -> Instant {
        *locked(&self.0.said)
    }

    /// It takes bytes now.
    pub(crate) fn take(&self) {
        *locked(&self.0.took) = Instant::now();
    }

    /// When it took bytes last.
    pub(crate) fn took(&self) -> Instant {
        *locked(&self.0.took)
    }

    /// Why it was refused.
    pub(crate) fn refusal(&self) -> Option<&'static str> {
        *locked(&self.0.refusal)
    }
}

impl State {
    fn hold(&self, bytes: usize) {
        let room = &self.room;
        let before = self.held.swap(bytes, Relaxed);
        let taken = room.taken.load(Relaxed) - room.beyond(before) + room.beyond(bytes);
        room.taken.store(taken, Relaxed);
    }
}

fn locked<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Drop for State {
    fn drop(&mut self) {
        self.hold(0);
    }
}
