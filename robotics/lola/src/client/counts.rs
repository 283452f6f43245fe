//! Owns what a client counts.

use std::sync::atomic::{AtomicU64, Ordering};

/// What happened on a connection to LoLA since the start.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Counts {
    /// Connections that were made.
    pub connections: u64,
    /// States that were read.
    pub states: u64,
    /// Packets that were no state.
    pub rejected: u64,
    /// Commands that reached the socket.
    pub commands: u64,
    /// Commands that did not.
    pub lost_commands: u64,
}

#[derive(Debug, Default)]
pub(super) struct Counters {
    connections: AtomicU64,
    states: AtomicU64,
    rejected: AtomicU64,
    commands: AtomicU64,
    lost_commands: AtomicU64,
}

impl Counters {
    pub(super) fn count_connection(&self) {
        increment(&self.connections);
    }

    pub(super) fn count_state(&self) {
        increment(&self.states);
    }

    pub(super) fn count_rejected(&self) {
        increment(&self.rejected);
    }

    pub(super) fn count_command(&self) {
        increment(&self.commands);
    }

    pub(super) fn count_lost_command(&self) {
        increment(&self.lost_commands);
    }

    pub(super) fn counts(&self) -> Counts {
        Counts {
            connections: self.connections.load(Ordering::Relaxed),
            states: self.states.load(Ordering::Relaxed),
            rejected: self.rejected.load(Ordering::Relaxed),
            commands: self.commands.load(Ordering::Relaxed),
            lost_commands: self.lost_commands.load(Ordering::Relaxed),
        }
    }
}

fn increment(counter: &AtomicU64) {
    counter.fetch_add(1, Ordering::Relaxed);
}
