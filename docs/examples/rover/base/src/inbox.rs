//! What came from the controller and no node has read yet: the newest scan, and all that the wheels rolled.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use framework::{NoEvent, Result, Stop, Timestamp, blocking};
use rover_nodes::types::Rolled;

use crate::line::Line;

/// A stop is noticed after at most this time.
const MOMENT: Duration = Duration::from_millis(50);

/// Who waits longer for a line hears why none comes.
const SILENCE: Duration = Duration::from_secs(1);

/// Between the thread of the connection and the nodes.
#[derive(Debug)]
pub(crate) struct Inbox {
    content: Mutex<Content>,
    changed: Condvar,
}

#[derive(Debug)]
struct Content {
    scan: Option<(Timestamp, Vec<f32>)>,
    wheels: Option<(Timestamp, Rolled)>,
    /// Why nothing comes.
    trouble: String,
}

impl Inbox {
    pub(crate) fn new() -> Self {
        Self {
            content: Mutex::new(Content {
                scan: None,
                wheels: None,
                trouble: "the base has not answered yet".to_owned(),
            }),
            changed: Condvar::new(),
        }
    }

    /// Wheels that nobody read roll on: none of it is lost.
    pub(crate) fn put(&self, at: Timestamp, line: Line) {
        let mut content = self.lock();
        match line {
            Line::Scan(ranges) => content.scan = Some((at, ranges)),
            Line::Wheels(rolled) => {
                let before = content
                    .wheels
                    .map_or(Rolled::default(), |(_, rolled)| rolled);
                let sum = Rolled {
                    left: before.left + rolled.left,
                    right: before.right + rolled.right,
                };
                content.wheels = Some((at, sum));
            }
        }
        self.changed.notify_all();
    }

    pub(crate) fn tell_trouble(&self, trouble: String) {
        self.lock().trouble = trouble;
    }

    pub(crate) fn wait_for_scan(&self, stop: &Stop) -> Result<(Timestamp, Vec<f32>)> {
        self.wait_for(stop, |content| content.scan.take())
    }

    pub(crate) fn wait_for_wheels(&self, stop: &Stop) -> Result<(Timestamp, Rolled)> {
        self.wait_for(stop, |content| content.wheels.take())
    }

    /// `NoEvent` after a second without: the node is called again.
    fn wait_for<T>(&self, stop: &Stop, take: impl Fn(&mut Content) -> Option<T>) -> Result<T> {
        blocking(|| {
            let begin = Instant::now();
            let mut content = self.lock();
            loop {
                stop.check()?;
                if let Some(taken) = take(&mut content) {
                    return Ok(taken);
                }
                if begin.elapsed() > SILENCE {
                    return Err(NoEvent(content.trouble.clone()).into());
                }
                let waited = self.changed.wait_timeout(content, MOMENT);
                content = waited.unwrap_or_else(PoisonError::into_inner).0;
            }
        })
    }

    /// Nothing behind the lock can be half done.
    fn lock(&self) -> MutexGuard<'_, Content> {
        self.content.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
