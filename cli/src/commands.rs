//! What each command does: dispatch, and what all of them share.
//!
//! Invariant: only these modules print; a command returns its outcome and never ends the process.

mod build;
mod capture;
mod cargo;
mod check;
mod completions;
mod deploy;
mod diff;
mod doctor;
mod explain;
mod generate;
mod graph;
mod man;
mod merge_driver;
mod new;
mod recording;
mod replay;
mod run;
mod running;
mod scaffold;
mod schema;
mod session;
pub mod show;
mod simulate;
mod system;
mod terminal;
mod vision;
mod watch;

use crate::arguments::{Arguments, Command, Recording, RecordingCommand};
use crate::diagnostics::Reported;
use crate::outcome::{Outcome, Refusal};
use session::Session;
use terminal::Terminal;

/// Why a command has no answer.
enum Failure {
    /// Errors are in the session's diagnostics.
    Reported,
    Refused(Refusal),
}

/// Does what the command line asks for; everything worth knowing is printed when it returns.
pub fn run(arguments: &Arguments) -> Outcome {
    let terminal = Terminal::new(arguments.global.color);
    let elsewhere = system::refuse_elsewhere(&arguments.command, std::env::consts::OS);
    if let Err(refusal) = elsewhere {
        terminal.refuse(&refusal);
        return refusal.outcome;
    }
    let answer = match &arguments.command {
        Command::Schema => schema::run(&terminal).map_err(Failure::Refused),
        Command::New(new) => new::run(&terminal, new),
        Command::MergeDriver(merge) => merge_driver::run(&terminal, merge),
        Command::Completions(completions) => {
            completions::run(&terminal, completions).map_err(Failure::Refused)
        }
        Command::Man(man) => man::run(&terminal, man).map_err(Failure::Refused),
        Command::Recording(recording)
            if !matches!(recording.command, RecordingCommand::Pull(_)) =>
        {
            recording::run(&arguments.global, &terminal, recording).map_err(Failure::Refused)
        }
        Command::Topic(topic) => running::topic(&terminal, topic).map_err(Failure::Refused),
        Command::Param(param) => running::param(&terminal, param).map_err(Failure::Refused),
        Command::Call(call) => running::call(&terminal, call).map_err(Failure::Refused),
        Command::Log(log) => running::log(&terminal, log).map_err(Failure::Refused),
        Command::Top(top) => running::top(&terminal, top).map_err(Failure::Refused),
        Command::Doctor(doctor) => doctor::run(&arguments.global, &terminal, doctor),
        command => with_session(arguments, command, &terminal),
    };
    match answer {
        Ok(outcome) => outcome,
        Err(Failure::Reported) => Outcome::Bad,
        Err(Failure::Refused(refusal)) => {
            terminal.refuse(&refusal);
            refusal.outcome
        }
    }
}

fn with_session(
    arguments: &Arguments,
    command: &Command,
    terminal: &Terminal,
) -> Result<Outcome, Failure> {
    if let Command::Explain(explain) = command
        && let Some(outcome) = explain::run_without_robot(terminal, explain)?
    {
        return Ok(outcome);
    }
    let mut session = Session::open(&arguments.global, terminal)?;
    if is_answered_from_cache(command) {
        session.use_cache();
    }
    let answer = match command {
        Command::Generate(generate) if generate.watch => {
            watch::run(&mut session, |session| generate::run(session, generate))
        }
        Command::Generate(generate) => generate::run(&mut session, generate),
        Command::Check(check) if check.watch => {
            watch::run(&mut session, |session| check::run(session, check))
        }
        Command::Check(check) => return check::run(&mut session, check),
        Command::Explain(explain) => explain::run(&mut session, explain),
        Command::Graph(graph) => graph::run(&mut session, graph),
        Command::Diff(diff) => return diff::run(&mut session, diff),
        Command::Show(show) => show::run(&mut session, show),
        Command::Run(run) => run::run(&mut session, run),
        Command::Build(build) => build::run(&mut session, build),
        Command::Simulate(simulate) => simulate::run(&mut session, simulate),
        Command::Vision(vision) => vision::run(&mut session, vision),
        Command::Replay(replay) => replay::run(&mut session, replay),
        Command::Capture(capture) => capture::run(&mut session, capture),
        Command::Deploy(deploy) => deploy::deploy(&mut session, deploy),
        Command::Robots(robots) => deploy::robots(&mut session, robots),
        Command::Logs(logs) => deploy::logs(&mut session, logs),
        Command::Recording(Recording {
            command: RecordingCommand::Pull(pull),
        }) => deploy::pull(&mut session, pull),
        Command::AddNode(add) => scaffold::add_node(&mut session, add),
        Command::AddCycler(add) => scaffold::add_cycler(&mut session, add),
        Command::RemoveNode(remove) => scaffold::remove_node(&mut session, remove),
        Command::RenameOutput(rename) => scaffold::rename_output(&mut session, rename),
        Command::Schema
        | Command::New(_)
        | Command::MergeDriver(_)
        | Command::Completions(_)
        | Command::Man(_)
        | Command::Recording(_)
        | Command::Topic(_)
        | Command::Param(_)
        | Command::Call(_)
        | Command::Log(_)
        | Command::Top(_)
        | Command::Doctor(_) => unreachable!("needs no session"),
    };
    if matches!(answer, Err(Failure::Reported)) {
        session.note_diagnostics();
    }
    answer
}

/// Whether an answer of an earlier run will do, if nothing that it was made of has changed.
fn is_answered_from_cache(command: &Command) -> bool {
    match command {
        Command::Generate(generate) => !generate.watch && !generate.no_cache,
        // What rustc says depends on more than the robot's files.
        Command::Check(check) => !check.watch && !check.cargo && !check.no_cache,
        _ => false,
    }
}

/// "1 node", "2 nodes".
pub(crate) fn plural(number: usize, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        number => format!("{number} {noun}s"),
    }
}

impl From<Reported> for Failure {
    fn from(_: Reported) -> Self {
        Self::Reported
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}
