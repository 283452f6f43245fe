//! Recordings of other types.

use hulkgen_recording::Recording;
use hulkgen_recording::layout::Layouts;

use super::Replayable;
use crate::recorded::TYPES;

/// What is of another type in the recording than in this robot, in words; `None`: nothing, or the recording does not tell.
pub(super) fn difference(recording: &Recording, replayable: &Replayable) -> Option<String> {
    let topic = format!("frames/{}", replayable.instance);
    let mut channels = recording.channels.iter();
    let (_, channel) = channels.find(|(_, channel)| channel.topic == topic)?;
    let digest = channel.metadata.iter().find(|(key, _)| key == TYPES);
    let (_, digest) = digest?;
    let types = (replayable.types)();
    if types.digest() == *digest {
        return None;
    }
    let layouts = Layouts::of(&recording.attachments);
    let parts = layouts.frames.get(digest).map(Vec::as_slice);
    let difference = parts.and_then(|parts| types.difference(parts));
    Some(difference.unwrap_or_else(|| "its types have another digest".to_owned()))
}
