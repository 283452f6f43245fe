//! Outputs that a recording has in channels of their own, as JSON.

use serde_json::Value;

use super::Shelf;
use crate::error::Result;

/// What an instance wrote in a cycle, if `--record-output` asked for it.
pub(super) fn recorded_output(
    recording: &Shelf,
    (instance, output): (&str, &str),
    cycle: u64,
) -> Result<Option<Value>> {
    let topic = format!("{instance}.main_outputs.{output}");
    let index = recording.index();
    let channel = index.output_channels.get(&topic);
    let place = channel.and_then(|channel| index.outputs.get(&(*channel, cycle as u32)));
    let Some(place) = place else {
        return Ok(None);
    };
    let written = recording.bytes(*place)?;
    Ok(serde_json::from_slice(&written).ok())
}
