//! One output of one instance, and everything that clients want of it.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::reflect::{Path, Reflect, ResolvedPath, Shape, binary};
use framework::tap::WINDOW;
use framework::{OutputKind, Tap, Tapped};
use protocol::Encoding;

use crate::hub::{Client, ClientId};
use crate::limits::Limits;
use crate::outbox::Content;
use crate::press::Press;

/// An output with its tap.
pub(crate) struct Source {
    /// `VisionTop.main_outputs.balls`.
    pub(crate) path: String,
    pub(crate) instance: usize,
    pub(crate) shape: Shape,
    tap: Tap,
    streams: Vec<Stream>,
    /// Copies that came too late, so far.
    dropped: u64,
    /// A client has replaced it.
    pub(crate) is_injected: bool,
}

/// One part of an output in one encoding.
struct Stream {
    part: ResolvedPath,
    encoding: Encoding,
    subscribers: Vec<Subscriber>,
    readers: Vec<Reader>,
}

/// Who wants it again and again.
struct Subscriber {
    client: ClientId,
    subscription: u32,
    rate: Rate,
}

/// Who wants it once.
struct Reader {
    client: ClientId,
    request: u32,
    /// A cycle wrote it when too many answers waited for the client.
    is_passed_over: bool,
}

/// The greatest rate of a subscription, by the timestamps of cycles.
pub(crate) struct Rate {
    /// Nanoseconds.
    period: u64,
    /// `None` before the first value, which is always due.
    due: Option<u64>,
    /// The time of the last value that was sent, and when that was.
    sent: Option<(u64, Instant)>,
}

impl Rate {
    /// At most so many per second; every cycle without.
    pub(crate) fn new(per_second: Option<f64>) -> Self {
        let period = per_second.map_or(0.0, |rate| 1e9 / rate);
        Self {
            // Saturates: slower than once in centuries is never.
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "it saturates"
            )]
            period: period as u64,
            due: None,
            sent: None,
        }
    }

    /// Whether a value of this time is to be sent.
    ///
    /// In a replay time also goes back, or stands still between the steps of somebody who looks closely.
    pub(crate) fn is_due(&mut self, time: u64) -> bool {
        let period = Duration::from_nanos(self.period);
        let is_restart = self
            .sent
            .is_some_and(|(last, at)| time < last || at.elapsed() > period.saturating_mul(2));
        let due = self.due.filter(|_| !is_restart).unwrap_or(time);
        if time < due {
            return false;
        }
        self.sent = Some((time, Instant::now()));
        // In step where it can be, so that 83 Hz at a rate of 40 gives 40 and not 27; but never in less than half the period.
        let in_step = due.saturating_add(self.period);
        let next = if in_step > time {
            in_step.max(time.saturating_add(self.period / 2))
        } else {
            time.saturating_add(self.period)
        };
        self.due = Some(next);
        true
    }
}

impl Source {
    pub(crate) fn new(instance: usize, instance_name: &str, tap: Tap) -> Self {
        let part = match tap.kind() {
            OutputKind::Main => "main_outputs",
            OutputKind::Additional => "additional_outputs",
        };
        Self {
            path: format!("{instance_name}.{part}.{}", tap.name()),
            instance,
            shape: tap.shape(),
            tap,
            streams: Vec::new(),
            dropped: 0,
            is_injected: false,
        }
    }

    pub(crate) fn kind(&self) -> OutputKind {
        self.tap.kind()
    }

    pub(crate) fn name(&self) -> &'static str {
        self.tap.name()
    }

    /// The JPEG files that are made of each of its values.
    pub(crate) fn jpegs(&self) -> usize {
        self.jpeg_streams().count()
    }

    /// Those of them that the client takes.
    pub(crate) fn jpegs_of(&self, client: ClientId) -> usize {
        let takes = |stream: &&Stream| stream.subscribers.iter().any(|it| it.client == client);
        self.jpeg_streams().filter(takes).count()
    }

    fn jpeg_streams(&self) -> impl Iterator<Item = &Stream> {
        let is_jpeg = |stream: &&Stream| matches!(stream.encoding, Encoding::Jpeg { .. });
        self.streams.iter().filter(is_jpeg)
    }

    /// Whether somebody has the part in this encoding already.
    pub(crate) fn has(&self, part: &ResolvedPath, encoding: Encoding) -> bool {
        let mut streams = self.streams.iter();
        streams.any(|stream| stream.part.path() == part.path() && stream.encoding == encoding)
    }

    pub(crate) fn is_open(&self) -> bool {
        self.tap.is_open()
    }

    /// From now on the client gets the part.
    pub(crate) fn subscribe(
        &mut self,
        part: ResolvedPath,
        encoding: Encoding,
        client: ClientId,
        subscription: u32,
        rate: Rate,
    ) {
        self.stream(part, encoding).subscribers.push(Subscriber {
            client,
            subscription,
            rate,
        });
        self.tap.open();
    }

    pub(crate) fn unsubscribe(&mut self, client: ClientId, subscription: u32) {
        for stream in &mut self.streams {
            let before = stream.subscribers.len();
            stream.subscribers.retain(|subscriber| {
                (subscriber.client, subscriber.subscription) != (client, subscription)
            });
            (stream.subscribers.len()..before).for_each(|_| self.tap.close());
        }
        self.forget_unused();
    }

    /// The client gets the part of the next cycle that has one.
    pub(crate) fn read(&mut self, part: ResolvedPath, client: ClientId, request: u32) {
        let stream = self.stream(part, Encoding::Json);
        stream.readers.push(Reader {
            client,
            request,
            is_passed_over: false,
        });
        self.tap.open();
    }

    /// Whether a cycle passed the client over; `None` where it does not wait for this one any more.
    pub(crate) fn passed_over(&self, client: ClientId, request: u32) -> Option<bool> {
        let mut readers = self.streams.iter().flat_map(|stream| &stream.readers);
        let reader = readers.find(|it| (it.client, it.request) == (client, request))?;
        Some(reader.is_passed_over)
    }

    /// The client does not wait for this one any more, of several with its number for one; without a number, for none.
    pub(crate) fn stop_reading(&mut self, client: ClientId, request: Option<u32>) {
        let mut left = request.map_or(usize::MAX, |_| 1);
        for stream in &mut self.streams {
            let before = stream.readers.len();
            stream.readers.retain(|reader| {
                let stops = left > 0
                    && reader.client == client
                    && request.is_none_or(|it| it == reader.request);
                left -= usize::from(stops);
                !stops
            });
            (stream.readers.len()..before).for_each(|_| self.tap.close());
        }
        self.forget_unused();
    }

    /// Hands out the copies that the instance has left; of those that it leaves meanwhile some may wait for the next time.
    pub(crate) fn hand_out(
        &mut self,
        clients: &mut BTreeMap<ClientId, Client>,
        press: &mut Press,
        limits: &Limits,
    ) {
        let Self {
            tap,
            streams,
            is_injected,
            ..
        } = self;
        let mut read = 0;
        as_many_as_wait(|| {
            tap.take(|tapped| {
                for stream in streams.iter_mut() {
                    read += stream.hand_out(tapped, *is_injected, clients, press, limits);
                }
            })
        });
        (0..read).for_each(|_| tap.close());
        let lost = tap.dropped() - self.dropped;
        self.dropped += lost;
        if lost > 0 {
            streams.iter().for_each(|stream| stream.lose(lost, clients));
        }
        if read > 0 {
            self.forget_unused();
        }
    }

    fn stream(&mut self, part: ResolvedPath, encoding: Encoding) -> &mut Stream {
        let known = self
            .streams
            .iter()
            .position(|stream| stream.part.path() == part.path() && stream.encoding == encoding);
        let position = known.unwrap_or_else(|| {
            self.streams.push(Stream {
                part,
                encoding,
                subscribers: Vec::new(),
                readers: Vec::new(),
            });
            self.streams.len() - 1
        });
        &mut self.streams[position]
    }

    fn forget_unused(&mut self) {
        self.streams
            .retain(|stream| !stream.subscribers.is_empty() || !stream.readers.is_empty());
    }
}

impl Stream {
    /// Makes the text or the bytes at most once; gives how many readers have what they wanted.
    fn hand_out(
        &mut self,
        tapped: Tapped<'_>,
        is_injected: bool,
        clients: &mut BTreeMap<ClientId, Client>,
        press: &mut Press,
        limits: &Limits,
    ) -> usize {
        let (cycle, time) = (tapped.cycle, tapped.timestamp.as_nanos());
        if matches!(self.encoding, Encoding::Jpeg { .. }) && !press.is_free(Instant::now()) {
            self.lose(1, clients);
            return 0;
        }
        let part = self.part.find(tapped.value);
        let readers = self.take_readers(clients, limits);
        let mut content = None;
        for subscriber in &mut self.subscribers {
            if !subscriber.rate.is_due(time) {
                continue;
            }
            if let Some(client) = clients.get_mut(&subscriber.client) {
                let content = content.get_or_insert_with(|| match self.encoding {
                    Encoding::Binary => encode(&self.part, part, cycle, time),
                    Encoding::Json => Content::Text(write(part, cycle, time, is_injected)),
                    Encoding::Jpeg { quality } => {
                        let mut bytes = stamp(cycle, time);
                        bytes.extend(press.compress(self.part.shape(), part, quality));
                        Content::Bytes(Arc::new(bytes))
                    }
                });
                client
                    .outbox
                    .update(subscriber.subscription, content.clone(), limits);
                client.news.notify_one();
            }
        }
        if readers.is_empty() {
            return 0;
        }
        let text = match content {
            Some(Content::Text(text)) => text,
            _ => write(part, cycle, time, is_injected),
        };
        for reader in &readers {
            if let Some(client) = clients.get_mut(&reader.client) {
                client.outbox.say_value(reader.request, text.clone());
                client.news.notify_one();
            }
        }
        readers.len()
    }

    /// Those that get a value now; who has too many answers to take waits for another cycle.
    fn take_readers(
        &mut self,
        clients: &BTreeMap<ClientId, Client>,
        limits: &Limits,
    ) -> Vec<Reader> {
        let may_ask = |reader: &mut Reader| {
            let client = clients.get(&reader.client);
            let may_ask = client.is_none_or(|client| client.outbox.may_ask(limits));
            reader.is_passed_over |= !may_ask;
            may_ask
        };
        self.readers.extract_if(.., may_ask).collect()
    }

    /// There was no time for so many cycles. Who does not want every one gets the next instead.
    fn lose(&self, cycles: u64, clients: &mut BTreeMap<ClientId, Client>) {
        let subscribers = self.subscribers.iter();
        for subscriber in subscribers.filter(|subscriber| subscriber.rate.period == 0) {
            if let Some(client) = clients.get_mut(&subscriber.client) {
                let subscription = Some(subscriber.subscription);
                client.outbox.count_lost(subscription, cycles);
                client.news.notify_one();
            }
        }
    }
}

/// The rest of an update, or of the answer to a `read`: what is the same for all clients.
fn write(part: Option<&dyn Reflect>, cycle: u64, time: u64, is_injected: bool) -> Arc<String> {
    let mark = if is_injected {
        r#""injected":true,"#
    } else {
        ""
    };
    let mut text = format!(r#""cycle":{cycle},"time":{time},{mark}"value":"#).into_bytes();
    let start = text.len();
    let written =
        part.is_some_and(|part| serde_json::to_writer(&mut text, part.as_serialize()).is_ok());
    if !written {
        text.truncate(start);
        text.extend_from_slice(b"null");
    }
    text.extend_from_slice(b"}}");
    // What serde_json writes is UTF-8.
    Arc::new(String::from_utf8(text).unwrap_or_default())
}

/// The rest of a binary frame; without a value where the part is not there.
fn encode(path: &ResolvedPath, part: Option<&dyn Reflect>, cycle: u64, time: u64) -> Content {
    let mut bytes = stamp(cycle, time);
    if let Some(part) = part {
        // On an error nothing is appended, which is as good as absent.
        let _ = binary::encode_as(path.shape(), part, &mut bytes);
    }
    Content::Bytes(Arc::new(bytes))
}

/// What stands in front of the value in a binary frame, behind the subscription.
fn stamp(cycle: u64, time: u64) -> Vec<u8> {
    [cycle.to_le_bytes(), time.to_le_bytes()].concat()
}

/// A path below an output, looked up in its type.
pub(crate) fn resolve(shape: &Shape, below: &str) -> Result<ResolvedPath, String> {
    let path: Path = below.parse().map_err(|error| format!("{error}"))?;
    ResolvedPath::new(shape, &path).map_err(|unknown| unknown.to_string())
}

/// Takes until there is nothing, but no more than can wait at once: an instance that is faster than its copies are handed out
/// would have them handed out for ever, and nobody would be heard.
fn as_many_as_wait(mut take: impl FnMut() -> bool) {
    for _ in 0..WINDOW {
        if !take() {
            return;
        }
    }
}

#[cfg(test)]
mod tests;
