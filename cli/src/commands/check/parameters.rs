//! `check --cargo` of what only serde can read: the robot's program is built and asked about its parameter files.

use std::collections::BTreeSet;
use std::env;
use std::process::{Command, Stdio};

use camino::Utf8Path;

use crate::commands::Failure;
use crate::commands::cargo::{ForProcessor, OWN_PROFILE, Request};
use crate::commands::session::Session;
use crate::diagnostics::Diagnostics;
use crate::late::parameters::Answer;
use crate::outcome::Refusal;
use crate::pipeline::Understood;
use crate::resolve::robot::Target;

/// Variables that set parameters: a robot's files are not checked with those of whoever checks them.
const VARIABLES: &str = "HULK_PARAMETERS__";

/// Builds the program of a target and adds what it says; whether it could be built.
pub(super) fn ask_program(
    session: &mut Session<'_>,
    understood: &Understood,
    target: &Target,
) -> Result<bool, Failure> {
    let profile = target.profile.as_deref().unwrap_or(OWN_PROFILE);
    let mut request = Request::build(&understood.robot, target, profile, None);
    if target.triple.is_none() {
        // `run` and `build` write the same program.
        let root = session.workspace.root();
        ForProcessor::of(root, None, target.cpu.as_deref())?.apply(&mut request);
    }
    let said = request.said(session, false)?;
    if !said.success {
        // What is left when everything was checked before: the linker.
        let late = said.diagnostics(session, understood)?;
        session.diagnostics.extend(late);
        return Ok(false);
    }
    let Some(executable) = said.executable else {
        return Err(Refusal::bad("cargo did not say where the program is").into());
    };
    let unchecked = &understood.unchecked;
    let mut found = Diagnostics::new();
    let mut told = BTreeSet::new();
    let used = unchecked
        .locations
        .iter()
        .map(|location| (location.as_deref(), true));
    let others = unchecked.other_locations.iter();
    let others = others.map(|location| (Some(location.as_str()), false));
    for (location, is_used) in used.chain(others) {
        let answer = ask(&executable, session.workspace.root(), location)?;
        // The hardware's table is the target's own, which runs at one of these locations.
        let all = answer.mistakes.iter().filter(|one| !one.is_of_hardware());
        // Where no target runs, values may be missing.
        for mistake in all.filter(|mistake| is_used || !mistake.is_of_location()) {
            let diagnostic = mistake.diagnostic(&session.workspace, location);
            let place = diagnostic
                .spans
                .first()
                .map(|span| (span.file.clone(), span.range.start));
            // A mistake of a file that several locations read is one.
            if told.insert((diagnostic.message.clone(), place)) {
                found.add(diagnostic);
            }
        }
    }
    session.diagnostics.extend(found);
    Ok(true)
}

/// What the program says about the robots of a location, or about those that are at none.
fn ask(program: &Utf8Path, root: &Utf8Path, location: Option<&str>) -> Result<Answer, Refusal> {
    let mut command = Command::new(program);
    command
        .args(["--check-parameters", "--format", "json", "--location"])
        .arg(location.unwrap_or_default())
        .current_dir(root)
        .stdin(Stdio::null());
    for (variable, _) in env::vars_os() {
        if variable.to_string_lossy().starts_with(VARIABLES) {
            command.env_remove(variable);
        }
    }
    let output = command
        .output()
        .map_err(|error| Refusal::bad(format!("cannot start `{program}`: {error}")))?;
    serde_json::from_slice(&output.stdout).map_err(|_| {
        let said = String::from_utf8_lossy(&output.stderr);
        let message = format!("`{program}` cannot check its parameters: {}", said.trim());
        Refusal::bad(message).help("use the framework of this version of hulkgen")
    })
}
