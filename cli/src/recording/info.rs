//! What a recording is, and what makes it large.

use std::collections::BTreeMap;
use std::fs;

use camino::Utf8Path;
use hulkgen_mcap::layout::{Layouts, Part, PartKind, Values};
use hulkgen_mcap::{Channel, Contents, Message, ReadError, Way};
use serde::Serialize;

use super::{FRAMES, TYPES, open};
use crate::outcome::Refusal;

/// How many of the largest states are named.
const LARGEST: usize = 3;

/// All that is to say of a recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Info {
    /// `COMPLETE` or `INCOMPLETE`.
    pub state: &'static str,
    /// Where the file breaks off; absent where it does not.
    pub cut_behind: Option<u64>,
    /// Offsets of chunks that are not what was written.
    pub damaged: Vec<u64>,
    /// Offsets of metadata and attachments that are not what was written.
    pub unreadable: Vec<u64>,
    /// What the recording says of its run: robot, target, revision, identities.
    pub run: BTreeMap<String, String>,
    /// From its first to its last message.
    pub duration_s: f64,
    /// On the disk.
    pub bytes: u64,
    /// Not compressed.
    pub uncompressed: u64,
    pub chunks: u64,
    /// Chunks that the ring closed over.
    pub gone: u64,
    /// In manifest order.
    pub instances: Vec<InstanceInfo>,
    /// In the order of the file.
    pub channels: Vec<ChannelInfo>,
    /// States of nodes, largest first.
    pub largest_states: Vec<StateInfo>,
    pub attachments: Vec<String>,
}

/// What is recorded of one instance.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct InstanceInfo {
    pub instance: String,
    /// Which cycles the manifest asks for.
    pub record: String,
    /// Cycles in the file.
    pub frames: u64,
    /// Cycles that were not recorded although wanted.
    pub dropped: u64,
    /// Cycles that were recorded and left to younger ones when the file had its budget.
    pub overwritten: u64,
    /// Digest of the types of its frames.
    pub types: String,
    /// Of a frame on average, with its head.
    pub bytes_per_cycle: f64,
    /// What frames consist of, largest first.
    pub parts: Vec<PartInfo>,
}

/// A part of the frames of an instance: the state of a node, an output, what was seen of another instance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartInfo {
    /// As nodes and manifest name it.
    pub name: String,
    pub kind: PartKind,
    /// On average.
    pub bytes_per_cycle: f64,
    /// In the largest frame.
    pub most_bytes: u64,
}

/// What a channel has.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct ChannelInfo {
    pub topic: String,
    pub encoding: String,
    pub messages: u64,
    /// Not compressed.
    pub bytes: u64,
}

/// The state of a node in its frames.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct StateInfo {
    pub instance: String,
    pub node: String,
    /// In the largest frame.
    pub bytes: u64,
}

/// Reads all of a recording.
pub fn info(path: &Utf8Path) -> Result<Info, Refusal> {
    let file = open(path)?;
    let contents = file.contents();
    let layouts = Layouts::of(&contents.attachments);
    let mut channels: BTreeMap<u16, Counted<'_>> = BTreeMap::new();
    for (number, channel) in &contents.channels {
        channels.insert(*number, Counted::new(channel, &layouts));
    }
    let (mut chunks, mut uncompressed) = (0, 0);
    let mut damaged = contents.damaged.clone();
    for place in &contents.chunks {
        let chunk = match file.chunk(place) {
            Err(ReadError::Damaged { offset }) => {
                damaged.push(offset);
                continue;
            }
            read => read.map_err(|error| Refusal::bad(format!("`{path}`: {error}")))?,
        };
        chunks += 1;
        uncompressed += chunk.bytes().len() as u64;
        for message in chunk.messages() {
            if let Some(channel) = channels.get_mut(&message.channel) {
                channel.add(&message);
            }
        }
    }
    let is_complete = contents.is_complete() && damaged.is_empty();
    let run = contents.metadata("run");
    let mut states: Vec<_> = channels.values().flat_map(Counted::states).collect();
    states.sort_by(|one, other| other.bytes.cmp(&one.bytes).then(one.node.cmp(&other.node)));
    states.truncate(LARGEST);
    let bytes = fs::metadata(path).map_or(0, |metadata| super::list::used(&metadata));
    Ok(Info {
        state: state(is_complete),
        cut_behind: match contents.way {
            Way::Whole => None,
            Way::Cut { behind } => Some(behind),
        },
        damaged,
        unreadable: contents.unreadable.clone(),
        run: run
            .map(|run| run.entries.iter().cloned().collect())
            .unwrap_or_default(),
        duration_s: duration(contents),
        bytes,
        uncompressed,
        chunks,
        gone: contents.gone,
        instances: instances(contents, &channels),
        channels: channels.into_values().map(|counted| counted.info).collect(),
        largest_states: states,
        attachments: contents
            .attachments
            .iter()
            .map(|one| one.name.clone())
            .collect(),
    })
}

/// In one word.
pub(super) fn state(is_complete: bool) -> &'static str {
    match is_complete {
        true => "COMPLETE",
        false => "INCOMPLETE",
    }
}

/// In seconds.
pub(super) fn duration(contents: &Contents) -> f64 {
    let first = contents.chunks.iter().map(|chunk| chunk.times.0).min();
    let last = contents.chunks.iter().map(|chunk| chunk.times.1).max();
    let span = last
        .unwrap_or_default()
        .saturating_sub(first.unwrap_or_default());
    span as f64 / 1e9
}

fn instances(contents: &Contents, channels: &BTreeMap<u16, Counted<'_>>) -> Vec<InstanceInfo> {
    let said = |metadata: &str, key: &str| {
        let said = contents.metadata(metadata).and_then(|one| one.get(key));
        said.map(ToOwned::to_owned)
    };
    let frames = channels.values().filter(|one| one.info.encoding == FRAMES);
    let described = frames.map(|counted| {
        let instance = super::values::instance_of(&counted.info.topic);
        let count = |what: &str| -> u64 {
            let text = said("end", &format!("{instance}.{what}"));
            text.and_then(|text| text.parse().ok()).unwrap_or_default()
        };
        InstanceInfo {
            instance: instance.to_owned(),
            record: said("record", instance).unwrap_or_default(),
            frames: counted.frames,
            dropped: count("dropped") + count("failed") + count("lost"),
            overwritten: count("overwritten"),
            types: counted.types.to_owned(),
            bytes_per_cycle: per_cycle(counted.bytes, counted.frames),
            parts: counted.parts_info(),
        }
    });
    described.collect()
}

/// To a tenth of a byte.
fn per_cycle(bytes: u64, cycles: u64) -> f64 {
    (bytes as f64 * 10.0 / cycles.max(1) as f64).round() / 10.0
}

/// One channel while it is counted.
struct Counted<'a> {
    info: ChannelInfo,
    frames: u64,
    /// Of frames where they begin.
    bytes: u64,
    types: &'a str,
    parts: &'a [Part],
    /// Of each part.
    sizes: Vec<Sizes>,
}

#[derive(Clone, Copy, Default)]
struct Sizes {
    /// Of all frames.
    all: u64,
    /// In the largest frame.
    most: u64,
}

impl<'a> Counted<'a> {
    fn new(channel: &'a Channel, layouts: &'a Layouts) -> Self {
        let types = channel.metadata.iter().find(|(key, _)| key == TYPES);
        let types = types.map_or("", |(_, types)| types.as_str());
        let parts = layouts.frames.get(types).map_or(&[][..], Vec::as_slice);
        Self {
            info: ChannelInfo {
                topic: channel.topic.clone(),
                encoding: channel.encoding.clone(),
                ..ChannelInfo::default()
            },
            frames: 0,
            bytes: 0,
            types,
            parts,
            sizes: vec![Sizes::default(); parts.len()],
        }
    }

    fn add(&mut self, message: &Message<'_>) {
        self.info.messages += 1;
        self.info.bytes += message.data.len() as u64;
        if self.info.encoding != FRAMES {
            return;
        }
        let Some((0, frame)) = message.data.split_first() else {
            return;
        };
        self.frames += 1;
        self.bytes += message.data.len() as u64;
        let mut values = Values::new(frame);
        for (part, sizes) in self.parts.iter().zip(&mut self.sizes) {
            // What cannot be read has no size.
            let Ok(bytes) = values.skip(&part.layout) else {
                break;
            };
            sizes.all += bytes as u64;
            sizes.most = sizes.most.max(bytes as u64);
        }
    }

    fn parts_info(&self) -> Vec<PartInfo> {
        let parts = self.parts.iter().zip(&self.sizes);
        let parts = parts.map(|(part, sizes)| PartInfo {
            name: part.name.clone(),
            kind: part.kind,
            bytes_per_cycle: per_cycle(sizes.all, self.frames),
            most_bytes: sizes.most,
        });
        let mut parts: Vec<_> = parts.collect();
        parts.sort_by(|one, other| other.bytes_per_cycle.total_cmp(&one.bytes_per_cycle));
        parts
    }

    fn states(&self) -> impl Iterator<Item = StateInfo> + '_ {
        let instance = super::values::instance_of(&self.info.topic);
        let parts = self.parts.iter().zip(&self.sizes);
        let states = parts.filter(|(part, _)| {
            matches!(
                part.kind,
                PartKind::Node | PartKind::State | PartKind::History
            )
        });
        states.map(move |(part, sizes)| StateInfo {
            instance: instance.to_owned(),
            node: part.name.clone(),
            bytes: sizes.most,
        })
    }
}
