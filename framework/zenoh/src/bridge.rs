//! Both sides together: what the robot says is published, what others wish is asked of the robot.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use client::{Heard, Robot};
use protocol::{Answer, Ask, Change, Good, Message, Outcome};
use serde_json::{Value, json};
use zenoh::query::Query;

use crate::Result;
use crate::cdr::{self, Layout};
use crate::edges::{self, Direction, Edge, Encoding, Kind};
use crate::feed;
use crate::keys::{Keys, LONGEST, Wish, refuse};

/// Answers that are awaited of the robot at a time; it has a limit of its own for those that take long.
const AWAITED: usize = 64;

/// An answer that takes longer comes no more; a robot lets calls wait for 5 s.
const PATIENCE: Duration = Duration::from_secs(10);

/// Lists and objects within each other: a robot refuses deeper requests without saying which it refuses.
const DEEPEST: usize = 48;

/// The word before the paths of parameters, which changes do without.
const PARAMETERS: &str = "parameters.";

/// A robot whose outputs, parameters and procedures have keys.
pub(crate) struct Bridge<'keys> {
    robot: Robot,
    keys: &'keys mut Keys,
    /// By the robot's number.
    subscriptions: BTreeMap<u32, Subscription>,
    /// Of parameters, by place in the list of edges.
    told: BTreeMap<usize, Told>,
    /// By number of the request.
    awaited: BTreeMap<u32, Awaited>,
    /// How often what came in was refused, by path.
    refused: BTreeMap<String, u64>,
}

/// Values of an edge.
struct Subscription {
    /// Place in the list of edges.
    edge: usize,
    /// Of binary values.
    layout: Option<Layout>,
}

/// What was published of a parameter: the robot tells each with every change of any.
struct Told {
    value: Vec<u8>,
    /// Nothing was written since.
    is_current: bool,
}

/// A request whose answer somebody waits for.
struct Awaited {
    /// Nobody waits longer.
    until: Instant,
    asker: Asker,
}

/// Who gets an answer.
enum Asker {
    /// What the robot answers is the answer.
    Query(usize, Query),
    /// A value came without a question: who sent it can only be told here.
    Put(usize, String),
    /// A parameter was written: its value then is the answer.
    Written(usize, Query),
}

impl<'keys> Bridge<'keys> {
    /// Declares what the robot's manifest maps, and subscribes to what goes out. What the robot or CDR refuses is told and
    /// left out.
    ///
    /// # Errors
    /// If Zenoh refuses a key.
    pub(crate) fn start(mut robot: Robot, keys: &'keys mut Keys) -> Result<Self> {
        let edges = edges::of_robot(&mut robot).unwrap_or_else(|message| {
            eprintln!("warning: {message}");
            Vec::new()
        });
        keys.declare(edges)?;
        let mut bridge = Self {
            robot,
            keys,
            subscriptions: BTreeMap::new(),
            told: BTreeMap::new(),
            awaited: BTreeMap::new(),
            refused: BTreeMap::new(),
        };
        for index in 0..bridge.keys.edges().len() {
            let edge = bridge.keys.edges()[index].clone();
            if edge.goes_out()
                && let Err(message) = bridge.subscribe(index, &edge)
            {
                eprintln!("warning: `{}`: {message}", edge.path);
            }
        }
        Ok(bridge)
    }

    fn subscribe(&mut self, edge: usize, wanted: &Edge) -> Result<()> {
        let asked = Ask::Subscribe {
            path: wanted.path.clone(),
            rate: wanted.rate,
            encoding: match wanted.encoding {
                Encoding::Json => protocol::Encoding::Json,
                Encoding::Cdr => protocol::Encoding::Binary,
            },
        };
        let Good::Subscribed(subscribed) = self.robot.ask(asked)? else {
            return Err("the robot subscribes nobody".to_owned());
        };
        let layout = subscribed.layout.map(Layout::read).transpose();
        match layout {
            Ok(layout) => {
                let subscription = Subscription { edge, layout };
                self.subscriptions
                    .insert(subscribed.subscription, subscription);
                Ok(())
            }
            Err(message) => {
                let subscription = subscribed.subscription;
                self.robot.ask(Ask::Unsubscribe { subscription })?;
                Err(message)
            }
        }
    }

    /// Who is bridged.
    pub(crate) fn greeting(&self) -> String {
        let edges = self.keys.edges().len();
        let plural = if edges == 1 { "key" } else { "keys" };
        format!("{} has {edges} {plural}", self.robot.welcome.robot)
    }

    /// Does what is wished, and hands on what the robot says.
    ///
    /// # Errors
    /// If the robot went away.
    pub(crate) fn turn(&mut self) -> Result<()> {
        self.give_up();
        while self.awaited.len() < AWAITED
            && let Ok(wish) = self.keys.wishes.try_recv()
        {
            self.grant(wish)?;
        }
        match self.robot.hear()? {
            Some(Heard::Message(Message::Update(update))) => {
                let attachment = json!({ "cycle": update.cycle, "time": update.time });
                if let Some(one) = self.subscriptions.get(&update.subscription) {
                    let edge = one.edge;
                    let (value, attachment) = (update.value.to_string(), attachment.to_string());
                    self.publish(edge, value.into(), attachment.into());
                }
            }
            Some(Heard::Frame(frame)) if !frame.value.is_empty() => {
                let subscription = self.subscriptions.get(&frame.subscription);
                if let Some(Subscription {
                    edge,
                    layout: Some(layout),
                }) = subscription
                {
                    let edge = *edge;
                    let time = self.robot.since_1970(frame.time);
                    let attachment = cdr::attachment(frame.cycle, time, self.keys.id());
                    match layout.to_cdr(&frame.value) {
                        Ok(value) => self.publish(edge, value, attachment),
                        Err(message) => eprintln!("warning: {message}"),
                    }
                }
            }
            Some(Heard::Message(Message::Answer(answer))) => self.hand_on(answer)?,
            Some(Heard::Message(Message::Lost(lost))) => {
                eprintln!("warning: {} updates of the robot are lost", lost.updates);
            }
            _ => {}
        }
        Ok(())
    }

    /// The robot went away: who waits for it is told.
    pub(crate) fn end(self, reason: &str) {
        for awaited in self.awaited.into_values() {
            awaited.asker.refuse(reason);
        }
    }

    /// Remembers whom the answer to this request is for.
    fn await_answer(&mut self, id: u32, asker: Asker) {
        let until = Instant::now() + PATIENCE;
        self.awaited.insert(id, Awaited { until, asker });
    }

    /// An answer that never comes must not take the place of others.
    fn give_up(&mut self) {
        let now = Instant::now();
        let late = self.awaited.iter().filter(|(_, one)| one.until <= now);
        let late: Vec<u32> = late.map(|(id, _)| *id).collect();
        for awaited in late.iter().filter_map(|id| self.awaited.remove(id)) {
            awaited.asker.refuse("the robot does not answer");
        }
    }

    fn publish(&mut self, edge: usize, value: Vec<u8>, attachment: Vec<u8>) {
        if self.is_news(edge, &value)
            && let Err(message) = self.keys.publish(edge, value, attachment)
        {
            eprintln!("warning: {message}");
        }
    }

    /// Outputs always are; of parameters only what differs, or two bridges of one key would answer each other for ever.
    fn is_news(&mut self, edge: usize, value: &[u8]) -> bool {
        let kind = self.keys.edges().get(edge).map(|edge| edge.kind);
        if kind != Some(Kind::Parameter) {
            return true;
        }
        let is_current = !self.awaited.values().any(|one| one.asker.writes(edge));
        let value = value.to_vec();
        let before = self.told.get(&edge);
        let is_news = before.is_none_or(|before| before.value != value);
        self.told.insert(edge, Told { value, is_current });
        is_news
    }

    /// Whether the robot has this value already, as far as it told.
    fn has(&self, edge: usize, value: &Value) -> bool {
        let told = self.told.get(&edge).filter(|told| told.is_current);
        told.is_some_and(|told| told.value == value.to_string().as_bytes())
    }

    /// What was told is not to be relied on until the robot tells anew.
    fn will_write(&mut self, edge: usize) {
        if let Some(told) = self.told.get_mut(&edge) {
            told.is_current = false;
        }
    }

    /// Asks the robot. What cannot be read is refused here.
    fn grant(&mut self, wish: Wish) -> Result<()> {
        match wish {
            Wish::Put(index, bytes) => {
                let Some(edge) = self.keys.edges().get(index).cloned() else {
                    return Ok(());
                };
                match self.put(index, &edge, &bytes) {
                    Ok(Some(ask)) => {
                        let id = self.robot.send(ask)?;
                        self.await_answer(id, Asker::Put(index, edge.path));
                    }
                    Ok(None) => {}
                    Err(message) => self.tell_refused(&edge.path, &message),
                }
            }
            Wish::Query(index, query) => {
                let Some(edge) = self.keys.edges().get(index).cloned() else {
                    refuse(&query, "the robot has this key no longer");
                    return Ok(());
                };
                match asked(&edge, &query, |time| self.robot.since_start(time)) {
                    Ok(ask) => {
                        let is_write = matches!(ask, Ask::Write { .. });
                        let id = self.robot.send(ask)?;
                        let asker = if is_write {
                            self.will_write(index);
                            Asker::Written(index, query)
                        } else {
                            Asker::Query(index, query)
                        };
                        self.await_answer(id, asker);
                    }
                    Err(message) => refuse(&query, &message),
                }
            }
        }
        Ok(())
    }

    /// What a sample of a key means; `None`: the robot has that value already.
    fn put(&mut self, index: usize, edge: &Edge, bytes: &[u8]) -> Result<Option<Ask>> {
        let value = read_json(bytes)?;
        if edge.kind == Kind::Remote {
            return feed::ask(&edge.path, value, |time| self.robot.since_start(time)).map(Some);
        }
        if self.has(index, &value) {
            return Ok(None);
        }
        self.will_write(index);
        Ok(Some(write(&edge.path, value)))
    }

    /// Who put a value cannot be told, so it is told here: the 1st, 2nd, 4th, … time of each path.
    fn tell_refused(&mut self, path: &str, message: &str) {
        let times = self.refused.entry(path.to_owned()).or_insert(0);
        *times += 1;
        if times.is_power_of_two() {
            eprintln!("warning: `{path}`: {message} (refused {times} times)");
        }
    }

    fn path_of(&self, index: usize) -> Option<String> {
        self.keys.edges().get(index).map(|edge| edge.path.clone())
    }

    /// The robot's answer to who waits for it.
    fn hand_on(&mut self, answer: Answer) -> Result<()> {
        let Some(awaited) = answer.id.and_then(|id| self.awaited.remove(&id)) else {
            return Ok(());
        };
        let good = match (answer.outcome, &awaited.asker) {
            (Outcome::Ok(good), _) => *good,
            (Outcome::Error(failure), Asker::Put(_, path)) => {
                self.tell_refused(path, &failure.message);
                return Ok(());
            }
            (Outcome::Error(failure), Asker::Query(_, query) | Asker::Written(_, query)) => {
                let refusals = failure.refusals.into_iter().map(|one| one.message);
                let messages: Vec<String> = [failure.message].into_iter().chain(refusals).collect();
                refuse(query, &messages.join("; "));
                return Ok(());
            }
        };
        match awaited.asker {
            Asker::Put(..) => {}
            Asker::Query(index, query) => match good {
                Good::Called(value) => self.keys.answer(index, &query, &value),
                Good::Value(read) => self.keys.answer(index, &query, &read.value),
                Good::Done {} => self.keys.answer(index, &query, &Value::Null),
                _ => refuse(&query, "the robot answers something else"),
            },
            Asker::Written(index, query) => match self.path_of(index) {
                Some(path) => {
                    let id = self.robot.send(Ask::Read { path })?;
                    self.await_answer(id, Asker::Query(index, query));
                }
                None => refuse(&query, "the robot has this key no longer"),
            },
        }
        Ok(())
    }
}

impl Asker {
    /// Whether the value of this edge may change.
    fn writes(&self, edge: usize) -> bool {
        matches!(self, Self::Put(of, _) | Self::Written(of, _) if *of == edge)
    }

    /// Who put a value cannot be told.
    fn refuse(self, reason: &str) {
        match self {
            Self::Query(_, query) | Self::Written(_, query) => refuse(&query, reason),
            Self::Put(_, path) => eprintln!("warning: `{path}`: {reason}"),
        }
    }
}

/// What a query of a key means; `of_robot` gives the robot's time for one since 1970.
fn asked(edge: &Edge, query: &Query, of_robot: impl Fn(u64) -> Option<u64>) -> Result<Ask> {
    let payload = query.payload();
    if payload.is_some_and(|payload| payload.len() > LONGEST) {
        return Err(format!("a payload has at most {LONGEST} bytes"));
    }
    let argument = payload.map(|payload| read_json(&payload.to_bytes()));
    let argument = argument.transpose()?;
    let path = edge.path.clone();
    match (edge.kind, edge.direction, argument) {
        (Kind::Procedure, _, argument) => Ok(Ask::Call {
            path,
            argument: argument.unwrap_or(Value::Null),
            timeout: None,
        }),
        (Kind::Remote, _, said) => feed::ask(&path, said.unwrap_or(Value::Null), of_robot),
        (_, Some(Direction::Out), Some(_)) => Err(format!(
            "`{path}` goes out alone: write `direction = \"both\"` at its `[[bridge]]`"
        )),
        (_, _, Some(value)) => Ok(write(&path, value)),
        (_, _, None) => Ok(Ask::Read { path }),
    }
}

fn write(path: &str, value: Value) -> Ask {
    let path = path.strip_prefix(PARAMETERS).unwrap_or(path).to_owned();
    Ask::Write {
        changes: vec![Change { path, value }],
    }
}

fn read_json(bytes: &[u8]) -> Result<Value> {
    let value = serde_json::from_slice(bytes);
    let value = value.map_err(|error| format!("the payload is no JSON: {error}"))?;
    match depth(&value) {
        depth if depth > DEEPEST => Err(format!(
            "lists and objects of the payload nest {depth} deep: send at most {DEEPEST}"
        )),
        _ => Ok(value),
    }
}

/// Lists and objects within each other at the deepest place; the reader's own limit bounds it.
fn depth(value: &Value) -> usize {
    match value {
        Value::Array(items) => 1 + items.iter().map(depth).max().unwrap_or(0),
        Value::Object(entries) => 1 + entries.values().map(depth).max().unwrap_or(0),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::{DEEPEST, read_json};

    #[test]
    fn what_nests_deeper_than_a_robot_reads_is_refused() {
        for (open, close) in [("[", "]"), (r#"{"a":"#, "}")] {
            let nested = |depth| format!("{}1{}", open.repeat(depth), close.repeat(depth));
            assert!(read_json(nested(DEEPEST).as_bytes()).is_ok());
            for depth in [DEEPEST + 1, 61, 127] {
                let refused = read_json(nested(depth).as_bytes()).expect_err("it is too deep");
                assert!(refused.contains(&format!("nest {depth} deep")), "{refused}");
            }
            let refused = read_json(nested(5000).as_bytes()).expect_err("nobody reads that");
            assert!(refused.contains("no JSON"), "{refused}");
        }
    }
}
