//! Hardware and nodes that do what a test wrote down.

use std::collections::VecDeque;
use std::fs::File;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, ThreadId};
use std::time::Duration;

use framework::{
    Clock, Error, Event, Hardware, HardwareContext, NoEvent, Result, Stop, Stopped, Timestamp,
};

use crate::process::MARK;

pub(crate) fn millis(millis: u64) -> Timestamp {
    Timestamp::ZERO + Duration::from_millis(millis)
}

/// What a node does in one call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Act {
    Work,
    Fail,
    Panic,
    NoEvent,
    Stopped,
    /// Takes so many milliseconds.
    Take(u64),
    /// Says so and works.
    Say(&'static str),
    /// Catches a panic of its own, as of a decoder that is not its own, and works.
    Catch,
    /// While it panics, a part of it panics, too.
    PanicTwice,
}

struct PanicsAgain;

impl Drop for PanicsAgain {
    fn drop(&mut self) {
        panic!("in between, as scripted")
    }
}

impl Act {
    pub(crate) fn perform(self) -> Result<()> {
        match self {
            Self::Work => Ok(()),
            Self::Fail => Err(Error::new("as scripted")),
            Self::Panic => panic!("as scripted"),
            Self::NoEvent => Err(NoEvent("as scripted".to_owned()).into()),
            Self::Stopped => Err(Stopped.into()),
            Self::Take(millis) => {
                std::thread::sleep(Duration::from_millis(millis));
                Ok(())
            }
            Self::Say(text) => {
                tracing::info!(target: "scripted", "{text}");
                Ok(())
            }
            Self::Catch => {
                drop(std::panic::catch_unwind(|| panic!("as scripted")));
                Ok(())
            }
            Self::PanicTwice => {
                let _part = PanicsAgain;
                panic!("as scripted")
            }
        }
    }
}

/// What the calls of one node do, one after the other; then it works.
#[derive(Clone, Debug, Default)]
pub(crate) struct Script(Arc<Mutex<VecDeque<Act>>>);

impl Script {
    pub(crate) fn new(acts: impl IntoIterator<Item = Act>) -> Self {
        Self(Arc::new(Mutex::new(acts.into_iter().collect())))
    }

    pub(crate) fn next(&self) -> Act {
        self.0
            .lock()
            .expect("not poisoned")
            .pop_front()
            .unwrap_or(Act::Work)
    }
}

/// What happened, in order. Clones are the same log.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log(Arc<Mutex<Vec<String>>>);

impl Log {
    pub(crate) fn add(&self, line: impl Into<String>) {
        self.0.lock().expect("not poisoned").push(line.into());
    }

    pub(crate) fn lines(&self) -> Vec<String> {
        self.0.lock().expect("not poisoned").clone()
    }

    pub(crate) fn count(&self, line: &str) -> usize {
        self.lines().iter().filter(|known| *known == line).count()
    }
}

/// How many robots wait for each other, and how far they may go, in ms.
#[derive(Default)]
struct Beats {
    joined: AtomicU64,
    now: AtomicU64,
}

/// Hardware whose events and data a test wrote down.
pub(crate) struct ScriptedHardware {
    pub(crate) clock: Clock,
    pub(crate) stop: Stop,
    pub(crate) log: Log,
    events: Mutex<VecDeque<Event>>,
    /// From capture to arrival.
    pub(crate) latency: Duration,
    /// Threads: data comes so often.
    pub(crate) period: Duration,
    reads: AtomicU64,
    /// Threads: how late who woke up.
    pub(crate) woken: Mutex<Vec<(ThreadId, Duration)>>,
    /// Counts the events of all hardwares that share it, if there is one; what is read is the count at the last own event.
    pub(crate) world: Option<Arc<AtomicU64>>,
    told: AtomicU64,
    /// What scenarios ask about.
    happened: AtomicU64,
    step: f64,
    /// A scenario's `[[robot]]`.
    entry: serde_json::Value,
    /// Of a world that several share.
    beats: Arc<Beats>,
    /// Somebody presses the button that gives the nodes the actuators back.
    pub(crate) button: AtomicBool,
    /// What never returns, if it says so.
    options: Vec<String>,
    _end: End,
}

/// Where it hangs, dropping it never returns.
#[derive(Default)]
struct End {
    hangs: bool,
}

impl Drop for End {
    fn drop(&mut self) {
        hang_if(self.hangs);
    }
}

fn hang_if(hangs: bool) {
    if hangs {
        loop {
            thread::park();
        }
    }
}

impl ScriptedHardware {
    pub(crate) fn lockstep(events: impl IntoIterator<Item = (u64, &'static str)>) -> Arc<Self> {
        let events = events.into_iter().map(|(at, instance)| Event {
            at: millis(at),
            instance,
        });
        Arc::new(Self::with(Clock::stepped(), events.collect()))
    }

    pub(crate) fn threads() -> Arc<Self> {
        let mut hardware = Self::with(Clock::wall(), VecDeque::new());
        // Shorter than the period, so that no two captures fall together at the very start.
        hardware.latency = Duration::from_millis(1);
        Arc::new(hardware)
    }

    pub(crate) fn with(clock: Clock, events: VecDeque<Event>) -> Self {
        Self {
            clock,
            stop: Stop::new(),
            log: Log::default(),
            events: Mutex::new(events),
            latency: Duration::from_millis(5),
            period: Duration::from_millis(2),
            reads: AtomicU64::new(0),
            woken: Mutex::default(),
            world: None,
            told: AtomicU64::new(0),
            happened: AtomicU64::new(0),
            step: 0.0,
            entry: serde_json::Value::Null,
            beats: Arc::default(),
            button: AtomicBool::new(false),
            options: Vec::new(),
            _end: End::default(),
        }
    }

    /// Waits for data; gives its capture time and a value.
    pub(crate) fn read(&self) -> Result<(Timestamp, u64)> {
        if self.clock.is_stepped() {
            self.stop.check()?;
        } else {
            let due = self.clock.now() + self.period;
            self.clock.wait_until(due, &self.stop)?;
            let late = self.clock.now() - due;
            let mut woken = self.woken.lock().expect("not poisoned");
            woken.push((thread::current().id(), late));
        }
        let now = self.clock.now();
        let captured = Timestamp::ZERO + (now - Timestamp::ZERO).saturating_sub(self.latency);
        let value = match self.world {
            Some(_) => self.told.load(Ordering::Relaxed),
            None => self.reads.fetch_add(1, Ordering::Relaxed),
        };
        Ok((captured, value))
    }
}

impl Hardware for ScriptedHardware {
    fn new(context: HardwareContext) -> Result<Self> {
        let step = context.table.get("step").and_then(toml::Value::as_float);
        // A scenario's robot moves for a second.
        let events = (1..=100).filter(|_| context.table.contains_key("step"));
        let events = events.map(|number| Event {
            at: millis(number * 10),
            instance: "Legs",
        });
        let mut hardware = Self::with(context.clock.clone(), events.collect());
        hardware.stop = context.stop.clone();
        hardware.options.clone_from(&context.options);
        hardware._end.hangs = context.options == ["hang in drop"];
        hardware.step = step.unwrap_or_default();
        hardware.entry = serde_json::to_value(context.table.get("robot"))?;
        Ok(hardware)
    }

    fn join(&self, context: HardwareContext) -> Result<Self> {
        let mut joined = Self::new(context)?;
        joined.beats = Arc::clone(&self.beats);
        self.beats.joined.fetch_add(1, Ordering::Relaxed);
        Ok(joined)
    }

    fn advance(&self) -> Result<Timestamp> {
        let before = self.beats.now.fetch_add(25, Ordering::Relaxed);
        Ok(millis(before + 25))
    }

    fn stop(&self) {
        self.stop.request();
        self.log.add("stop");
        hang_if(self.options == ["hang in stop"]);
    }

    fn enter_safe_state(&self) {
        self.log.add("safe state");
        if self.options == [MARK] {
            File::create(std::env::temp_dir().join(MARK)).expect("its folder is there");
        }
        hang_if(self.options == ["hang in safe state"]);
    }

    fn rearm(&self) {
        self.log.add("rearm");
    }

    fn is_rearm_wanted(&self) -> bool {
        self.button.swap(false, Ordering::Relaxed)
    }

    fn next_event(&self) -> Result<Option<Event>> {
        if let Some(world) = &self.world {
            let count = world.fetch_add(1, Ordering::Relaxed);
            self.told.store(count, Ordering::Relaxed);
        }
        let mut events = self.events.lock().expect("not poisoned");
        let next = events.front().map_or(Timestamp::ZERO, |event| event.at);
        let is_shared = self.beats.joined.load(Ordering::Relaxed) > 0;
        if is_shared && next > millis(self.beats.now.load(Ordering::Relaxed)) {
            return Ok(None);
        }
        let crashes_at = self.entry["crashes_at"].as_u64();
        assert!(
            crashes_at.is_none_or(|at| next < millis(at)),
            "the hardware crashes as scripted"
        );
        let leaves_at = self.entry["leaves_at"].as_u64();
        if leaves_at.is_some_and(|at| next >= millis(at)) {
            self.stop.request();
            self.stop.check()?;
        }
        let event = events.pop_front();
        self.happened
            .fetch_add(u64::from(event.is_some()), Ordering::Relaxed);
        Ok(event)
    }

    fn truth(&self) -> serde_json::Value {
        // The driver asks for one event more before a cycle ends.
        let until = (self.clock.now() - Timestamp::ZERO).as_millis() as u64 / 10;
        let jumped = self.happened.load(Ordering::Relaxed) / 1000 * 1000;
        let late = (until > 50).then_some(until);
        serde_json::json!({
            "events": jumped + until, "late": late, "is_late": late.is_some(), "step": self.step, "entry": self.entry,
        })
    }

    fn disturb(&self, deed: &toml::Table) -> Result<()> {
        if deed.contains_key("interrupt") {
            signal_hook::low_level::raise(signal_hook::consts::SIGINT)?;
            return Ok(());
        }
        if deed.contains_key("leave") {
            self.stop.request();
            return Ok(());
        }
        assert!(!deed.contains_key("explode"), "explodes as scripted");
        let jump = deed.get("jump").and_then(toml::Value::as_integer);
        let jump = jump.ok_or_else(|| Error::new("expected `jump = NUMBER`"))?;
        self.happened
            .fetch_add(jump.unsigned_abs(), Ordering::Relaxed);
        Ok(())
    }
}
