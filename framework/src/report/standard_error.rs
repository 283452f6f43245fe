//! Standard error, which may take nothing for as long as it likes: Ctrl-S in a terminal, a pipe that nobody reads.
//!
//! Invariant: once it is kept from the robot, nobody who tells something waits for it. What finds no place meanwhile is left out
//! and counted.

use std::fmt;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::{self, Thread};
use std::time::{Duration, Instant};

use crossbeam_queue::ArrayQueue;

use super::plural;

/// Texts that wait. Nobody tells so many at once while a robot runs.
const WAITING: usize = 1024;

/// Whoever reads at all has read within this time.
const PATIENCE: Duration = Duration::from_secs(2);

/// Between two looks at what is written.
const GLANCE: Duration = Duration::from_millis(1);

/// Whether what is told belongs to a test.
static IN_TEST: AtomicBool = AtomicBool::new(false);

/// Who writes for the process; nobody, until a robot runs.
static WRITER: OnceLock<Writer> = OnceLock::new();

/// From here on what is told is kept with the output of the test whose thread tells it, or began the one that does: failures
/// that tests provoke do not hide the one that was not expected.
pub(crate) fn tell_test() {
    IN_TEST.store(true, Ordering::Relaxed);
}

/// From here to the end of the process a thread of its own writes what is told: a robot must not wait for who watches it.
pub(crate) fn keep_from_robot() -> io::Result<()> {
    if WRITER.get().is_none() {
        let writer = Writer::start()?;
        // Of two at once one has nothing to write, ever.
        let _ = WRITER.set(writer);
    }
    Ok(())
}

/// Tells whoever watches standard error, in one piece; if nobody can read it, the robot goes on.
pub(crate) fn tell(message: fmt::Arguments<'_>) {
    let text = format!("{message}\n");
    if IN_TEST.load(Ordering::Relaxed) {
        // What the harness collects; it would panic where nobody can read it.
        eprint!("{text}");
        return;
    }
    match WRITER.get() {
        Some(writer) => {
            writer.queue.push(text);
            writer.thread.unpark();
        }
        None => write(&text),
    }
}

/// Waits for a moment until what was told is written: before the process ends, and before data that people read behind it.
pub(crate) fn flush() {
    if let Some(writer) = WRITER.get() {
        writer.queue.await_written(PATIENCE);
    }
}

fn write(text: &str) {
    // Nobody can be told that nobody can be told.
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

struct Writer {
    queue: Arc<Queue>,
    thread: Thread,
}

impl Writer {
    fn start() -> io::Result<Self> {
        let queue = Arc::new(Queue::new(WAITING));
        let of_thread = Arc::clone(&queue);
        let thread = thread::Builder::new().name("standard error".to_owned());
        let thread = thread.spawn(move || {
            loop {
                of_thread.write_all(write);
                thread::park();
            }
        })?;
        Ok(Self {
            queue,
            thread: thread.thread().clone(),
        })
    }
}

/// What is told and not written yet.
struct Queue {
    texts: ArrayQueue<String>,
    /// Lines that found no place, of which nobody was told yet.
    left_out: AtomicU64,
    /// Texts, with those that were left out.
    told: AtomicU64,
    /// Texts that are no longer waited for.
    done: AtomicU64,
    /// How many were done when somebody had waited in vain: one more and it is worth waiting again.
    stuck_at: AtomicU64,
}

impl Queue {
    fn new(places: usize) -> Self {
        Self {
            texts: ArrayQueue::new(places),
            left_out: AtomicU64::new(0),
            told: AtomicU64::new(0),
            done: AtomicU64::new(0),
            stuck_at: AtomicU64::new(u64::MAX),
        }
    }

    /// Never waits.
    fn push(&self, text: String) {
        // Relaxed, all of these: they are counts, and whoever waits for them has told before on the same thread.
        self.told.fetch_add(1, Ordering::Relaxed);
        if let Err(text) = self.texts.push(text) {
            let lines = text.lines().count() as u64;
            self.left_out.fetch_add(lines, Ordering::Relaxed);
            self.done.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// Writes what waits, and behind it how much is missing.
    fn write_all(&self, mut write: impl FnMut(&str)) {
        loop {
            while let Some(text) = self.texts.pop() {
                write(&text);
                // Release: who sees it done sees what was written.
                self.done.fetch_add(1, Ordering::Release);
            }
            let left_out = self.left_out.load(Ordering::Relaxed);
            if left_out == 0 {
                return;
            }
            let lines = plural(left_out, "line");
            write(&format!(
                "{lines} left out here: standard error took nothing\n"
            ));
            // Only now: it is waited for, too.
            self.left_out.fetch_sub(left_out, Ordering::Relaxed);
        }
    }

    /// Until all is written that was told before, or the time is over. Who has waited in vain does not wait again for the same.
    fn await_written(&self, patience: Duration) {
        let told = self.told.load(Ordering::Relaxed);
        let begun = Instant::now();
        loop {
            let done = self.done.load(Ordering::Acquire);
            if done >= told && self.left_out.load(Ordering::Relaxed) == 0 {
                return;
            }
            if done == self.stuck_at.load(Ordering::Relaxed) {
                return;
            }
            if begun.elapsed() > patience {
                self.stuck_at.store(done, Ordering::Relaxed);
                return;
            }
            thread::sleep(GLANCE);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn what_finds_no_place_is_left_out_and_counted_behind_what_found_one() {
        let queue = Queue::new(2);
        let written_of = |queue: &Queue| {
            let mut written = String::new();
            queue.write_all(|text| written.push_str(text));
            written
        };
        for text in ["one\n", "two\n", "three\nfour\n", "five\n"] {
            queue.push(text.to_owned());
        }
        assert_eq!(
            written_of(&queue),
            "one\ntwo\n3 lines left out here: standard error took nothing\n"
        );
        queue.push("six\n".to_owned());
        assert_eq!(written_of(&queue), "six\n");
    }

    #[test]
    fn who_waits_for_what_was_told_waits_so_long_and_only_once_for_the_same() {
        let queue = Arc::new(Queue::new(2));
        queue.await_written(Duration::MAX);
        queue.push("one\n".to_owned());
        queue.push("two\n".to_owned());
        let patience = Duration::from_millis(30);
        let begun = Instant::now();
        queue.await_written(patience);
        assert!(begun.elapsed() > patience);
        // Nothing has moved.
        queue.await_written(Duration::MAX);
        let (sender, written) = mpsc::channel();
        let of_thread = Arc::clone(&queue);
        let writer = thread::spawn(move || {
            of_thread.write_all(|text| {
                thread::sleep(Duration::from_millis(30));
                sender.send(text.to_owned()).expect("somebody listens");
            });
        });
        assert_eq!(written.recv().as_deref(), Ok("one\n"));
        while queue.done.load(Ordering::Acquire) == 0 {
            thread::yield_now();
        }
        queue.await_written(Duration::MAX);
        assert_eq!(written.try_recv().as_deref(), Ok("two\n"));
        writer.join().expect("it does not panic");
    }
}
