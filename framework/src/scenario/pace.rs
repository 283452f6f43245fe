//! How fast the world of a scenario goes on; where clients watch it, they may change that: `framework.procedures.speed`.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::error::{Error, Result};
use crate::procedure::{Answer, CallAny, PendingAny};
use crate::reflect::{Reflect as _, Shape};
use crate::stop::Stop;
use crate::time::Timestamp;
use crate::world::Named;

/// Faster than any machine.
const GREATEST: f64 = 1000.0;

/// So soon another speed is noticed.
const NOTICE: Duration = Duration::from_millis(20);

/// In how many seconds of the world one second on the wall passes, at most; 0: not at all. Its clones are the same speed.
#[derive(Clone)]
pub(super) struct Speed(Arc<AtomicU64>);

impl Speed {
    /// That of clocks on the wall.
    pub(super) fn real_time() -> Self {
        Self(Arc::new(AtomicU64::new(1.0_f64.to_bits())))
    }

    /// What clients call to hear and to change it.
    pub(super) fn procedure(&self) -> Named {
        ("speed", Box::new(self.clone()))
    }

    fn get(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }

    fn set(&self, speed: f64) -> Result<()> {
        if !(0.0..=GREATEST).contains(&speed) {
            return Err(Error::new(format!(
                "a world cannot go on at {speed} times real time: expected 0 to {GREATEST}"
            )));
        }
        self.0.store(speed.to_bits(), Ordering::Relaxed);
        Ok(())
    }
}

/// Asked with a number, it is the speed from now on; with nothing, it stays. The answer is the speed.
impl CallAny for Speed {
    fn types(&self) -> (&'static str, &'static str) {
        ("Option<f64>", "f64")
    }

    fn shapes(&self) -> Option<(Shape, Shape)> {
        Some((Option::<f64>::shape(), f64::shape()))
    }

    fn call_any(
        &self,
        request: &mut dyn erased_serde::Deserializer<'_>,
    ) -> Result<Box<dyn PendingAny>> {
        if let Some(speed) = erased_serde::deserialize::<Option<f64>>(request)? {
            self.set(speed)?;
        }
        Ok(Box::new(Told(self.get())))
    }
}

/// An answer that is there at once.
struct Told(f64);

impl PendingAny for Told {
    fn wait_any(&self, _timeout: Duration) -> Option<Answer<Box<dyn erased_serde::Serialize>>> {
        Some(Ok(Box::new(self.0)))
    }
}

/// How fast the world goes on.
pub(super) enum Pace {
    /// As fast as the machine can.
    Free,
    /// No faster than somebody wishes.
    Watched(Watched),
}

/// A world that came to a time when the wall had another, and goes on at a speed since.
pub(super) struct Watched {
    wished: Speed,
    speed: f64,
    since: (Timestamp, Instant),
    reached: Timestamp,
}

impl Watched {
    fn new(wished: Speed) -> Self {
        Self {
            speed: wished.get(),
            wished,
            since: (Timestamp::ZERO, Instant::now()),
            reached: Timestamp::ZERO,
        }
    }

    /// For how long the world may not come to this time yet; `None`: for nobody knows how long.
    fn early(&mut self, time: Timestamp) -> Option<Duration> {
        let wished = self.wished.get();
        if self.speed.to_bits() != wished.to_bits() {
            // What had passed of the way to the next time is walked at the new speed: it is short.
            self.since = (self.reached, Instant::now());
            self.speed = wished;
        }
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
    /// That of clients, if any watch; it begins now.
    pub(super) fn of(wished: Option<Speed>) -> Self {
        wished.map_or(Self::Free, |wished| Self::Watched(Watched::new(wished)))
    }

    /// Until the world may come to this time.
    ///
    /// # Errors
    /// Where somebody ends the run meanwhile.
    pub(super) fn wait_for(&mut self, time: Timestamp, stop: &Stop) -> Result<()> {
        let Self::Watched(watched) = self else {
            return Ok(());
        };
        loop {
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

    fn at(milliseconds: u64) -> Timestamp {
        Timestamp::ZERO + Duration::from_millis(milliseconds)
    }

    /// What a client hears that sends this.
    fn call(speed: &Speed, request: &str) -> Result<f64> {
        let mut request = serde_json::Deserializer::from_str(request);
        let mut request = <dyn erased_serde::Deserializer<'_>>::erase(&mut request);
        let pending = speed.call_any(&mut request)?;
        let answer = pending.wait_any(Duration::ZERO).expect("it is there");
        let answer = serde_json::to_value(answer.expect("it is not refused"));
        Ok(answer.expect("a number").as_f64().expect("a number"))
    }

    #[test]
    fn a_world_that_is_watched_waits_for_the_wall_and_does_not_hurry() {
        let (stop, begun) = (Stop::new(), Instant::now());
        let mut pace = Pace::Watched(Watched::new(Speed::real_time()));
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
        let (stop, speed) = (Stop::new(), Speed::real_time());
        let mut pace = Pace::Watched(Watched::new(speed.clone()));
        speed.set(0.25).expect("a speed");
        let begun = Instant::now();
        pace.wait_for(at(20), &stop).expect("nobody stops it");
        assert!(begun.elapsed() >= Duration::from_millis(80));
        // An hour is over at once, and a world that stands is woken.
        speed.set(0.0).expect("a speed");
        std::thread::scope(|scope| {
            let held = scope.spawn(|| pace.wait_for(at(50), &stop));
            std::thread::sleep(Duration::from_millis(100));
            assert!(!held.is_finished(), "it stands");
            speed.set(GREATEST).expect("a speed");
            held.join().expect("no panic").expect("nobody stops it");
        });
        let begun = Instant::now();
        pace.wait_for(at(10_000), &stop).expect("nobody stops it");
        assert!(begun.elapsed() >= Duration::from_millis(9));
        speed.set(0.0).expect("a speed");
        stop.request();
        let stopped = pace.wait_for(at(20_000), &stop);
        assert!(stopped.is_err_and(|error| error.is_stopped()));
    }

    #[test]
    fn who_asks_with_nothing_hears_and_what_is_no_speed_changes_nothing() {
        let speed = Speed::real_time();
        assert_eq!(call(&speed, "null").expect("an answer"), 1.0);
        assert_eq!(call(&speed, "0.5").expect("an answer"), 0.5);
        for wrong in ["-1", "1001", "\"fast\"", "{}"] {
            let error = call(&speed, wrong).expect_err(wrong).to_string();
            assert!(!error.is_empty());
            assert_eq!(call(&speed, "null").expect("an answer"), 0.5);
        }
        let error = call(&speed, "-1").expect_err("backwards").to_string();
        assert!(error.contains("expected 0 to 1000"), "{error}");
    }
}
