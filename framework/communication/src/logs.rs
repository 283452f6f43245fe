//! Log messages: fetched from where instances leave them, numbered, and kept for those who come late.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::iter;
use std::sync::Arc;

use framework::Clock;
use framework::logs::{self, Rates, Record, Sink};
use protocol::{Level, Log};

use crate::limits::Limits;

/// Taken at once: whoever says more than this thread can take must not keep it from everything else.
const AT_ONCE: usize = 1024;

/// The messages of the run.
pub(crate) struct Logs {
    sink: Arc<Sink>,
    /// Oldest first.
    kept: VecDeque<Log>,
    /// Messages so far, those that were left out, too.
    number: u64,
    rates: Rates,
}

impl Logs {
    pub(crate) fn new(clock: Clock) -> Self {
        Self {
            sink: Sink::new(clock),
            kept: VecDeque::new(),
            number: 0,
            rates: Rates::default(),
        }
    }

    /// What was said since the last time; of a module that says too much a part. `nodes` are all nodes of the robot.
    pub(crate) fn fetch(&mut self, nodes: &[&'static str], limits: &Limits) -> Vec<Log> {
        let mut new = Vec::new();
        self.number += self.sink.left_out();
        for record in iter::from_fn(|| self.sink.take()).take(AT_ONCE) {
            self.number += 1;
            if self.rates.is_allowed(&record, limits.logs_per_second) {
                new.push(describe(record, self.number, nodes));
            }
        }
        self.kept.extend(new.iter().cloned());
        let surplus = self.kept.len().saturating_sub(limits.kept_logs);
        self.kept.drain(..surplus);
        new
    }

    /// The newest messages, oldest first.
    pub(crate) fn kept(&self) -> impl Iterator<Item = &Log> {
        self.kept.iter()
    }

    pub(crate) fn set_level(&self, of: Option<(&str, Option<&str>)>, level: Level) {
        self.sink.set_level(of, level_of(level));
    }
}

fn describe(record: Record, number: u64, nodes: &[&'static str]) -> Log {
    let within = nodes
        .iter()
        .filter(|node| logs::is_within(&record.module, node));
    let node = within.max_by_key(|node| node.len());
    let mut fields = record.fields;
    if node.is_none() {
        fields.insert("module".to_owned(), record.module.into_owned().into());
    }
    Log {
        number,
        time: record.time.as_nanos(),
        level: match record.level {
            logs::Level::TRACE => Level::Trace,
            logs::Level::DEBUG => Level::Debug,
            logs::Level::INFO => Level::Info,
            logs::Level::WARN => Level::Warn,
            logs::Level::ERROR => Level::Error,
        },
        instance: record.instance.map(Cow::into_owned),
        node: node.map(|node| (*node).to_owned()),
        cycle: record.cycle,
        message: record.message,
        fields,
    }
}

fn level_of(level: Level) -> logs::Level {
    match level {
        Level::Trace => logs::Level::TRACE,
        Level::Debug => logs::Level::DEBUG,
        Level::Info => logs::Level::INFO,
        Level::Warn => logs::Level::WARN,
        Level::Error => logs::Level::ERROR,
    }
}
