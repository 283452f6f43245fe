//! The slots that one cycler instance writes in place and others read in place.
//!
//! A slot is one database. One atomic word per slot says which cycle it holds, which consumers have
//! it queued and how many readers hold it. One number per consumer says up to which cycle it has
//! released what it took. Together they decide about access, and nobody ever waits for anybody.
//!
//! ```text
//!              claim (held == 0, released, not the newest)   publish
//!   published -----------------------------------> writing ----------> published, queued for all
//!   published -- a reader holds the newest (held + 1) -> held  -- lets go (held - 1)
//!   queued    -- a consumer takes it (its bit is cleared) -> taken -- released passes its number
//! ```
//!
//! A consumer takes in order and releases in order, so one number is enough, and letting go costs
//! it a store where a reader needs a read-modify-write.
//!
//! # Invariants
//!
//! 1. A slot that somebody holds is never claimed, so what is held does not change. A consumer holds
//!    what is not queued for it and what it has not released.
//! 2. The newest slot is never claimed, so there always is one to read.
//! 3. A hold names the sequence number it wants: nobody gets a slot that was written again.
//! 4. A reader holds one slot, a consumer at most its window.
//! 5. What was announced and is not announced any more is abandoned or can be taken.
//!
//! # Number of slots
//!
//! `2 + readers + sum(windows)` suffice: one is being written, one is the newest, and by invariant
//! 4 the parties hold at most `readers + sum(windows)` others. When the writer publishes, the slot
//! it wrote becomes the newest, so at least one slot is neither the newest nor held. The writer
//! prefers one that nobody has queued, else it takes the oldest that is only queued.
//!
//! *The writer does not wait.* Its search fails only where somebody took hold in the meantime.
//! While it searches nothing is published, so each reader that looks again finds the newest, which
//! the writer does not want, and each consumer takes each queued slot once: the search is bounded.
//!
//! *Readers are lock-free.* A hold fails only where the writer or another party made progress.
//!
//! *What a consumer can lose.* While it holds `h` of its window `w`, all others hold at most their
//! share, so `w - h` slots and the newest are left to the newest cycles: the writer takes what
//! nobody has queued, and else the oldest that nobody holds. A consumer loses cycles only where
//! more than `w - h + 1` complete between two of its looks, and then the oldest of them; it sees
//! the gap in the sequence numbers and counts it.
//!
//! # Orderings
//!
//! The word and the consumers' numbers protect the value, as a lock would:
//!
//! - *publish* stores the word with `Release`, *hold* and *take* change it with `Acquire`: who
//!   holds a slot sees everything that was written into it. Changes by other parties in between
//!   are read-modify-writes, which continue the release sequence.
//! - *let go* changes the word with `Release`, *claim* with `Acquire`: what readers read happens
//!   before the writer writes there again, through the same kind of release sequence. A consumer
//!   stores its number with `Release`, and *claim* loads it with `Acquire`.
//! - *claim* changes the word only as long as it is what was looked at: a consumer that takes and a
//!   reader that holds in between change it. Where there are no readers and nobody has the slot
//!   queued, the writer alone changes the word, and a store is enough.
//!
//! The other atomics only say where to look, and what they promise must be there:
//!
//! - `newest` and `completed` are stored with `Release` after the word and loaded with `Acquire`:
//!   the slot they name is published for whoever sees them, so that a failed hold means progress.
//!   `newest` carries the sequence number, for invariant 3; one atomic never goes back in time,
//!   hence a reader never does. `by_sequence` is relaxed under the cover of `completed`.
//! - `announced` is stored with `Release` (also by the next announcement, and when it is
//!   withdrawn) after `completed`, and consumers load it with `Acquire` before `completed`. So
//!   whoever does not see an announcement any more sees what became of it: invariant 5.

mod create;
mod queue;
mod reader;
mod slots;
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
