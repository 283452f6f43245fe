//! A robot of its own is recorded, and its recording answers: other parameters, one node, another revision, a test of a node.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde_json::Value;
use support::target_folder;

/// The node that is looked at.
const NODE: &str = "nodes/src/control/speed_choice.rs";

/// To cargo the packages of all new robots are the same, whichever folder they lie in: one at a time is compiled.
static TURN: Mutex<()> = Mutex::new(());

struct Recorded {
    folder: tempfile::TempDir,
    _turn: MutexGuard<'static, ()>,
}

impl Recorded {
    /// A new robot under git that ran for a second.
    fn new() -> Self {
        // Before its files are written: they have to be newer than what was compiled of another robot.
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let robot = Self {
            _turn: turn,
            folder: tempfile::tempdir().expect("there is room for a folder"),
        };
        let made = hulkgen_in(robot.folder.path(), &["new", "robot"]);
        assert!(made.status.success(), "{}", text(&made));
        for words in [
            "init --quiet",
            "add --all",
            "-c user.name=a -c user.email=a@b commit --quiet --message first",
        ] {
            let mut git = Command::new("git");
            let output = git
                .args(words.split(' '))
                .current_dir(robot.path())
                .output();
            let output = output.expect("git made this checkout");
            assert!(output.status.success(), "{}", text(&output));
        }
        robot.hulkgen(
            &["run", "--for", "1s", "--headless", "--record", "tape.mcap"],
            0,
        );
        robot
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("robot")
    }

    /// With what it compiles where everything of this repository is compiled; gives standard output and error.
    #[track_caller]
    fn hulkgen(&self, words: &[&str], status: i32) -> (String, String) {
        let target = target_folder();
        let target = target.parent().expect("target/<profile>");
        let mut command = Command::new(target_folder().join("hulkgen"));
        command
            .args(words)
            .args(["--profile", "dev", "--target-dir"])
            .arg(target)
            .current_dir(self.path())
            .env("XDG_CACHE_HOME", self.folder.path().join("cache"))
            .env("CARGO_NET_OFFLINE", "true");
        let output = command.output().expect("hulkgen can be started");
        assert_eq!(
            output.status.code(),
            Some(status),
            "{words:?}: {}",
            text(&output)
        );
        (
            String::from_utf8_lossy(&output.stdout).into_owned(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    }

    #[track_caller]
    fn replay(&self, words: &[&str]) -> Value {
        let all = ["replay", "tape.mcap", "--format", "json"];
        let all: Vec<_> = all.iter().chain(words).copied().collect();
        let (said, _) = self.hulkgen(&all, 0);
        serde_json::from_str(&said).expect("it is JSON")
    }

    fn edit(&self, from: &str, to: &str) {
        let path = self.path().join(NODE);
        let before = fs::read_to_string(&path).expect("the node is there");
        assert_eq!(before.matches(from).count(), 1, "`{from}`");
        fs::write(path, before.replace(from, to)).expect("the folder is ours");
    }

    /// What cargo says of one test file of the node's crate.
    fn test(&self, name: &str) -> Output {
        let target = target_folder();
        let mut cargo = Command::new(env!("CARGO"));
        cargo
            .args(["test", "--offline", "--package", "nodes", "--test", name])
            .current_dir(self.path())
            .env(
                "CARGO_TARGET_DIR",
                target.parent().expect("target/<profile>"),
            );
        cargo.output().expect("cargo can be started")
    }
}

fn hulkgen_in(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(target_folder().join("hulkgen"));
    let output = command.args(words).current_dir(folder).output();
    output.expect("`cargo test --workspace` builds it")
}

fn text(output: &Output) -> String {
    format!(
        "{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    )
}

/// Node, output and instance of every change.
fn changes(answer: &Value) -> Vec<[&str; 3]> {
    let changes = answer["changes"].as_array().expect("a list").iter();
    let all = changes.map(|change| {
        ["node", "output", "instance"].map(|key| change[key].as_str().unwrap_or_default())
    });
    all.collect()
}

#[test]
fn a_recording_says_what_would_have_been() {
    let robot = Recorded::new();
    let verified = robot.replay(&["--verify"]);
    assert_eq!(verified["good"], true, "{verified}");

    let one = robot.replay(&["--node", "speed_choice"]);
    let instances = one["instances"].as_array().expect("a list");
    assert_eq!(instances.len(), 1, "{one}");
    assert_eq!(instances[0]["outputs"], instances[0]["verified"], "{one}");
    assert_eq!(
        one["recomputed"],
        serde_json::json!([{ "instance": "Control", "nodes": ["nodes::control::speed_choice"] }])
    );
    let (_, said) = robot.hulkgen(&["replay", "tape.mcap", "--node", "sped_choice"], 1);
    assert!(said.contains("did you mean `speed_choice`?"), "{said}");

    let expected = [["nodes::control::speed_choice", "wheel_speed", "Control"]];
    let other = robot.replay(&["--set", "speed_choice.cruising=0.123"]);
    assert_eq!(changes(&other), expected, "{other}");
    let first = &other["changes"][0]["first"];
    assert_ne!(first["before"], first["after"], "{other}");
    assert!(
        other["notes"]
            .to_string()
            .contains("states that were recorded"),
        "{other}"
    );
    let wrong = ["replay", "tape.mcap", "--set", "speed_choice.cruisin=1"];
    let (_, said) = robot.hulkgen(&wrong, 1);
    assert!(said.contains("cruising"), "{said}");

    let same = robot.replay(&["--against", "HEAD"]);
    assert_eq!(changes(&same), [[""; 3]; 0], "{same}");
    robot.edit(
        "0.0 } else { *context.cruising }",
        "0.0 } else { *context.cruising + 0.5 }",
    );
    let revision = robot.replay(&["--against", "HEAD"]);
    assert_eq!(changes(&revision), expected, "{revision}");
    assert_eq!(
        (&revision["before"], &revision["after"]),
        (&"HEAD".into(), &"this build".into())
    );
    let first = &revision["changes"][0]["first"];
    let speed = |value: &Value| value.as_f64().expect("a speed");
    let faster = speed(&first["after"]) - speed(&first["before"]);
    assert!((faster - 0.5).abs() < 1e-6, "{revision}");
    let unknown = ["replay", "tape.mcap", "--against", "nowhere"];
    let (_, said) = robot.hulkgen(&unknown, 2);
    assert!(said.contains("name a commit, branch or tag"), "{said}");
}

#[test]
fn a_captured_cycle_is_a_test_that_fails_when_the_node_changes() {
    let robot = Recorded::new();
    let verified = robot.replay(&["--node", "speed_choice"]);
    let frames = verified["instances"][0]["frames"]
        .as_u64()
        .expect("a count");
    // Late enough that something was seen.
    let cycle = (frames * 3 / 4).to_string();
    let capture = |node: &str, at: &str, status| {
        let words = ["capture", "tape.mcap", "--at", at, "--node", node];
        robot.hulkgen(&words, status).1
    };
    capture("speed_choice", &cycle, 0);
    let name = format!("speed_choice_control_{cycle}");
    let tests = robot.path().join("nodes/tests");
    let data = fs::read_to_string(tests.join(format!("captured/{name}.json")));
    let data: Value = serde_json::from_str(&data.expect("it was written")).expect("JSON");
    assert!(data["fields"]["cruising"].is_number(), "{data}");
    assert!(
        data["outputs"]["wheel_speed"]["value"].is_number(),
        "{data}"
    );

    let tested = robot.test(&name);
    assert!(tested.status.success(), "{}", text(&tested));
    assert!(text(&tested).contains("1 passed"), "{}", text(&tested));
    robot.edit(
        "wheel_speed: Some(wheel_speed)",
        "wheel_speed: Some(wheel_speed + 0.001)",
    );
    let tested = robot.test(&name);
    assert!(!tested.status.success());
    let said = text(&tested);
    assert!(
        said.contains("`wheel_speed` is not what was recorded"),
        "{said}"
    );

    let said = capture("speed_choice", "1000000", 1);
    assert!(
        said.contains("is not in the recording, which has cycles 1 to"),
        "{said}"
    );
    let said = capture("wheel_sender", &cycle, 1);
    assert!(said.contains("it uses the hardware"), "{said}");
    let said = capture("odometry_receiver", &cycle, 1);
    assert!(said.contains("a setup node"), "{said}");
    let said = capture("speed_choise", &cycle, 2);
    assert!(said.contains("did you mean"), "{said}");
}
