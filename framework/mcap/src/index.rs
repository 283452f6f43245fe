//! What lies where in a file: told by its end, or found out record by record.

use std::io;

use crate::file::Metadata;
use crate::format::{CHUNK_HEAD, COMPRESSION, MAGIC, RECORD_HEAD, Take, opcode};
use crate::open::{ChunkPlace, Contents, Source};
use crate::read::{self, Chunk, ReadError, Way};

/// Bytes of a footer with its head, and of what ends the file.
const END: u64 = RECORD_HEAD as u64 + 8 + 8 + 4 + MAGIC.len() as u64;

/// No record that is read whole is larger; chunks of ours have 4 MiB.
const LARGEST: u64 = 1 << 30;

/// The name of the metadata that counts chunks that the ring closed over.
pub(crate) const RING: &str = "ring";

/// What the end of the file tells; `None`: it has no such end, or one that cannot be right.
pub(crate) fn summary(source: &impl Source) -> Result<Option<Contents>, ReadError> {
    let length = source.length()?;
    let magic = MAGIC.len() as u64;
    if length < magic || source.read_at(0, magic)? != MAGIC {
        return Err(ReadError::Other);
    }
    let Some(footer) = length.checked_sub(END).filter(|footer| *footer >= magic) else {
        return Ok(None);
    };
    let end = source.read_at(footer, END)?;
    let Some((start, sum)) = summary_start(&end).filter(|(start, _)| *start < footer) else {
        return Ok(None);
    };
    if footer - start > LARGEST {
        return Ok(None);
    }
    let records = source.read_at(start, footer - start)?;
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&records);
    hasher.update(&end[..RECORD_HEAD + 16]);
    // 0: whoever wrote it gives no sum.
    if sum != 0 && hasher.finalize() != sum {
        return Ok(None);
    }
    let understood = indexed(source, &records, start);
    Ok(understood.filter(|contents| !contents.channels.is_empty()))
}

/// Where the summary starts, and its check sum.
fn summary_start(end: &[u8]) -> Option<(u64, u32)> {
    let footer = end.strip_suffix(&MAGIC)?;
    let (opcode::FOOTER, content) = Take(footer).record()? else {
        return None;
    };
    let mut content = Take(content);
    let (start, _) = (content.u64()?, content.u64()?);
    (start != 0).then_some((start, content.u32()?))
}

fn indexed(source: &impl Source, records: &[u8], end: u64) -> Option<Contents> {
    let mut contents = Contents {
        is_indexed: true,
        ..Contents::default()
    };
    let content_at = |offset: u64, length: u64| {
        let is_inside = offset.checked_add(length).is_some_and(|last| last <= end);
        let bytes = (is_inside && length <= LARGEST).then(|| source.read_at(offset, length));
        bytes?.ok()
    };
    let mut rest = Take(records);
    while !rest.0.is_empty() {
        let (kind, content) = rest.record()?;
        let mut index = Take(content);
        match kind {
            opcode::CHUNK_INDEX => {
                let times = (index.u64()?, index.u64()?);
                let (offset, length) = (index.u64()?, index.u64()?);
                let is_inside = offset.checked_add(length).is_some_and(|last| last <= end);
                if !is_inside || length < RECORD_HEAD as u64 {
                    return None;
                }
                contents.chunks.push(ChunkPlace {
                    offset,
                    length,
                    times,
                });
            }
            opcode::ATTACHMENT_INDEX | opcode::METADATA_INDEX => {
                let offset = index.u64()?;
                let record = content_at(offset, index.u64()?)?;
                let wanted = match kind {
                    opcode::ATTACHMENT_INDEX => opcode::ATTACHMENT,
                    _ => opcode::METADATA,
                };
                let found = Take(&record).record();
                let found = found.filter(|(kind, _)| *kind == wanted);
                // What it had is lost, the rest can be understood without it.
                if found
                    .and_then(|(kind, content)| contents.add(kind, content))
                    .is_none()
                {
                    contents.unreadable.push(offset);
                }
            }
            kind => contents.add(kind, content)?,
        }
    }
    contents.chunks.sort_by_key(|chunk| chunk.offset);
    contents.gone = contents.said_gone();
    Some(contents)
}

/// Looks at every record, and at all of every chunk, up to where the file breaks off.
pub(crate) fn scan(
    source: &impl Source,
    chunk: &mut dyn FnMut(Chunk),
) -> Result<Contents, ReadError> {
    let length = source.length()?;
    let mut position = MAGIC.len() as u64;
    if length < position || source.read_at(0, position)? != MAGIC {
        return Err(ReadError::Other);
    }
    let mut contents = Contents::default();
    // The record before, if it is damaged.
    let mut doubtful = None;
    loop {
        let understood = scan_record(source, (position, length), &mut contents, chunk)?;
        let Some((kind, next)) = understood else {
            // Then the length of that one is not right either, or it is the one that breaks off.
            if let Some(offset) = doubtful {
                contents.damaged.retain(|known| *known != offset);
                contents.unreadable.retain(|known| *known != offset);
                position = offset;
            }
            contents.way = Way::Cut { behind: position };
            break;
        };
        let last = [contents.damaged.last(), contents.unreadable.last()];
        doubtful = last.contains(&Some(&position)).then_some(position);
        position = next;
        if kind == opcode::DATA_END {
            let magic = MAGIC.len() as u64;
            let has_end =
                length - position >= magic && source.read_at(length - magic, magic)? == MAGIC;
            if !has_end {
                contents.way = Way::Cut { behind: position };
            }
            break;
        }
    }
    // Those of a file that was recovered have no record in it.
    contents.gone = contents.gone.max(contents.said_gone());
    Ok(contents)
}

/// The kind of a record and where it ends; `None`: it cannot be understood.
fn scan_record(
    source: &impl Source,
    (position, end): (u64, u64),
    contents: &mut Contents,
    chunk: &mut dyn FnMut(Chunk),
) -> io::Result<Option<(u8, u64)>> {
    let head = RECORD_HEAD as u64;
    let start = position + head;
    if start > end {
        return Ok(None);
    }
    let bytes = source.read_at(position, head)?;
    let mut rest = Take(&bytes);
    let (Some(kind), Some(length)) = (rest.u8(), rest.u64()) else {
        return Ok(None);
    };
    // No kind is 0: that is a hole.
    let Some(next) = start.checked_add(length).filter(|next| *next <= end) else {
        return Ok(None);
    };
    let kind = match is_chunk(
        &source.read_at(start, length.min(CHUNK_HEAD as u64))?,
        length,
    ) {
        true => opcode::CHUNK,
        false if kind == 0 => return Ok(None),
        false => kind,
    };
    let is_read = matches!(
        kind,
        opcode::SCHEMA | opcode::CHANNEL | opcode::METADATA | opcode::ATTACHMENT | opcode::CHUNK
    );
    if !is_read {
        contents.gone += u64::from(kind == opcode::GONE);
        return Ok(Some((kind, next)));
    }
    if length > LARGEST {
        return Ok(None);
    }
    let content = source.read_at(start, length)?;
    let understood = match kind {
        opcode::CHUNK => {
            match Chunk::understood(&content, position).zip(times(&content)) {
                Some((found, times)) => {
                    contents.chunks.push(ChunkPlace {
                        offset: position,
                        length: next - position,
                        times,
                    });
                    chunk(found);
                }
                // Its own end is known, and the next one can be understood without it.
                None => contents.damaged.push(position),
            }
            Some(())
        }
        // As of chunks.
        opcode::METADATA | opcode::ATTACHMENT if contents.add(kind, &content).is_none() => {
            contents.unreadable.push(position);
            Some(())
        }
        opcode::METADATA | opcode::ATTACHMENT => Some(()),
        kind => contents.add(kind, &content),
    };
    Ok(understood.map(|()| (kind, next)))
}

/// Whether the content of a record is that of a chunk, told by its first bytes: where its kind is wrong nothing else says that
/// messages are lost, and its check sum tells whether they are.
fn is_chunk(head: &[u8], length: u64) -> bool {
    let mut rest = Take(head);
    rest.bytes(16 + 8 + 4).is_some()
        && rest.text() == Some(COMPRESSION)
        && rest.u64() == length.checked_sub(CHUNK_HEAD as u64)
}

/// Of the first and the last message of a chunk.
fn times(content: &[u8]) -> Option<(u64, u64)> {
    let mut content = Take(content);
    content.u64().zip(content.u64())
}

impl Contents {
    /// How many chunks the metadata say that the ring closed over.
    fn said_gone(&self) -> u64 {
        let gone = self.metadata(RING).and_then(|ring| ring.get("gone"));
        gone.and_then(|gone| gone.parse().ok()).unwrap_or_default()
    }

    /// Adds what a record tells; `None`: it cannot be understood.
    fn add(&mut self, kind: u8, content: &[u8]) -> Option<()> {
        let mut rest = Take(content);
        match kind {
            opcode::SCHEMA => self.schemas.push(read::schema(&mut rest)?),
            opcode::CHANNEL => self.channels.push(read::channel(&mut rest)?),
            opcode::METADATA => self.metadata.push(Metadata {
                name: rest.text()?.to_owned(),
                entries: rest.map()?,
            }),
            opcode::ATTACHMENT => self.attachments.push(read::attachment(content)?),
            _ => {}
        }
        Some(())
    }
}
