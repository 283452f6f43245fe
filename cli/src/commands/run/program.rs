//! The robot's program, in place of hulkgen or while hulkgen waits.

use std::ffi::OsString;
use std::io;
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use camino::Utf8Path;

use crate::arguments::{Run, TextOrJson};
use crate::interrupt::{self, Beside, Ended};
use crate::outcome::Refusal;
use crate::workspace::RUNS;

/// Replaces this process, so that signals, exit status and terminal are the robot's own, as
/// `cargo run` does. Runs in the workspace root, where the generated program expects to be. Returns
/// only if that is impossible.
pub(in crate::commands) fn become_robot(
    executable: &Utf8Path,
    arguments: &[OsString],
    root: &Utf8Path,
) -> Refusal {
    let mut command = command(executable, arguments, root);
    interrupt::heed();
    let error = command.exec();
    cannot_start(executable, &error)
}

/// Runs it to its end in the workspace root; Ctrl-C is left to it.
pub(in crate::commands) fn end_of_robot(
    executable: &Utf8Path,
    arguments: &[OsString],
    root: &Utf8Path,
) -> Result<Ended, Refusal> {
    interrupt::wait_for(|| command(executable, arguments, root).status())
        .map_err(|error| cannot_start(executable, &error))
}

/// Starts it in the workspace root; hulkgen goes on beside.
pub(super) fn start_robot(
    executable: &Utf8Path,
    arguments: &[OsString],
    root: &Utf8Path,
) -> Result<Beside, Refusal> {
    Beside::start(&mut command(executable, arguments, root))
        .map_err(|error| cannot_start(executable, &error))
}

fn command(executable: &Utf8Path, arguments: &[OsString], root: &Utf8Path) -> Command {
    let mut command = Command::new(executable);
    if let Ok(current) = std::env::current_dir() {
        command.args(runs(root, &current));
    }
    command.args(arguments).current_dir(root);
    command
}

/// Where runs lie, for somebody in another folder than the robot's: the program tells their paths, which have to lead there.
fn runs(root: &Utf8Path, current: &Path) -> Vec<OsString> {
    match current == root {
        true => Vec::new(),
        false => vec!["--runs".into(), root.join(RUNS).into()],
    }
}

fn cannot_start(executable: &Utf8Path, error: &io::Error) -> Refusal {
    Refusal::bad(format!("cannot start `{executable}`: {error}"))
}

/// The program's options: those of `run` that are not hulkgen's own.
pub(super) fn arguments(run: &Run) -> Result<Vec<OsString>, Refusal> {
    let mut arguments = Vec::new();
    let folders = [
        ("--parameters", &run.parameters),
        ("--run-folder", &run.run_folder),
    ];
    for (name, folder) in folders {
        if let Some(folder) = folder {
            arguments.extend([name.into(), absolute(folder)?]);
        }
    }
    match (run.record_file(), &run.record) {
        (Some(file), _) => arguments.extend(["--record".into(), absolute(file)?]),
        (None, Some(switch)) => arguments.extend(["--record".into(), switch.as_str().into()]),
        (None, None) => {}
    }
    let mut add = |name: &str, value: &str| arguments.extend([name.into(), value.into()]);
    if let Some(duration) = run.duration {
        add("--for", &format!("{}s", duration.get().as_secs_f64()));
    }
    if let Some(location) = &run.location {
        add("--location", location);
    }
    if let Some(budget) = &run.recording_budget {
        add("--recording-budget", &budget.to_string());
    }
    for output in &run.record_output {
        add("--record-output", output);
    }
    for assignment in &run.set {
        add("--set", assignment);
    }
    match run.format {
        Some(TextOrJson::Json) => add("--format", "json"),
        Some(TextOrJson::Text) => add("--format", "text"),
        None => {}
    }
    if run.headless {
        arguments.push("--headless".into());
    }
    if !run.options.is_empty() {
        arguments.push("--".into());
        arguments.extend(run.options.iter().cloned());
    }
    Ok(arguments)
}

/// The folder seen from anywhere: it was written for the current folder, the program runs in another.
pub(in crate::commands) fn absolute(folder: &Utf8Path) -> Result<OsString, Refusal> {
    std::path::absolute(folder)
        .map(PathBuf::into_os_string)
        .map_err(|error| Refusal::bad(format!("cannot use the folder `{folder}`: {error}")))
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::{arguments, runs};
    use crate::arguments::{Arguments, Command};

    fn passed_on(line: &str) -> String {
        let parsed = Arguments::try_parse_from(line.split(' ')).expect("it is right usage");
        let Command::Run(run) = parsed.command else {
            panic!("`{line}` is no run")
        };
        let arguments = arguments(&run).expect("the current folder is known");
        let words: Vec<_> = arguments
            .iter()
            .map(|argument| argument.to_string_lossy())
            .collect();
        words.join(" ")
    }

    #[test]
    fn options_of_the_robot_are_passed_on_and_those_of_cargo_are_not() {
        assert_eq!(
            passed_on(
                "hulkgen run simulated --for 1500ms --headless --format json --location lab \
                 --set a.b=1 --set c=2 --profile dev --target-dir t -- --scene ball"
            ),
            "--for 1.5s --location lab --set a.b=1 --set c=2 --format json --headless -- --scene ball"
        );
    }

    #[test]
    fn folders_are_meant_from_where_the_command_was_given() {
        let folder = std::env::current_dir()
            .expect("tests run somewhere")
            .join("other");
        let folder = folder.display();
        assert_eq!(passed_on("hulkgen run"), "");
        assert_eq!(
            passed_on("hulkgen run --parameters other --run-folder /runs/1"),
            format!("--parameters {folder} --run-folder /runs/1")
        );
        assert_eq!(
            passed_on("hulkgen run --record other"),
            format!("--record {folder}")
        );
        assert_eq!(
            passed_on("hulkgen run --record off --recording-budget 1GiB"),
            "--record off --recording-budget 1GiB"
        );
    }

    #[test]
    fn sizes_are_those_of_the_manifest_and_checked_before_anything_is_built() {
        for (written, passed) in [
            ("2GB", "2GB"),
            ("1.5GiB", "1536MiB"),
            ("1TiB", "1TiB"),
            ("500MB", "500MB"),
        ] {
            assert_eq!(
                passed_on(&format!("hulkgen run --recording-budget {written}")),
                format!("--recording-budget {passed}")
            );
        }
        let line = ["hulkgen", "run", "--recording-budget", "2"];
        let error = Arguments::try_parse_from(line).expect_err("it has no unit");
        assert!(error.to_string().contains("from `B` to `TiB`"), "{error}");
    }

    #[test]
    fn paths_of_runs_lead_there_from_every_folder() {
        let root = "/robot".into();
        assert_eq!(runs(root, "/robot".as_ref()), [""; 0]);
        for elsewhere in ["/robot/nodes", "/"] {
            assert_eq!(runs(root, elsewhere.as_ref()), ["--runs", "/robot/runs"]);
        }
    }
}
