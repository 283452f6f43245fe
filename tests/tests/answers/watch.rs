//! `--watch`: a new answer whenever a file is saved.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use serde_json::Value;

use crate::json;
use crate::robot::Robot;

/// Longer than any answer takes on a busy machine.
const LONG: Duration = Duration::from_secs(120);

/// A command that does not end by itself.
struct Watching {
    child: Child,
    answers: Receiver<String>,
}

impl Watching {
    /// Each line of stdout is an answer.
    fn start(robot: &Robot, arguments: &str) -> Self {
        let mut child = robot
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("hulkgen was built");
        let stdout = child.stdout.take().expect("it was asked for above");
        let (said, answers) = channel();
        thread::spawn(move || {
            // Ends when hulkgen does, or when nobody listens any more.
            let lines = BufReader::new(stdout).lines().map_while(Result::ok);
            lines.for_each(|line| said.send(line).unwrap_or_default());
        });
        Self { child, answers }
    }

    #[track_caller]
    fn next(&self) -> Value {
        json(&self.answers.recv_timeout(LONG).expect("an answer comes"))
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        // It may have ended already; there is nobody to tell.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

const NODE: &str = "nodes/src/detector.rs";
const INPUT: &str = "Input<u8, \"brightness\">";

#[test]
fn check_answers_again_after_every_change() {
    let robot = Robot::new("perception_and_real_time");
    let watching = Watching::start(&robot, "check --watch --format json");
    let clean = serde_json::json!({ "version": 1, "diagnostics": [] });
    assert_eq!(watching.next(), clean);

    robot.edit(NODE, INPUT, "Input<u8, \"brightnes\">");
    let answer = watching.next();
    let error = &answer["diagnostics"][0];
    assert_eq!(error["code"], "unknown-output", "{answer:#}");
    assert_eq!(error["spans"][0]["file"], NODE);
    assert_eq!(error["help"], "did you mean `brightness`?");

    robot.edit(NODE, "Input<u8, \"brightnes\">", INPUT);
    assert_eq!(watching.next(), clean);

    // A file that is read for the first time, and one that is no longer there.
    robot.write("parameters/default.toml", "speed = 1\n");
    assert_eq!(
        watching.next()["diagnostics"][0]["code"],
        "unknown-parameter"
    );
    std::fs::remove_file(robot.path(NODE)).expect("it was there");
    let answer = watching.next();
    let codes = answer["diagnostics"].as_array().expect("a list").iter();
    assert!(
        codes.clone().any(|one| one["code"] == "unknown-node"),
        "{answer:#}"
    );
}

#[test]
fn generate_writes_again_and_is_not_woken_by_what_it_writes() {
    let robot = Robot::new("perception_and_real_time");
    let watching = Watching::start(&robot, "generate --watch --format json");
    let first = watching.next();
    let added = first["added"].as_array().expect("a list");
    assert!(added.contains(&"generated/src/lib.rs".into()), "{first}");

    robot.edit(
        NODE,
        "    seen: MainOutput",
        "    dim: MainOutput<bool>,\n    seen: MainOutput",
    );
    let second = watching.next();
    let changed = second["changed"].as_array().expect("a list");
    assert!(
        changed.contains(&"generated/src/cyclers/vision.rs".into()),
        "{second}"
    );
    assert!(robot.read("generated/DATAFLOW.md").contains("`dim`"));

    // Had the files that were written woken it, the next answer would say that nothing changed.
    robot.edit(NODE, "    dim: MainOutput<bool>,\n", "");
    assert_eq!(watching.next()["changed"], second["changed"]);
    assert!(!robot.read("generated/DATAFLOW.md").contains("`dim`"));
}

#[test]
fn parameters_behind_a_link_to_a_folder_are_watched() {
    let robot = Robot::new("perception_and_real_time");
    let shared = tempfile::tempdir().expect("a temporary folder");
    let file = shared.path().join("default.toml");
    std::fs::write(&file, "").expect("the folder is ours");
    std::fs::remove_dir_all(robot.path("parameters")).expect("it is there");
    std::os::unix::fs::symlink(shared.path(), robot.path("parameters")).expect("it is ours");
    let watching = Watching::start(&robot, "check --watch --format json");
    let clean = serde_json::json!({ "version": 1, "diagnostics": [] });
    assert_eq!(watching.next(), clean);
    for (text, code) in [
        ("speed = 1\n", "unknown-parameter"),
        ("speed = \n", "syntax"),
    ] {
        std::fs::write(&file, text).expect("the folder is ours");
        let answer = watching.next();
        assert_eq!(answer["diagnostics"][0]["code"], code, "{answer:#}");
    }
    std::fs::write(&file, "# none\n").expect("the folder is ours");
    assert_eq!(watching.next(), clean);
}
