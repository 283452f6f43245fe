//! Where frames, values, logs and outputs of a recording lie.

use std::collections::BTreeMap;

use hulkgen_recording::{Channel, Chunk, Contents, Message};

use crate::error::{Error, Result};
use crate::recorded::{
    BEGUN, FINISHED, FRAMES, Head, JSON, LOGS, Loading, VALUES, VERSION, ValuePlace, ValuePlaces,
    from_log,
};
use crate::time::Timestamp;

/// Where some bytes lie.
#[derive(Clone, Copy, Debug)]
pub(in crate::replay) struct Place {
    chunk: u32,
    start: u32,
    length: u32,
}

/// One recorded cycle.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub head: Head,
    /// What stands behind the head.
    pub(in crate::replay) content: Place,
    /// Digests of what it wrote; `None`: it was not finished.
    pub(in crate::replay) end: Option<Place>,
    /// The version of the parameters that it begins with, of an instance that reads any; of others anything.
    pub(in crate::replay) version: Option<u64>,
}

/// The cycles of one instance.
#[derive(Debug, Default)]
pub(in crate::replay) struct Recorded {
    /// In the order of the file.
    pub(in crate::replay) frames: Vec<Frame>,
    /// Why one of them cannot be understood; those behind it are left out.
    pub(in crate::replay) damaged: Option<String>,
}

/// So many bytes of what was said are kept: a jump says hundreds of messages again, each of another chunk.
const MOST_SAID: usize = 16 << 20;

/// What was said.
#[derive(Debug)]
pub(in crate::replay) struct Logged {
    pub(in crate::replay) time: Timestamp,
    /// Of the message as JSON.
    pub(in crate::replay) place: Place,
    /// What lies there; `None`: there was no room.
    pub(in crate::replay) json: Option<Box<[u8]>>,
    /// Whose cycle said it, by its place among [`Index::speakers`], and which one.
    pub(in crate::replay) cycle: Option<(usize, u64)>,
}

/// All that is known of the chunks while they are not in memory.
#[derive(Debug, Default)]
pub(in crate::replay) struct Index {
    /// Of values: names of instances, and numbers.
    pub(in crate::replay) channels: Vec<(String, u16)>,
    /// Instance by channel.
    pub(in crate::replay) topics: BTreeMap<u16, String>,
    instances: BTreeMap<String, Recorded>,
    chunks: Vec<Indexed>,
    /// In the order of the file.
    pub(in crate::replay) logs: Vec<Logged>,
    /// Instances that said something.
    pub(in crate::replay) speakers: Vec<String>,
    /// Bytes of messages that are kept.
    said: usize,
    /// Messages that are none.
    pub(in crate::replay) unreadable_logs: u64,
    /// Main outputs in channels of their own, by channel and cycle.
    pub(in crate::replay) outputs: BTreeMap<(u16, u32), Place>,
    /// What those channels are called.
    pub(in crate::replay) output_channels: BTreeMap<String, u16>,
    log_channel: Option<u16>,
}

/// One chunk.
#[derive(Debug)]
struct Indexed {
    bytes: usize,
    values: ValuePlaces,
}

impl Place {
    fn new(chunk: usize, start: usize, length: usize) -> Self {
        // Chunks beyond 1 GiB are none, and a file has fewer than 2^32 of them.
        let [chunk, start, length] = [chunk, start, length].map(|number| number as u32);
        Self {
            chunk,
            start,
            length,
        }
    }

    /// Which chunk.
    pub(in crate::replay) fn chunk(self) -> usize {
        self.chunk as usize
    }

    /// The bytes, out of their chunk.
    pub(in crate::replay) fn part(self, chunk: &Chunk) -> Result<&[u8]> {
        let start = self.start as usize;
        let part = chunk.bytes().get(start..start + self.length as usize);
        part.ok_or_else(|| Error::new("the chunk is not the one that was indexed"))
    }
}

impl Frame {
    /// Whether the cycle was finished.
    pub fn is_finished(&self) -> bool {
        self.end.is_some()
    }
}

impl Index {
    /// Of a recording without chunks.
    ///
    /// # Errors
    /// If it was made by another version.
    pub(super) fn new(contents: &Contents) -> Result<Self> {
        let mut index = Self::default();
        for (number, channel) in &contents.channels {
            if channel.encoding == JSON {
                index.add_output(contents, *number, channel);
                if channel.topic == LOGS {
                    index.log_channel.get_or_insert(*number);
                }
            }
            if ![FRAMES, VALUES].contains(&&*channel.encoding) {
                continue;
            }
            let mut metadata = channel.metadata.iter();
            let version = metadata.find(|(key, _)| key == "version");
            let version = version.map_or("", |(_, version)| version);
            if version != VERSION.to_string() {
                return Err(Error::new(format!(
                    "the recording is of version `{version}`, this robot reads version {VERSION}"
                )));
            }
            match channel.topic.split_once('/') {
                Some(("frames", instance)) => {
                    index.topics.insert(*number, instance.to_owned());
                    index.instances.entry(instance.to_owned()).or_default();
                }
                Some(("values", instance)) => index.channels.push((instance.to_owned(), *number)),
                _ => {}
            }
        }
        Ok(index)
    }

    /// All that `--record-output` asked for. What is written in the form of a well-known message is not the value itself.
    fn add_output(&mut self, contents: &Contents, number: u16, channel: &Channel) {
        let mut schemas = contents.schemas.iter();
        let schema = schemas.find(|(number, _)| channel.schema == Some(*number));
        let is_other_form = schema.is_some_and(|(_, schema)| schema.name.starts_with("foxglove."));
        if channel.topic.contains(".main_outputs.") && !is_other_form {
            self.output_channels.insert(channel.topic.clone(), number);
        }
    }

    /// Adds what the next chunk has.
    pub(super) fn add(&mut self, chunk: &Chunk) {
        let number = self.chunks.len();
        let mut values = Vec::new();
        for (start, message) in chunk.placed_messages() {
            let Message {
                channel, sequence, ..
            } = message;
            let place = Place::new(number, start, message.data.len());
            if let Some(instance) = self.topics.get(&channel) {
                if let Some(recorded) = self.instances.get_mut(instance) {
                    recorded.add(instance, &message, place);
                }
            } else if self.channels.iter().any(|(_, known)| *known == channel) {
                values.push(ValuePlace {
                    channel,
                    sequence,
                    start: place.start,
                    length: place.length,
                });
            } else if self.log_channel == Some(channel) {
                self.add_log(&message, place);
            } else if self.output_channels.values().any(|known| *known == channel) {
                self.outputs.insert((channel, sequence), place);
            }
        }
        self.chunks.push(Indexed {
            bytes: chunk.bytes().len(),
            values: ValuePlaces::new(values),
        });
    }

    fn add_log(&mut self, message: &Message<'_>, place: Place) {
        let time = Timestamp::from_nanos(message.time);
        let Some(record) = from_log(time, message.data) else {
            self.unreadable_logs += 1;
            return;
        };
        let cycle = record.instance.zip(record.cycle);
        let cycle = cycle.map(|(instance, cycle)| {
            let mut speakers = self.speakers.iter();
            let known = speakers.position(|speaker| *speaker == instance);
            let speaker = known.unwrap_or_else(|| {
                self.speakers.push(instance.into_owned());
                self.speakers.len() - 1
            });
            (speaker, cycle)
        });
        let has_room = self.said + message.data.len() <= MOST_SAID;
        let json: Option<Box<[u8]>> = has_room.then(|| message.data.into());
        self.said += json.as_ref().map_or(0, |json| json.len());
        self.logs.push(Logged {
            time,
            place,
            json,
            cycle,
        });
    }

    /// The cycles of an instance; `None`: the recording has no such instance.
    pub(in crate::replay) fn of(&self, instance: &str) -> Option<&Recorded> {
        self.instances.get(instance)
    }

    pub(super) fn bytes_of(&self, chunk: usize) -> usize {
        self.chunks[chunk].bytes
    }

    pub(super) fn values_of(&self, chunk: usize) -> &ValuePlaces {
        &self.chunks[chunk].values
    }

    /// Where a chunk has a value.
    pub(in crate::replay) fn value(
        &self,
        chunk: usize,
        (channel, sequence): (u16, u32),
    ) -> Option<Place> {
        let found = self.chunks.get(chunk)?.values.find(channel, sequence)?;
        Some(Place {
            chunk: chunk as u32,
            start: found.start,
            length: found.length,
        })
    }

    /// All that chunks have of one value, in the order of the file.
    pub(in crate::replay) fn everywhere(&self, wanted: (u16, u32)) -> impl Iterator<Item = Place> {
        (0..self.chunks.len()).filter_map(move |chunk| self.value(chunk, wanted))
    }

    /// All values of one channel in the order of the file, each with its number.
    pub(in crate::replay) fn values(&self, channel: u16) -> impl Iterator<Item = (u32, Place)> {
        let chunks = self.chunks.iter().enumerate();
        chunks.flat_map(move |(chunk, indexed)| {
            let own = indexed.values.iter();
            let own = own.filter(move |value| value.channel == channel);
            own.map(move |value| {
                let place = Place {
                    chunk: chunk as u32,
                    start: value.start,
                    length: value.length,
                };
                (value.sequence, place)
            })
        })
    }
}

impl Recorded {
    fn add(&mut self, instance: &str, message: &Message<'_>, place: Place) {
        if self.damaged.is_none()
            && let Err(error) = self.understand(instance, message, place)
        {
            self.damaged = Some(error.to_string());
        }
    }

    fn understand(&mut self, instance: &str, message: &Message<'_>, place: Place) -> Result<()> {
        let damaged = || Error::new(format!("a frame of `{instance}` is damaged"));
        let (kind, content) = message.data.split_first().ok_or_else(damaged)?;
        let end = place.start + place.length;
        // The last so many bytes of the message.
        let last = |length: usize| Place {
            start: end - length as u32,
            length: length as u32,
            ..place
        };
        match *kind {
            BEGUN => {
                let mut content = Loading::new(content);
                let head: Head = content.take()?;
                self.frames.push(Frame {
                    head,
                    end: None,
                    content: last(content.rest().len()),
                    version: content.take().ok(),
                });
                Ok(())
            }
            FINISHED => {
                // It may stand alone in a chunk, and the one before, where its beginning stood, may be gone.
                let begun = self.frames.last_mut();
                if let Some(begun) =
                    begun.filter(|frame| frame.head.number as u32 == message.sequence)
                {
                    begun.end = Some(last(content.len()));
                }
                Ok(())
            }
            _ => Err(damaged()),
        }
    }
}
