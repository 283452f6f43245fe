//! Recordings of a robot.
//!
//! ```text
//!   cycler --- Track: frames into a block of its own ---\
//!   cycler --- Track ------------------------------------> full blocks -> writer thread -> chunks -> file
//!                 ^--------------- empty blocks <---------------------------/
//! ```
//!
//! A cycler encodes what a cycle took and gave into a block that nobody else has meanwhile, and hands the block over when it is
//! full or old. Values of which it has handles, as images, it leaves to the writer ([`Late`]). It never waits: without an empty
//! block its frames are dropped and counted. One thread owns the file.
//!
//! Between two messages a block that was begun lies in its track's place, from where the writer takes it if the track has had no
//! frame for long. So a cycle that hangs keeps no frame to itself; its end then stands alone in a block.
//!
//! The file is that of [`hulkgen_mcap`]. A block is never divided between two chunks, so a reader that has one chunk has
//! everything that the frames in it refer to; of a frame whose end came later it may lack that end.

mod block;
mod late;
mod pool;
mod recorder;
mod rewrite;
mod track;

pub use block::{Full, Writing};
pub use hulkgen_mcap::{
    Attachment, Channel, ChannelId, Chunk, ChunkPlace, Contents, Description, Message, Metadata,
    ReadError, Recording, RecordingFile, Schema, Storage, Way, Writer, layout,
};
pub use late::Late;
pub use recorder::{Ended, Recorder, Settings};
pub use rewrite::{Rewrite, Rewrites, Rewritten};
pub use track::{Counts, Frame, Recorded, Track};
