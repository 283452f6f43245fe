//! Reading a recording, however it ended.

use std::fmt;
use std::io::{self, Read as _};
use std::path::Path;
use std::sync::Arc;

use crate::file::{Attachment, Channel, Metadata, Schema};
use crate::format::{COMPRESSION, Take, opcode};
use crate::index;
use crate::open::{Contents, RecordingFile};

/// No chunk says that it is larger when it is not compressed.
const LARGEST_CHUNK: u64 = 1 << 30;

/// A file that was read into memory: whole chunks in the order of the file.
#[derive(Debug, Default)]
pub struct Recording {
    pub schemas: Vec<(u16, Schema)>,
    /// By their numbers in the file.
    pub channels: Vec<(u16, Channel)>,
    pub metadata: Vec<Metadata>,
    pub attachments: Vec<Attachment>,
    pub chunks: Vec<Chunk>,
    /// How many chunks the ring closed over.
    pub gone: u64,
    /// Offsets of chunks that are not what was written; those behind them are read.
    pub damaged: Vec<u64>,
    /// Offsets of metadata and attachments that are not what was written, and not among those above.
    pub unreadable: Vec<u64>,
    pub way: Way,
}

/// How the file ends.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Way {
    /// With all that belongs to the end of a file.
    #[default]
    Whole,
    /// It breaks off, or something else stands there, behind so many bytes.
    Cut { behind: u64 },
}

/// Some messages that can be understood without any other chunk. Clones share them.
#[derive(Clone, Debug)]
pub struct Chunk {
    /// Offset of its record in the file.
    pub offset: u64,
    /// Not compressed.
    bytes: Arc<Vec<u8>>,
}

/// One message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message<'chunk> {
    /// Number of its channel in the file.
    pub channel: u16,
    pub sequence: u32,
    /// In nanoseconds of the run.
    pub time: u64,
    pub data: &'chunk [u8],
}

/// Why there is nothing to read.
#[derive(Debug)]
pub enum ReadError {
    Disk(io::Error),
    /// It does not begin as an MCAP file does.
    Other,
    /// The chunk at this place is not what was written.
    Damaged {
        offset: u64,
    },
}

impl Recording {
    /// Reads a file up to where it breaks off, without chunks that are damaged, all of it into memory; [`RecordingFile`] does not.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let file = RecordingFile::open(path)?;
        let mut chunks = Vec::new();
        let mut damaged = file.contents().damaged.clone();
        for place in &file.contents().chunks {
            match file.chunk(place) {
                Ok(chunk) => chunks.push(chunk),
                Err(ReadError::Damaged { offset }) => damaged.push(offset),
                Err(error) => return Err(error),
            }
        }
        let contents = file.into_contents();
        Ok(Self {
            damaged,
            ..Self::of(contents, chunks)
        })
    }

    /// As [`open`](Self::open), of the file's bytes.
    pub fn read(bytes: &[u8]) -> Result<Self, ReadError> {
        let mut chunks = Vec::new();
        let contents = index::scan(&bytes, &mut |chunk| chunks.push(chunk))?;
        Ok(Self::of(contents, chunks))
    }

    fn of(contents: Contents, chunks: Vec<Chunk>) -> Self {
        Self {
            schemas: contents.schemas,
            channels: contents.channels,
            metadata: contents.metadata,
            attachments: contents.attachments,
            chunks,
            gone: contents.gone,
            damaged: contents.damaged,
            unreadable: contents.unreadable,
            way: contents.way,
        }
    }

    /// The metadata of this name that was written last.
    pub fn metadata(&self, name: &str) -> Option<&Metadata> {
        self.metadata.iter().rfind(|one| one.name == name)
    }

    /// Whether the run ended and everything was recorded.
    pub fn is_complete(&self) -> bool {
        let is_as_written = self.damaged.is_empty() && self.unreadable.is_empty();
        self.way == Way::Whole && is_as_written && is_said_complete(self.metadata("end"))
    }
}

/// Whether the metadata `end` says that everything was recorded.
pub(crate) fn is_said_complete(end: Option<&Metadata>) -> bool {
    let state = end.and_then(|end| end.get("state"));
    state == Some("COMPLETE")
}

impl Metadata {
    /// The text of this name.
    pub fn get(&self, name: &str) -> Option<&str> {
        let entry = self.entries.iter().find(|(key, _)| key == name);
        entry.map(|(_, value)| value.as_str())
    }
}

pub(crate) fn schema(rest: &mut Take<'_>) -> Option<(u16, Schema)> {
    let id = rest.u16()?;
    let (name, encoding) = (rest.text()?.to_owned(), rest.text()?.to_owned());
    let length = rest.u32()?;
    let data = rest.bytes(length as usize)?.to_vec();
    let schema = Schema {
        name,
        encoding,
        data,
    };
    Some((id, schema))
}

pub(crate) fn channel(rest: &mut Take<'_>) -> Option<(u16, Channel)> {
    let (id, schema) = (rest.u16()?, rest.u16()?);
    let channel = Channel {
        topic: rest.text()?.to_owned(),
        schema: (schema != 0).then_some(schema),
        encoding: rest.text()?.to_owned(),
        metadata: rest.map()?,
        once_per_chunk: false,
    };
    Some((id, channel))
}

pub(crate) fn attachment(content: &[u8]) -> Option<Attachment> {
    let (covered, sum) = content.split_at_checked(content.len().checked_sub(4)?)?;
    if crc32fast::hash(covered) != Take(sum).u32()? {
        return None;
    }
    let mut rest = Take(covered);
    rest.bytes(16)?;
    let (name, media_type) = (rest.text()?.to_owned(), rest.text()?.to_owned());
    let length = usize::try_from(rest.u64()?).ok()?;
    Some(Attachment {
        name,
        media_type,
        data: rest.bytes(length)?.to_vec(),
    })
}

/// The messages of a chunk whose check sum is right.
fn messages(rest: &mut Take<'_>) -> Option<Vec<u8>> {
    rest.bytes(16)?;
    let uncompressed = rest.u64().filter(|bytes| *bytes <= LARGEST_CHUNK)?;
    let sum = rest.u32()?;
    let compression = rest.text()?;
    let length = usize::try_from(rest.u64()?).ok()?;
    let records = rest.bytes(length)?;
    let bytes = match compression {
        "" => records.to_vec(),
        COMPRESSION => {
            let mut bytes = Vec::new();
            let decoder = lz4_flex::frame::FrameDecoder::new(records);
            decoder
                .take(uncompressed + 1)
                .read_to_end(&mut bytes)
                .ok()?;
            bytes
        }
        _ => return None,
    };
    let is_whole = bytes.len() as u64 == uncompressed && crc32fast::hash(&bytes) == sum;
    is_whole.then_some(bytes)
}

impl Chunk {
    /// From the content of its record, if the check sum is right.
    pub(crate) fn understood(content: &[u8], offset: u64) -> Option<Self> {
        let bytes = Arc::new(messages(&mut Take(content))?);
        Some(Self { offset, bytes })
    }

    /// Bytes of its messages, not compressed.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// In the order in which they were written.
    pub fn messages(&self) -> impl Iterator<Item = Message<'_>> {
        self.placed_messages().map(|(_, message)| message)
    }

    /// The same, each with the place among [`bytes`](Self::bytes) where its data begin.
    pub fn placed_messages(&self) -> impl Iterator<Item = (usize, Message<'_>)> {
        let mut rest = Take(&self.bytes);
        std::iter::from_fn(move || {
            loop {
                let (opcode, content) = rest.record()?;
                if opcode != opcode::MESSAGE {
                    continue;
                }
                let mut head = Take(content);
                let (channel, sequence, time) = (head.u16()?, head.u32()?, head.u64()?);
                head.u64()?;
                let data = head.0;
                // They end where the next record begins.
                let place = self.bytes.len() - rest.0.len() - data.len();
                return Some((
                    place,
                    Message {
                        channel,
                        sequence,
                        time,
                        data,
                    },
                ));
            }
        })
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Disk(error) => write!(formatter, "{error}"),
            Self::Other => formatter.write_str("it is no MCAP file"),
            Self::Damaged { offset } => {
                write!(formatter, "the chunk at byte {offset} is damaged")
            }
        }
    }
}

impl std::error::Error for ReadError {}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        Self::Disk(error)
    }
}
