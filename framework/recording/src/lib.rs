//! Recordings of a robot.
//!
//! ```text
//!   cycler --- Track: frames into a block of its own ---\
//!   cycler --- Track ------------------------------------> full blocks -> writer thread -> chunks -> file
//!                 ^--------------- empty blocks <---------------------------/
//! ```
//!
//! A cycler encodes what a cycle took and gave into a block that nobody else has, and hands the block over when it is full or
//! old. It never waits: without an empty block its frames are dropped and counted. One thread owns the file.
//!
//! The file is that of [`hulkgen_mcap`]. A block is never divided between two chunks, so a reader that has one chunk has
//! everything that the frames in it refer to.

mod block;
mod pool;
mod recorder;
mod rewrite;
mod track;

pub use block::{Full, Writing};
pub use hulkgen_mcap::{
    Attachment, Channel, ChannelId, Chunk, Contents, Description, Message, Metadata, ReadError,
    Recording, RecordingFile, Schema, Storage, Way, Writer, layout,
};
pub use recorder::{Ended, Recorder, Settings};
pub use rewrite::{Rewrite, Rewrites};
pub use track::{Counts, Frame, Recorded, Track};
