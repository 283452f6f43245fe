//! `logs`: what a robot's system keeps of the program's output.

use crate::arguments;
use crate::commands::Failure;
use crate::commands::session::Session;
use crate::deploy::script::quoted;
use crate::outcome::{Outcome, Refusal};

pub(in crate::commands) fn logs(
    session: &mut Session<'_>,
    logs: &arguments::Logs,
) -> Result<Outcome, Failure> {
    let (remote, reached) = super::remote(session, &logs.host, &logs.reached)?;
    let Some(unit) = reached.service().unit else {
        return Err(Refusal::wrong_usage(
            "nothing starts the program there, so nobody keeps its output",
        )
        .help("name a unit file in `[target.deploy]` of hulk.toml")
        .into());
    };
    let follow = if logs.follow { " --follow" } else { "" };
    let (journalctl, unit) = (&reached.deploy.journalctl, quoted(unit));
    let command = format!("{journalctl} --unit {unit} --lines {}{follow}", logs.lines);
    let status = remote.attached(&command).status().map_err(|error| {
        Refusal::bad(format!("cannot start `ssh`: {error}")).help("install openssh-client")
    })?;
    Ok(if status.success() {
        Outcome::Good
    } else {
        Outcome::Bad
    })
}
