//! What was said when the recording was made: said again when the time passes it.

use std::collections::BTreeMap;

use hulkgen_recording::Recording;

use super::Moment;
use crate::logs::{Record, say_again};
use crate::recorded::{from_log, recorded_logs};
use crate::replay::Players;
use crate::report::tell;
use crate::time::Timestamp;

/// So many messages are said at once: more nobody reads, and those who listen have no room for them.
const MOST: usize = 500;

/// The messages of a recording.
#[derive(Default)]
pub(super) struct Said<'r> {
    /// In the order in which they are said.
    messages: Vec<Message<'r>>,
    /// Of a cycle, by instance and position: which of the messages.
    of_cycles: BTreeMap<(usize, usize), Vec<usize>>,
}

struct Message<'r> {
    /// How many moments have been once it was said: one of a cycle that was recorded belongs to that cycle.
    passed: usize,
    time: Timestamp,
    json: &'r [u8],
    /// Instance and position.
    cycle: Option<(usize, usize)>,
}

impl<'r> Said<'r> {
    /// Those of the recording with these cycles.
    pub(super) fn new(recording: &'r Recording, players: &Players<'_>, moments: &[Moment]) -> Self {
        let numbered = moments.iter().enumerate().map(|(index, moment)| {
            let player = &players.players[moment.instance];
            let number = player.frames[moment.position].head.number;
            ((player.instance, number), (index, moment))
        });
        let numbered: BTreeMap<_, _> = numbered.collect();
        let (mut messages, mut unreadable) = (Vec::new(), 0);
        for (time, json) in recorded_logs(recording) {
            let Some(record) = from_log(time, json) else {
                unreadable += 1;
                continue;
            };
            let cycle = record.instance.as_deref().zip(record.cycle);
            let found = cycle.and_then(|cycle| numbered.get(&cycle));
            messages.push(match found {
                Some((index, moment)) => Message {
                    passed: index + 1,
                    time,
                    json,
                    cycle: Some((moment.instance, moment.position)),
                },
                None => Message {
                    // What was said before everything else is said with it.
                    passed: moments.partition_point(|moment| moment.at <= time).max(1),
                    time,
                    json,
                    cycle: None,
                },
            });
        }
        if unreadable > 0 {
            tell(format_args!(
                "{unreadable} log messages of the recording cannot be read"
            ));
        }
        messages.sort_by_key(|message| (message.passed, message.time));
        let mut of_cycles: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for (index, message) in messages.iter().enumerate() {
            if let Some(cycle) = message.cycle {
                of_cycles.entry(cycle).or_default().push(index);
            }
        }
        Self {
            messages,
            of_cycles,
        }
    }

    /// What was said in a cycle.
    pub(super) fn of(&self, instance: usize, position: usize) -> Vec<Record> {
        let found = self.of_cycles.get(&(instance, position));
        let found = found.into_iter().flatten();
        let records = found.map(|index| self.messages[*index].record());
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
            heard.iter().for_each(Message::say);
        } else {
            let passed = &self.messages[until(to.saturating_sub(1))..until(from - 1)];
            let heard = &passed[..passed.len().min(MOST)];
            heard.iter().rev().for_each(Message::say);
        }
    }
}

impl Message<'_> {
    fn record(&self) -> Option<Record> {
        from_log(self.time, self.json)
    }

    fn say(&self) {
        if let Some(record) = self.record() {
            say_again(&record);
        }
    }
}
