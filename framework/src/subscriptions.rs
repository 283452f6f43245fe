//! Which outputs of one instance somebody listens to.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// Counts the listeners of each name. Clones are the same subscriptions.
#[derive(Clone, Debug)]
pub struct Subscriptions {
    names: &'static [&'static str],
    listeners: Arc<[AtomicU32]>,
}

impl Subscriptions {
    /// Nobody listens to any of these yet.
    pub fn new(names: &'static [&'static str]) -> Self {
        Self {
            names,
            listeners: names.iter().map(|_| AtomicU32::new(0)).collect(),
        }
    }

    /// One listener more; `false` if nothing has this name. Counts from the instance's next `begin` on.
    pub fn subscribe(&self, name: &str) -> bool {
        let listeners = self.listeners_of(name);
        listeners
            .inspect(|listeners| _ = listeners.fetch_add(1, Ordering::Relaxed))
            .is_some()
    }

    /// One listener less; harmless where there is none.
    pub fn unsubscribe(&self, name: &str) {
        if let Some(listeners) = self.listeners_of(name) {
            // Fails exactly if there is no listener.
            let _ = listeners.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |count| {
                count.checked_sub(1)
            });
        }
    }

    /// Whether somebody listens, name after name in the order of [`Subscriptions::names`].
    #[inline]
    pub fn wanted(&self) -> Wanted<'_> {
        Wanted(self.listeners.iter())
    }

    /// All that can be listened to.
    pub fn names(&self) -> &'static [&'static str] {
        self.names
    }

    fn listeners_of(&self, name: &str) -> Option<&AtomicU32> {
        let index = self.names.iter().position(|known| *known == name)?;
        self.listeners.get(index)
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
