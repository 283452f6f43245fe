//! Outputs as channels: JSON with the output's own schema, images as `foxglove.CompressedImage`.

use std::sync::Arc;

use foxglove::messages::{CompressedImage, Timestamp};
use foxglove::{Channel, ChannelBuilder, PartialMetadata, RawChannel, Schema};
use protocol::{Ask, Encoding, Entry, EntryKind, Good};
use serde_json::{Value, json};

use crate::{Options, Result};
use client::Robot;

/// Folders within each other, at most: more than an instance and the parts of an output's name make.
const DEPTH: usize = 64;

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

/// What a robot says of one output.
pub(crate) struct Described {
    path: String,
    form: Form,
}

enum Form {
    Json { schema: Schema, is_wrapped: bool },
    Image,
}

/// All outputs of the robot.
pub(crate) fn describe(robot: &mut Robot) -> Result<Vec<Described>> {
    let mut outputs = Vec::new();
    let mut list = |below: String| -> Result<Vec<Entry>> {
        let depth = Some(1);
        match robot.ask(Ask::Paths { below, depth })? {
            Good::Paths(entries) => Ok(entries),
            _ => Err("the robot does not tell its paths".to_owned()),
        }
    };
    add_outputs(String::new(), DEPTH, &mut list, &mut outputs)?;
    let described = outputs.into_iter();
    described
        .map(|entry| Described::new(robot, entry))
        .collect()
}

/// Adds all outputs below a folder. What is in outputs and parameters is not asked for: it may be more than a robot lists.
fn add_outputs(
    below: String,
    depth: usize,
    list: &mut impl FnMut(String) -> Result<Vec<Entry>>,
    outputs: &mut Vec<Entry>,
) -> Result<()> {
    for entry in list(below)? {
        match entry.kind {
            EntryKind::MainOutput | EntryKind::AdditionalOutput => outputs.push(entry),
            EntryKind::Folder if depth > 0 => add_outputs(entry.path, depth - 1, list, outputs)?,
            _ => {}
        }
    }
    Ok(())
}

/// A channel for each of them. What was shown before goes on in its channel where it looks the same, with those who look at
/// it; other channels are closed. What has no channel is told and left out.
pub(crate) fn channels(described: Vec<Described>, mut before: Vec<Output>) -> Vec<Output> {
    let mut kept = Vec::new();
    for output in described {
        let is_same = |earlier: &Output| earlier.path == output.path && earlier.has(&output.form);
        let earlier = before.iter().position(is_same);
        kept.push((output, earlier.map(|index| before.swap_remove(index))));
    }
    // Before others get their topics.
    before.into_iter().for_each(Output::close);
    let outputs = kept.into_iter().filter_map(|(output, earlier)| {
        if let Some(earlier) = earlier {
            return Some(Output {
                subscription: None,
                ..earlier
            });
        }
        let path = output.path.clone();
        let output = Output::new(output);
        let output = output.inspect_err(|message| eprintln!("warning: `{path}`: {message}"));
        output.ok()
    });
    outputs.collect()
}

impl Described {
    fn new(robot: &mut Robot, entry: Entry) -> Result<Self> {
        let path = entry.path;
        if entry.image.is_some() {
            let form = Form::Image;
            return Ok(Self { path, form });
        }
        let ask = Ask::Schema { path: path.clone() };
        let Good::Schema(schema) = robot.ask(ask)? else {
            return Err(format!("the robot does not tell the schema of `{path}`"));
        };
        let (schema, is_wrapped) = as_object(schema);
        let name = entry.type_name.unwrap_or_else(|| path.clone());
        let text = serde_json::to_vec(&schema).map_err(|error| error.to_string())?;
        let schema = Schema::new(name, "jsonschema", text);
        let form = Form::Json { schema, is_wrapped };
        Ok(Self { path, form })
    }
}

impl Output {
    fn new(described: Described) -> Result<Self> {
        let topic = format!("/{}", described.path.replace('.', "/"));
        let channel = match described.form {
            Form::Image => Kind::Image(ChannelBuilder::new(&topic).build()),
            Form::Json { schema, is_wrapped } => {
                let built = ChannelBuilder::new(&topic)
                    .message_encoding("json")
                    .schema(schema)
                    .build_raw();
                Kind::Json {
                    channel: built.map_err(|error| error.to_string())?,
                    is_wrapped,
                }
            }
        };
        Ok(Self {
            path: described.path,
            topic,
            channel,
            subscription: None,
            watching: 0,
        })
    }

    fn has(&self, form: &Form) -> bool {
        match (&self.channel, form) {
            (Kind::Image(_), Form::Image) => true,
            (Kind::Json { channel, .. }, Form::Json { schema, .. }) => {
                channel.schema() == Some(schema)
            }
            _ => false,
        }
    }

    fn close(self) {
        match self.channel {
            Kind::Json { channel, .. } => channel.close(),
            Kind::Image(channel) => channel.close(),
        }
    }

    /// Asks the robot for its values from now on.
    pub(crate) fn subscribe(&mut self, robot: &mut Robot, options: &Options) -> Result<()> {
        if let Good::Subscribed(subscribed) = robot.ask(self.ask(options))? {
            self.subscription = Some(subscribed.subscription);
        }
        Ok(())
    }

    /// How the robot sends its values.
    fn ask(&self, options: &Options) -> Ask {
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
    use protocol::{Entry, EntryKind};
    use serde_json::json;

    use super::{DEPTH, add_outputs, as_object};

    #[test]
    fn nothing_is_asked_of_what_is_no_folder() {
        let entry = |path: &str, kind| -> Entry {
            serde_json::from_value(json!({ "path": path, "kind": kind, "has_children": true }))
                .expect("an entry")
        };
        let mut asked = Vec::new();
        let mut list = |below: String| {
            let folder = |name| vec![entry(name, EntryKind::Folder)];
            let entries = match below.as_str() {
                "" => vec![
                    entry("A", EntryKind::Folder),
                    entry("parameters", EntryKind::Parameter),
                    entry("framework", EntryKind::Folder),
                ],
                "A" => folder("A.additional_outputs"),
                "A.additional_outputs" => vec![
                    entry("A.additional_outputs.a", EntryKind::AdditionalOutput),
                    entry("A.additional_outputs.b", EntryKind::Folder),
                ],
                "A.additional_outputs.b" => {
                    vec![entry(
                        "A.additional_outputs.b.c",
                        EntryKind::AdditionalOutput,
                    )]
                }
                _ => vec![entry("framework.x", EntryKind::Procedure)],
            };
            asked.push(below);
            Ok(entries)
        };
        let mut outputs = Vec::new();
        add_outputs(String::new(), DEPTH, &mut list, &mut outputs).expect("it is told");
        let paths: Vec<_> = outputs.iter().map(|entry| entry.path.as_str()).collect();
        assert_eq!(
            paths,
            ["A.additional_outputs.a", "A.additional_outputs.b.c"]
        );
        let folders = [
            "",
            "A",
            "A.additional_outputs",
            "A.additional_outputs.b",
            "framework",
        ];
        assert_eq!(asked, folders);
    }

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
