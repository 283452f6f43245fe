//! `replay`: generate, build, and let the robot's program run a recording again; beside it perhaps another revision's.

use std::ffi::OsString;

use camino::Utf8PathBuf;

use super::Failure;
use super::cargo::OWN_PROFILE;
use super::run::{Built, Wanted, absolute, become_robot, build_with};
use super::session::Session;
use crate::arguments::{Replay, TextOrJson};
use crate::cache::checkout;
use crate::outcome::{Outcome, Refusal};
use crate::recording;

pub(super) fn run(session: &mut Session<'_>, replay: &Replay) -> Result<Outcome, Failure> {
    // Before anything is built.
    recording::look_at(&replay.file)?;
    let mut arguments = arguments(replay)?;
    let wanted = Wanted {
        target: replay.target.as_deref(),
        build: &replay.build,
    };
    let Some(built) = build_with(session, &wanted)? else {
        return Ok(Outcome::Bad);
    };
    if let Some(revision) = &replay.against {
        let Some(program) = other_program(session, revision, &built, &wanted)? else {
            return Ok(Outcome::Bad);
        };
        arguments.extend(["--against".into(), program.into()]);
        arguments.extend(["--against-name", revision].map(OsString::from));
    }
    let root = session.workspace.root();
    Err(become_robot(&built.executable, &arguments, root).into())
}

/// The same program of another revision, built once for each; `None`: cargo said why not.
///
/// It is built where this one was, so that what both need is compiled once; then it makes room for this one again.
fn other_program(
    session: &mut Session<'_>,
    revision: &str,
    built: &Built,
    wanted: &Wanted<'_>,
) -> Result<Option<Utf8PathBuf>, Failure> {
    let root = session.workspace.root().to_owned();
    let copy = checkout::of(&root, revision)?;
    let profile = built.profile.as_deref().unwrap_or(OWN_PROFILE);
    let kept = copy.program(&built.target, profile);
    if kept.is_file() {
        return Ok(Some(kept));
    }
    session
        .terminal
        .note(&format!("building `{revision}` in {}\n", copy.root));
    let request = built.request_elsewhere()?;
    let said = request.said_in(&copy.root, session, session.terminal.colors_notes())?;
    let Some(executable) = said.executable.filter(|_| said.success) else {
        let refusal = Refusal::bad(format!("`{revision}` cannot be built"));
        return Err(refusal
            .help("cargo says why above; name a revision whose generated crate builds")
            .into());
    };
    copy.keep(&executable, &kept)?;
    // Where it was built, this robot's program stood.
    Ok(build_with(session, wanted)?.map(|_| kept))
}

/// The program's options.
fn arguments(replay: &Replay) -> Result<Vec<OsString>, Refusal> {
    let mut arguments = vec!["--replay".into(), absolute(&replay.file)?];
    if replay.verify {
        arguments.push("--verify".into());
    }
    if replay.carry {
        arguments.push("--carry".into());
    }
    let mut add = |name: &str, value: &str| arguments.extend([name.into(), value.into()]);
    for assignment in &replay.set {
        add("--set", assignment);
    }
    if let Some(node) = &replay.node {
        add("--node", node);
    }
    if let Some(tolerance) = replay.tolerance {
        add("--tolerance", &tolerance.to_string());
    }
    if let Some(TextOrJson::Json) = replay.format {
        add("--format", "json");
    }
    Ok(arguments)
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::arguments;
    use crate::arguments::{Arguments, Command};

    fn passed_on(line: &str) -> Option<String> {
        let parsed = Arguments::try_parse_from(line.split(' ')).ok()?;
        let Command::Replay(replay) = parsed.command else {
            panic!("`{line}` is no replay")
        };
        let arguments = arguments(&replay).expect("the current folder is known");
        let words = arguments.iter().map(|word| word.to_string_lossy());
        Some(words.collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn options_of_the_program_are_passed_on() {
        for (line, expected) in [
            ("/a --verify", "--replay /a --verify"),
            ("/a --set a=1 --carry", "--replay /a --carry --set a=1"),
            (
                "/a --verify --node walk --tolerance 1e-3 --format json",
                "--replay /a --verify --node walk --tolerance 0.001 --format json",
            ),
            (
                "/a --set b.c=1 --set d=[2] --node walk --profile dev",
                "--replay /a --set b.c=1 --set d=[2] --node walk",
            ),
            (
                "/a --verify --tolerance 0",
                "--replay /a --verify --tolerance 0",
            ),
            ("/a --node walk", "--replay /a --node walk"),
            ("/a --against main", "--replay /a"),
            ("/a", "--replay /a"),
        ] {
            let line = format!("hulkgen replay {line}");
            assert_eq!(passed_on(&line).as_deref(), Some(expected), "{line}");
        }
    }

    #[test]
    fn a_replay_answers_one_question() {
        for line in [
            "/a --verify --set b=1",
            "/a --verify --against main",
            "/a --set b=1 --against main",
            "/a --set b=1 --tolerance 1",
            "/a --tolerance 1",
        ] {
            assert_eq!(passed_on(&format!("hulkgen replay {line}")), None, "{line}");
        }
    }
}
