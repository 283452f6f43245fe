//! Outputs as channels: JSON with the output's own schema, images as `foxglove.CompressedImage`.

use std::sync::Arc;

use foxglove::messages::{CompressedImage, Timestamp};
use foxglove::{Channel, ChannelBuilder, PartialMetadata, RawChannel, Schema};
use protocol::{Ask, Encoding, Entry, EntryKind, Good};
use serde_json::{Value, json};

use crate::robot::Robot;
use crate::{Options, Result};

/// Deeper than names of outputs go.
const DEPTH: u8 = 8;

/// What stands around a value that is no object: a message is one.
const VALUE: &str = "value";

/// One output.
pub(crate) struct Output {
    pub(crate) path: String,
    pub(crate) topic: String,
    channel: Kind,
    /// While somebody looks at it: the subscription, and how many look.
    pub(crate) subscription: Option<u32>,
    pub(crate) watching: usize,
}

enum Kind {
    Json {
        channel: Arc<RawChannel>,
        is_wrapped: bool,
    },
    Image(Channel<CompressedImage>),
}

/// A channel for each output of the robot.
pub(crate) fn channels(robot: &mut Robot) -> Result<Vec<Output>> {
    let listed = robot.ask(Ask::Paths {
        below: String::new(),
        depth: Some(DEPTH),
    })?;
    let Good::Paths(entries) = listed else {
        return Err("the robot does not tell its paths".to_owned());
    };
    let mut outputs: Vec<Output> = Vec::new();
    for entry in entries {
        let is_part = outputs.last().is_some_and(|output| {
            let rest = entry.path.strip_prefix(output.path.as_str());
            rest.is_some_and(|rest| rest.starts_with('.'))
        });
        let is_output = matches!(
            entry.kind,
            EntryKind::MainOutput | EntryKind::AdditionalOutput
        );
        if is_output && !is_part {
            outputs.push(Output::new(robot, entry)?);
        }
    }
    Ok(outputs)
}

impl Output {
    fn new(robot: &mut Robot, entry: Entry) -> Result<Self> {
        let topic = format!("/{}", entry.path.replace('.', "/"));
        let channel = if entry.image.is_some() {
            Kind::Image(ChannelBuilder::new(&topic).build())
        } else {
            let path = entry.path.clone();
            let Good::Schema(schema) = robot.ask(Ask::Schema { path })? else {
                return Err(format!(
                    "the robot does not tell the schema of `{}`",
                    entry.path
                ));
            };
            let (schema, is_wrapped) = as_object(schema);
            let name = entry.type_name.unwrap_or_else(|| entry.path.clone());
            let text = serde_json::to_vec(&schema).map_err(|error| error.to_string())?;
            let built = ChannelBuilder::new(&topic)
                .message_encoding("json")
                .schema(Schema::new(name, "jsonschema", text))
                .build_raw();
            Kind::Json {
                channel: built.map_err(|error| error.to_string())?,
                is_wrapped,
            }
        };
        Ok(Self {
            path: entry.path,
            topic,
            channel,
            subscription: None,
            watching: 0,
        })
    }

    /// How the robot sends its values.
    pub(crate) fn ask(&self, options: &Options) -> Ask {
        Ask::Subscribe {
            path: self.path.clone(),
            rate: Some(options.rate),
            encoding: match self.channel {
                Kind::Json { .. } => Encoding::Json,
                Kind::Image(_) => Encoding::Jpeg {
                    quality: options.quality,
                },
            },
        }
    }

    /// Hands on a value of that time, in nanoseconds since 1970; what is not there is no message.
    pub(crate) fn log(&self, value: Value, time: u64) {
        let Kind::Json {
            channel,
            is_wrapped,
        } = &self.channel
        else {
            return;
        };
        if value.is_null() {
            return;
        }
        let message = if *is_wrapped {
            json!({ VALUE: value })
        } else {
            value
        };
        // Numbers, texts and what consists of them are JSON.
        let text = serde_json::to_vec(&message).unwrap_or_default();
        channel.log_with_meta(&text, PartialMetadata::with_log_time(time));
    }

    /// As [`Output::log`], of a JPEG file.
    pub(crate) fn log_image(&self, file: Vec<u8>, time: u64) {
        if let Kind::Image(channel) = &self.channel
            && !file.is_empty()
        {
            let image = CompressedImage {
                timestamp: Some(timestamp(time)),
                frame_id: self.path.clone(),
                data: file.into(),
                format: "jpeg".to_owned(),
            };
            channel.log_with_meta(&image, PartialMetadata::with_log_time(time));
        }
    }
}

fn timestamp(time: u64) -> Timestamp {
    const SECOND: u64 = 1_000_000_000;
    let seconds = u32::try_from(time / SECOND).unwrap_or(u32::MAX);
    // Less than a second.
    Timestamp::new(seconds, (time % SECOND) as u32)
}

/// Foxglove asks for objects: others are put into one.
fn as_object(mut schema: Value) -> (Value, bool) {
    if schema.get("type") == Some(&json!("object")) {
        return (schema, false);
    }
    // Definitions belong to the root, where `#/definitions/…` looks for them.
    let definitions = schema
        .as_object_mut()
        .and_then(|schema| schema.remove("definitions"));
    let mut around = json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "type": "object",
        "properties": { VALUE: schema },
        "required": [VALUE],
    });
    if let Some(definitions) = definitions {
        around["definitions"] = definitions;
    }
    (around, true)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::as_object;

    #[test]
    fn what_is_no_object_is_put_into_one() {
        let object = json!({ "type": "object", "properties": {} });
        assert_eq!(as_object(object.clone()), (object, false));
        let list = json!({ "type": "array", "items": { "$ref": "#/definitions/A" }, "definitions": { "A": {} } });
        let (around, is_wrapped) = as_object(list);
        assert!(is_wrapped);
        assert_eq!(around["properties"]["value"]["type"], "array");
        assert_eq!(around["definitions"], json!({ "A": {} }));
        assert_eq!(around["properties"]["value"].get("definitions"), None);
    }
}
