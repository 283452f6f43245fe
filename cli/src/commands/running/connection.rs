//! The connection to a running robot, and what people are told where there is none.

use std::env;
use std::time::{Duration, Instant};

use client::{Error, Heard, Robot, Why};
use protocol::{Ask, Good, Welcome};

use crate::arguments::Running;
use crate::outcome::Refusal;

/// Names the token where the command line does not: others on this machine can read command lines.
const TOKEN: &str = "HULKGEN_TOKEN";

/// How long one look for what the robot says takes where no end is wanted.
const LOOK: Duration = Duration::from_secs(1);

/// A running robot.
pub(super) struct Connection(Robot);

impl Connection {
    /// Finds the robot, hears its welcome, and shows the token if there is one.
    pub(super) fn open(running: &Running) -> Result<Self, Refusal> {
        let host = running.host.as_deref().unwrap_or("127.0.0.1");
        let token = running.token.clone().or_else(|| env::var(TOKEN).ok());
        let robot = Robot::connect(host, token.as_deref());
        // Nothing was asked yet but whether the token is the robot's.
        robot.map(Self).map_err(|error| refusal(error, true))
    }

    /// What the robot said first.
    pub(super) fn welcome(&self) -> &Welcome {
        &self.0.welcome
    }

    /// Asks and waits for the answer.
    pub(super) fn ask(&mut self, ask: Ask) -> Result<Good, Refusal> {
        self.ask_for(ask, Duration::ZERO)
    }

    /// Asks for something that may take the robot so long.
    pub(super) fn ask_for(&mut self, ask: Ask, duration: Duration) -> Result<Good, Refusal> {
        let needs_token = self.welcome().needs_token;
        let answer = self.0.ask_for(ask, duration);
        answer.map_err(|error| refusal(error, needs_token))
    }

    /// What the robot says next, however long that takes.
    pub(super) fn hear(&mut self) -> Result<Heard, Refusal> {
        loop {
            if let Some(heard) = self.hear_before(Instant::now() + LOOK)? {
                return Ok(heard);
            }
        }
    }

    /// What the robot says before that time, if anything.
    pub(super) fn hear_before(&mut self, end: Instant) -> Result<Option<Heard>, Refusal> {
        let heard = self.0.hear_before(end);
        heard.map_err(|error| refusal(error, false))
    }

    /// What the robot said makes no sense here.
    pub(super) fn confused(&self) -> Refusal {
        refusal(self.0.confused(), false)
    }
}

/// What went wrong, with what to do.
fn refusal(error: Error, needs_token: bool) -> Refusal {
    if let Why::Refused(failure) = &error.why {
        return refused(failure, needs_token);
    }
    let refusal = Refusal::bad(error.to_string());
    match error.why.help() {
        Some(help) => refusal.help(help),
        None => refusal,
    }
}

fn refused(failure: &protocol::Failure, needs_token: bool) -> Refusal {
    let each = failure
        .refusals
        .iter()
        .map(|refusal| match refusal.path.as_str() {
            "" => refusal.message.clone(),
            path => format!("`{path}`: {}", refusal.message),
        });
    let each: Vec<_> = each.collect();
    // The message says the same in one line.
    let refusal = Refusal::bad(match each.is_empty() {
        true => failure.message.clone(),
        false => each.join("\n  "),
    });
    if needs_token {
        return refusal.help(format!(
            "writing needs the robot's token: `--token TOKEN`, or {TOKEN} in the environment"
        ));
    }
    refusal
}
