//! The framework's buffer, and what consumes from it, once more with loom's atomics and cells in
//! place of the real ones, so that tests can run every interleaving of the threads and everything
//! the orderings permit.

/// Only the timestamp, as the buffer names it.
mod time {
    pub(crate) use framework::Timestamp;
}

/// The sources of `framework::buffer`.
#[path = "../../src/buffer"]
pub mod buffer {
    mod create;
    mod queue;
    mod reader;
    mod slots;
    #[path = "../../loom/src/sync.rs"]
    mod sync;
    mod view;
    mod word;
    mod writer;

    pub use create::{buffer, buffer_of};
    pub use queue::Queue;
    pub use reader::Reader;
    pub use slots::Entry;
    pub use view::{Latest, View};
    pub use writer::Writer;
}

/// The sources of `framework::temporal` that a real-time cycle calls.
#[path = "../../src/temporal"]
pub mod temporal {
    mod consumer;
    mod horizon;
    mod reference;
    mod series;

    pub use consumer::{Consumer, Projection, QueueCounts};
    pub use horizon::{Bounds, Horizon, Lane};
    pub use reference::{Reference, ReferenceKind};
    pub use series::{Item, Items, Iter, PerceptionInput, Series, Timeline};
}
