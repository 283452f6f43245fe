//! A whole file out of one that breaks off.

use std::path::Path;

use crate::file::{Channel, Description, Metadata, Writer};
use crate::open::RecordingFile;
use crate::read::{ReadError, Way};

/// The name of the metadata that tells how the run ended.
const END: &str = "end";

/// What became of the chunks of a file that breaks off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recovered {
    /// That are in the new file.
    pub chunks: u64,
    /// Bytes of the old file behind its last whole chunk.
    pub lost: u64,
}

/// Writes a whole file, which must not exist, with all chunks of this one up to the first that is damaged.
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
    let description = Description {
        library: format!("hulkgen {}", env!("CARGO_PKG_VERSION")),
        schemas: contents
            .schemas
            .iter()
            .map(|(_, one)| one.clone())
            .collect(),
        channels: channels.collect(),
        metadata: metadata.cloned().collect(),
        attachments: contents.attachments.clone(),
    };
    let mut writer = Writer::create(into, description, u64::MAX)?;
    let mut recovered = Recovered {
        chunks: 0,
        lost: match contents.way {
            Way::Whole => 0,
            Way::Cut { behind } => length.saturating_sub(behind),
        },
    };
    for place in &contents.chunks {
        match file.chunk(place) {
            Ok(chunk) => writer.add(chunk.bytes()),
            Err(ReadError::Damaged { offset }) => {
                recovered.lost = length.saturating_sub(offset);
                break;
            }
            Err(error) => return Err(error),
        }
        writer.close_chunk()?;
        recovered.chunks += 1;
    }
    // What the old file says of its end holds for the new one only where nothing is lost.
    if recovered.lost == 0
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
