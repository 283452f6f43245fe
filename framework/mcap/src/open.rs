//! A file whose chunks are read one at a time.

use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt as _;
use std::path::Path;

use crate::file::{Attachment, Channel, Metadata, Schema};
use crate::format::RECORD_HEAD;
use crate::index;
use crate::read::{Chunk, ReadError, Way, is_said_complete};

/// A file of which only the list of its chunks is in memory.
#[derive(Debug)]
pub struct RecordingFile {
    file: File,
    contents: Contents,
}

/// All of a file but its messages.
#[derive(Debug, Default)]
pub struct Contents {
    pub schemas: Vec<(u16, Schema)>,
    /// By their numbers in the file.
    pub channels: Vec<(u16, Channel)>,
    pub metadata: Vec<Metadata>,
    pub attachments: Vec<Attachment>,
    /// In the order of the file.
    pub chunks: Vec<ChunkPlace>,
    /// How many chunks the ring closed over.
    pub gone: u64,
    /// Offsets of chunks that are not what was written, where every record was looked at; [`RecordingFile::chunk`] finds others.
    pub damaged: Vec<u64>,
    /// Offsets of metadata and attachments that are not what was written, and not among those above.
    pub unreadable: Vec<u64>,
    pub way: Way,
    /// Whether the file's own index told it; else every record was looked at.
    pub is_indexed: bool,
}

/// Where a chunk lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChunkPlace {
    /// Offset of its record in the file.
    pub offset: u64,
    /// Bytes of its record.
    pub length: u64,
    /// Times of its first and last message, in nanoseconds of the run.
    pub times: (u64, u64),
}

impl RecordingFile {
    /// Reads the file's index, or, where it has none because it breaks off, every record up to there.
    ///
    /// # Errors
    /// If the disk fails, or it is no MCAP file.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let file = File::open(path)?;
        let contents = match index::summary(&file)? {
            Some(contents) => contents,
            None => index::scan(&file, &mut |_| {})?,
        };
        Ok(Self { file, contents })
    }

    /// Bytes of the file.
    ///
    /// # Errors
    /// If the disk fails.
    pub fn length(&self) -> io::Result<u64> {
        Source::length(&self.file)
    }

    /// All of it but the messages.
    pub fn contents(&self) -> &Contents {
        &self.contents
    }

    /// Without the file.
    pub fn into_contents(self) -> Contents {
        self.contents
    }

    /// Reads one chunk.
    ///
    /// # Errors
    /// If the disk fails, or the chunk is not what was written.
    pub fn chunk(&self, place: &ChunkPlace) -> Result<Chunk, ReadError> {
        let ChunkPlace { offset, length, .. } = *place;
        let record = Source::read_at(&self.file, offset, length)?;
        let content = record.get(RECORD_HEAD..).unwrap_or_default();
        Chunk::understood(content, offset).ok_or(ReadError::Damaged { offset })
    }
}

impl Contents {
    /// The metadata of this name that was written last.
    pub fn metadata(&self, name: &str) -> Option<&Metadata> {
        self.metadata.iter().rfind(|one| one.name == name)
    }

    /// The attachment of this name.
    pub fn attachment(&self, name: &str) -> Option<&Attachment> {
        self.attachments.iter().find(|one| one.name == name)
    }

    /// Whether the run ended and everything was recorded.
    pub fn is_complete(&self) -> bool {
        let is_as_written = self.damaged.is_empty() && self.unreadable.is_empty();
        self.way == Way::Whole && is_as_written && is_said_complete(self.metadata("end"))
    }
}

/// Bytes at any place.
pub(crate) trait Source {
    fn length(&self) -> io::Result<u64>;

    /// Exactly these bytes.
    fn read_at(&self, offset: u64, length: u64) -> io::Result<Vec<u8>>;
}

impl Source for File {
    fn length(&self) -> io::Result<u64> {
        Ok(self.metadata()?.len())
    }

    fn read_at(&self, offset: u64, length: u64) -> io::Result<Vec<u8>> {
        // Only what is there is reserved.
        let end = offset.checked_add(length);
        if end.is_none_or(|end| Source::length(self).is_ok_and(|all| end > all)) {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        let mut bytes = vec![0; usize::try_from(length).map_err(io::Error::other)?];
        self.read_exact_at(&mut bytes, offset)?;
        Ok(bytes)
    }
}

impl Source for &[u8] {
    fn length(&self) -> io::Result<u64> {
        Ok(self.len() as u64)
    }

    fn read_at(&self, offset: u64, length: u64) -> io::Result<Vec<u8>> {
        let start = usize::try_from(offset).ok();
        let end = offset.checked_add(length);
        let end = end.and_then(|end| usize::try_from(end).ok());
        let bytes = start.zip(end).and_then(|(start, end)| self.get(start..end));
        bytes
            .map(<[u8]>::to_vec)
            .ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
    }
}
