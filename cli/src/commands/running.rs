//! `topic`, `param`, `call`, `log` and `top`: what a running robot is asked for.
//!
//! Invariant: these commands read no manifest and need no robot on this machine.

mod connection;
mod images;
mod log;
mod param;
mod text;
mod top;
mod topic;

use std::thread;
use std::time::Duration;

use protocol::{Ask, EntryKind, Good};
use serde_json::Value;

use super::terminal::Terminal;
use crate::arguments::{Call, Running, TextOrJson};
use crate::outcome::{Outcome, Refusal};
use connection::Connection;

pub(super) use log::log;
pub(super) use param::param;
pub(super) use top::top;
pub(super) use topic::topic;

/// A running robot, and what the system granted its threads: a text where something was asked, and whether it is real time.
pub(super) struct Threads {
    /// Robot and target.
    pub(super) robot: String,
    /// (instance, what was granted, whether it has a real-time policy)
    pub(super) granted: Vec<(String, String, bool)>,
}

/// Asks the robot at this address.
pub(super) fn threads(address: Option<&str>) -> Result<Threads, Refusal> {
    let mut connection = Connection::open(&Running {
        host: address.map(str::to_owned),
        token: None,
        format: TextOrJson::Text,
    })?;
    let Good::Timings(timings) = connection.ask(Ask::Timings {})? else {
        return Err(connection.confused());
    };
    let granted = timings.instances.iter().filter_map(|instance| {
        let granted = instance.scheduling.as_ref()?;
        let is_real_time = granted.policy.as_deref() != Some("other");
        Some((
            instance.name.clone(),
            top::thread_text(granted),
            is_real_time,
        ))
    });
    let welcome = connection.welcome();
    Ok(Threads {
        robot: format!("{} ({})", welcome.robot, welcome.target),
        granted: granted.collect(),
    })
}

/// Levels below the root where outputs, procedures and the groups of parameters are: `INSTANCE.KIND.NAME`.
const NAMED: u8 = 3;

pub(super) fn call(terminal: &Terminal, call: &Call) -> Result<Outcome, Refusal> {
    let argument = match &call.argument {
        None => Value::Null,
        Some(text) => serde_json::from_str(text).map_err(|error| {
            Refusal::wrong_usage(format!("the argument is not JSON: {error}")).help(quotes(text))
        })?,
    };
    let mut connection = Connection::open(&call.running)?;
    let Some(path) = &call.path else {
        return topic::list_kinds(
            terminal,
            &mut connection,
            call.running.format,
            &[EntryKind::Procedure],
        );
    };
    let good = connection.ask_for(
        Ask::Call {
            path: path.clone(),
            argument,
            timeout: call.timeout,
        },
        // The robot says itself when the call has failed.
        Duration::from_secs_f64(call.timeout.unwrap_or(5.0)),
    );
    // A message that begins with the path is about what stood, or should have stood, behind it.
    let is_about_argument = |refusal: &Refusal| refusal.message.starts_with(&format!("`{path}`: "));
    let good = good.map_err(|refusal| match (&call.argument, &refusal.help) {
        (None, None) if is_about_argument(&refusal) => refusal.help(format!(
            "if it wants an argument: JSON behind the path; `hulkgen topic info {path}` names its type"
        )),
        _ => refusal,
    })?;
    let Good::Called(response) = good else {
        return Err(connection.confused());
    };
    let said = match call.running.format {
        TextOrJson::Text => text::tree(&response),
        TextOrJson::Json => format!("{response}\n"),
    };
    terminal.data(&said)?;
    Ok(Outcome::Good)
}

/// What makes JSON of an argument that is none.
fn quotes(argument: &str) -> &'static str {
    match argument.trim_start().starts_with(['{', '[']) {
        true => {
            "keys and texts stand in double quotes, all of it in single ones: '{\"forward\": 0.05}'"
        }
        false => "texts stand in quotes: '\"forward\"'",
    }
}

/// Does something again and again, `count` times if that is given, until it says false: nobody wants more.
fn again(
    count: Option<u64>,
    every: Option<f64>,
    mut deed: impl FnMut() -> Result<bool, Refusal>,
) -> Result<Outcome, Refusal> {
    let mut done = 0;
    while count.is_none_or(|count| done < count) {
        if done > 0
            && let Some(seconds) = every
        {
            thread::sleep(Duration::from_secs_f64(seconds));
        }
        if !deed()? {
            break;
        }
        done += 1;
    }
    Ok(Outcome::Good)
}

#[cfg(test)]
mod tests {
    use super::quotes;

    #[test]
    fn an_object_is_told_of_its_keys_and_a_word_of_quotes() {
        assert!(quotes("{forward:1}").contains("'{\"forward\": 0.05}'"));
        assert!(quotes("forward").contains("'\"forward\"'"));
    }
}
