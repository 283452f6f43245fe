//! How fast the world of a scenario goes on; where clients watch it, they may change that: `framework.procedures.speed`.

use std::time::{Duration, Instant};

use crate::error::Result;
use crate::procedure::{Answerer, Caller, procedure};
use crate::stop::Stop;
use crate::time::Timestamp;

/// Faster than any machine.
const GREATEST: f64 = 1000.0;

/// So soon clients are answered, where the world waits.
const NOTICE: Duration = Duration::from_millis(20);

/// Asked with a number, it is the speed from now on, in times of real time; with nothing, it stays. The answer is the speed.
pub(super) type SpeedCaller = Caller<Option<f64>, f64>;

/// How fast the world goes on.
pub(super) enum Pace {
    /// As fast as the machine can.
    Free,
    /// No faster than somebody wishes.
    Watched(Watched),
}

/// A world that came to a time when the wall had another, and goes on at a speed since.
pub(super) struct Watched {
    asked: Answerer<Option<f64>, f64>,
    /// How many seconds of the world pass in one on the wall, at most; 0: none.
    speed: f64,
    since: (Timestamp, Instant),
    reached: Timestamp,
}

/// A world that begins now, in real time until clients wish otherwise.
pub(super) fn watched() -> (SpeedCaller, Watched) {
    let (caller, asked) = procedure();
    let watched = Watched {
        asked,
        speed: 1.0,
        since: (Timestamp::ZERO, Instant::now()),
        reached: Timestamp::ZERO,
    };
    (caller, watched)
}

impl Watched {
    /// Answers those who ask for the speed.
    fn answer(&mut self) {
        loop {
            self.asked.take();
            let Some(call) = self.asked.call() else {
                return;
            };
            match *call.request() {
                Some(speed) if !(0.0..=GREATEST).contains(&speed) => call.refuse(format!(
                    "a world cannot go on at {speed} times real time: expected 0 to {GREATEST}"
                )),
                wished => {
                    if let Some(speed) = wished {
                        // What had passed of the way to the next time is walked at the new speed: it is short.
                        self.since = (self.reached, Instant::now());
                        self.speed = speed;
                    }
                    call.answer(self.speed);
                }
            }
        }
    }

    /// For how long the world may not come to this time yet; `None`: for nobody knows how long.
    fn early(&mut self, time: Timestamp) -> Option<Duration> {
        if self.speed == 0.0 {
            return None;
        }
        let due = Duration::try_from_secs_f64((time - self.since.0).as_secs_f64() / self.speed);
        let due = due.unwrap_or(Duration::MAX);
        let elapsed = self.since.1.elapsed();
        if elapsed > due {
            // A world that was too much for the machine does not hurry afterwards.
            self.since = (time, Instant::now());
        }
        Some(due.saturating_sub(elapsed))
    }
}

impl Pace {
    /// Until the world may come to this time.
    ///
    /// # Errors
    /// Where somebody ends the run meanwhile.
    pub(super) fn wait_for(&mut self, time: Timestamp, stop: &Stop) -> Result<()> {
        let Self::Watched(watched) = self else {
            return Ok(());
        };
        loop {
            watched.answer();
            let early = watched.early(time);
            if early == Some(Duration::ZERO) {
                watched.reached = time;
                return Ok(());
            }
            stop.wait(early.map_or(NOTICE, |early| early.min(NOTICE)))?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedure::Pending;

    fn at(milliseconds: u64) -> Timestamp {
        Timestamp::ZERO + Duration::from_millis(milliseconds)
    }

    /// What a client hears at once.
    fn heard(pending: &Pending<f64>) -> Result<f64, String> {
        let answer = pending.try_answer().expect("it was answered");
        answer.map_err(|refused| refused.to_string())
    }

    #[test]
    fn a_world_that_is_watched_waits_for_the_wall_and_does_not_hurry() {
        let (stop, begun) = (Stop::new(), Instant::now());
        let mut pace = Pace::Watched(watched().1);
        pace.wait_for(at(30), &stop).expect("nobody stops it");
        assert!(begun.elapsed() >= Duration::from_millis(30));
        // It was slow: what comes a little later is not at once.
        std::thread::sleep(Duration::from_millis(100));
        pace.wait_for(at(40), &stop).expect("nobody stops it");
        let late = Instant::now();
        pace.wait_for(at(60), &stop).expect("nobody stops it");
        assert!(late.elapsed() >= Duration::from_millis(19));
        stop.request();
        let stopped = pace.wait_for(at(60_000), &stop);
        assert!(stopped.is_err_and(|error| error.is_stopped()));
        Pace::Free
            .wait_for(at(60_000), &Stop::new())
            .expect("it waits for nothing");
    }

    #[test]
    fn clients_hold_a_world_slow_it_down_and_let_it_go() {
        let stop = Stop::new();
        let (speed, watched) = watched();
        let mut pace = Pace::Watched(watched);
        speed.call(Some(0.25));
        let begun = Instant::now();
        pace.wait_for(at(20), &stop).expect("nobody stops it");
        assert!(begun.elapsed() >= Duration::from_millis(80));
        // A world that stands is woken, and seconds are over at once.
        speed.call(Some(0.0));
        std::thread::scope(|scope| {
            let held = scope.spawn(|| pace.wait_for(at(50), &stop));
            std::thread::sleep(Duration::from_millis(100));
            assert!(!held.is_finished(), "it stands");
            speed.call(Some(GREATEST));
            held.join().expect("no panic").expect("nobody stops it");
        });
        let begun = Instant::now();
        pace.wait_for(at(10_000), &stop).expect("nobody stops it");
        assert!(begun.elapsed() >= Duration::from_millis(9));
        speed.call(Some(0.0));
        stop.request();
        let stopped = pace.wait_for(at(20_000), &stop);
        assert!(stopped.is_err_and(|error| error.is_stopped()));
    }

    #[test]
    fn who_asks_with_nothing_hears_and_what_is_no_speed_changes_nothing() {
        let (speed, mut watched) = watched();
        let mut ask = |wished| {
            let pending = speed.call(wished);
            watched.answer();
            heard(&pending)
        };
        assert_eq!(ask(None), Ok(1.0));
        assert_eq!(ask(Some(0.5)), Ok(0.5));
        for wrong in [-1.0, 1001.0, f64::NAN, f64::INFINITY] {
            let refused = ask(Some(wrong)).expect_err("it is no speed");
            assert!(refused.contains("expected 0 to 1000"), "{refused}");
            assert_eq!(ask(None), Ok(0.5));
        }
    }
}
