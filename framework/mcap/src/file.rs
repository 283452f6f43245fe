//! An MCAP file that is being written.

mod chunk;
mod end;

use std::fs::File;
use std::io::{self, SeekFrom};
use std::path::Path;

use crate::format::{MAGIC, Put, Take, opcode};
use crate::ring::Ring;
use crate::storage::{Storage, is_full};

pub(crate) use chunk::ChunkIndex;

use chunk::OpenChunk;

/// What there is to say before anything was recorded.
#[derive(Clone, Debug, Default)]
pub struct Description {
    /// What wrote the file.
    pub library: String,
    pub schemas: Vec<Schema>,
    pub channels: Vec<Channel>,
    pub metadata: Vec<Metadata>,
    pub attachments: Vec<Attachment>,
}

/// What messages of channels look like.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Schema {
    pub name: String,
    /// `jsonschema` or one of ours.
    pub encoding: String,
    pub data: Vec<u8>,
}

/// A channel by its place in [`Description::channels`], counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ChannelId(pub u16);

impl ChannelId {
    /// Its number in the file, where they count from 1.
    pub fn number(self) -> u16 {
        self.0 + 1
    }
}

/// Messages of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    pub topic: String,
    /// Place in [`Description::schemas`], counted from 0.
    pub schema: Option<u16>,
    /// `json`, or one of ours.
    pub encoding: String,
    pub metadata: Vec<(String, String)>,
    /// Of messages with one sequence number only the first is kept in a chunk: several instances write what they read of
    /// another one, each for itself.
    pub once_per_chunk: bool,
}

/// A named list of texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Metadata {
    pub name: String,
    pub entries: Vec<(String, String)>,
}

/// A file inside of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attachment {
    pub name: String,
    pub media_type: String,
    pub data: Vec<u8>,
}

/// The writing end of a file.
#[derive(Debug)]
pub struct Writer {
    file: Box<dyn Storage>,
    position: u64,
    description: Description,
    chunk: OpenChunk,
    ring: Ring,
    /// Offset and length of metadata, by name.
    metadata: Vec<(u64, u64, String)>,
    attachments: Vec<(u64, u64, usize)>,
}

impl Writer {
    /// Creates the file, which must not exist, with everything that is known before.
    pub fn create(path: &Path, description: Description, budget: u64) -> io::Result<Self> {
        let file = File::options().write(true).create_new(true).open(path)?;
        Self::onto(Box::new(file), description, budget)
    }

    /// As [`create`](Self::create), onto what is there already and empty.
    pub fn onto(file: Box<dyn Storage>, description: Description, budget: u64) -> io::Result<Self> {
        let mut writer = Self {
            file,
            position: 0,
            description,
            chunk: OpenChunk::new(),
            ring: Ring::new(budget),
            metadata: Vec::new(),
            attachments: Vec::new(),
        };
        writer.write_head()?;
        Ok(writer)
    }

    fn write_head(&mut self) -> io::Result<()> {
        let mut head = MAGIC.to_vec();
        head.put_record(opcode::HEADER, |content| {
            content.put_text("");
            content.put_text(&self.description.library);
        });
        put_schemas_and_channels(&mut head, &self.description);
        self.append(&head)?;
        for metadata in self.description.metadata.clone() {
            self.write_metadata(&metadata)?;
        }
        for index in 0..self.description.attachments.len() {
            let mut record = Vec::new();
            put_attachment(&mut record, &self.description.attachments[index]);
            let place = (self.position, record.len() as u64, index);
            self.attachments.push(place);
            self.append(&record)?;
        }
        Ok(())
    }

    pub fn write_metadata(&mut self, metadata: &Metadata) -> io::Result<()> {
        let mut record = Vec::new();
        record.put_record(opcode::METADATA, |content| {
            content.put_text(&metadata.name);
            put_map(content, &metadata.entries);
        });
        let place = (self.position, record.len() as u64, metadata.name.clone());
        self.append(&record)?;
        self.metadata.push(place);
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(self.position))?;
        if let Err(error) = self.file.write_all(bytes) {
            // What comes next may be shorter than the part that a full disk took; and whatever stands behind the end, no
            // reader finds the end.
            let _ = self.file.set_len(self.position);
            return Err(error);
        }
        self.position += bytes.len() as u64;
        Ok(())
    }

    /// Adds the messages of one block to the chunk that is open.
    pub fn add(&mut self, messages: &[u8]) {
        let mut rest = Take(messages);
        loop {
            let before = rest.0;
            let Some((opcode::MESSAGE, content)) = rest.record() else {
                break;
            };
            let mut head = Take(content);
            let (Some(number), Some(sequence), Some(time)) = (head.u16(), head.u32(), head.u64())
            else {
                break;
            };
            if self.once_per_chunk(number) && !self.chunk.is_new(number, sequence) {
                continue;
            }
            let record = before.len() - rest.0.len();
            self.chunk.add(&before[..record], number, time);
        }
    }

    fn once_per_chunk(&self, number: u16) -> bool {
        let place = usize::from(number).checked_sub(1);
        let channel = place.and_then(|place| self.description.channels.get(place));
        channel.is_some_and(|channel| channel.once_per_chunk)
    }

    /// Bytes of the chunk that is open, not compressed.
    pub fn open_bytes(&self) -> usize {
        self.chunk.bytes()
    }

    /// Writes the open chunk; on an error nothing of it counts. It is empty afterwards in either case. Older chunks may have
    /// gone for it: [`kept_chunks`](Self::kept_chunks).
    pub fn close_chunk(&mut self) -> io::Result<()> {
        let Some((index, bytes)) = self.chunk.close(self.position)? else {
            return Ok(());
        };
        let written = self.append_chunk(&bytes);
        self.chunk.begin(bytes);
        written?;
        self.ring.add(&mut *self.file, index);
        Ok(())
    }

    /// Appends where the disk is full, too: the oldest chunks make room, as far as the ring gives them up.
    fn append_chunk(&mut self, bytes: &[u8]) -> io::Result<()> {
        loop {
            match self.append(bytes) {
                Err(error) if is_full(&error) && self.ring.make_room(&mut *self.file) => {}
                appended => return appended,
            }
        }
    }

    /// How many chunks the file has; what the ring closed over does not count.
    pub fn kept_chunks(&self) -> usize {
        self.ring.len()
    }
}

fn put_schemas_and_channels(out: &mut Vec<u8>, description: &Description) {
    put_schemas(out, description);
    put_channels(out, description);
}

fn put_schemas(out: &mut Vec<u8>, description: &Description) {
    for (id, schema) in (1..).zip(&description.schemas) {
        out.put_record(opcode::SCHEMA, |content| {
            content.put_u16(id);
            content.put_text(&schema.name);
            content.put_text(&schema.encoding);
            content.put_list(|data| data.extend_from_slice(&schema.data));
        });
    }
}

fn put_channels(out: &mut Vec<u8>, description: &Description) {
    for (id, channel) in (1..).zip(&description.channels) {
        out.put_record(opcode::CHANNEL, |content| {
            content.put_u16(id);
            // 0: none.
            content.put_u16(channel.schema.map_or(0, |schema| schema + 1));
            content.put_text(&channel.topic);
            content.put_text(&channel.encoding);
            put_map(content, &channel.metadata);
        });
    }
}

fn put_map(out: &mut Vec<u8>, entries: &[(String, String)]) {
    out.put_list(|map| {
        for (key, value) in entries {
            map.put_text(key);
            map.put_text(value);
        }
    });
}

fn put_attachment(out: &mut Vec<u8>, attachment: &Attachment) {
    out.put_record(opcode::ATTACHMENT, |content| {
        let start = content.len();
        content.put_u64(0);
        content.put_u64(0);
        content.put_text(&attachment.name);
        content.put_text(&attachment.media_type);
        content.put_u64(attachment.data.len() as u64);
        content.extend_from_slice(&attachment.data);
        let sum = crc32fast::hash(&content[start..]);
        content.put_u32(sum);
    });
}
