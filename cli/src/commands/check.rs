//! `check`: every diagnostic, and a summary.

mod parameters;

use serde::{Deserialize, Serialize};

use super::cargo::Request;
use super::session::Session;
use super::{Failure, generate, plural};
use crate::arguments::{Check, CheckFormat};
use crate::diagnostics::{self, Diagnostics, Severity};
use crate::graph::{self, Graph};
use crate::outcome::Outcome;
use crate::pipeline::Understood;

/// What is printed, and how it ends.
#[derive(Serialize, Deserialize)]
struct Answer {
    text: String,
    is_bad: bool,
}

pub(super) fn run(session: &mut Session<'_>, check: &Check) -> Result<Outcome, Failure> {
    let question = question(session, check);
    let kept: Option<Answer> = session.cache.recall(&session.workspace, &question);
    let answer = match kept {
        Some(kept) => kept,
        None => {
            let answer = answer(session, check)?;
            session.cache.keep(&session.workspace, &question, &answer);
            answer
        }
    };
    session.terminal.data(&answer.text)?;
    Ok(if answer.is_bad {
        Outcome::Bad
    } else {
        Outcome::Good
    })
}

/// All that the answer depends on besides the robot.
fn question(session: &Session<'_>, check: &Check) -> String {
    let Check {
        cargo,
        deny_warnings,
        watch: _,
        no_cache: _,
        format,
    } = check;
    let color = session.terminal.colors_data();
    format!("check: cargo {cargo}, deny warnings {deny_warnings}, {format:?}, color {color}")
}

fn answer(session: &mut Session<'_>, check: &Check) -> Result<Answer, Failure> {
    let understood = session.understand();
    let mut compiles = true;
    if check.cargo
        && let Ok(understood) = &understood
    {
        compiles = compile(session, check, understood)?;
    }
    let found = &session.diagnostics;
    let is_bad = understood.is_err()
        || !compiles
        || found.has_errors()
        || (check.deny_warnings && found.has_warnings());
    let text = match check.format {
        CheckFormat::Json => {
            let mut text = diagnostics::to_json(found, &session.workspace).to_string();
            text.push('\n');
            text
        }
        CheckFormat::RustcJson => diagnostics::to_rustc_json(found, &session.workspace, !is_bad),
        CheckFormat::Text => {
            let color = session.terminal.colors_data();
            let mut text = diagnostics::render(found, &session.workspace, color);
            text.push_str(&summary_of_diagnostics(found));
            if let Ok(understood) = &understood {
                let graph = graph::describe(&understood.robot, &understood.schedule);
                let opaque = understood.unchecked.opaque.len();
                text.push_str(&summary_of_robot(
                    &graph,
                    understood.robot.besides_edges,
                    if check.cargo { 0 } else { opaque },
                ));
            }
            text
        }
    };
    Ok(Answer { text, is_bad })
}

/// Adds what rustc finds; whether cargo could compile everything it was asked for.
///
/// The generated crate is written first, for rustc reads it.
fn compile(
    session: &mut Session<'_>,
    check: &Check,
    understood: &Understood,
) -> Result<bool, Failure> {
    generate::write(session, understood)?;
    let targets = &understood.robot.targets;
    let (here, elsewhere): (Vec<_>, Vec<_>) = targets
        .iter()
        .partition(|target| is_of_this_machine(target.triple.as_deref()));
    for target in elsewhere {
        let (name, triple) = (&target.name, target.triple.as_deref().unwrap_or_default());
        let note = format!("target `{name}` is for `{triple}` and is not compiled here\n");
        session.terminal.note(&note);
    }
    let color = check.format == CheckFormat::Text && session.terminal.colors_data();
    let first = here.first().copied();
    let said = Request::check(&understood.robot, here).said(session, color)?;
    let late = said.diagnostics(session, understood)?;
    session.diagnostics.extend(late);
    // With an error the program would not start, whatever it reads.
    if !said.success || session.diagnostics.has_errors() || understood.unchecked.opaque.is_empty() {
        return Ok(said.success);
    }
    match first {
        Some(target) => parameters::ask_program(session, understood, target),
        None => {
            let note = "no target is for this machine: opaque parameters are not checked\n";
            session.terminal.note(note);
            Ok(true)
        }
    }
}

/// Whether the host's compiler makes programs for this triple; a version of libc does not matter to a check.
fn is_of_this_machine(triple: Option<&str>) -> bool {
    let has = |part| triple.is_none_or(|triple| triple.split(['-', '.']).any(|word| word == part));
    has(std::env::consts::ARCH) && has(std::env::consts::OS)
}

/// "2 errors, 1 warning" on a line; nothing if there is neither.
fn summary_of_diagnostics(found: &Diagnostics) -> String {
    let count = |severity| {
        found
            .sorted()
            .iter()
            .filter(|one| one.severity() == severity)
            .count()
    };
    let parts: Vec<String> = [(Severity::Error, "error"), (Severity::Warning, "warning")]
        .into_iter()
        .map(|(severity, noun)| (count(severity), noun))
        .filter(|(number, _)| *number > 0)
        .map(|(number, noun)| plural(number, noun))
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!("{}\n", parts.join(", "))
    }
}

/// How much there is, and how much of it was checked.
///
/// `besides` the edges something was left to rustc, `opaque` parameters to the robot's program.
fn summary_of_robot(graph: &Graph, besides: usize, opaque: usize) -> String {
    let instances = graph
        .cyclers
        .iter()
        .map(|cycler| cycler.instances.len())
        .sum();
    let nodes = graph.cyclers.iter().map(|cycler| cycler.nodes.len()).sum();
    let edges = match graph.edges.len() - graph.checked_edges() {
        0 => "all checked".to_owned(),
        left => format!("{left} left to rustc"),
    };
    let besides = match besides {
        0 => String::new(),
        _ => format!(", {} left to rustc", plural(besides, "other question")),
    };
    let opaque = match opaque {
        0 => String::new(),
        _ => format!(", {} left to `check --cargo`", plural(opaque, "parameter")),
    };
    format!(
        "robot {}: {}, {}, {}, {}, {edges}{besides}{opaque}\n",
        graph.robot,
        plural(graph.cyclers.len(), "cycler"),
        plural(instances, "instance"),
        plural(nodes, "node"),
        plural(graph.edges.len(), "edge"),
    )
}
