//! What nodes, hardware and framework say, as a channel of Foxglove's log messages.
//!
//! Messages wait in their queue until a thread of the recording's own looks: no cycle waits for it. What the queue has no
//! room for is told in a message of its own.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use hulkgen_recording::{Channel, ChannelId, Description, Schema, Track};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::SaveError;
use super::output::JSON;
use crate::clock::Clock;
use crate::foxglove::{Log, Message};
use crate::logs::{Level, Rates, Record, Sink};
use crate::time::Timestamp;

/// What the channel is called, and the track among those of instances.
pub(crate) const LOGS: &str = "logs";

/// How often the thread looks: the queue has room for more than nodes say in this time.
const LOOK: Duration = Duration::from_millis(50);

/// Messages of a module in a second: what one says in a loop takes no room from frames.
const MOST: usize = 200;

/// Describes the channel, behind those that there are.
pub(super) fn add_channel(description: &mut Description) -> ChannelId {
    let schema = description.schemas.len() as u16;
    let channel = ChannelId(description.channels.len() as u16);
    description.schemas.push(Schema {
        name: Log::SCHEMA.name.to_owned(),
        encoding: "jsonschema".to_owned(),
        data: (Log::SCHEMA.json)().to_string().into_bytes(),
    });
    description.channels.push(Channel {
        topic: LOGS.to_owned(),
        schema: Some(schema),
        encoding: JSON.to_owned(),
        metadata: Vec::new(),
        once_per_chunk: false,
    });
    channel
}

/// The thread that records messages; it ends with this.
pub(super) struct LogRecorder {
    is_ending: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl LogRecorder {
    /// Records what is said from now on, by this clock.
    ///
    /// # Errors
    /// If there can be no thread.
    pub(super) fn start(track: Track, channel: ChannelId, clock: Clock) -> std::io::Result<Self> {
        let is_ending = Arc::<AtomicBool>::default();
        let sink = Sink::new(clock.clone());
        let mut writing = Writing {
            track,
            channel,
            sink,
            clock,
            rates: Rates::default(),
        };
        let ending = is_ending.clone();
        let thread = thread::Builder::new()
            .name("logs".to_owned())
            .spawn(move || {
                // Relaxed: nothing else is told by it; what was said before is in the queue, which orders itself.
                while !ending.load(Ordering::Relaxed) {
                    writing.record();
                    thread::park_timeout(LOOK);
                }
                writing.record();
            })?;
        Ok(Self {
            is_ending,
            thread: Some(thread),
        })
    }
}

impl Drop for LogRecorder {
    fn drop(&mut self) {
        self.is_ending.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            // A panic there has been told; what it had not written is lost with it.
            let _ = thread.join();
        }
    }
}

struct Writing {
    track: Track,
    channel: ChannelId,
    sink: Arc<Sink>,
    clock: Clock,
    rates: Rates,
}

impl Writing {
    fn record(&mut self) {
        let mut left_out = 0;
        while let Some(record) = self.sink.take() {
            if self.rates.is_allowed(&record, MOST) {
                self.write(&record);
            } else {
                left_out += 1;
            }
        }
        left_out += self.sink.left_out();
        if left_out > 0 {
            let message = format!("{left_out} messages were left out: too many at once");
            let now = self.clock.now();
            self.write(&Record {
                time: now,
                heard: now,
                level: Level::WARN,
                module: module_path!().into(),
                instance: None,
                cycle: None,
                message,
                fields: Map::new(),
            });
        }
        // Whoever looks at the file of a running robot finds them.
        self.track.hand_over();
    }

    fn write(&mut self, record: &Record) {
        let text = as_log(record).to_string();
        let time = record.time.as_nanos();
        let cycle = record.cycle.unwrap_or_default() as u32;
        // What becomes of it is counted.
        let _ = self.track.frame(time, 0, |frame| {
            frame.message(self.channel, cycle, time, |writing| {
                writing.put(text.as_bytes()).map_err(SaveError::from)
            })
        });
    }
}

/// The message in Foxglove's form, and what that has no field for.
fn as_log(record: &Record) -> Value {
    let log = Log {
        timestamp: record.time.into(),
        level: match record.level {
            Level::TRACE | Level::DEBUG => 1,
            Level::INFO => 2,
            Level::WARN => 3,
            Level::ERROR => 4,
        },
        message: record.message.clone(),
        name: record.module.clone().into_owned(),
        ..Log::default()
    };
    let mut log = crate::foxglove::written(&log).unwrap_or_default();
    if let Some(log) = log.as_object_mut() {
        log.insert("instance".to_owned(), record.instance.as_deref().into());
        log.insert("cycle".to_owned(), record.cycle.into());
        log.insert("fields".to_owned(), record.fields.clone().into());
    }
    log
}

/// A message as a recording has it; more is in it for other tools.
#[derive(Deserialize)]
struct Said {
    level: u8,
    message: String,
    name: String,
    #[serde(default)]
    instance: Option<String>,
    #[serde(default)]
    cycle: Option<u64>,
    #[serde(default)]
    fields: Map<String, Value>,
}

/// What was said at this time; `None`: the bytes are no such message.
pub(crate) fn from_log(time: Timestamp, json: &[u8]) -> Option<Record> {
    let said: Said = serde_json::from_slice(json).ok()?;
    Some(Record {
        time,
        heard: time,
        level: match said.level {
            0 | 1 => Level::DEBUG,
            2 => Level::INFO,
            3 => Level::WARN,
            _ => Level::ERROR,
        },
        module: said.name.into(),
        instance: said.instance.map(Into::into),
        cycle: said.cycle,
        message: said.message,
        fields: said.fields,
    })
}
