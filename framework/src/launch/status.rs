//! Looks after a run: ends it on a signal or when its time is over, and shows a line a second on standard error.

use std::cmp::Reverse;
use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::signals::Signals;
use crate::cycler::{Counters, Counts};
use crate::error::{Error, Result};
use crate::guarded::contain;
use crate::recorded::{self, Recording};
use crate::report::{plural, tell};
use crate::robot::Robot;
use crate::stop::Stop;

const PERIOD: Duration = Duration::from_millis(20);
const SHOWN_EVERY: Duration = Duration::from_secs(1);

/// How many of those whose frames are missing have room in a line.
const NAMED: usize = 4;

/// The thread that looks after the run. Dropping it requests the stop.
pub(super) struct Supervisor {
    stop: Stop,
    watched: Arc<Mutex<Option<Watched>>>,
    thread: Option<JoinHandle<Result<()>>>,
}

/// What there is to look after once the robot was created.
struct Watched {
    started: Instant,
    duration: Option<Duration>,
    shown: Instant,
    instances: Vec<Line>,
    /// Frames of a recording, by instance and whatever else it has.
    recorded: Vec<(String, Arc<recorded::Counts>)>,
}

struct Line {
    name: &'static str,
    counters: Arc<Counters>,
    shown: Counts,
}

impl Supervisor {
    /// From now on a signal requests the stop.
    pub(super) fn start(signals: Signals, stop: Stop) -> Result<Self> {
        let watched = Arc::new(Mutex::new(None));
        let seen = watched.clone();
        let of_thread = stop.clone();
        let is_over = move || {
            // Before anything is shown.
            signals.any() || lock(&seen).as_mut().is_some_and(Watched::look)
        };
        let thread = thread::Builder::new()
            .name("supervisor".to_owned())
            .spawn(move || supervise(&of_thread, is_over))?;
        Ok(Self {
            stop,
            watched,
            thread: Some(thread),
        })
    }

    /// From now on the robot's status is shown, and it is stopped after `duration`.
    pub(super) fn watch<P>(
        &self,
        robot: &Robot<P>,
        duration: Option<Duration>,
        recording: Option<&Recording>,
    ) {
        let now = Instant::now();
        let instances = robot.instances.iter().map(|instance| Line {
            name: instance.description().name,
            counters: instance.counters().clone(),
            shown: Counts::default(),
        });
        *lock(&self.watched) = Some(Watched {
            started: now,
            duration,
            shown: now,
            instances: instances.collect(),
            recorded: recording.map_or_else(Vec::new, Recording::shared_counts),
        });
    }

    /// Waits for the thread, which ends when the stop was requested.
    pub(super) fn join(mut self) -> Result<()> {
        let joined = self.thread.take().map(JoinHandle::join);
        // Its panics are errors already.
        joined.map_or(Ok(()), |joined| {
            joined.unwrap_or_else(|_| Err(Error::new("the supervisor panicked")))
        })
    }
}

impl Drop for Supervisor {
    fn drop(&mut self) {
        self.stop.request();
    }
}

/// Requests the stop when the run is over, and when it can no longer be told whether it is.
fn supervise(stop: &Stop, mut is_over: impl FnMut() -> bool) -> Result<()> {
    let supervised = contain("supervisor", || {
        while stop.wait(PERIOD).is_ok() {
            if is_over() {
                stop.request();
            }
        }
        Ok(())
    });
    stop.request();
    supervised.map_err(|error| error.context("the supervisor failed"))
}

impl Watched {
    /// Shows the status when it is time to; whether the run is over.
    fn look(&mut self) -> bool {
        let now = Instant::now();
        let since_shown = now - self.shown;
        if since_shown >= SHOWN_EVERY {
            self.shown = now;
            let mut line = format!("{:6.0} s", (now - self.started).as_secs_f64());
            for instance in &mut self.instances {
                instance.write(since_shown, &mut line);
            }
            let missing = self.recorded.iter();
            let missing = missing.map(|(of, counts)| (&**of, counts.missing()));
            write_missing(missing.collect(), &mut line);
            tell(format_args!("{line}"));
        }
        self.duration
            .is_some_and(|duration| now - self.started >= duration)
    }
}

impl Line {
    /// Cycles per second since it was last shown; totals of what should not happen, where it did.
    fn write(&mut self, since_shown: Duration, line: &mut String) {
        let counts = self.counters.read();
        let cycles = counts.cycles - self.shown.cycles;
        let rate = cycles as f64 / since_shown.as_secs_f64();
        self.shown = counts;
        // Writing to a string cannot fail.
        let _ = write!(line, "  |  {} {rate:6.1}/s", self.name);
        for (count, what) in [
            (counts.failures, "failure"),
            (counts.overruns, "overrun"),
            (counts.restarts, "restart"),
        ] {
            if count > 0 {
                let _ = write!(line, ", {}", plural(count, what));
            }
        }
    }
}

/// How much is not in the recording, and of whom most is.
fn write_missing(mut missing: Vec<(&str, u64)>, line: &mut String) {
    let sum = |some: &[(&str, u64)]| some.iter().map(|(_, count)| count).sum::<u64>();
    missing.retain(|(_, count)| *count > 0);
    if missing.is_empty() {
        return;
    }
    missing.sort_by_key(|(_, count)| Reverse(*count));
    let (named, others) = match missing.len() > NAMED {
        // Room for those who share the last place.
        true => missing.split_at(NAMED - 1),
        false => (&*missing, &[][..]),
    };
    // Writing to a string cannot fail.
    let _ = write!(line, "  |  {} not recorded: ", sum(&missing));
    let named = named.iter().map(|(of, count)| format!("{of} {count}"));
    let others = (!others.is_empty()).then(|| format!("{} others {}", others.len(), sum(others)));
    let _ = write!(line, "{}", Vec::from_iter(named.chain(others)).join(", "));
}

fn lock(watched: &Mutex<Option<Watched>>) -> std::sync::MutexGuard<'_, Option<Watched>> {
    watched.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_supervisor_that_panics_stops_the_robot_with_an_error() {
        let stop = Stop::new();
        let error = supervise(&stop, || panic!("as the test wants")).expect_err("it panicked");
        assert!(stop.is_requested());
        let message = error.to_string();
        assert!(
            message.contains("supervisor failed") && message.contains("as the test wants"),
            "{message}"
        );
    }

    #[test]
    fn whose_frames_are_not_recorded_stands_in_the_line() {
        let line = |missing: &[(&str, u64)]| {
            let mut line = "1 s".to_owned();
            write_missing(missing.to_vec(), &mut line);
            line
        };
        assert_eq!(line(&[]), "1 s");
        assert_eq!(line(&[("Top", 0), ("Bottom", 0)]), "1 s");
        assert_eq!(
            line(&[("Top", 0), ("Bottom", 7), ("logs", 0)]),
            "1 s  |  7 not recorded: Bottom 7"
        );
        // Most first; who has as many keeps its place.
        let four = [("A", 2), ("B", 30), ("C", 2), ("D", 1)];
        assert_eq!(line(&four), "1 s  |  35 not recorded: B 30, A 2, C 2, D 1");
        let many = [("A", 2), ("B", 30), ("C", 2), ("D", 1), ("E", 0), ("F", 9)];
        assert_eq!(
            line(&many),
            "1 s  |  44 not recorded: B 30, F 9, A 2, 2 others 3"
        );
    }

    #[test]
    fn a_supervisor_that_is_dropped_requests_the_stop() {
        let stop = Stop::new();
        let supervisor = Supervisor {
            stop: stop.clone(),
            watched: Arc::default(),
            thread: None,
        };
        drop(supervisor);
        assert!(stop.is_requested());
    }
}
