//! All clients and the one robot: who wants what, who may do what, and what waits for a cycle or a node.
//!
//! Only the server's thread comes here, so that nothing in it waits for anybody.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use axum::extract::ws::Message as Frame;
use framework::link::Link;
use framework::parameters::Version;
use framework::procedure::PendingAny;
use protocol::{Answer, Failure, Good, Level, Message, Outcome, Refusal, Welcome};

use crate::closely::Closely;
use crate::connection::News;
use crate::limits::Limits;
use crate::logs::Logs;
use crate::outbox::{Content, Outbox};
use crate::press::Press;
use crate::requests::{self, Feeder, Injection};
use crate::run::new_run_id;
use crate::sources::{Rate, Source};
use crate::timings::{self, Told};
use crate::trace::Traces;

/// Files of parameters are looked at so often.
const FILES_EVERY: Duration = Duration::from_millis(500);

/// A request that is done with the next cycle waits for it so long.
pub(crate) const PATIENCE: Duration = Duration::from_secs(2);

/// Instances tell what they did within this time, or have finished no cycle meanwhile.
const REPORTING: Duration = Duration::from_millis(500);

/// So long copies are handed out before clients are heard again.
const LONGEST: Duration = Duration::from_millis(20);

/// Names one connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ClientId(u64);

#[cfg(test)]
impl ClientId {
    pub(crate) fn of_test(number: u64) -> Self {
        Self(number)
    }
}

/// What a server was told about itself.
#[derive(Clone, Debug)]
pub(crate) struct Rules {
    pub(crate) target: &'static str,
    pub(crate) token: Option<String>,
    pub(crate) is_read_only: bool,
    pub(crate) graph: &'static str,
    pub(crate) peers: Vec<String>,
}

/// The robot and its clients.
pub(crate) struct Hub {
    pub(crate) link: Link,
    /// By which clients tell this run from others. A server is one run's: of a scenario, each time that it is played.
    run: String,
    pub(crate) rules: Rules,
    pub(crate) limits: Limits,
    pub(crate) sources: Vec<Source>,
    /// The source that is looked at first.
    first: usize,
    pub(crate) clients: BTreeMap<ClientId, Client>,
    /// What clients put in place of which output, the last of it last: (instance, name).
    pub(crate) injected: BTreeMap<(usize, &'static str), Vec<Injection>>,
    /// Which client feeds which instance of another machine, by place.
    pub(crate) feeders: BTreeMap<usize, Feeder>,
    pub(crate) waiting: Vec<Waiting>,
    pub(crate) logs: Logs,
    /// Paths of all nodes.
    pub(crate) nodes: Vec<&'static str>,
    told: Told,
    traces: Traces,
    press: Press,
    files_looked_at: Instant,
    /// The version of the parameters that clients know.
    pub(crate) told_parameters: Version,
    closely: Closely,
    next_client: u64,
}

/// One connection.
pub(crate) struct Client {
    pub(crate) outbox: Outbox,
    pub(crate) news: News,
    pub(crate) is_trusted: bool,
    pub(crate) wrong_tokens: u32,
    /// What it is subscribed to, by number.
    pub(crate) subscriptions: BTreeMap<u32, Subscription>,
    pub(crate) next_subscription: u32,
    /// Requests that wait.
    pub(crate) waiting: usize,
    /// Log messages that it wants.
    pub(crate) logs: Option<Level>,
}

/// What a client is subscribed to.
pub(crate) enum Subscription {
    /// An output, by its place among the sources.
    Output(usize),
    Parameters {
        path: String,
        rate: Rate,
        /// It was too early to tell the last change.
        is_behind: bool,
    },
}

/// A request that is answered later.
pub(crate) struct Waiting {
    pub(crate) client: ClientId,
    pub(crate) request: u32,
    pub(crate) until: Instant,
    pub(crate) kind: WaitingFor,
}

pub(crate) enum WaitingFor {
    /// The next cycle of an output, by its place among the sources.
    Read(usize),
    Call(Box<dyn PendingAny>),
    /// Reports of all instances, by the number under which they were asked for.
    Timings(u64),
}

impl Hub {
    pub(crate) fn new(mut link: Link, rules: Rules, limits: Limits) -> Self {
        let mut sources = Vec::new();
        for (index, instance) in link.instances.iter_mut().enumerate() {
            let name = instance.description.name;
            let taps = std::mem::take(&mut instance.taps).into_iter();
            sources.extend(taps.map(|tap| Source::new(index, name, tap)));
        }
        Self {
            run: new_run_id(),
            told: Told::new(link.instances.len()),
            press: Press::new(),
            traces: Traces::new(link.instances.len()),
            logs: Logs::new(link.clock.clone()),
            nodes: link
                .instances
                .iter()
                .flat_map(|instance| instance.nodes.iter().copied())
                .collect(),
            told_parameters: link.parameters.version(),
            link,
            rules,
            limits,
            sources,
            first: 0,
            clients: BTreeMap::new(),
            injected: BTreeMap::new(),
            feeders: BTreeMap::new(),
            waiting: Vec::new(),
            files_looked_at: Instant::now(),
            closely: Closely::default(),
            next_client: 0,
        }
    }

    /// A client has come.
    pub(crate) fn connect(&mut self) -> (ClientId, News) {
        let id = ClientId(self.next_client);
        self.next_client += 1;
        let needs_token = self.rules.token.is_some() && !self.rules.is_read_only;
        let news = News::default();
        let mut client = Client {
            outbox: Outbox::default(),
            news: news.clone(),
            is_trusted: !needs_token,
            wrong_tokens: 0,
            subscriptions: BTreeMap::new(),
            next_subscription: 1,
            waiting: 0,
            logs: None,
        };
        let instances = self.link.instances.iter();
        client.outbox.say(&Message::Welcome(Welcome {
            version: protocol::VERSION,
            robot: self.link.robot.to_owned(),
            target: self.rules.target.to_owned(),
            instances: instances
                .map(|instance| instance.description.name.to_owned())
                .collect(),
            can_write: !self.rules.is_read_only,
            needs_token,
            time: self.link.clock.now().as_nanos(),
            run: Some(self.run.clone()),
            peers: self.rules.peers.clone(),
        }));
        self.clients.insert(id, client);
        (id, news)
    }

    pub(crate) fn has_clients(&self) -> bool {
        !self.clients.is_empty()
    }

    /// A client has gone: what it held is free again.
    pub(crate) fn disconnect(&mut self, id: ClientId) {
        let Some(client) = self.clients.remove(&id) else {
            return;
        };
        for (number, subscription) in client.subscriptions {
            self.end(id, number, &subscription);
        }
        for source in &mut self.sources {
            source.stop_reading(id, None);
        }
        self.waiting.retain(|waiting| waiting.client != id);
        self.stop_feeding(id);
        self.stop_injecting(id);
    }

    /// A client has said something; whether it may go on.
    pub(crate) fn receive(&mut self, id: ClientId, text: &str) -> bool {
        requests::receive(self, id, text)
    }

    /// A client has said something that is no text.
    pub(crate) fn refuse_binary(&mut self, id: ClientId) {
        let message = "requests are JSON texts, and this is a binary message".to_owned();
        self.answer(id, None, Err(Failure::new(message)));
    }

    /// What to send to a client next.
    pub(crate) fn next(&mut self, id: ClientId) -> Option<Frame> {
        self.clients.get_mut(&id)?.outbox.next()
    }

    /// Whether a client takes what it asked for, and may ask for more.
    pub(crate) fn may_ask(&self, id: ClientId) -> bool {
        let client = self.clients.get(&id);
        client.is_some_and(|client| client.outbox.may_ask(&self.limits))
    }

    /// Whether nobody may ever change anything.
    pub(crate) fn is_read_only(&self) -> bool {
        self.rules.is_read_only
    }

    /// Whether a client may change anything by now.
    pub(crate) fn may_change(&self, id: ClientId) -> bool {
        let is_trusted = |client: &Client| client.is_trusted;
        !self.rules.is_read_only && self.clients.get(&id).is_some_and(is_trusted)
    }

    pub(crate) fn answer(
        &mut self,
        id: ClientId,
        request: Option<u32>,
        result: Result<Good, Failure>,
    ) {
        if let Some(client) = self.clients.get_mut(&id) {
            client.answer(request, result);
        }
    }

    /// Looks at everything that may have changed; whether it has to be done again soon.
    pub(crate) fn look(&mut self) -> bool {
        self.hand_out();
        self.told.fetch(&self.link.instances);
        self.look_at_logs();
        self.look_after_waiting();
        self.closely.stop_when_over();
        self.look_at_files();
        if self.link.parameters.version() != self.told_parameters {
            // In a replay they go with the time.
            self.parameters_changed();
        }
        let is_behind = self.tell_parameters();
        is_behind || !self.waiting.is_empty() || self.sources.iter().any(Source::is_open)
    }

    /// As [`look`](Self::look), with all that instances have left, however long it takes: nobody looks again.
    pub(crate) fn look_at_last(&mut self) {
        for source in self.sources.iter_mut().filter(|source| source.is_open()) {
            source.hand_out(&mut self.clients, &mut self.press, &self.limits);
        }
        self.look();
    }

    /// Hands out what instances left, of each in turn, as long as clients can wait to be heard.
    fn hand_out(&mut self) {
        let begun = Instant::now();
        let count = self.sources.len();
        for index in (self.first..count).chain(0..self.first) {
            let source = &mut self.sources[index];
            if !source.is_open() {
                continue;
            }
            source.hand_out(&mut self.clients, &mut self.press, &self.limits);
            if begun.elapsed() > LONGEST {
                // Those behind it come first the next time, which is soon: this one is open.
                self.first = index + 1;
                return;
            }
        }
    }

    /// Ends a subscription that its client does not have any more.
    pub(crate) fn end(&mut self, id: ClientId, number: u32, subscription: &Subscription) {
        if let Subscription::Output(source) = subscription
            && let Some(source) = self.sources.get_mut(*source)
        {
            source.unsubscribe(id, number);
        }
    }

    /// Asks all instances what they did.
    pub(crate) fn ask_for_reports(&mut self) -> WaitingFor {
        self.closely.look();
        WaitingFor::Timings(self.told.ask(&self.link.instances))
    }

    /// The last seconds as a trace.
    pub(crate) fn trace(&mut self, time: Duration) -> serde_json::Value {
        self.closely.look();
        self.traces.describe(&self.link, time, self.limits.spans)
    }

    /// When a request that waits has to be answered at the latest.
    pub(crate) fn patience(kind: &WaitingFor) -> Instant {
        let patience = match kind {
            WaitingFor::Timings(_) => REPORTING,
            WaitingFor::Read(_) | WaitingFor::Call(_) => PATIENCE,
        };
        Instant::now() + patience
    }

    fn look_at_logs(&mut self) {
        for log in self.logs.fetch(&self.nodes, &self.limits) {
            let wants = |client: &&mut Client| client.logs.is_some_and(|least| log.level >= least);
            for client in self.clients.values_mut().filter(wants) {
                client.outbox.log(log.clone(), &self.limits);
                client.news.notify_one();
            }
        }
    }

    fn look_after_waiting(&mut self) {
        let now = Instant::now();
        for mut waiting in std::mem::take(&mut self.waiting) {
            let is_over = now >= waiting.until;
            match self.outcome(&mut waiting, is_over) {
                Some(result) => {
                    if let Some(client) = self.clients.get_mut(&waiting.client) {
                        client.waiting = client.waiting.saturating_sub(1);
                        if let Some(result) = result {
                            client.answer(Some(waiting.request), result);
                        }
                    }
                }
                None => self.waiting.push(waiting),
            }
        }
    }

    /// What a waiting request ends with: `None` as long as it waits, `Some(None)` if it was answered already.
    fn outcome(
        &mut self,
        waiting: &mut Waiting,
        is_over: bool,
    ) -> Option<Option<Result<Good, Failure>>> {
        match &mut waiting.kind {
            WaitingFor::Read(source) => {
                let source = self.sources.get_mut(*source)?;
                let passed_over = source.passed_over(waiting.client, waiting.request);
                let Some(is_passed_over) = passed_over else {
                    return Some(None);
                };
                is_over.then(|| {
                    source.stop_reading(waiting.client, Some(waiting.request));
                    let (path, seconds) = (&source.path, PATIENCE.as_secs());
                    Some(Err(Failure::new(match is_passed_over {
                        false => format!("no cycle wrote `{path}` within {seconds} s"),
                        true => format!(
                            "`{path}` was not read within {seconds} s: cycles wrote it when too many answers waited for this client to take them; ask for less at a time"
                        ),
                    })))
                })
            }
            WaitingFor::Call(pending) => match pending.wait_any(Duration::ZERO) {
                Some(Ok(response)) => Some(Some(
                    serde_json::to_value(&*response)
                        .map(Good::Called)
                        .map_err(|error| Failure::new(format!("its response is no JSON: {error}"))),
                )),
                Some(Err(refused)) => Some(Some(Err(Failure::new(refused.to_string())))),
                None => is_over.then(|| {
                    let message =
                        "the node did not answer in time; it may still do what it was asked";
                    Some(Err(Failure::new(message.to_owned())))
                }),
            },
            WaitingFor::Timings(asked) => {
                let is_whole = self.told.have_answered(*asked, &self.link.instances);
                let described = || timings::describe(self, &self.told, *asked);
                (is_whole || is_over).then(|| Some(Ok(Good::Timings(described()))))
            }
        }
    }

    fn look_at_files(&mut self) {
        if self.files_looked_at.elapsed() < FILES_EVERY {
            return;
        }
        self.files_looked_at = Instant::now();
        // A mistake in a file is told where the robot was started; the robot goes on with the values it has.
        match self.link.parameters.poll() {
            Some(Ok(_)) => self.parameters_changed(),
            Some(Err(error)) => framework::logs::tell_warning(module_path!(), &error),
            None => {}
        }
    }
}

impl Client {
    pub(crate) fn answer(&mut self, request: Option<u32>, result: Result<Good, Failure>) {
        self.outbox.say(&Message::Answer(Answer {
            id: request,
            outcome: match result {
                Ok(good) => Outcome::Ok(Box::new(good)),
                Err(failure) => Outcome::Error(failure),
            },
        }));
        self.news.notify_one();
    }

    /// An update that was not made by a cycle.
    pub(crate) fn update(&mut self, subscription: u32, content: Content, limits: &Limits) {
        self.outbox.update(subscription, content, limits);
        self.news.notify_one();
    }
}

/// A failure that is only a message.
pub(crate) trait Fail {
    fn new(message: String) -> Self;
    /// Of several things at once.
    fn of(refusals: Vec<Refusal>) -> Self;
}

impl Fail for Failure {
    fn new(message: String) -> Self {
        Self {
            message,
            refusals: Vec::new(),
        }
    }

    fn of(refusals: Vec<Refusal>) -> Self {
        let told = refusals.iter().map(|refusal| match refusal.path.as_str() {
            "" => refusal.message.clone(),
            path => format!("`{path}`: {}", refusal.message),
        });
        Self {
            message: told.collect::<Vec<_>>().join("; "),
            refusals,
        }
    }
}
