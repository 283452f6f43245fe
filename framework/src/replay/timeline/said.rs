//! What was said when the recording was made: said again when the time passes it.

use std::cell::Cell;
use std::collections::BTreeMap;

use super::Moment;
use crate::logs::{Record, say_again};
use crate::recorded::from_log;
use crate::replay::shelf::Logged;
use crate::replay::{Players, Shelf};
use crate::report::tell;

/// So many messages are said at once: more nobody reads, and those who listen have no room for them.
const MOST: usize = 500;

/// The messages of a recording.
pub(super) struct Said<'r> {
    recording: &'r Shelf,
    /// In the order in which they are said.
    messages: Vec<Message<'r>>,
    /// Of a cycle, by instance and position: which of the messages.
    of_cycles: BTreeMap<(usize, usize), Vec<usize>>,
    /// Whether it was told that a message cannot be read: once says enough.
    is_told: Cell<bool>,
}

struct Message<'r> {
    /// How many moments have been once it was said: one of a cycle that was recorded belongs to that cycle.
    passed: usize,
    logged: &'r Logged,
    /// Instance and position.
    cycle: Option<(usize, usize)>,
}

impl<'r> Said<'r> {
    /// Nothing was said.
    pub(super) fn nothing(recording: &'r Shelf) -> Self {
        Self {
            recording,
            messages: Vec::new(),
            of_cycles: BTreeMap::new(),
            is_told: Cell::new(false),
        }
    }

    /// All that was, with these cycles.
    pub(super) fn new(recording: &'r Shelf, players: &Players<'_>, moments: &[Moment]) -> Self {
        let numbered = moments.iter().enumerate().map(|(index, moment)| {
            let player = &players.players[moment.instance];
            let number = player.frames[moment.position].head.number;
            ((player.instance, number), (index, moment))
        });
        let numbered: BTreeMap<_, _> = numbered.collect();
        let index = recording.index();
        let messages = index.logs.iter().map(|logged| {
            let cycle = logged.cycle;
            let cycle = cycle.map(|(speaker, cycle)| (&*index.speakers[speaker], cycle));
            match cycle.and_then(|cycle| numbered.get(&cycle)) {
                Some((index, moment)) => Message {
                    passed: index + 1,
                    logged,
                    cycle: Some((moment.instance, moment.position)),
                },
                None => Message {
                    // What was said before everything else is said with it.
                    passed: moments
                        .partition_point(|moment| moment.at <= logged.time)
                        .max(1),
                    logged,
                    cycle: None,
                },
            }
        });
        let mut messages: Vec<_> = messages.collect();
        let unreadable = index.unreadable_logs;
        if unreadable > 0 {
            tell(format_args!(
                "{unreadable} log messages of the recording cannot be read"
            ));
        }
        messages.sort_by_key(|message| (message.passed, message.logged.time));
        let mut of_cycles: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for (index, message) in messages.iter().enumerate() {
            if let Some(cycle) = message.cycle {
                of_cycles.entry(cycle).or_default().push(index);
            }
        }
        Self {
            messages,
            of_cycles,
            ..Self::nothing(recording)
        }
    }

    /// What was said in a cycle.
    pub(super) fn of(&self, instance: usize, position: usize) -> Vec<Record> {
        let found = self.of_cycles.get(&(instance, position));
        let found = found.into_iter().flatten();
        let records = found.map(|index| self.record(&self.messages[*index]));
        records.flatten().collect()
    }

    /// Says what time passes over that comes from so many moments to so many: backwards the newest first, and of too many
    /// those that are nearest to where it comes.
    pub(super) fn pass(&self, from: usize, to: usize) {
        // The moment that time comes to speaks; the one that it leaves has spoken.
        let until = |passed: usize| {
            self.messages
                .partition_point(|message| message.passed <= passed)
        };
        if from <= to {
            let passed = &self.messages[until(from)..until(to)];
            let heard = &passed[passed.len().saturating_sub(MOST)..];
            heard.iter().for_each(|message| self.say(message));
        } else {
            let passed = &self.messages[until(to.saturating_sub(1))..until(from - 1)];
            let heard = &passed[..passed.len().min(MOST)];
            heard.iter().rev().for_each(|message| self.say(message));
        }
    }

    fn say(&self, message: &Message<'_>) {
        if let Some(record) = self.record(message) {
            say_again(&record);
        }
    }

    fn record(&self, message: &Message<'_>) -> Option<Record> {
        let Logged {
            time, place, json, ..
        } = message.logged;
        if let Some(json) = json {
            return from_log(*time, json);
        }
        match self.recording.bytes(*place) {
            Ok(json) => from_log(*time, &json),
            Err(error) => {
                if !self.is_told.replace(true) {
                    tell(format_args!("what was said cannot be said again: {error}"));
                }
                None
            }
        }
    }
}
