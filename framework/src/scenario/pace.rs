//! How fast the world of a scenario goes on, and whether it does; where clients watch it, they may change both:
//! `framework.procedures.speed` and `.scenario`.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::choice::{Choice, ChoiceCaller, choice};
use crate::error::Result;
use crate::procedure::{Answerer, Caller, procedure};
use crate::stop::Stop;
use crate::time::Timestamp;
use crate::world::Named;

/// Faster than any machine.
const GREATEST: f64 = 1000.0;

/// So soon clients are answered, where the world waits.
const NOTICE: Duration = Duration::from_millis(20);

/// Asked with a number, it is the speed from now on, in times of real time; with nothing, it stays. The answer is the speed.
type SpeedCaller = Caller<Option<f64>, f64>;

/// What clients of each robot may ask of the world that all of them share.
pub(super) struct Callers {
    speed: SpeedCaller,
    scenario: ChoiceCaller,
}

/// So many questions are answered before the world goes on: nobody holds it by asking.
pub(super) const ANSWERS: usize = 16;

/// How fast the world goes on.
pub(super) enum Pace {
    /// As fast as the machine can.
    Free,
    /// No faster than somebody wishes.
    Watched(Box<Watched>),
}

/// A world that came to a time when the wall had another, and goes on at a speed since.
pub(super) struct Watched {
    asked: Answerer<Option<f64>, f64>,
    choice: Choice,
    /// How many seconds of the world pass in one on the wall, at most; 0: none.
    speed: f64,
    since: (Timestamp, Instant),
    /// Where it is on the way to.
    next: Timestamp,
}

/// The world of the scenario in this file, which begins now, in real time until clients wish otherwise.
pub(super) fn watched(file: &Path) -> (Callers, Box<Watched>) {
    let (speed, asked) = procedure();
    let (scenario, choice) = choice(file);
    let watched = Watched {
        asked,
        choice,
        speed: 1.0,
        since: (Timestamp::ZERO, Instant::now()),
        next: Timestamp::ZERO,
    };
    (Callers { speed, scenario }, Box::new(watched))
}

impl Callers {
    /// For the server of one robot.
    pub(super) fn procedures(&self) -> [Named; 2] {
        [
            ("speed", Box::new(self.speed.clone())),
            ("scenario", Box::new(self.scenario.clone())),
        ]
    }
}

impl Watched {
    /// Answers those who ask for the speed.
    fn answer(&mut self) {
        for _ in 0..ANSWERS {
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
                        let passed = self.since.1.elapsed().mul_f64(self.speed);
                        self.since = ((self.since.0 + passed).min(self.next), Instant::now());
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
    /// Until the world may come to this time; breaks with the file of the scenario that somebody chose in place of this one.
    ///
    /// # Errors
    /// Where somebody ends the run meanwhile.
    pub(super) fn wait_for(
        &mut self,
        time: Timestamp,
        stop: &Stop,
    ) -> Result<ControlFlow<PathBuf>> {
        let Self::Watched(watched) = self else {
            return Ok(ControlFlow::Continue(()));
        };
        watched.next = time;
        loop {
            if let Some(file) = watched.choice.answer() {
                return Ok(ControlFlow::Break(file));
            }
            watched.answer();
            let early = watched.early(time);
            if early == Some(Duration::ZERO) {
                return Ok(ControlFlow::Continue(()));
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

    fn nowhere() -> (SpeedCaller, Box<Watched>) {
        let (callers, watched) = watched(Path::new("nowhere.toml"));
        (callers.speed, watched)
    }

    /// The world comes to this time.
    fn come(pace: &mut Pace, time: Timestamp, stop: &Stop) {
        let came = pace.wait_for(time, stop).expect("nobody stops it");
        assert!(came.is_continue(), "nobody chose anything");
    }

    /// What a client hears at once.
    fn heard(pending: &Pending<f64>) -> Result<f64, String> {
        let answer = pending.try_answer().expect("it was answered");
        answer.map_err(|refused| refused.to_string())
    }

    #[test]
    fn a_world_that_is_watched_waits_for_the_wall_and_does_not_hurry() {
        let (stop, begun) = (Stop::new(), Instant::now());
        let mut pace = Pace::Watched(nowhere().1);
        come(&mut pace, at(30), &stop);
        assert!(begun.elapsed() >= Duration::from_millis(30));
        // It was slow: what comes a little later is not at once.
        std::thread::sleep(Duration::from_millis(100));
        come(&mut pace, at(40), &stop);
        let late = Instant::now();
        come(&mut pace, at(60), &stop);
        assert!(late.elapsed() >= Duration::from_millis(19));
        stop.request();
        let stopped = pace.wait_for(at(60_000), &stop);
        assert!(stopped.is_err_and(|error| error.is_stopped()));
        come(&mut Pace::Free, at(60_000), &Stop::new());
    }

    #[test]
    fn clients_hold_a_world_slow_it_down_and_let_it_go() {
        let stop = Stop::new();
        let (speed, watched) = nowhere();
        let mut pace = Pace::Watched(watched);
        speed.call(Some(0.25));
        let begun = Instant::now();
        come(&mut pace, at(200), &stop);
        // 800 ms but for what passed before the wish was heard, which a busy machine may make long.
        assert!(begun.elapsed() >= Duration::from_millis(500));
        // A world that stands is woken, and seconds are over at once.
        speed.call(Some(0.0));
        std::thread::scope(|scope| {
            let held = scope.spawn(|| come(&mut pace, at(300), &stop));
            std::thread::sleep(Duration::from_millis(100));
            assert!(!held.is_finished(), "it stands");
            speed.call(Some(GREATEST));
            held.join().expect("no panic");
        });
        let begun = Instant::now();
        come(&mut pace, at(200_000), &stop);
        assert!(begun.elapsed() >= Duration::from_millis(100));
        speed.call(Some(0.0));
        stop.request();
        let stopped = pace.wait_for(at(300_000), &stop);
        assert!(stopped.is_err_and(|error| error.is_stopped()));
    }

    #[test]
    fn who_says_the_same_speed_again_and_again_holds_nothing() {
        let stop = Stop::new();
        let (speed, watched) = nowhere();
        let mut pace = Pace::Watched(watched);
        speed.call(Some(0.5));
        std::thread::scope(|scope| {
            let walk = scope.spawn(|| come(&mut pace, at(200), &stop));
            let begun = Instant::now();
            while !walk.is_finished() {
                assert!(begun.elapsed() < Duration::from_secs(20), "it is held");
                speed.call(Some(0.5));
                std::thread::sleep(Duration::from_millis(5));
            }
            assert!(begun.elapsed() >= Duration::from_millis(300), "it hurries");
        });
    }

    #[test]
    fn a_world_that_stands_ends_where_another_scenario_is_chosen() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("push.toml");
        let text = "ends = 1.0\n[[assertion]]\nwhat = \"it is upright\"\nvalue = \"truth.tilt\"\nbelow = 1.0\n";
        std::fs::write(&file, text).expect("it is written");
        let (callers, watched) = watched(&file);
        let mut pace = Pace::Watched(watched);
        callers.speed.call(Some(0.0));
        callers.scenario.call(Some("push".to_owned()));
        let ended = pace
            .wait_for(at(50), &Stop::new())
            .expect("nobody stops it");
        assert_eq!(ended, ControlFlow::Break(file));
    }

    #[test]
    fn who_asks_with_nothing_hears_and_what_is_no_speed_changes_nothing() {
        let (speed, mut watched) = nowhere();
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
