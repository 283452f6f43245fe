//! What hulkgen answers, as its users call it: the built binary in this repository and in robots of its own.

mod diff;
mod doctor;
mod editor;
mod explain;
mod pages;
mod partial;
mod robot;
mod schema;
mod show;
mod watch;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use support::root;

/// The binary beside this test: `cargo test --workspace` builds it.
fn binary() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a path");
    let folder = test.parent().and_then(Path::parent);
    let folder = folder.expect("target/<profile>/deps/<test>");
    folder.join(format!("hulkgen{}", std::env::consts::EXE_SUFFIX))
}

/// hulkgen with these words in a folder.
fn hulkgen(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(binary());
    command
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env_remove("CARGO")
        .stdin(Stdio::null());
    command
}

/// How a command ended and what it said.
#[derive(Debug)]
struct Ended {
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Ended {
    fn of(command: &mut Command) -> Self {
        let output = command.output();
        let Output {
            status,
            stdout,
            stderr,
        } = output.unwrap_or_else(|error| panic!("{command:?}: {error}"));
        let text = |bytes| String::from_utf8(bytes).expect("it prints UTF-8");
        Self {
            status: status.code(),
            stdout: text(stdout),
            stderr: text(stderr),
        }
    }

    /// Shows everything if the status is another.
    #[track_caller]
    fn expect(self, status: i32) -> Self {
        assert_eq!(self.status, Some(status), "{self:#?}");
        self
    }
}

/// What hulkgen prints in this repository, after ending with 0.
#[track_caller]
fn answer(arguments: &str) -> String {
    Ended::of(&mut hulkgen(&root(), arguments)).expect(0).stdout
}

#[track_caller]
fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in:\n{text}"))
}

/// Every command that the help lists.
fn commands() -> Vec<String> {
    let help = answer("--help");
    let listed = help.split("\nCommands:\n").nth(1).unwrap_or_default();
    let listed = listed.split("\n\n").next().unwrap_or_default();
    let names = listed
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    let names: Vec<String> = names
        .filter(|name| *name != "help")
        .map(str::to_owned)
        .collect();
    assert!(names.len() > 15, "{help}");
    names
}
