//! `--watch`: a command again and again, whenever a file of the workspace changes.

use std::thread;
use std::time::Duration;

use super::Failure;
use super::session::Session;
use crate::diagnostics::Diagnostics;
use crate::manifest;
use crate::outcome::Outcome;
use crate::workspace::{Glance, Workspace};

/// How often files are looked at: fast enough for a person, and a few hundred `stat` calls are nothing.
const INTERVAL: Duration = Duration::from_millis(300);

/// Does it now and after every change, whatever comes of it; only Ctrl-C ends it.
pub(super) fn run(
    session: &mut Session<'_>,
    mut once: impl FnMut(&mut Session<'_>) -> Result<Outcome, Failure>,
) -> Result<Outcome, Failure> {
    loop {
        let root = session.workspace.root().to_owned();
        session.workspace = Workspace::at_root(&root);
        session.diagnostics = Diagnostics::new();
        // Looked at first: what changes meanwhile is seen afterwards.
        let before = Glance::at(&session.workspace);
        match once(session) {
            Ok(_) => {}
            Err(Failure::Reported) => session.note_diagnostics(),
            Err(Failure::Refused(refusal)) => session.terminal.refuse(&refusal),
        }
        session
            .terminal
            .note("waiting for changes; Ctrl-C ends this\n");
        wait(session, &before);
    }
}

/// Returns when the workspace is not as it was.
fn wait(session: &Session<'_>, before: &Glance) {
    let root = session.workspace.root();
    let generated = manifest::load(&session.workspace, &mut Diagnostics::new())
        .ok()
        .map(|manifest| manifest.robot.generated);
    loop {
        thread::sleep(INTERVAL);
        let now = Glance::at(&Workspace::at_root(root));
        if !now.is_as(before, generated.as_deref()) {
            return;
        }
    }
}
