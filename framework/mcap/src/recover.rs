//! A whole file out of one that breaks off.

use std::path::Path;

use crate::file::{Channel, Description, Metadata, Writer};
use crate::index::RING;
use crate::open::RecordingFile;
use crate::read::{ReadError, Way};

/// The name of the metadata that tells how the run ended.
const END: &str = "end";

/// What became of the chunks of a file that breaks off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// That are in the new file.
    pub chunks: u64,
    /// Bytes of the old file behind its last whole chunk.
    pub lost: u64,
    /// Offsets of chunks of the old file that are damaged, and not in the new one.
    pub damaged: Vec<u64>,
    /// Offsets of metadata and attachments of the old file that cannot be read, and are not in the new one.
    pub unreadable: Vec<u64>,
}

/// Writes a whole file, which must not exist, with all chunks of this one that are not damaged. Where that fails there is
/// no new file.
///
/// # Errors
/// If a disk fails, or the channels are not numbered as those of recordings are.
pub fn recover(file: &RecordingFile, into: &Path) -> Result<Recovered, ReadError> {
    let contents = file.contents();
    let length = file.length()?;
    let numbers = contents.channels.iter().map(|(number, _)| *number);
    let schemas = contents.schemas.iter().map(|(number, _)| *number);
    if !numbers.eq(1..=contents.channels.len() as u16)
        || !schemas.eq(1..=contents.schemas.len() as u16)
    {
        return Err(ReadError::Other);
    }
    let channels = contents.channels.iter().map(|(_, channel)| Channel {
        // Places count from 0, numbers from 1.
        schema: channel.schema.and_then(|number| number.checked_sub(1)),
        ..channel.clone()
    });
    let metadata = contents.metadata.iter().filter(|one| one.name != END);
    // Where it breaks off only records say it, which the new file does not have.
    let gone = match contents.metadata(RING) {
        None if contents.gone > 0 => Some(Metadata::ring(contents.gone)),
        _ => None,
    };
    let description = Description {
        library: format!("hulkgen {}", env!("CARGO_PKG_VERSION")),
        schemas: contents
            .schemas
            .iter()
            .map(|(_, one)| one.clone())
            .collect(),
        channels: channels.collect(),
        metadata: metadata.cloned().chain(gone).collect(),
        attachments: contents.attachments.clone(),
    };
    let writer = Writer::create(into, description, u64::MAX)?;
    let recovered = copy(file, writer, length);
    if recovered.is_err() {
        // Half a file would look like a whole one.
        let _ = std::fs::remove_file(into);
    }
    recovered
}

fn copy(file: &RecordingFile, mut writer: Writer, length: u64) -> Result<Recovered, ReadError> {
    let contents = file.contents();
    let mut recovered = Recovered {
        chunks: 0,
        lost: match contents.way {
            Way::Whole => 0,
            Way::Cut { behind } => length.saturating_sub(behind),
        },
        damaged: contents.damaged.clone(),
        unreadable: contents.unreadable.clone(),
    };
    for place in &contents.chunks {
        match file.chunk(place) {
            Ok(chunk) => writer.add(chunk.bytes()),
            Err(ReadError::Damaged { offset }) => {
                recovered.damaged.push(offset);
                continue;
            }
            Err(error) => return Err(error),
        }
        writer.close_chunk()?;
        recovered.chunks += 1;
    }
    // What the old file says of its end holds for the new one only where nothing is lost.
    if recovered.lost == 0
        && recovered.damaged.is_empty()
        && recovered.unreadable.is_empty()
        && let Some(end) = contents.metadata(END)
    {
        writer.write_metadata(end)?;
    }
    writer.write_metadata(&Metadata {
        name: "recovered".to_owned(),
        entries: vec![("chunks".to_owned(), recovered.chunks.to_string())],
    })?;
    writer.finish()?;
    Ok(recovered)
}
