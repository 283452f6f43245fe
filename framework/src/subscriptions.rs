//! Which outputs of one instance somebody listens to.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// Counts the listeners of each name. Clones are the same subscriptions.
#[derive(Clone, Debug)]
pub struct Subscriptions {
    names: &'static [&'static str],
    listeners: Arc<Listeners>,
    /// How many changes this clone has seen.
    seen: u32,
}

#[derive(Debug)]
struct Listeners {
    /// Mostly nobody comes or goes: then this is all that an instance looks at.
    changes: AtomicU32,
    counts: Box<[AtomicU32]>,
}

impl Subscriptions {
    /// Nobody listens to any of these yet.
    pub fn new(names: &'static [&'static str]) -> Self {
        Self {
            names,
            listeners: Arc::new(Listeners {
                changes: AtomicU32::new(0),
                counts: names.iter().map(|_| AtomicU32::new(0)).collect(),
            }),
            seen: 0,
        }
    }

    /// One listener more; `false` if nothing has this name. Counts from the instance's next `begin` on.
    pub fn subscribe(&self, name: &str) -> bool {
        let count = self.count_of(name);
        count
            .inspect(|count| {
                count.fetch_add(1, Ordering::Relaxed);
                self.change();
            })
            .is_some()
    }

    /// One listener less; harmless where there is none.
    pub fn unsubscribe(&self, name: &str) {
        if let Some(count) = self.count_of(name) {
            let one_less = |count: u32| count.checked_sub(1);
            // Fails exactly if there is no listener.
            let _ = count.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_less);
            self.change();
        }
    }

    /// Whether anybody came or went since this was last asked: one atomic load.
    #[inline]
    pub fn changed(&mut self) -> bool {
        // Acquire: with the change come the counts before it.
        let changes = self.listeners.changes.load(Ordering::Acquire);
        std::mem::replace(&mut self.seen, changes) != changes
    }

    /// Whether somebody listens, name after name in the order of [`Subscriptions::names`].
    #[inline]
    pub fn wanted(&self) -> Wanted<'_> {
        Wanted(self.listeners.counts.iter())
    }

    /// All that can be listened to.
    pub fn names(&self) -> &'static [&'static str] {
        self.names
    }

    fn count_of(&self, name: &str) -> Option<&AtomicU32> {
        let index = self.names.iter().position(|known| *known == name)?;
        self.listeners.counts.get(index)
    }

    fn change(&self) {
        // Release: who sees it sees the new count.
        self.listeners.changes.fetch_add(1, Ordering::Release);
    }
}

/// Answers for one name after the other. Generated code asks in the order in which it gave the names.
#[derive(Debug)]
pub struct Wanted<'a>(std::slice::Iter<'a, AtomicU32>);

impl Wanted<'_> {
    /// Whether somebody listens to the next name: one atomic load. `false` behind the last.
    #[inline]
    pub fn next_one(&mut self) -> bool {
        let listeners = self.0.next();
        listeners.is_some_and(|listeners| listeners.load(Ordering::Relaxed) > 0)
    }
}
