//! Writes down every ship once, in order of the times at which they were seen, and says which may still be preceded.

use framework::{LatestInput, MainOutput, Parameter, PerceptionInput, Result, context};
use serde::{Deserialize, Serialize};

use crate::types::{Entry, Ship};

/// The last pages.
#[derive(Debug, Deserialize, Serialize)]
pub struct Book {
    entries: Vec<Entry>,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    ships: PerceptionInput<Ship, "Lookout", "ship">,
    newest: LatestInput<Ship, "LookoutNorth", "ship">,
    #[reflect(range = 1..=10_000)]
    pages: Parameter<u32, "book.pages">,
}

#[context]
pub struct MainOutputs {
    entries: MainOutput<Vec<Entry>>,
    provisional: MainOutput<Vec<Entry>>,
    newest_in_the_north: MainOutput<Option<Entry>>,
}

impl Book {
    /// Never fails.
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self {
            entries: Vec::new(),
        })
    }

    /// What is persistent stays, what is transient is written on a loose sheet.
    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        let entry = |(at, ship): (framework::Timestamp, &Ship)| Entry {
            time: at.as_nanos(),
            number: ship.number,
        };
        self.entries
            .extend(context.ships.persistent.iter().map(entry));
        let pages = usize::try_from(*context.pages).unwrap_or(usize::MAX);
        let surplus = self.entries.len().saturating_sub(pages);
        self.entries.drain(..surplus);
        let provisional: Vec<Entry> = context.ships.transient.iter().map(entry).collect();
        let newest = context.newest.as_ref();
        let newest = newest.map(|newest| entry((newest.timestamp, newest.value)));
        Ok(MainOutputs {
            entries: self.entries.clone().into(),
            provisional: provisional.into(),
            newest_in_the_north: newest.into(),
        })
    }
}
