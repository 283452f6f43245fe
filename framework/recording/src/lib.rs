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
//! The file is an [MCAP](https://mcap.dev/spec) file. A block is never divided between two chunks, so a reader that has one
//! chunk has everything that the frames in it refer to. A budget makes the file a ring: the oldest chunks become records of
//! a private kind, which all readers skip, and give their place on the disk back.

mod block;
mod file;
mod format;
mod pool;
mod read;
mod recorder;
mod ring;
mod track;

pub use block::{Full, Writing};
pub use file::{Attachment, Channel, ChannelId, Description, Metadata, Schema};
pub use read::{Chunk, Message, ReadError, Recording, Way};
pub use recorder::{Ended, Recorder, Settings};
pub use track::{Counts, Frame, Recorded, Track};
