//! `recording pull`: the runs of a robot onto this machine.

use camino::Utf8Path;
use serde_json::json;

use crate::arguments::{Pull, TextOrJson};
use crate::commands::Failure;
use crate::commands::session::Session;
use crate::deploy::script::quoted;
use crate::outcome::{Outcome, Refusal};

/// A folder's name, also of a destination that is a URL.
fn folder_of(host: &str) -> &str {
    let host = host.strip_prefix("ssh://").unwrap_or(host);
    host.strip_suffix('/').unwrap_or(host)
}

pub(in crate::commands) fn pull(
    session: &mut Session<'_>,
    pull: &Pull,
) -> Result<Outcome, Failure> {
    let (remote, reached) = super::remote(session, &pull.host, &pull.reached)?;
    let runs = format!("{}/runs", reached.deploy.folder);
    let into = pull
        .into
        .clone()
        .unwrap_or_else(|| session.runs().join(folder_of(&pull.host)));
    let (from, into) = if pull.newest {
        // By the recordings: a folder is as old as its file is, however long that is written.
        let newest = format!(
            "cd {} && {{ ls -1td -- */*.mcap 2>/dev/null; ls -1t; }} | head -n 1",
            quoted(&runs)
        );
        let newest = remote.shell(&newest).map_err(Refusal::from)?;
        let newest = newest.trim();
        let newest = newest.split_once('/').map_or(newest, |(folder, _)| folder);
        // A name of one folder, whatever the robot says.
        if newest.is_empty() || Utf8Path::new(newest).file_name() != Some(newest) {
            return Err(Refusal::bad(format!("`{}` has no runs", pull.host)).into());
        }
        (format!("{runs}/{newest}"), into.join(newest))
    } else {
        (runs, into)
    };
    let mut told = 0;
    let fetched = remote.fetch(&from, &into, |percent| {
        if percent >= told + 10 {
            told = percent;
            session
                .terminal
                .note(&format!("{}: {percent} %\n", pull.host));
        }
    });
    fetched.map_err(|failed| {
        let message = format!(
            "the runs of `{}` are not all here: {}",
            pull.host, failed.message
        );
        Refusal::bad(message).help("call it again: what is here is not fetched again")
    })?;
    session.terminal.data(&match pull.format {
        TextOrJson::Text => format!("{into}\n"),
        TextOrJson::Json => format!("{}\n", json!({ "version": 1, "folder": into })),
    })?;
    Ok(Outcome::Good)
}
