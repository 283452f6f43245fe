//! `doctor`: whether this machine and this robot are ready, line by line, each with the deed that mends it.

mod host;
mod machine;
mod robot;
mod running;
mod system;

use serde::Serialize;
use serde_json::json;

use super::Failure;
use super::session::Session;
use super::terminal::Terminal;
use crate::arguments::{Doctor, Global, TextOrJson};
use crate::outcome::{Outcome, Refusal};
use crate::workspace::Workspace;

/// What was looked at, and how it is.
#[derive(Debug, PartialEq, Eq, Serialize)]
struct Finding {
    about: &'static str,
    state: State,
    /// A lower-case fragment without full stop.
    message: String,
    /// What to do, unless all is well.
    help: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum State {
    Ok,
    Warning,
    Bad,
}

pub(super) fn run(
    global: &Global,
    terminal: &Terminal,
    doctor: &Doctor,
) -> Result<Outcome, Failure> {
    let mut session = Session::open(global, terminal);
    let findings = match &doctor.host {
        Some(host) => host::look(&mut session?, host, &doctor.reached)?,
        None => here(&mut session),
    };
    terminal.data(&match doctor.format {
        TextOrJson::Text => findings.iter().map(line).collect(),
        TextOrJson::Json => format!("{}\n", json!({ "version": 1, "checks": findings })),
    })?;
    let is_bad = findings.iter().any(|finding| finding.state == State::Bad);
    Ok(if is_bad { Outcome::Bad } else { Outcome::Good })
}

/// This machine, and the robot of this folder.
fn here(session: &mut Result<Session<'_>, Refusal>) -> Vec<Finding> {
    let root = session
        .as_ref()
        .map(|session| session.workspace.root().to_owned());
    let root = root.unwrap_or_else(|_| ".".into());
    let mut findings = vec![Finding::ok("hulkgen", env!("CARGO_PKG_VERSION"))];
    findings.extend(machine::tools(&root));
    findings.extend(machine::tools_of_deploy(&root));
    findings.extend(robot::look(session));
    findings.push(machine::free_space(&root));
    findings.extend(system::look(&Workspace::at_root("/".into()), "this user"));
    findings.extend(running::look(None));
    findings
}

fn line(finding: &Finding) -> String {
    let state = match finding.state {
        State::Ok => "ok     ",
        State::Warning => "warning",
        State::Bad => "bad    ",
    };
    let mut text = format!("{state}  {}: {}\n", finding.about, finding.message);
    if let Some(help) = &finding.help {
        text.push_str(&format!("         help: {help}\n"));
    }
    text
}

impl Finding {
    fn ok(about: &'static str, message: impl Into<String>) -> Self {
        Self {
            about,
            state: State::Ok,
            message: message.into(),
            help: None,
        }
    }

    fn warning(about: &'static str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            state: State::Warning,
            help: Some(help.into()),
            ..Self::ok(about, message)
        }
    }

    fn bad(about: &'static str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            state: State::Bad,
            ..Self::warning(about, message, help)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Finding, line};

    #[test]
    fn what_is_not_well_says_what_to_do() {
        assert_eq!(
            line(&Finding::ok("git", "2.53.0")),
            "ok       git: 2.53.0\n"
        );
        assert_eq!(
            line(&Finding::bad("cargo", "cannot be started", "install Rust")),
            "bad      cargo: cannot be started\n         help: install Rust\n"
        );
    }
}
