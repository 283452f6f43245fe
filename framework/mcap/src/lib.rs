//! Recordings as files.
//!
//! The file is an [MCAP](https://mcap.dev/spec) file. A budget makes it a ring: the oldest chunks become records of a private
//! kind, which all readers skip, and give their place on the disk back. It is read however it ended, one chunk at a time.
//!
//! Invariant: nothing here needs the types of a robot; what a robot wrote tells its [`Layout`] beside it.

mod file;
mod fnv;
mod format;
mod index;
pub mod layout;
mod open;
mod read;
mod recover;
mod ring;
mod storage;

pub use file::{Attachment, Channel, ChannelId, Description, Metadata, Schema, Writer};
pub use fnv::fnv;
pub use format::{MESSAGE_HEAD, RECORD_HEAD, opcode, split_messages};
pub use layout::Layout;
pub use open::{ChunkPlace, Contents, RecordingFile};
pub use read::{Chunk, Message, ReadError, Recording, Way};
pub use recover::{Recovered, recover};
pub use storage::Storage;
