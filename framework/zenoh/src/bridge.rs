//! Both sides together: what the robot says is published, what others wish is asked of the robot.

use std::collections::BTreeMap;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use client::{Heard, Robot};
use protocol::{Answer, Ask, Good, Message, Outcome};
use serde_json::{Value, json};
use zenoh::query::Query;

use crate::Result;
use crate::asks;
use crate::cdr;
use crate::edges::{self, Edge, Encoding, Kind};
use crate::feed;
use crate::forms::Form;
use crate::keys::{Keys, Wish, refuse};
use crate::layout::Layout;
use crate::ros2;
use crate::trouble::Trouble;

/// Answers that are awaited of the robot at a time; it has a limit of its own for those that take long.
const AWAITED: usize = 64;

/// An answer that takes longer comes no more; a robot lets calls wait for 5 s.
const PATIENCE: Duration = Duration::from_secs(10);

/// A robot whose outputs, parameters and procedures have keys.
pub(crate) struct Bridge<'keys> {
    robot: Robot,
    keys: &'keys mut Keys,
    /// Places in the list of edges, by the robot's number.
    subscriptions: BTreeMap<u32, usize>,
    /// Of edges with CDR, by place in the list of edges.
    forms: BTreeMap<usize, Form>,
    /// Of parameters, by place in the list of edges.
    told: BTreeMap<usize, Told>,
    /// By number of the request.
    awaited: BTreeMap<u32, Awaited>,
    /// How often what came in was refused, by path.
    refused: BTreeMap<String, u64>,
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
    /// If Zenoh refuses a key, or the robot does not answer: then its keys stay as they are.
    pub(crate) fn start(
        mut robot: Robot,
        keys: &'keys mut Keys,
    ) -> std::result::Result<Self, Trouble> {
        let edges = match edges::of_robot(&mut robot) {
            Err(Trouble::Refused(message)) => {
                eprintln!("warning: {message}");
                Vec::new()
            }
            told => told?,
        };
        keys.declare(edges, &robot.welcome.robot)?;
        let mut bridge = Self {
            robot,
            keys,
            subscriptions: BTreeMap::new(),
            forms: BTreeMap::new(),
            told: BTreeMap::new(),
            awaited: BTreeMap::new(),
            refused: BTreeMap::new(),
        };
        for index in 0..bridge.keys.edges().len() {
            let edge = bridge.keys.edges()[index].clone();
            match bridge.prepare(index, &edge) {
                Err(Trouble::Refused(message)) => {
                    eprintln!("warning: `{}`: {message}", edge.path);
                }
                prepared => prepared?,
            }
        }
        Ok(bridge)
    }

    fn prepare(&mut self, index: usize, edge: &Edge) -> std::result::Result<(), Trouble> {
        let is_output = matches!(edge.kind, Kind::MainOutput | Kind::AdditionalOutput);
        if edge.encoding == Encoding::Cdr && !is_output {
            let form = Form::ask(&mut self.robot, edge)?;
            self.forms.insert(index, form);
        }
        if edge.goes_out() {
            self.subscribe(index, edge, is_output)?;
        }
        let form = self.forms.get(&index);
        match form.and_then(|form| ros2::interface::objection(edge, form)) {
            Some(objection) if self.keys.objects_first(index) => Err(objection.into()),
            _ => Ok(()),
        }
    }

    /// Of outputs the robot has bytes, of parameters JSON alone.
    fn subscribe(
        &mut self,
        index: usize,
        edge: &Edge,
        is_output: bool,
    ) -> std::result::Result<(), Trouble> {
        let asked = Ask::Subscribe {
            path: edge.path.clone(),
            rate: edge.rate,
            encoding: match edge.encoding {
                Encoding::Cdr if is_output => protocol::Encoding::Binary,
                _ => protocol::Encoding::Json,
            },
        };
        let Good::Subscribed(subscribed) = self.robot.ask(asked)? else {
            return Err("the robot subscribes nobody".to_owned().into());
        };
        match subscribed.layout.map(Layout::read).transpose() {
            Ok(layout) => {
                let form = layout.map(|layout| (index, Form::Value(layout)));
                self.forms.extend(form);
                self.subscriptions.insert(subscribed.subscription, index);
                Ok(())
            }
            Err(message) => {
                let subscription = subscribed.subscription;
                self.robot.ask(Ask::Unsubscribe { subscription })?;
                Err(message.into())
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
                if let Some(edge) = self.subscriptions.get(&update.subscription).copied() {
                    let value = self.written(edge, &update.value);
                    let attachment = self.beside(edge, update.cycle, update.time);
                    self.publish(edge, value, attachment);
                }
            }
            Some(Heard::Frame(frame)) if !frame.value.is_empty() => {
                if let Some(edge) = self.subscriptions.get(&frame.subscription).copied()
                    && let Some(form) = self.forms.get(&edge)
                {
                    let value = form.output().to_cdr(&frame.value).map(Some);
                    let attachment = self.beside(edge, frame.cycle, frame.time);
                    self.publish(edge, value, attachment);
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

    /// A value in the form of its edge; `None`: it is not there, and CDR has no form for that.
    fn written(&self, edge: usize, value: &Value) -> Result<Option<Vec<u8>>> {
        let encoding = self.keys.edges().get(edge).map(|edge| edge.encoding);
        match (encoding, self.forms.get(&edge)) {
            (Some(Encoding::Cdr), Some(form)) => form.output().json_to_cdr(value),
            (Some(Encoding::Cdr), None) => Ok(None),
            _ => Ok(Some(value.to_string().into_bytes())),
        }
    }

    /// What stands beside a value of this cycle.
    fn beside(&self, edge: usize, cycle: u64, time: u64) -> Vec<u8> {
        let encoding = self.keys.edges().get(edge).map(|edge| edge.encoding);
        if encoding == Some(Encoding::Cdr) {
            cdr::attachment(cycle, self.robot.since_1970(time), self.keys.id(edge))
        } else {
            json!({ "cycle": cycle, "time": time })
                .to_string()
                .into_bytes()
        }
    }

    fn publish(&mut self, edge: usize, value: Result<Option<Vec<u8>>>, attachment: Vec<u8>) {
        let published = match value {
            Ok(Some(value)) if self.is_news(edge, &value) => {
                self.keys.publish(edge, value, attachment)
            }
            Ok(_) => Ok(()),
            Err(message) => Err(message),
        };
        if let Err(message) = published {
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
        told.is_some_and(
            |told| matches!(self.written(edge, value), Ok(Some(it)) if it == told.value),
        )
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
                let form = self.forms.get(&index);
                let since_start = |time| self.robot.since_start(time);
                match asks::of_query(&edge, form, &query, since_start) {
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
        let value = asks::read(edge, self.forms.get(&index), bytes)?;
        if edge.kind == Kind::Remote {
            return feed::ask(&edge.path, value, |time| self.robot.since_start(time)).map(Some);
        }
        if self.has(index, &value) {
            return Ok(None);
        }
        self.will_write(index);
        Ok(Some(asks::write(&edge.path, value)))
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

    /// In the form of the edge; ROS 2 finds the answer to a request by what stood beside that.
    fn answer(&self, index: usize, query: &Query, value: &Value, cycle: u64) {
        let asked = query.attachment().map(|beside| beside.to_bytes());
        let asked = asked.and_then(|beside| cdr::Beside::read(&beside));
        match self.written(index, value) {
            Ok(Some(value)) => {
                let since = SystemTime::now().duration_since(UNIX_EPOCH);
                let now = since.map_or(0, |since| since.as_nanos());
                let now = u64::try_from(now).unwrap_or_default();
                let (number, id) = match asked {
                    Some(cdr::Beside { number, id }) => (number, id),
                    None => (cycle, self.keys.id(index)),
                };
                let attachment = cdr::attachment(number, now, id);
                self.keys.answer(index, query, value, attachment);
            }
            Ok(None) => refuse(query, "there is no such value now"),
            Err(message) => refuse(query, &message),
        }
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
                // It has the refusals in it.
                refuse(query, &failure.message);
                return Ok(());
            }
        };
        match awaited.asker {
            Asker::Put(..) => {}
            Asker::Query(index, query) => match good {
                Good::Called(value) => self.answer(index, &query, &value, 0),
                Good::Value(read) => self.answer(index, &query, &read.value, read.cycle),
                Good::Done {} => self.answer(index, &query, &Value::Null, 0),
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
