//! `run --watch`: the robot's program, and after every change that compiles the new one in its place.

use std::ffi::OsString;
use std::process::ExitStatus;

use super::{Wanted, build, program};
use crate::arguments;
use crate::commands::session::Session;
use crate::commands::{Failure, watch};
use crate::digest::Digest;
use crate::interrupt::Beside;
use crate::outcome::{Outcome, Refusal};
use crate::workspace;

/// The program that was built last.
struct Robot<'a> {
    wanted: Wanted<'a>,
    arguments: Vec<OsString>,
    running: Option<Running>,
}

struct Running {
    program: Beside,
    /// `None`: its file could not be read.
    content: Option<Digest>,
}

pub(super) fn run(session: &mut Session<'_>, run: &arguments::Run) -> Result<Outcome, Failure> {
    if let Some(file) = run.record_file() {
        let message =
            format!("`--watch` starts the robot again, and `{file}` can be recorded once");
        let refusal = Refusal::wrong_usage(message)
            .help("`--record on` makes a recording in a folder of each run");
        return Err(refusal.into());
    }
    let mut robot = Robot {
        wanted: Wanted::of(run),
        arguments: program::arguments(run)?,
        running: None,
    };
    watch::run_beside(session, &mut robot, Robot::renew, Robot::look)
}

impl Robot<'_> {
    /// Builds, and starts what was built; what runs goes on meanwhile, and if nothing was built or it is the same.
    fn renew(&mut self, session: &mut Session<'_>) -> Result<Outcome, Failure> {
        let built = build(session, &self.wanted);
        self.look(session);
        let executable = match built {
            Ok(Some(executable)) => executable,
            Ok(None) => return Ok(self.goes_on(session)),
            Err(failure) => {
                watch::say(session, &failure);
                return Ok(self.goes_on(session));
            }
        };
        let content = workspace::content_of(&executable);
        if let Some(running) = &self.running
            && running.content.is_some()
            && running.content == content
        {
            session
                .terminal
                .note("the program is as it was: the robot goes on\n");
            return Ok(Outcome::Good);
        }
        self.end(session)?;
        let root = session.workspace.root();
        let program = program::start_robot(&executable, &self.arguments, root)?;
        self.running = Some(Running { program, content });
        Ok(Outcome::Good)
    }

    fn goes_on(&self, session: &Session<'_>) -> Outcome {
        if self.running.is_some() {
            session
                .terminal
                .note("the robot goes on as it was built before\n");
        }
        Outcome::Bad
    }

    fn end(&mut self, session: &Session<'_>) -> Result<(), Refusal> {
        let Some(running) = self.running.take() else {
            return Ok(());
        };
        session
            .terminal
            .note("the robot is stopped and started anew\n");
        running
            .program
            .end()
            .map_err(|error| Refusal::bad(format!("cannot wait for the robot: {error}")))
    }

    /// Says when the robot has ended by itself.
    fn look(&mut self, session: &Session<'_>) {
        let Some(running) = &self.running else {
            return;
        };
        let note = match running.program.ended() {
            Ok(None) => return,
            Ok(Some(status)) => format!(
                "the robot ended {}: the next change starts it\n",
                how(status)
            ),
            Err(error) => format!("cannot tell whether the robot runs: {error}\n"),
        };
        self.running = None;
        session.terminal.note(&note);
    }
}

fn how(status: ExitStatus) -> String {
    match status.code() {
        Some(code) => format!("with {code}"),
        None => format!("by a {status}"),
    }
}

#[cfg(test)]
mod tests {
    use std::os::unix::process::ExitStatusExt as _;
    use std::process::ExitStatus;

    use super::how;

    #[test]
    fn an_end_is_a_status_or_a_signal() {
        assert_eq!(how(ExitStatus::from_raw(1 << 8)), "with 1");
        assert_eq!(how(ExitStatus::from_raw(9)), "by a signal: 9 (SIGKILL)");
    }
}
