//! What waits to be sent to one client: answers, which are never lost, and log messages and updates, of which the newest count.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use axum::extract::ws::Message;
use protocol::{Log, Lost};

use crate::bundle::{Bundle, Piece};
use crate::limits::Limits;

/// Bytes of a value, made once however many clients want it.
#[derive(Clone, Debug)]
pub(crate) enum Content {
    /// The rest of an update behind its subscription.
    Text(Arc<String>),
    /// The rest of a binary frame behind its subscription.
    Bytes(Arc<Vec<u8>>),
}

/// What must not be lost.
#[derive(Debug)]
enum Said {
    Text(String),
    /// A value that a request asked for, made once however many ask for it: the rest behind the number of the request.
    Value(u32, Arc<String>),
}

/// What is put into one message at most, before its last piece.
const BUNDLE: usize = 64 << 10;

/// What waits for one client.
#[derive(Debug, Default)]
pub(crate) struct Outbox {
    /// The client wants what waits in as few messages as there can be.
    is_bundling: bool,
    /// They come behind the texts that were sent last.
    frames: Option<Message>,
    answers: VecDeque<Said>,
    answer_bytes: usize,
    /// Oldest first, as they are sent.
    logs: VecDeque<String>,
    log_bytes: usize,
    /// Oldest first, by a number of their own.
    updates: BTreeMap<u64, (u32, Content)>,
    /// Numbers of each subscription's updates, oldest first.
    of_subscription: BTreeMap<u32, VecDeque<u64>>,
    /// Without those of the long one.
    update_bytes: usize,
    /// The update for which there is never room, and whose it is: one at a time waits beside the others.
    long: Option<(u64, u32)>,
    next: u64,
    /// Told with the next message.
    lost: BTreeMap<Option<u32>, u64>,
}

impl Content {
    fn len(&self) -> usize {
        match self {
            Self::Text(text) => text.len(),
            Self::Bytes(bytes) => bytes.len(),
        }
    }
}

impl Said {
    /// Bytes that are as good as all of it.
    fn len(&self) -> usize {
        match self {
            Self::Text(text) => text.len(),
            Self::Value(_, rest) => rest.len(),
        }
    }

    fn text(self) -> String {
        match self {
            Self::Text(text) => text,
            Self::Value(request, rest) => {
                format!(r#"{{"answer":{{"id":{request},"ok":{{"value":{{{rest}}}}}"#)
            }
        }
    }
}

impl Outbox {
    /// An answer, or anything else that must not be lost.
    pub(crate) fn say(&mut self, message: &protocol::Message) {
        // Messages consist of texts and numbers, which JSON can say.
        let text = serde_json::to_string(message).unwrap_or_default();
        self.keep(Said::Text(text));
    }

    /// The answer to a `read`: the rest of an update is that of a value, too.
    pub(crate) fn say_value(&mut self, request: u32, rest: Arc<String>) {
        self.keep(Said::Value(request, rest));
    }

    fn keep(&mut self, said: Said) {
        self.answer_bytes += said.len();
        self.answers.push_back(said);
    }

    /// A message that may be lost, and is told then; where there is no room, the oldest go.
    pub(crate) fn log(&mut self, log: Log, limits: &Limits) {
        let text = serde_json::to_string(&protocol::Message::Log(log)).unwrap_or_default();
        if text.len() > limits.queued_bytes {
            self.count_lost(None, 1);
            return;
        }
        self.log_bytes += text.len();
        self.logs.push_back(text);
        while self.log_bytes > limits.queued_bytes
            && let Some(oldest) = self.logs.pop_front()
        {
            self.log_bytes -= oldest.len();
            self.count_lost(None, 1);
        }
    }

    /// Whether the client took so many of its answers that it may ask for more.
    pub(crate) fn may_ask(&self, limits: &Limits) -> bool {
        self.answer_bytes <= limits.queued_bytes
    }

    /// A value of a subscription; where there is no room, its oldest go. Of those for which there never is any one waits, the
    /// newest of its subscription.
    pub(crate) fn update(&mut self, subscription: u32, content: Content, limits: &Limits) {
        let is_long = content.len() > limits.queued_bytes;
        if is_long && self.long.is_some_and(|(_, other)| other != subscription) {
            self.count_lost(Some(subscription), 1);
            return;
        }
        let waiting = |outbox: &Self| {
            let numbers = outbox.of_subscription.get(&subscription);
            numbers.map_or(0, VecDeque::len)
        };
        let bytes = if is_long { 0 } else { content.len() };
        while waiting(self) > 0
            && (waiting(self) >= limits.queued_updates
                || self.update_bytes + bytes > limits.queued_bytes
                || (is_long && self.long.is_some()))
        {
            self.lose_oldest(subscription);
        }
        // Its own are gone: now those that wait longest.
        while self.update_bytes + bytes > limits.queued_bytes
            && let Some((_, (oldest, _))) = self.updates.first_key_value()
        {
            self.lose_oldest(*oldest);
        }
        if is_long {
            self.long = Some((self.next, subscription));
        }
        self.update_bytes += bytes;
        self.updates.insert(self.next, (subscription, content));
        let numbers = self.of_subscription.entry(subscription).or_default();
        numbers.push_back(self.next);
        self.next += 1;
    }

    /// Something was lost before it came here.
    pub(crate) fn count_lost(&mut self, subscription: Option<u32>, updates: u64) {
        if updates > 0 {
            *self.lost.entry(subscription).or_default() += updates;
        }
    }

    /// There will be no more of it.
    pub(crate) fn forget(&mut self, subscription: u32) {
        for number in self
            .of_subscription
            .remove(&subscription)
            .into_iter()
            .flatten()
        {
            self.remove(number);
        }
        self.lost.remove(&Some(subscription));
    }

    /// From now on.
    pub(crate) fn bundle(&mut self) {
        self.is_bundling = true;
    }

    /// What to send next.
    pub(crate) fn next(&mut self) -> Option<Message> {
        if self.frames.is_some() {
            return self.frames.take();
        }
        let mut bundle = Bundle::default();
        bundle.add(self.next_piece()?);
        while self.is_bundling
            && bundle.length() < BUNDLE
            && let Some(piece) = self.next_piece()
        {
            bundle.add(piece);
        }
        let [texts, frames] = bundle.messages();
        self.frames = frames;
        texts.or_else(|| self.frames.take())
    }

    /// Answers, what was lost, log messages, updates.
    fn next_piece(&mut self) -> Option<Piece> {
        if let Some(answer) = self.answers.pop_front() {
            self.answer_bytes -= answer.len();
            return Some(Piece::Text(answer.text()));
        }
        if let Some((subscription, updates)) = self.lost.pop_first() {
            let lost = protocol::Message::Lost(Lost {
                subscription,
                updates,
            });
            return serde_json::to_string(&lost).ok().map(Piece::Text);
        }
        if let Some(log) = self.logs.pop_front() {
            self.log_bytes -= log.len();
            return Some(Piece::Text(log));
        }
        let (number, (subscription, content)) = self.updates.pop_first()?;
        self.make_room(number, &content);
        if let Some(numbers) = self.of_subscription.get_mut(&subscription) {
            numbers.pop_front();
        }
        Some(piece(subscription, &content))
    }

    fn lose_oldest(&mut self, subscription: u32) {
        let numbers = self.of_subscription.get_mut(&subscription);
        if let Some(number) = numbers.and_then(VecDeque::pop_front) {
            self.remove(number);
            self.count_lost(Some(subscription), 1);
        }
    }

    fn remove(&mut self, number: u64) {
        if let Some((_, content)) = self.updates.remove(&number) {
            self.make_room(number, &content);
        }
    }

    /// It waits no more.
    fn make_room(&mut self, number: u64, content: &Content) {
        if self.long.is_some_and(|(long, _)| long == number) {
            self.long = None;
        } else {
            self.update_bytes -= content.len();
        }
    }
}

/// Puts the subscription in front of what is the same for all clients.
fn piece(subscription: u32, content: &Content) -> Piece {
    match content {
        Content::Text(rest) => Piece::Text(format!(
            r#"{{"update":{{"subscription":{subscription},{rest}"#
        )),
        Content::Bytes(rest) => {
            let mut bytes = Vec::with_capacity(protocol::BINARY_MAGIC.len() + 4 + rest.len());
            bytes.extend_from_slice(&protocol::BINARY_MAGIC);
            bytes.extend_from_slice(&subscription.to_le_bytes());
            bytes.extend_from_slice(rest);
            Piece::Frame(bytes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(length: usize) -> Content {
        Content::Text(Arc::new("x".repeat(length)))
    }

    fn limits() -> Limits {
        Limits {
            queued_updates: 3,
            queued_bytes: 100,
            ..Limits::default()
        }
    }

    fn sent(outbox: &mut Outbox) -> Vec<String> {
        std::iter::from_fn(|| outbox.next())
            .map(|message| message.into_text().expect("text").to_string())
            .collect()
    }

    #[test]
    fn of_one_subscription_the_newest_are_kept_and_the_others_told() {
        let mut outbox = Outbox::default();
        for length in 1..=5 {
            outbox.update(7, text(length), &limits());
        }
        outbox.update(8, text(1), &limits());
        let expected = [
            r#"{"lost":{"subscription":7,"updates":2}}"#,
            r#"{"update":{"subscription":7,xxx"#,
            r#"{"update":{"subscription":7,xxxx"#,
            r#"{"update":{"subscription":7,xxxxx"#,
            r#"{"update":{"subscription":8,x"#,
        ];
        assert_eq!(sent(&mut outbox), expected);
        assert_eq!(outbox.update_bytes, 0);
    }

    #[test]
    fn bytes_are_limited_and_the_large_pay_first() {
        let mut outbox = Outbox::default();
        outbox.update(1, text(10), &limits());
        outbox.update(2, text(80), &limits());
        outbox.update(2, text(80), &limits());
        assert_eq!(outbox.updates.len(), 2);
        outbox.update(3, text(100), &limits());
        let lost: Vec<_> = outbox.lost.clone().into_iter().collect();
        assert_eq!(lost, [(Some(1), 1), (Some(2), 2)]);
        assert_eq!(outbox.update_bytes, 100);
    }

    #[test]
    fn of_updates_that_are_larger_than_all_that_may_wait_one_waits_beside_them() {
        let mut outbox = Outbox::default();
        outbox.update(1, text(1), &limits());
        outbox.update(2, text(101), &limits());
        outbox.update(3, text(101), &limits());
        outbox.update(1, text(99), &limits());
        assert_eq!(outbox.update_bytes, 100);
        // The newest of its subscription.
        outbox.update(2, text(102), &limits());
        outbox.update(3, text(101), &limits());
        let begin = |subscription: u32, length: usize| {
            let x = "x".repeat(length);
            format!(r#"{{"update":{{"subscription":{subscription},{x}"#)
        };
        let expected = [
            r#"{"lost":{"subscription":2,"updates":1}}"#.to_owned(),
            r#"{"lost":{"subscription":3,"updates":2}}"#.to_owned(),
            begin(1, 1),
            begin(1, 99),
            begin(2, 102),
        ];
        assert_eq!(sent(&mut outbox), expected);
        // Once it is sent, and once nobody wants it any more, there is a place.
        outbox.update(3, text(101), &limits());
        outbox.forget(3);
        outbox.update(1, text(101), &limits());
        assert_eq!(sent(&mut outbox), [begin(1, 101)]);
        assert_eq!(outbox.update_bytes, 0);
    }

    #[test]
    fn of_log_messages_the_newest_are_kept_and_who_waits_for_them_may_ask() {
        let limits = Limits {
            queued_bytes: 400,
            ..Limits::default()
        };
        let log = |number, message: &str| Log {
            number,
            time: 0,
            level: protocol::Level::Info,
            instance: None,
            node: None,
            cycle: None,
            message: message.to_owned(),
            fields: serde_json::Map::default(),
        };
        let mut outbox = Outbox::default();
        for number in 1..=9 {
            outbox.log(log(number, &"x".repeat(100)), &limits);
        }
        outbox.log(log(10, &"x".repeat(400)), &limits);
        outbox.update(1, text(1), &limits);
        assert!(outbox.may_ask(&limits));
        let sent = sent(&mut outbox);
        assert_eq!(sent[0], r#"{"lost":{"updates":8}}"#);
        let begins = |text: &String, begin: &str| text.starts_with(begin);
        assert!(begins(&sent[1], r#"{"log":{"number":8,"#), "{sent:?}");
        assert!(begins(&sent[2], r#"{"log":{"number":9,"#), "{sent:?}");
        assert!(begins(&sent[3], r#"{"update":"#), "{sent:?}");
        assert_eq!(sent.len(), 4);
    }

    #[test]
    fn who_wants_bundles_gets_what_waits_in_two_messages() {
        let limits = Limits::default();
        let text = |number| Content::Text(Arc::new(format!("{number}}}}}")));
        let frame = |byte| Content::Bytes(Arc::new(vec![byte; 20]));
        let mut outbox = Outbox::default();
        outbox.bundle();
        for number in 1..4 {
            outbox.update(1, text(number), &limits);
            outbox.update(3, frame(number), &limits);
        }
        outbox.count_lost(Some(9), 4);
        let texts = r#"[{"lost":{"subscription":9,"updates":4}},{"update":{"subscription":1,1}},{"update":{"subscription":1,2}},{"update":{"subscription":1,3}}]"#;
        assert_eq!(outbox.next(), Some(Message::text(texts)));
        let mut frames = b"HKGS".to_vec();
        for byte in 1..4 {
            frames.extend(28_u32.to_le_bytes());
            frames.extend(b"HKG1\x03\0\0\0");
            frames.extend([byte; 20]);
        }
        assert_eq!(outbox.next(), Some(Message::binary(frames)));
        assert_eq!(outbox.next(), None);
        // One alone is no bundle.
        outbox.update(1, text(6), &limits);
        let alone = r#"{"update":{"subscription":1,6}}"#;
        assert_eq!(outbox.next(), Some(Message::text(alone)));
        assert_eq!(outbox.next(), None);
        // What is large goes with what came before it, and ends the bundle.
        let large = Content::Bytes(Arc::new(vec![7; BUNDLE]));
        for content in [frame(1), large, frame(2)] {
            outbox.update(4, content, &limits);
        }
        let lengths = [(); 2].map(|()| outbox.next().expect("it waits").into_data().len());
        assert_eq!(lengths, [4 + 4 + 28 + 4 + 8 + BUNDLE, 28]);
    }

    #[test]
    fn what_is_forgotten_is_neither_sent_nor_told() {
        let mut outbox = Outbox::default();
        for _ in 0..5 {
            outbox.update(1, text(1), &limits());
        }
        outbox.forget(1);
        assert_eq!(sent(&mut outbox), Vec::<String>::new());
        assert_eq!(outbox.update_bytes, 0);
    }
}
