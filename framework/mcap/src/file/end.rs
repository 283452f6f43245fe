//! The end of a file: what it says last, and where everything lies.

use std::collections::BTreeMap;
use std::io;

use super::{Metadata, Writer, put_channels, put_schemas};
use crate::format::{MAGIC, Put, opcode};
use crate::index::RING;
use crate::storage::is_full;

impl Metadata {
    /// How many chunks the ring closed over.
    pub(crate) fn ring(gone: u64) -> Self {
        Self {
            name: RING.to_owned(),
            entries: vec![("gone".to_owned(), gone.to_string())],
        }
    }
}

impl Writer {
    /// Writes what finds everything again; the file is whole afterwards.
    pub fn finish(self) -> io::Result<()> {
        self.finish_saying(|_| Vec::new())
    }

    /// As [`finish`](Self::finish), with metadata before it, made of how many chunks the file has. It is asked again where a
    /// full disk takes the end only after older chunks have gone for it.
    pub fn finish_saying(mut self, mut last: impl FnMut(usize) -> Vec<Metadata>) -> io::Result<()> {
        self.close_chunk()?;
        let (position, metadata) = (self.position, self.metadata.len());
        loop {
            let said = last(self.kept_chunks());
            match self.write_end(&said) {
                Err(error) if is_full(&error) && self.ring.make_room(&mut *self.file) => {
                    self.position = position;
                    self.metadata.truncate(metadata);
                    self.file.set_len(position)?;
                }
                ended => return ended.and_then(|()| self.file.sync_all()),
            }
        }
    }

    fn write_end(&mut self, said: &[Metadata]) -> io::Result<()> {
        for metadata in said {
            self.write_metadata(metadata)?;
        }
        if self.ring.gone() > 0 {
            self.write_metadata(&Metadata::ring(self.ring.gone()))?;
        }
        let mut end = Vec::new();
        end.put_record(opcode::DATA_END, |content| content.put_u32(0));
        let summary_start = self.position + end.len() as u64;
        let mut summary = Vec::new();
        let mut groups = Vec::new();
        let mut group = |summary: &mut Vec<u8>, opcode: u8, write: &mut dyn FnMut(&mut Vec<u8>)| {
            let start = summary.len();
            write(summary);
            if summary.len() > start {
                groups.push((opcode, start as u64, (summary.len() - start) as u64));
            }
        };
        let description = &self.description;
        group(&mut summary, opcode::SCHEMA, &mut |out| {
            put_schemas(out, description);
        });
        group(&mut summary, opcode::CHANNEL, &mut |out| {
            put_channels(out, description);
        });
        group(&mut summary, opcode::STATISTICS, &mut |out| {
            self.put_statistics(out);
        });
        group(&mut summary, opcode::CHUNK_INDEX, &mut |out| {
            self.ring.chunks().for_each(|chunk| chunk.put(out));
        });
        group(&mut summary, opcode::ATTACHMENT_INDEX, &mut |out| {
            self.put_attachment_indexes(out);
        });
        group(&mut summary, opcode::METADATA_INDEX, &mut |out| {
            for (offset, length, name) in &self.metadata {
                out.put_record(opcode::METADATA_INDEX, |content| {
                    content.put_u64(*offset);
                    content.put_u64(*length);
                    content.put_text(name);
                });
            }
        });
        let offsets_start = summary_start + summary.len() as u64;
        for (opcode, start, length) in groups {
            summary.put_record(opcode::SUMMARY_OFFSET, |content| {
                content.put_u8(opcode);
                content.put_u64(summary_start + start);
                content.put_u64(length);
            });
        }
        // The check sum covers the footer up to itself.
        summary.put_u8(opcode::FOOTER);
        summary.put_u64(8 + 8 + 4);
        summary.put_u64(summary_start);
        summary.put_u64(offsets_start);
        let sum = crc32fast::hash(&summary);
        summary.put_u32(sum);
        summary.extend(MAGIC);
        end.extend(summary);
        self.append(&end)
    }

    fn put_statistics(&self, out: &mut Vec<u8>) {
        let mut counts: BTreeMap<u16, u64> = BTreeMap::new();
        let mut times: Option<(u64, u64)> = None;
        for chunk in self.ring.chunks() {
            for (channel, (_, messages)) in &chunk.lists {
                *counts.entry(*channel).or_default() += messages;
            }
            let (first, last) = times.unwrap_or(chunk.times);
            times = Some((first.min(chunk.times.0), last.max(chunk.times.1)));
        }
        let (first, last) = times.unwrap_or_default();
        out.put_record(opcode::STATISTICS, |content| {
            content.put_u64(counts.values().sum());
            content.put_u16(self.description.schemas.len() as u16);
            content.put_u32(self.description.channels.len() as u32);
            content.put_u32(self.attachments.len() as u32);
            content.put_u32(self.metadata.len() as u32);
            content.put_u32(self.ring.chunks().count() as u32);
            content.put_u64(first);
            content.put_u64(last);
            content.put_list(|map| {
                for (channel, count) in counts {
                    map.put_u16(channel);
                    map.put_u64(count);
                }
            });
        });
    }

    fn put_attachment_indexes(&self, out: &mut Vec<u8>) {
        for (offset, length, index) in &self.attachments {
            let attachment = &self.description.attachments[*index];
            out.put_record(opcode::ATTACHMENT_INDEX, |content| {
                content.put_u64(*offset);
                content.put_u64(*length);
                content.put_u64(0);
                content.put_u64(0);
                content.put_u64(attachment.data.len() as u64);
                content.put_text(&attachment.name);
                content.put_text(&attachment.media_type);
            });
        }
    }
}
