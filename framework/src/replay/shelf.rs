//! The chunks of a recording: where what they have lies is known of all of them, in memory are those that were needed last.
//!
//! Invariant: no more than [`MOST`] bytes of chunks are kept, or one chunk that alone is larger.

mod index;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;

use hulkgen_recording::{Chunk, ChunkPlace, Contents, ReadError, Recording, RecordingFile};

use super::OtherParameters;
use crate::error::{Error, Result};
use crate::recorded::{Stored, channel_of};
pub use index::Frame;
pub(super) use index::{Index, Logged, Place};

/// So many bytes of chunks are kept. Chunks have 4 MiB: a timeline that stands still shows a cycle of each instance ten times a
/// second, each perhaps of another chunk, and there is room for those of 16 instances.
const MOST: usize = 64 << 20;

/// A recording of which some chunks are in memory.
#[derive(Debug)]
pub struct Shelf {
    source: Source,
    index: Index,
    /// Offsets of chunks that are not what was written.
    damaged: Vec<u64>,
    kept: RefCell<Kept>,
}

/// Where chunks come from.
#[derive(Debug)]
enum Source {
    /// Those of these places.
    File(RecordingFile, Vec<ChunkPlace>),
    Memory(Contents, Vec<Chunk>),
}

/// Chunks that were needed last.
#[derive(Debug)]
struct Kept {
    /// With the time at which it was needed, counted in questions.
    chunks: BTreeMap<usize, (u64, Chunk)>,
    questions: u64,
    /// Of the chunks.
    bytes: usize,
    /// There may be so many.
    most: usize,
    /// There were so many.
    most_held: usize,
    /// How often one was read.
    reads: u64,
}

impl Shelf {
    /// Of a file: reads it once.
    ///
    /// # Errors
    /// If it cannot be read, is no recording, or one of another version.
    pub fn open(path: &Path) -> Result<Self> {
        let unread = |error: ReadError| Error::new(error.to_string());
        let file = RecordingFile::open(path).map_err(unread)?;
        let contents = file.contents();
        let mut index = Index::new(contents)?;
        let mut damaged = contents.damaged.clone();
        let mut places = Vec::new();
        for place in &contents.chunks {
            match file.chunk(place) {
                Ok(chunk) => {
                    index.add(&chunk);
                    places.push(*place);
                }
                Err(ReadError::Damaged { offset }) => damaged.push(offset),
                Err(error) => return Err(unread(error)),
            }
        }
        Ok(Self::new(Source::File(file, places), index, damaged))
    }

    /// Of what is in memory already.
    ///
    /// # Errors
    /// If it is a recording of another version.
    pub fn of(recording: &Recording) -> Result<Self> {
        let contents = Contents {
            schemas: recording.schemas.clone(),
            channels: recording.channels.clone(),
            metadata: recording.metadata.clone(),
            attachments: recording.attachments.clone(),
            gone: recording.gone,
            damaged: recording.damaged.clone(),
            unreadable: recording.unreadable.clone(),
            way: recording.way.clone(),
            ..Contents::default()
        };
        let mut index = Index::new(&contents)?;
        for chunk in &recording.chunks {
            index.add(chunk);
        }
        let source = Source::Memory(contents, recording.chunks.clone());
        Ok(Self::new(source, index, recording.damaged.clone()))
    }

    fn new(source: Source, index: Index, damaged: Vec<u64>) -> Self {
        Self {
            source,
            index,
            damaged,
            kept: RefCell::new(Kept {
                chunks: BTreeMap::new(),
                questions: 0,
                bytes: 0,
                most: MOST,
                most_held: 0,
                reads: 0,
            }),
        }
    }

    /// Keeps so many bytes of chunks in place of 64 MiB, and always the one that was needed last.
    pub fn keeping(mut self, bytes: usize) -> Self {
        self.kept.get_mut().most = bytes;
        self
    }

    /// How many bytes of chunks were kept at once, at most.
    pub fn most_held(&self) -> usize {
        self.kept.borrow().most_held
    }

    /// How often a chunk was read since it was opened.
    pub fn reads(&self) -> u64 {
        self.kept.borrow().reads
    }

    /// All of the recording but the messages.
    pub fn contents(&self) -> &Contents {
        match &self.source {
            Source::File(file, _) => file.contents(),
            Source::Memory(contents, _) => contents,
        }
    }

    /// Offsets of chunks that are not what was written: what they had is not there.
    pub fn damaged(&self) -> &[u64] {
        &self.damaged
    }

    /// Whether the run ended and everything was recorded.
    pub fn is_complete(&self) -> bool {
        self.damaged.is_empty() && self.contents().is_complete()
    }

    /// What lies where.
    pub(super) fn index(&self) -> &Index {
        &self.index
    }

    /// A chunk, by its place among those that are not damaged.
    pub(super) fn chunk(&self, number: usize) -> Result<Chunk> {
        let bytes = self.index.bytes_of(number);
        let mut kept = self.kept.borrow_mut();
        if let Some(found) = kept.find(number) {
            return Ok(found);
        }
        kept.make_room(bytes);
        let chunk = self.read(number)?;
        kept.add(number, &chunk);
        Ok(chunk)
    }

    fn read(&self, number: usize) -> Result<Chunk> {
        let (file, places) = match &self.source {
            Source::File(file, places) => (file, places),
            Source::Memory(_, chunks) => return Ok(chunks[number].clone()),
        };
        let place = &places[number];
        let changed = |error: &str| {
            Error::new(format!(
                "the chunk at byte {} could be read when the recording was opened, and no longer can be ({error}): the file was changed meanwhile, or its disk fails; replay a copy that nobody writes",
                place.offset
            ))
        };
        let chunk = file
            .chunk(place)
            .map_err(|error| changed(&error.to_string()))?;
        match chunk.bytes().len() == self.index.bytes_of(number) {
            true => Ok(chunk),
            false => Err(changed("it is another one")),
        }
    }

    /// A copy of the bytes that lie there.
    pub(super) fn bytes(&self, place: Place) -> Result<Vec<u8>> {
        let chunk = self.chunk(place.chunk())?;
        Ok(place.part(&chunk)?.to_vec())
    }

    /// The channel of the values of an instance.
    pub(super) fn channel(&self, instance: &str) -> Option<u16> {
        channel_of(&self.index.channels, instance)
    }

    /// The values of this chunk, of which that is the content.
    pub(super) fn stored<'s>(
        &'s self,
        number: usize,
        chunk: &'s Chunk,
        other: Option<&'s OtherParameters>,
    ) -> Stored<'s> {
        Stored {
            channels: &self.index.channels,
            values: self.index.values_of(number),
            bytes: chunk.bytes(),
            other: other.map(OtherParameters::versions),
        }
    }
}

impl Kept {
    fn find(&mut self, number: usize) -> Option<Chunk> {
        self.questions += 1;
        let (needed, chunk) = self.chunks.get_mut(&number)?;
        *needed = self.questions;
        Some(chunk.clone())
    }

    /// Lets those go that were not needed for the longest time, until so many bytes have room.
    fn make_room(&mut self, bytes: usize) {
        while self.bytes + bytes > self.most {
            let oldest = self.chunks.iter().min_by_key(|(_, (needed, _))| *needed);
            let Some(number) = oldest.map(|(number, _)| *number) else {
                return;
            };
            if let Some((_, gone)) = self.chunks.remove(&number) {
                self.bytes -= gone.bytes().len();
            }
        }
    }

    fn add(&mut self, number: usize, chunk: &Chunk) {
        self.bytes += chunk.bytes().len();
        self.most_held = self.most_held.max(self.bytes);
        self.reads += 1;
        self.chunks.insert(number, (self.questions, chunk.clone()));
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use hulkgen_recording::{Channel, Description, Writer};

    use super::{MOST, Shelf};
    use crate::recorded::{VALUES, VERSION};

    /// More than there is room for.
    const CHUNKS: usize = 24;

    /// As many as a recorder puts into a chunk.
    const BYTES: usize = 4 << 20;

    /// A recording of such chunks, each with the value of one cycle: its number, again and again.
    fn recorded(folder: &Path, chunks: usize, bytes: usize) -> PathBuf {
        let path = folder.join(format!("{bytes}.mcap"));
        let channel = Channel {
            topic: "values/Eye".to_owned(),
            schema: None,
            encoding: VALUES.to_owned(),
            metadata: vec![("version".to_owned(), VERSION.to_string())],
            once_per_chunk: true,
        };
        let description = Description {
            channels: vec![channel],
            ..Description::default()
        };
        let mut writer = Writer::create(&path, description, u64::MAX).expect("it is new");
        for number in 0..chunks {
            let mut content = 1_u16.to_le_bytes().to_vec();
            content.extend((number as u32).to_le_bytes());
            content.extend([0; 16]);
            content.resize(content.len() + bytes, number as u8);
            let mut message = vec![5];
            message.extend((content.len() as u64).to_le_bytes());
            message.extend(content);
            writer.add(&message);
            writer.close_chunk().expect("there is room");
        }
        writer.finish().expect("there is room");
        path
    }

    /// Takes every chunk out, one after the other.
    fn read_through(shelf: &Shelf) {
        let channel = shelf.channel("Eye").expect("it was recorded");
        for number in 0..CHUNKS {
            let value = (channel, number as u32);
            let place = shelf.index().value(number, value);
            let value = shelf.bytes(place.expect("each chunk has one"));
            let value = value.expect("nobody changed the file");
            assert!(value.len() == BYTES && value.iter().all(|byte| usize::from(*byte) == number));
        }
    }

    #[test]
    fn of_a_recording_for_which_there_is_no_room_the_chunks_needed_last_are_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = recorded(folder.path(), CHUNKS, BYTES);
        let shelf = Shelf::open(&path).expect("it is a recording");
        read_through(&shelf);
        read_through(&shelf);
        let most = shelf.most_held();
        assert!(
            (MOST - 2 * BYTES..=MOST).contains(&most),
            "{most} bytes were kept"
        );
        assert_eq!(shelf.reads(), 2 * CHUNKS as u64);

        // The same count sees it where nothing goes.
        let all = Shelf::open(&path).expect("it is a recording");
        let all = all.keeping(usize::MAX);
        read_through(&all);
        read_through(&all);
        assert!(all.most_held() > CHUNKS * BYTES && CHUNKS * BYTES > MOST);
        assert_eq!(all.reads(), CHUNKS as u64);
    }

    #[test]
    fn chunks_that_are_needed_again_and_again_are_read_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = recorded(folder.path(), CHUNKS, BYTES);
        let shelf = Shelf::open(&path).expect("it is a recording");
        for round in 0..10 {
            // One comes that nobody needs again.
            for number in (0..14).chain([14 + round]) {
                shelf.chunk(number).expect("nobody changed the file");
            }
        }
        assert_eq!(shelf.reads(), 14 + 10);
        // Not even one has room, which is kept nevertheless.
        let shelf = shelf.keeping(1);
        shelf.chunk(0).expect("nobody changed the file");
        let before = shelf.reads();
        shelf.chunk(20).expect("nobody changed the file");
        shelf.chunk(20).expect("nobody changed the file");
        assert_eq!(shelf.reads(), before + 1);
    }

    #[test]
    fn a_chunk_that_was_there_and_is_no_longer_is_an_error_that_says_so() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = recorded(folder.path(), 2, 1000);
        let other = recorded(folder.path(), 2, 1001);
        let shelf = || Shelf::open(&path).expect("it is a recording").keeping(0);
        let why = |shelf: &Shelf| {
            let error = shelf.chunk(0).expect_err("it is no longer there");
            error.to_string()
        };
        let (damaged, shorter, replaced) = (shelf(), shelf(), shelf());
        let place = damaged.contents().chunks[0];
        let whole = fs::read(&path).expect("it is there");
        let mut bytes = whole.clone();
        bytes[(place.offset + place.length) as usize - 1] ^= 1;
        fs::write(&path, &bytes).expect("it can be written");
        let error = why(&damaged);
        let begins = format!(
            "the chunk at byte {} could be read when the recording was opened, and no longer can be (",
            place.offset
        );
        assert!(error.starts_with(&begins), "{error}");
        assert!(error.contains("is damaged"), "{error}");
        // Those behind it are as they were.
        damaged.chunk(1).expect("it is whole");

        fs::write(&path, &whole[..place.offset as usize + 10]).expect("it can be written");
        assert!(why(&shorter).starts_with(&begins));
        fs::copy(&other, &path).expect("it can be written");
        let error = why(&replaced);
        assert!(error.contains("it is another one"), "{error}");
    }
}
