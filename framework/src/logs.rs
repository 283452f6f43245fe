//! Log messages of nodes, hardware and framework, collected for whoever asks.
//!
//! Nodes say them with the macros of the crate `tracing`. A message knows the instance and the cycle that its thread is in, and
//! the module that says it: for a node that is its path in the manifest. It goes into a queue that a server empties; where
//! the queue is full it is left out and counted, so that no thread waits.
//! Of several robots that live in lockstep each one's sinks get what is said while it lives; what is said between, as by
//! the world that they share, all get.
//!
//! Without a sink nothing is collected, and a message costs one load.

mod again;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard, Weak};

use crossbeam_queue::ArrayQueue;
use serde_json::{Map, Value};
use tracing::field::{Field, Visit};
use tracing::level_filters::LevelFilter;
use tracing::span;
use tracing::subscriber::Interest;
use tracing::{Event, Metadata, Subscriber};

use crate::clock::Clock;
use crate::report::tell;
use crate::time::Timestamp;

pub(crate) use again::{Again, again, say_again};
pub use tracing::Level;

/// Messages that wait for the server.
const WAITING: usize = 1024;

/// Longer texts are cut.
const LONGEST: usize = 8 << 10;

/// All sinks of the process.
static SINKS: RwLock<Vec<Weak<Sink>>> = RwLock::new(Vec::new());

thread_local! {
    static PLACE: Cell<Option<Place>> = const { Cell::new(None) };
    /// Which robot lives on this thread, by its clock.
    static ROBOT: Cell<Option<usize>> = const { Cell::new(None) };
}

/// Until it is dropped, what its thread says is one robot's.
pub(crate) struct Within {
    before: Option<usize>,
    place: Option<Place>,
}

impl Drop for Within {
    fn drop(&mut self) {
        ROBOT.set(self.before);
        PLACE.set(self.place);
    }
}

/// What a thread is in.
#[derive(Clone, Copy, Debug)]
struct Place {
    instance: &'static str,
    cycle: u64,
}

/// One message.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Of the robot's clock, of a recording's robot in a replay.
    pub time: Timestamp,
    /// When the sink got it: the same, apart from a replay, where time goes on here while it does not there.
    pub heard: Timestamp,
    pub level: Level,
    /// The module that says it.
    pub module: Cow<'static, str>,
    /// Whose thread says it.
    pub instance: Option<Cow<'static, str>>,
    pub cycle: Option<u64>,
    pub message: String,
    /// What is said with it.
    pub fields: Map<String, Value>,
}

/// Where messages are collected, from its creation until it is dropped.
#[derive(Debug)]
pub struct Sink {
    clock: Clock,
    records: ArrayQueue<Record>,
    left_out: AtomicU64,
    rules: RwLock<Rules>,
}

/// How often modules say something: what one says too often is left to who counts.
#[derive(Clone, Debug, Default)]
pub struct Rates {
    /// Of each module: a second, and how many messages came in it.
    seconds: BTreeMap<Cow<'static, str>, (u64, usize)>,
}

impl Rates {
    /// Whether at most so many of the module were heard in the second of this message, with it.
    pub fn is_allowed(&mut self, record: &Record, most: usize) -> bool {
        let second = record.heard.as_nanos() / 1_000_000_000;
        let rate = self.seconds.entry(record.module.clone()).or_default();
        if rate.0 != second {
            *rate = (second, 0);
        }
        rate.1 += 1;
        rate.1 <= most
    }
}

/// Which messages are made.
#[derive(Clone, Debug)]
struct Rules {
    /// Where no other holds.
    level: Level,
    others: Vec<Rule>,
}

/// A level for one instance, or for one module in it.
#[derive(Clone, Debug)]
struct Rule {
    instance: String,
    module: Option<String>,
    level: Level,
}

impl Sink {
    /// Collects messages from now on, those of level `INFO` and above.
    pub fn new(clock: Clock) -> Arc<Self> {
        let sink = Arc::new(Self {
            clock,
            records: ArrayQueue::new(WAITING),
            left_out: AtomicU64::new(0),
            rules: RwLock::new(Rules {
                level: Level::INFO,
                others: Vec::new(),
            }),
        });
        let mut sinks = SINKS.write().unwrap_or_else(PoisonError::into_inner);
        sinks.retain(|known| known.strong_count() > 0);
        sinks.push(Arc::downgrade(&sink));
        drop(sinks);
        // Whoever has set another one before wants it so.
        let _ = tracing::subscriber::set_global_default(Collector);
        tracing::callsite::rebuild_interest_cache();
        sink
    }

    /// The message that waits longest.
    pub fn take(&self) -> Option<Record> {
        self.records.pop()
    }

    /// How many messages found no place since this was last asked.
    pub fn left_out(&self) -> u64 {
        self.left_out.swap(0, Ordering::Relaxed)
    }

    /// Messages of an instance, of a module in it, or all, are made from this level on.
    pub fn set_level(&self, of: Option<(&str, Option<&str>)>, level: Level) {
        let mut rules = self.rules.write().unwrap_or_else(PoisonError::into_inner);
        match of {
            None => {
                rules.level = level;
                rules.others.clear();
            }
            Some((instance, module)) => {
                rules.others.retain(|rule| {
                    rule.instance != instance
                        || (module.is_some() && rule.module.as_deref() != module)
                });
                rules.others.push(Rule {
                    instance: instance.to_owned(),
                    module: module.map(str::to_owned),
                    level,
                });
            }
        }
        drop(rules);
        tracing::callsite::rebuild_interest_cache();
    }

    fn wants(&self, level: Level, module: &str, instance: Option<&str>) -> bool {
        level <= self.rules().of(module, instance)
    }

    /// Whether what that robot says is for this one. A wall clock is the only one in its process.
    fn is_of(&self, robot: Option<usize>) -> bool {
        let identities = self.clock.identity().zip(robot);
        identities.is_none_or(|(own, robot)| own == robot)
    }

    fn keep(&self, record: Record) {
        if self.records.push(record).is_err() {
            self.left_out.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn rules(&self) -> RwLockReadGuard<'_, Rules> {
        self.rules.read().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Rules {
    /// The rule that says most about it holds.
    fn of(&self, module: &str, instance: Option<&str>) -> Level {
        let of_instance = |rule: &&Rule| instance.is_some_and(|it| it == rule.instance);
        let fits = |rule: &&Rule| {
            let wanted = rule.module.as_deref();
            of_instance(rule) && wanted.is_none_or(|wanted| is_within(module, wanted))
        };
        let found = self.others.iter().filter(fits);
        let found = found.max_by_key(|rule| rule.module.as_ref().map_or(0, String::len));
        found.map_or(self.level, |rule| rule.level)
    }

    fn most_verbose(&self) -> Level {
        let others = self.others.iter().map(|rule| rule.level);
        others.fold(self.level, Ord::max)
    }
}

/// Whether a module is `outer` or lies in it.
pub fn is_within(module: &str, outer: &str) -> bool {
    let rest = module.strip_prefix(outer);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
}

/// What this thread says is of the robot with this clock, and of no instance until it enters one.
#[must_use]
pub(crate) fn within(clock: &Clock) -> Within {
    Within {
        before: ROBOT.replace(clock.identity()),
        place: PLACE.take(),
    }
}

/// From now on the thread is in this cycle.
#[inline]
pub(crate) fn enter(instance: &'static str, cycle: u64) {
    PLACE.set(Some(Place { instance, cycle }));
}

/// Something beside the robot is not as it should be: it goes on, and who watches standard error is told, too.
pub fn tell_warning(module: &'static str, warning: &dyn fmt::Display) {
    record(Level::WARN, module, format_args!("{warning}"));
    tell(format_args!("warning: {warning}"));
}

/// A message of the framework about a node.
pub(crate) fn record(level: Level, module: &'static str, message: fmt::Arguments<'_>) {
    hand_out(level, module, || (cut(message.to_string()), Map::new()));
}

/// Gives the message to everybody who wants it; it is made only if somebody does.
fn hand_out(
    level: Level,
    module: &'static str,
    make: impl FnOnce() -> (String, Map<String, Value>),
) {
    if again::is_silent() {
        return;
    }
    let place = PLACE.get();
    let instance = place.map(|place| place.instance);
    let wanting = sinks_for(level, module, instance, ROBOT.get());
    if wanting.is_empty() {
        return;
    }
    let (message, fields) = make();
    if again::is_known(level, module, &message) {
        return;
    }
    for sink in wanting {
        let heard = sink.clock.passed();
        sink.keep(Record {
            time: again::time().unwrap_or_else(|| sink.clock.now()),
            heard,
            level,
            module: module.into(),
            instance: instance.map(Cow::Borrowed),
            cycle: place.map(|place| place.cycle),
            message: message.clone(),
            fields: fields.clone(),
        });
    }
}

/// Everybody who wants such a message.
fn sinks_for(
    level: Level,
    module: &str,
    instance: Option<&str>,
    robot: Option<usize>,
) -> Vec<Arc<Sink>> {
    let sinks = SINKS.read().unwrap_or_else(PoisonError::into_inner);
    let sinks = sinks.iter().filter_map(Weak::upgrade);
    let wants = |sink: &Arc<Sink>| sink.is_of(robot) && sink.wants(level, module, instance);
    sinks.filter(wants).collect()
}

/// What `tracing` calls.
struct Collector;

impl Subscriber for Collector {
    fn register_callsite(&self, _: &'static Metadata<'static>) -> Interest {
        Interest::sometimes()
    }

    fn max_level_hint(&self) -> Option<LevelFilter> {
        let sinks = SINKS.read().unwrap_or_else(PoisonError::into_inner);
        let levels = sinks.iter().filter_map(Weak::upgrade);
        let levels = levels.map(|sink| sink.rules().most_verbose());
        Some(
            levels
                .max()
                .map_or(LevelFilter::OFF, LevelFilter::from_level),
        )
    }

    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.is_event()
    }

    fn new_span(&self, _: &span::Attributes<'_>) -> span::Id {
        span::Id::from_u64(1)
    }

    fn record(&self, _: &span::Id, _: &span::Record<'_>) {}

    fn record_follows_from(&self, _: &span::Id, _: &span::Id) {}

    fn event(&self, event: &Event<'_>) {
        let metadata = event.metadata();
        let module = metadata.target();
        // Targets live as long as their metadata.
        hand_out(*metadata.level(), module, || {
            let mut said = Said::default();
            event.record(&mut said);
            (cut(said.message), said.fields)
        });
    }

    fn enter(&self, _: &span::Id) {}

    fn exit(&self, _: &span::Id) {}
}

/// Message and fields of an event.
#[derive(Default)]
struct Said {
    message: String,
    fields: Map<String, Value>,
}

impl Said {
    fn say(&mut self, field: &Field, value: Value) {
        match (field.name(), value) {
            ("message", Value::String(text)) => self.message = text,
            (name, value) => {
                self.fields.insert(name.to_owned(), value);
            }
        }
    }
}

impl Visit for Said {
    fn record_debug(&mut self, field: &Field, value: &dyn fmt::Debug) {
        let mut text = String::new();
        // Writing to a string cannot fail; what cannot be shown is shown as far as it went.
        let _ = write!(text, "{value:?}");
        self.say(field, cut(text).into());
    }

    fn record_str(&mut self, field: &Field, value: &str) {
        self.say(field, cut(value.to_owned()).into());
    }

    fn record_f64(&mut self, field: &Field, value: f64) {
        self.say(field, value.into());
    }

    fn record_i64(&mut self, field: &Field, value: i64) {
        self.say(field, value.into());
    }

    fn record_u64(&mut self, field: &Field, value: u64) {
        self.say(field, value.into());
    }

    fn record_bool(&mut self, field: &Field, value: bool) {
        self.say(field, value.into());
    }
}

fn cut(mut text: String) -> String {
    if text.len() > LONGEST {
        let end = (0..=LONGEST).rev().find(|end| text.is_char_boundary(*end));
        text.truncate(end.unwrap_or_default());
        text.push('…');
    }
    text
}
