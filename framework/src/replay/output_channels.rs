//! Outputs that a recording has in channels of their own, as JSON.

use std::collections::BTreeMap;

use hulkgen_recording::{Channel, Recording};
use serde_json::Value;

use crate::recorded::JSON;

/// Values of main outputs, by channel and cycle.
#[derive(Debug, Default)]
pub(super) struct OutputChannels<'r> {
    values: BTreeMap<(&'r str, u32), &'r [u8]>,
}

impl<'r> OutputChannels<'r> {
    /// All that `--record-output` asked for. What is written in the form of a well-known message is not the value itself.
    pub(super) fn of(recording: &'r Recording) -> Self {
        let is_other_form = |channel: &Channel| {
            let mut schemas = recording.schemas.iter();
            let schema = schemas.find(|(number, _)| channel.schema == Some(*number));
            schema.is_some_and(|(_, schema)| schema.name.starts_with("foxglove."))
        };
        let own = recording.channels.iter().filter(|(_, channel)| {
            let is_output = channel.encoding == JSON && channel.topic.contains(".main_outputs.");
            is_output && !is_other_form(channel)
        });
        let own = own.map(|(number, channel)| (*number, channel.topic.as_str()));
        let own: BTreeMap<u16, &str> = own.collect();
        if own.is_empty() {
            return Self::default();
        }
        let messages = recording.chunks.iter().flat_map(|chunk| chunk.messages());
        let values = messages.filter_map(|message| {
            let topic = own.get(&message.channel)?;
            Some(((*topic, message.sequence), message.data))
        });
        Self {
            values: values.collect(),
        }
    }

    /// What an instance wrote in a cycle.
    pub(super) fn value(&self, instance: &str, output: &str, cycle: u64) -> Option<Value> {
        let topic = format!("{instance}.main_outputs.{output}");
        let written = self.values.get(&(topic.as_str(), cycle as u32))?;
        serde_json::from_slice(written).ok()
    }
}
