//! `--watch`: a command again and again, whenever a file of the workspace changes.

use std::thread;
use std::time::Duration;

use super::Failure;
use super::session::Session;
use crate::diagnostics::Diagnostics;
use crate::manifest;
use crate::outcome::Outcome;
use crate::workspace::{Asked, Glance, Workspace};

/// How often files are looked at: fast enough for a person, and a few hundred `stat` calls are nothing.
const INTERVAL: Duration = Duration::from_millis(300);

/// Does it now and after every change, whatever comes of it; only Ctrl-C ends it.
pub(super) fn run(
    session: &mut Session<'_>,
    mut once: impl FnMut(&mut Session<'_>) -> Result<Outcome, Failure>,
) -> Result<Outcome, Failure> {
    run_beside(session, &mut once, |once, session| once(session), |_, _| {})
}

/// As [`run`], with something that goes on beside: `look` sees to it each time before files are looked at.
pub(super) fn run_beside<B>(
    session: &mut Session<'_>,
    beside: &mut B,
    mut once: impl FnMut(&mut B, &mut Session<'_>) -> Result<Outcome, Failure>,
    mut look: impl FnMut(&mut B, &Session<'_>),
) -> Result<Outcome, Failure> {
    // Of the round before: a link may lead elsewhere since, where only this round looks.
    let mut asked = Asked::default();
    loop {
        let root = session.workspace.root().to_owned();
        session.workspace = Workspace::at_root(&root);
        session.diagnostics = Diagnostics::new();
        // Looked at first: what changes meanwhile is seen afterwards.
        let before = Glance::at(&session.workspace, &asked);
        if let Err(failure) = once(beside, session) {
            say(session, &failure);
        }
        session
            .terminal
            .note("waiting for changes; Ctrl-C ends this\n");
        asked = Asked::of(&session.workspace);
        let before = before.and(Glance::at(&Workspace::at_root(&root), &asked));
        wait(session, &before, &asked, || look(beside, session));
    }
}

/// What a command that fails would say at its end.
pub(super) fn say(session: &Session<'_>, failure: &Failure) {
    match failure {
        Failure::Reported => session.note_diagnostics(),
        Failure::Refused(refusal) => session.terminal.refuse(refusal),
    }
}

/// Returns when the workspace is not as it was.
fn wait(session: &Session<'_>, before: &Glance, asked: &Asked, mut look: impl FnMut()) {
    let root = session.workspace.root();
    let generated = manifest::load(&session.workspace, &mut Diagnostics::new())
        .ok()
        .map(|manifest| manifest.robot.generated);
    // What was read first in this round may have changed since, and nobody had looked at it before.
    let is_as_read = session.workspace.is_as_read();
    loop {
        thread::sleep(INTERVAL);
        look();
        let now = Glance::at(&Workspace::at_root(root), asked);
        if !is_as_read || !now.is_as(before, generated.as_deref()) {
            return;
        }
    }
}
