//! What clients ask, and what becomes of it.

mod feed;
mod inject;
mod subscribe;

use std::time::{Duration, Instant};

pub(crate) use feed::Feeder;
use framework::Given;
use framework::reflect::ResolvedPath;
pub(crate) use inject::Injection;
use protocol::{Ask, Change, Failure, Good, Level, Request, Value};
use serde_json::Value as Json;

use crate::catalogue;
use crate::hub::{ClientId, Fail, Hub, Waiting, WaitingFor};
use crate::nesting;
use crate::parameters;
use crate::sources::resolve;

/// A call waits so long for its node unless the client says otherwise.
const CALL: Duration = Duration::from_secs(5);

/// And at most so long.
const LONGEST_CALL: Duration = Duration::from_secs(600);

/// `None`: the answer comes later.
type Answered = Result<Option<Good>, Failure>;

/// Reads and answers one message; whether the client may go on.
pub(crate) fn receive(hub: &mut Hub, client: ClientId, text: &str) -> bool {
    match read(hub, text) {
        Ok(request) => {
            let id = Some(request.id);
            match answer(hub, client, request) {
                Ok(Some(good)) => hub.answer(client, id, Ok(good)),
                Ok(None) => {}
                Err(failure) => hub.answer(client, id, Err(failure)),
            }
        }
        Err((id, message)) => hub.answer(client, id, Err(Failure::new(message))),
    }
    let wrong_tokens = hub.clients.get(&client).map_or(0, |it| it.wrong_tokens);
    wrong_tokens == 0 || wrong_tokens < hub.limits.wrong_tokens
}

/// The request, or why it is none, with its number where that can be read.
fn read(hub: &Hub, text: &str) -> Result<Request, (Option<u32>, String)> {
    let depth = nesting::depth(text);
    if depth > hub.limits.nesting {
        let most = hub.limits.nesting;
        return Err((
            None,
            format!("lists and objects nest {depth} deep, {most} are allowed"),
        ));
    }
    serde_json::from_str(text).map_err(|error| {
        #[derive(serde::Deserialize)]
        struct Numbered {
            id: u32,
        }
        let numbered = serde_json::from_str::<Numbered>(text);
        (
            numbered.ok().map(|numbered| numbered.id),
            format!("no request: {error}"),
        )
    })
}

fn answer(hub: &mut Hub, client: ClientId, request: Request) -> Answered {
    let id = request.id;
    if writes(&request.ask) {
        hub.check_may_write(client)?;
    }
    match request.ask {
        Ask::Authenticate { token } => hub.authenticate(client, &token),
        Ask::Paths { below, depth } => hub.paths(&below, depth),
        Ask::Schema { path } => hub.schema(&path),
        Ask::Layout { path } => hub.layout(&path),
        Ask::Read { path } => hub.read(client, id, &path),
        Ask::Subscribe {
            path,
            rate,
            encoding,
        } => hub.subscribe(client, &path, rate, encoding),
        Ask::Unsubscribe { subscription } => hub.unsubscribe(client, subscription),
        Ask::Bundle {} => hub.bundle(client),
        Ask::Write { changes } => hub.write(changes),
        Ask::Parameters { path } => {
            hub.check_path(&path)?;
            parameters::read(&hub.link.parameters, &path).map(|it| Some(Good::Parameters(it)))
        }
        Ask::Unstored {} => Ok(Some(Good::Unstored(parameters::unstored(
            &hub.link.parameters,
        )))),
        Ask::Store { layer, paths } => {
            for path in &paths {
                hub.check_path(path)?;
            }
            let stored = parameters::store(&hub.link.parameters, &layer, &paths)?;
            Ok(Some(Good::Stored(stored)))
        }
        Ask::Reload {} => hub.reload(),
        Ask::Inject { path, value } => hub.inject(client, &path, value),
        Ask::Release { path } => hub.release(&path),
        Ask::Call {
            path,
            argument,
            timeout,
        } => hub.call(client, id, &path, &argument, timeout),
        Ask::Announce { instance, time } => hub.announce(client, &instance, time),
        Ask::Complete {
            instance,
            time,
            outputs,
        } => hub.complete(client, &instance, time, &outputs),
        Ask::Abandon { instance, time } => hub.abandon(client, &instance, time),
        Ask::Timings {} => {
            let reports = hub.ask_for_reports();
            hub.wait(client, id, reports, None)
        }
        Ask::Graph {} => hub.graph(),
        Ask::Logs { level } => hub.log(client, id, level.unwrap_or(Level::Info)),
        Ask::SetLogLevel { of, level } => hub.set_log_level(of.as_deref(), level),
        Ask::Trace { seconds } => hub.last_seconds(seconds),
    }
}

/// Whether only those may ask it who may change the robot.
fn writes(ask: &Ask) -> bool {
    match ask {
        Ask::Write { .. }
        | Ask::Store { .. }
        | Ask::Reload {}
        | Ask::Inject { .. }
        | Ask::Release { .. }
        | Ask::Call { .. }
        | Ask::Announce { .. }
        | Ask::Complete { .. }
        | Ask::Abandon { .. }
        | Ask::SetLogLevel { .. } => true,
        Ask::Authenticate { .. }
        | Ask::Paths { .. }
        | Ask::Schema { .. }
        | Ask::Layout { .. }
        | Ask::Read { .. }
        | Ask::Subscribe { .. }
        | Ask::Unsubscribe { .. }
        | Ask::Bundle {}
        | Ask::Parameters { .. }
        | Ask::Unstored {}
        | Ask::Logs { .. }
        | Ask::Timings {}
        | Ask::Trace { .. }
        | Ask::Graph {} => false,
    }
}

impl Hub {
    fn check_may_write(&self, client: ClientId) -> Result<(), Failure> {
        if self.rules.is_read_only {
            let message = "this robot was started to be read only: start it without `--read-only`, and with `--token` where it listens to other machines";
            return Err(Failure::new(message.to_owned()));
        }
        if self.may_change(client) {
            Ok(())
        } else {
            let message = "this needs the robot's token: `authenticate` first";
            Err(Failure::new(message.to_owned()))
        }
    }

    fn check_path(&self, path: &str) -> Result<(), Failure> {
        let most = self.limits.path_bytes;
        if path.len() > most {
            let length = path.len();
            return Err(Failure::new(format!(
                "a path of {length} bytes, {most} are allowed"
            )));
        }
        Ok(())
    }

    fn authenticate(&mut self, client: ClientId, token: &str) -> Answered {
        let is_right = self
            .rules
            .token
            .as_ref()
            .is_none_or(|expected| is_same(expected, token));
        if let Some(client) = self.clients.get_mut(&client) {
            client.is_trusted |= is_right;
            client.wrong_tokens += u32::from(!is_right);
        }
        if is_right {
            Ok(Some(Good::Done {}))
        } else {
            Err(Failure::new("this is not the robot's token".to_owned()))
        }
    }

    fn paths(&self, below: &str, depth: Option<u8>) -> Answered {
        self.check_path(below)?;
        let depth = usize::from(depth.unwrap_or(1));
        catalogue::list(self, below, depth)
            .map(|entries| Some(Good::Paths(entries)))
            .map_err(Failure::new)
    }

    fn schema(&self, path: &str) -> Answered {
        let part = self.part(path)?;
        Ok(Some(Good::Schema(part.shape().json_schema())))
    }

    fn layout(&self, path: &str) -> Answered {
        let part = self.part(path)?;
        let layout = serde_json::to_value(part.shape().layout());
        let layout = layout.map_err(|error| Failure::new(format!("`{path}`: {error}")))?;
        Ok(Some(Good::Layout(layout)))
    }

    /// What a path leads to by its types.
    fn part(&self, path: &str) -> Result<ResolvedPath, Failure> {
        self.check_path(path)?;
        let shape = match below_parameters(path) {
            Some(path) => resolve(self.link.parameters.shape(), path),
            None => match catalogue::message(self, path) {
                Some((shape, below)) => resolve(&shape, below),
                None => {
                    let (source, below) = self.find(path)?;
                    resolve(&self.sources[source].shape, below)
                }
            },
        };
        shape.map_err(|message| Failure::new(format!("`{path}`: {message}")))
    }

    fn read(&mut self, client: ClientId, request: u32, path: &str) -> Answered {
        self.check_path(path)?;
        if let Some(path) = below_parameters(path) {
            let reading = parameters::read(&self.link.parameters, path)?;
            return Ok(Some(Good::Value(Value {
                cycle: reading.version,
                time: self.link.clock.now().as_nanos(),
                value: reading.value,
                injected: false,
            })));
        }
        let (source, below) = self.find(path)?;
        let part = resolve(&self.sources[source].shape, below)
            .map_err(|message| Failure::new(format!("`{path}`: {message}")))?;
        let answered = self.wait(client, request, WaitingFor::Read(source), None)?;
        self.sources[source].read(part, client, request);
        Ok(answered)
    }

    fn write(&mut self, changes: Vec<Change>) -> Answered {
        for change in &changes {
            self.check_path(&change.path)?;
        }
        let changes: Vec<_> = changes
            .into_iter()
            .map(|change| (change.path, change.value))
            .collect();
        let version = self
            .link
            .parameters
            .change(&changes)
            .map_err(parameters::refusals)?;
        if version != self.told_parameters {
            self.parameters_changed();
        }
        Ok(Some(Good::Written { version: version.0 }))
    }

    fn reload(&mut self) -> Answered {
        let version = self
            .link
            .parameters
            .reload()
            .map_err(|error| Failure::new(error.to_string()))?;
        self.parameters_changed();
        Ok(Some(Good::Written { version: version.0 }))
    }

    fn call(
        &mut self,
        client: ClientId,
        request: u32,
        path: &str,
        argument: &Json,
        timeout: Option<f64>,
    ) -> Answered {
        self.check_path(path)?;
        let timeout = match timeout {
            None => CALL,
            Some(seconds) => Duration::try_from_secs_f64(seconds)
                .map_err(|_| Failure::new("a time-out is a number of seconds".to_owned()))?
                .min(LONGEST_CALL),
        };
        if path == catalogue::REARM {
            self.link.rearm.request();
            return Ok(Some(Good::Called(Json::Null)));
        }
        // Before it is called: who is refused moves nothing.
        self.check_may_wait(client)?;
        let procedure = catalogue::procedure(self, path).map_err(Failure::new)?;
        let pending = procedure
            .call_any(&Given::from(argument))
            .map_err(|error| Failure::new(format!("`{path}`: {error}")))?;
        self.wait(client, request, WaitingFor::Call(pending), Some(timeout))
    }

    fn last_seconds(&mut self, seconds: f64) -> Answered {
        let time = Duration::try_from_secs_f64(seconds)
            .map_err(|_| Failure::new("a trace is of a number of seconds".to_owned()))?;
        Ok(Some(Good::Trace(self.trace(time))))
    }

    fn graph(&self) -> Answered {
        serde_json::from_str(self.rules.graph)
            .map(|graph| Some(Good::Graph(graph)))
            .map_err(|_| Failure::new("this robot was built without its graph".to_owned()))
    }

    /// Answers first, so that the messages come behind it.
    fn log(&mut self, id: ClientId, request: u32, level: Level) -> Answered {
        let client = self.clients.get_mut(&id).ok_or_else(gone)?;
        client.answer(Some(request), Ok(Good::Done {}));
        client.logs = Some(level);
        for log in self.logs.kept().filter(|log| log.level >= level) {
            client.outbox.log(log.clone(), &self.limits);
        }
        Ok(None)
    }

    fn set_log_level(&self, of: Option<&str>, level: Level) -> Answered {
        let Some(of) = of else {
            self.logs.set_level(None, level);
            return Ok(Some(Good::Done {}));
        };
        self.check_path(of)?;
        let (instance, module) = match of.split_once('.') {
            Some((instance, module)) => (instance, Some(module)),
            None => (of, None),
        };
        let mut instances = self.link.instances.iter();
        let known = instances.find(|known| known.description.name == instance);
        let has_node = |module: &str| known.is_some_and(|known| known.nodes.contains(&module));
        if known.is_none() || module.is_some_and(|module| !has_node(module)) {
            let nodes = known.map(|known| known.nodes.join(", "));
            let expected =
                nodes.map_or_else(String::new, |nodes| format!("; its nodes are {nodes}"));
            return Err(Failure::new(format!(
                "no `{of}`: expected `INSTANCE` or `INSTANCE.crate::module` of one of its nodes{expected}"
            )));
        }
        self.logs.set_level(Some((instance, module)), level);
        Ok(Some(Good::Done {}))
    }

    /// The answer comes later.
    fn wait(
        &mut self,
        id: ClientId,
        request: u32,
        kind: WaitingFor,
        timeout: Option<Duration>,
    ) -> Answered {
        self.check_may_wait(id)?;
        self.clients.get_mut(&id).ok_or_else(gone)?.waiting += 1;
        let until = timeout.map_or_else(|| Self::patience(&kind), |it| Instant::now() + it);
        self.waiting.push(Waiting {
            client: id,
            request,
            until,
            kind,
        });
        Ok(None)
    }

    fn check_may_wait(&self, id: ClientId) -> Result<(), Failure> {
        let most = self.limits.waiting;
        let client = self.clients.get(&id).ok_or_else(gone)?;
        if client.waiting >= most {
            return Err(Failure::new(format!(
                "{most} requests of this client wait already, which is the most"
            )));
        }
        Ok(())
    }

    /// The output that a path names, and what follows behind its name.
    fn find<'path>(&self, path: &'path str) -> Result<(usize, &'path str), Failure> {
        catalogue::find(&self.sources, path).ok_or_else(|| {
            let near = catalogue::shortened(self, path).or_else(|| catalogue::near(self, path));
            let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            Failure::new(format!(
                "no `{path}`: expected `parameters…`, `INSTANCE.main_outputs.NAME…` or `INSTANCE.additional_outputs.NAME…`; `hulkgen topic list` lists them{near}"
            ))
        })
    }
}

/// The path without `parameters` in front, if it leads there.
fn below_parameters(path: &str) -> Option<&str> {
    let rest = path.strip_prefix(catalogue::PARAMETERS)?;
    match rest {
        "" => Some(""),
        _ => rest.strip_prefix('.'),
    }
}

/// In the same time wherever they differ, so that nobody finds out letter by letter.
fn is_same(expected: &str, given: &str) -> bool {
    let differences = expected
        .bytes()
        .zip(given.bytes())
        .fold(0, |differences, (one, other)| differences | (one ^ other));
    differences == 0 && expected.len() == given.len()
}

/// Only while it leaves.
fn gone() -> Failure {
    Failure::new("the client is gone".to_owned())
}
