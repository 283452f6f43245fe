//! Recordings of other types.

use hulkgen_recording::Contents;
use hulkgen_recording::layout::{Layout, Layouts, Part, PartKind, first_difference};
use serde::de::DeserializeOwned;

use super::Replayable;
use crate::recorded::{PARAMETERS, TYPES, layout_of};

/// What is of another type in the recording than in this robot, in words; `None`: nothing, or the recording does not tell.
pub(super) fn difference(recording: &Contents, replayable: &Replayable) -> Option<String> {
    let topic = format!("frames/{}", replayable.instance);
    let mut channels = recording.channels.iter();
    let (_, channel) = channels.find(|(_, channel)| channel.topic == topic)?;
    let digest = channel.metadata.iter().find(|(key, _)| key == TYPES);
    let (_, digest) = digest?;
    let types = (replayable.types)();
    let layouts = Layouts::of(&recording.attachments);
    if types.digest() == *digest {
        // Frames name what others wrote, whose types are not among their own.
        let mut values = types.values.iter();
        return values.find_map(|(name, layout)| of_values(&layouts, name, layout));
    }
    let parts = layouts.frames.get(digest).map(Vec::as_slice);
    let difference = parts.and_then(|parts| types.difference(parts));
    Some(difference.unwrap_or_else(|| "its types have another digest".to_owned()))
}

/// The same of the parameters.
pub(super) fn of_parameters<P: DeserializeOwned>(recording: &Contents) -> Option<String> {
    let layouts = Layouts::of(&recording.attachments);
    of_values(&layouts, PARAMETERS, &layout_of::<P>())
}

/// The same of what frames name: what an instance wrote, or the parameters.
fn of_values(layouts: &Layouts, name: &str, layout: &Layout) -> Option<String> {
    let part = |layout: &Layout| Part {
        name: name.to_owned(),
        kind: PartKind::Input,
        layout: layout.clone(),
    };
    let recorded = layouts.values.get(name)?;
    first_difference(&[part(recorded)], &[part(layout)])
}
