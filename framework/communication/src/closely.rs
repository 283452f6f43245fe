//! Every cycle is timed while somebody listens.
//!
//! What is timed is one setting of the whole process, in which several robots may run, each with a server of its own: who
//! listens first remembers what it was, who leaves last puts it back.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use framework::timing::{self, Timing};

/// Whoever asked listens so long.
const LISTENING: Duration = Duration::from_secs(10);

/// How many servers have somebody who listens, and what was timed before.
static LISTENERS: Mutex<(usize, Timing)> = Mutex::new((0, Timing::Sampled));

/// Whether somebody listens at this server; whoever does has left when it is dropped.
#[derive(Debug, Default)]
pub(crate) struct Closely {
    asked: Option<Instant>,
}

impl Closely {
    /// Somebody asks: every cycle is timed, for a while.
    pub(crate) fn look(&mut self) {
        if self.asked.replace(Instant::now()).is_none() {
            let mut listeners = LISTENERS.lock().unwrap_or_else(PoisonError::into_inner);
            if listeners.0 == 0 {
                listeners.1 = timing::current();
            }
            listeners.0 += 1;
            timing::set(Timing::Complete);
        }
    }

    /// Whoever has not asked for long does not listen any more.
    pub(crate) fn stop_when_over(&mut self) {
        if self.asked.is_some_and(|asked| asked.elapsed() > LISTENING) {
            self.stop();
        }
    }

    fn stop(&mut self) {
        if self.asked.take().is_some() {
            let mut listeners = LISTENERS.lock().unwrap_or_else(PoisonError::into_inner);
            listeners.0 -= 1;
            if listeners.0 == 0 {
                timing::set(listeners.1);
            }
        }
    }
}

impl Drop for Closely {
    fn drop(&mut self) {
        self.stop();
    }
}

#[cfg(test)]
mod tests {
    use super::{Closely, Timing, timing};

    #[test]
    fn who_leaves_last_puts_it_back() {
        let (mut one, mut other) = (Closely::default(), Closely::default());
        one.look();
        one.look();
        other.look();
        one.stop();
        one.stop();
        assert_eq!(timing::current(), Timing::Complete, "one still listens");
        drop(other);
        assert_eq!(timing::current(), Timing::Sampled);
    }
}
