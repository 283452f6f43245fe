//! Threads that do not end: neither a node that never returns nor hardware may keep the process for good.

use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use crate::report::tell;

/// After the stop: hardware comes down and blocked calls return within 0.1 s, and no cycle is meant to take a second.
const PATIENCE: Duration = Duration::from_secs(10);

/// Between two looks.
const GLANCE: Duration = Duration::from_millis(2);

/// What is done about them.
#[derive(Default)]
pub(super) struct Overdue<'robot> {
    give_up: Option<&'robot (dyn Fn() + Sync)>,
}

/// Threads, by name.
#[derive(Default)]
pub(super) struct Running<'scope>(Vec<(&'static str, ScopedJoinHandle<'scope, ()>)>);

impl<'scope> Running<'scope> {
    pub(super) fn add(&mut self, name: &'static str, thread: ScopedJoinHandle<'scope, ()>) {
        self.0.push((name, thread));
    }

    fn left(&self) -> impl Iterator<Item = &'static str> {
        let left = self.0.iter().filter(|(_, thread)| !thread.is_finished());
        left.map(|(name, _)| *name)
    }
}

impl<'robot> Overdue<'robot> {
    pub(super) fn then(give_up: &'robot (dyn Fn() + Sync)) -> Self {
        Self {
            give_up: Some(give_up),
        }
    }

    /// Waits for their end, or gives up; `why` they do not end.
    pub(super) fn await_end(&self, running: &Running<'_>, why: &str) {
        let begun = Instant::now();
        while running.left().next().is_some() {
            if begun.elapsed() > PATIENCE {
                let names: Vec<_> = running.left().collect();
                tell(format_args!(
                    "{} did not end within {PATIENCE:?} of the stop: {why}",
                    names.join(", ")
                ));
                if let Some(give_up) = self.give_up {
                    give_up();
                }
                return;
            }
            thread::sleep(GLANCE);
        }
    }
}
