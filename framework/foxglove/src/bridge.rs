//! Both sides together: what Foxglove wishes is asked of the robot, what the robot says is handed on.
//!
//! Foxglove's server has threads of its own; only [`Bridge::turn`] talks to the robot.

use std::mem;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};

use foxglove::websocket::{
    AnyClient, Capability, ChannelView, Client, GetParametersResponder, Parameter,
    ParameterHandler, ServerListener, SetParametersResponder,
};
use foxglove::{WebSocketServer, WebSocketServerHandle};
use protocol::{Ask, Message};

use crate::channels::{Output, channels, describe};
use crate::{Options, Result, parameters};
use client::{Heard, Robot};

/// Wishes that wait for the robot, more than it has outputs; of more, questions get no values and looks are lost.
const WISHES: usize = 4096;

/// A robot that is shown.
pub(crate) struct Bridge<'options> {
    options: &'options Options,
    robot: Robot,
    outputs: Vec<Output>,
    server: WebSocketServerHandle,
    wishes: Receiver<Wish>,
}

/// What Foxglove wants.
enum Wish {
    Watch { topic: String },
    Leave { topic: String },
    Get(Vec<String>, GetParametersResponder),
    Set(Vec<Parameter>, SetParametersResponder),
}

/// Where wishes come in.
struct Ear(SyncSender<Wish>);

impl ServerListener for Ear {
    fn on_subscribe(&self, _: Client, channel: ChannelView) {
        let topic = channel.topic().to_owned();
        self.hear(Wish::Watch { topic });
    }

    fn on_unsubscribe(&self, _: Client, channel: ChannelView) {
        let topic = channel.topic().to_owned();
        self.hear(Wish::Leave { topic });
    }
}

impl ParameterHandler for Ear {
    fn get(
        &self,
        _: AnyClient,
        names: Vec<String>,
        _: Option<String>,
        responder: GetParametersResponder,
    ) {
        self.hear(Wish::Get(names, responder));
    }

    fn set(
        &self,
        _: AnyClient,
        parameters: Vec<Parameter>,
        _: Option<String>,
        responder: SetParametersResponder,
    ) {
        self.hear(Wish::Set(parameters, responder));
    }
}

impl Wish {
    /// Whoever asks gets an answer, one without values.
    fn refuse(self) {
        match self {
            Self::Watch { .. } | Self::Leave { .. } => {}
            Self::Get(_, responder) => responder.respond(Vec::new()),
            Self::Set(_, responder) => responder.respond(Vec::new()),
        }
    }
}

impl Ear {
    /// Nobody waits here for the robot: Foxglove's server goes on.
    fn hear(&self, wish: Wish) {
        if let Err(TrySendError::Full(wish)) = self.0.try_send(wish) {
            eprintln!("warning: {WISHES} wishes wait for the robot already: one is refused");
            wish.refuse();
        }
        // A bridge that has ended hears nothing any more, and its clients are told by their connection.
    }
}

impl<'options> Bridge<'options> {
    /// From now on Foxglove can connect.
    pub(crate) fn start(mut robot: Robot, options: &'options Options) -> Result<Self> {
        let outputs = channels(describe(&mut robot)?, Vec::new());
        let (sender, wishes) = sync_channel(WISHES);
        let listen = options.listen;
        let server = WebSocketServer::new()
            .name(robot.welcome.robot.clone())
            .bind(listen.ip().to_string(), listen.port())
            .capabilities([Capability::Parameters])
            .listener(Arc::new(Ear(sender.clone())))
            .parameter_handler(Arc::new(Ear(sender)))
            .start_blocking()
            .map_err(|error| format!("--listen {listen}: {error}"))?;
        Ok(Self {
            options,
            robot,
            outputs,
            server,
            wishes,
        })
    }

    /// Goes on with a robot that has come back: what is looked at is asked of it again.
    ///
    /// # Errors
    /// If it does not tell its outputs. What it refuses to show is told and left out.
    pub(crate) fn go_on_with(&mut self, mut robot: Robot) -> Result<()> {
        let described = describe(&mut robot)?;
        self.robot = robot;
        self.outputs = channels(described, mem::take(&mut self.outputs));
        for output in self.outputs.iter_mut().filter(|it| it.watching > 0) {
            if let Err(message) = output.subscribe(&mut self.robot, self.options) {
                eprintln!("warning: `{}`: {message}", output.path);
            }
        }
        Ok(())
    }

    /// The robot's.
    pub(crate) fn name(&self) -> &str {
        &self.robot.welcome.robot
    }

    /// Where it listens.
    pub(crate) fn port(&self) -> u16 {
        self.server.port()
    }

    /// Does what is wished, and hands on what the robot says.
    ///
    /// # Errors
    /// If the robot went away.
    pub(crate) fn turn(&mut self) -> Result<()> {
        while let Ok(wish) = self.wishes.try_recv() {
            self.grant(wish);
        }
        match self.robot.hear()? {
            Some(Heard::Message(Message::Update(update))) => {
                let time = self.robot.since_1970(update.time);
                if let Some(output) = self.subscribed(update.subscription) {
                    output.log(update.value, time);
                }
            }
            Some(Heard::Frame(frame)) => {
                let time = self.robot.since_1970(frame.time);
                if let Some(output) = self.subscribed(frame.subscription) {
                    output.log_image(frame.value, time);
                }
            }
            Some(Heard::Message(Message::ParametersChanged(_))) => {
                if let Ok(all) = parameters::read(&mut self.robot, &[]) {
                    self.server.publish_parameter_values(all);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// While the robot is away: who looks is remembered for when it is back, and who asks gets no values.
    pub(crate) fn refuse_wishes(&mut self) {
        while let Ok(wish) = self.wishes.try_recv() {
            let (topic, is_watched) = match &wish {
                Wish::Watch { topic } => (topic, true),
                Wish::Leave { topic } => (topic, false),
                Wish::Get(..) | Wish::Set(..) => {
                    wish.refuse();
                    continue;
                }
            };
            let mut outputs = self.outputs.iter_mut();
            if let Some(output) = outputs.find(|output| output.topic == *topic) {
                output.watching = match is_watched {
                    true => output.watching.saturating_add(1),
                    false => output.watching.saturating_sub(1),
                };
            }
        }
    }

    fn subscribed(&self, subscription: u32) -> Option<&Output> {
        let mut outputs = self.outputs.iter();
        outputs.find(|output| output.subscription == Some(subscription))
    }

    /// What the robot refuses is told here; whether it went away, its next word tells.
    fn grant(&mut self, wish: Wish) {
        let granted = match wish {
            Wish::Watch { topic } => self.watch(&topic),
            Wish::Leave { topic } => self.leave(&topic),
            Wish::Get(names, responder) => {
                let read = parameters::read(&mut self.robot, &names);
                let (parameters, result) = or_none(read);
                responder.respond(parameters);
                result
            }
            Wish::Set(wanted, responder) => {
                let names: Vec<_> = wanted.iter().map(|it| it.name.clone()).collect();
                let written = parameters::write(&mut self.robot, wanted);
                let (mut parameters, result) = or_none(written);
                if result.is_err() {
                    // Then they are what they were.
                    parameters = parameters::read(&mut self.robot, &names).unwrap_or_default();
                }
                responder.respond(parameters);
                result
            }
        };
        if let Err(message) = granted {
            eprintln!("warning: {message}");
        }
    }

    fn watch(&mut self, topic: &str) -> Result<()> {
        let Some(output) = self.outputs.iter_mut().find(|output| output.topic == topic) else {
            return Ok(());
        };
        output.watching += 1;
        // Whoever comes later may get what an earlier one was refused.
        match output.subscription {
            None => output.subscribe(&mut self.robot, self.options),
            Some(_) => Ok(()),
        }
    }

    fn leave(&mut self, topic: &str) -> Result<()> {
        let Some(output) = self.outputs.iter_mut().find(|output| output.topic == topic) else {
            return Ok(());
        };
        output.watching = output.watching.saturating_sub(1);
        if output.watching == 0
            && let Some(subscription) = output.subscription.take()
        {
            self.robot.ask(Ask::Unsubscribe { subscription })?;
        }
        Ok(())
    }
}

fn or_none(result: Result<Vec<Parameter>>) -> (Vec<Parameter>, Result<()>) {
    match result {
        Ok(parameters) => (parameters, Ok(())),
        Err(message) => (Vec::new(), Err(message)),
    }
}
