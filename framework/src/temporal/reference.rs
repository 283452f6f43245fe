//! What a cycle read of other instances, by number instead of by value.

use crate::buffer::Reader;
use crate::time::Timestamp;

/// A read of another instance: enough to find the value again in a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference {
    /// The instance that wrote it.
    pub instance: &'static str,
    /// Number of the cycle that wrote it; 0 where none had.
    pub cycle: u64,
    /// How it was read.
    pub kind: ReferenceKind,
}

/// How a cycle of another instance was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReferenceKind {
    /// As the newest.
    Latest,
    /// In order, for the last time.
    Persistent {
        /// Its place in the order.
        order: Timestamp,
    },
    /// In order, and again in the next cycle.
    Transient {
        /// Its place in the order.
        order: Timestamp,
    },
}

impl<T> Reader<T> {
    /// Which cycle of `instance` the reading cycle sees, for a recording.
    pub fn references(&self, instance: &'static str, visit: &mut dyn FnMut(Reference)) {
        let cycle = self.view().cycle();
        visit(Reference {
            instance,
            cycle,
            kind: ReferenceKind::Latest,
        });
    }
}
