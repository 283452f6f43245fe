//! What a replay has said: messages of the recording once more, and what nodes say whose cycles run again.

use std::cell::RefCell;

use super::{Level, ROBOT, Record, sinks_for};
use crate::time::Timestamp;

thread_local! {
    static AGAIN: RefCell<Option<Again>> = const { RefCell::new(None) };
}

/// How a cycle that runs again is heard.
#[derive(Clone, Debug)]
pub(crate) enum Again {
    /// Not at all: it was heard before.
    Silent,
    /// As if it were this time, apart from what the recording has of the cycle.
    Apart { at: Timestamp, known: Vec<Record> },
}

/// Until it is dropped, what its thread says is said by a cycle that runs again.
pub(crate) struct Replayed(());

impl Drop for Replayed {
    fn drop(&mut self) {
        AGAIN.set(None);
    }
}

/// From now on the thread runs such a cycle.
#[must_use]
pub(crate) fn again(how: Again) -> Replayed {
    AGAIN.set(Some(how));
    Replayed(())
}

/// Says a message of a recording to everybody who wants it.
pub(crate) fn say_again(record: &Record) {
    let instance = record.instance.as_deref();
    for sink in sinks_for(record.level, &record.module, instance, ROBOT.get()) {
        sink.keep(Record {
            heard: sink.clock.passed(),
            ..record.clone()
        });
    }
}

/// Whether nobody is to hear this thread.
pub(super) fn is_silent() -> bool {
    AGAIN.with_borrow(|again| matches!(again, Some(Again::Silent)))
}

/// Whether the recording has this message, which is said as it has it.
pub(super) fn is_known(level: Level, module: &str, message: &str) -> bool {
    let is_it =
        |known: &Record| (known.level, &*known.module, &*known.message) == (level, module, message);
    AGAIN.with_borrow(|again| match again {
        Some(Again::Apart { known, .. }) => known.iter().any(is_it),
        Some(Again::Silent) | None => false,
    })
}

/// The time of a message, if it is not the time at which it is heard.
pub(super) fn time() -> Option<Timestamp> {
    AGAIN.with_borrow(|again| match again {
        Some(Again::Apart { at, .. }) => Some(*at),
        Some(Again::Silent) | None => None,
    })
}
