//! A robot of its own is recorded, and its recording answers: other parameters, one node, another revision, a test of a node.

use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde_json::Value;
use support::{compile_unoptimised, target_folder};

/// A busy machine may take so long for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// A node whose test has to bring a state that is made whole, hardware, the past and a call.
const EVERYTHING: &str = r#"//! Sums up what was wished for, and says it twice.

use std::sync::Arc;

use framework::{
    CyclerState, HardwareInterface, HistoricInput, MainOutput, Parameter, Procedure, Result, context,
};
use serde::{Deserialize, Serialize};

use crate::interfaces::Wheels;

#[derive(Debug, Deserialize, Serialize)]
pub struct Everything {
    sum: f32,
    #[serde(skip)]
    factors: Arc<[f32]>,
}

#[context]
pub struct CreationContext {
    factor: Parameter<f32, "speed_choice.cruising">,
    node: CyclerState<f32, "everything.called">,
}

#[context]
pub struct CycleContext {
    hardware_interface: HardwareInterface,
    past: HistoricInput<Option<f32>, "wheel_speed?">,
    node: CyclerState<f32, "everything.called">,
    set: Procedure<f32, f32, "set">,
}

#[context]
pub struct MainOutputs {
    newest: MainOutput<f32>,
}

impl Everything {
    pub fn new(context: CreationContext) -> Result<Self> {
        Ok(Self { sum: *context.node, factors: Arc::new([*context.factor]) })
    }

    pub fn restore(&mut self, context: CreationContext) -> Result<()> {
        self.factors = Arc::new([*context.factor]);
        Ok(())
    }

    pub fn cycle(&mut self, context: CycleContext<impl Wheels>) -> Result<MainOutputs> {
        let past: f32 = context.past.iter().filter_map(|(_, speed)| speed.copied()).sum();
        self.sum += past * self.factors[0];
        if let Some(call) = context.set {
            self.sum = *call.request();
            *context.node += 1.0;
            call.answer(*context.node);
        }
        context.hardware_interface.write_speed(self.sum * 0.0)?;
        Ok(MainOutputs { newest: (past + *context.node).into() })
    }
}
"#;

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
        compile_unoptimised(&robot.path());
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

    /// Runs the program that was built, until a client has called `procedure`; gives the cycle that took the call.
    fn record_call(&self, file: &str, procedure: &str, request: &str) -> u64 {
        let free = TcpListener::bind("127.0.0.1:0").and_then(|listener| listener.local_addr());
        let address = free.expect("this machine has a free port").to_string();
        let program = Command::new(target_folder().join("simulation"))
            .args(["--headless", "--record", file, "--listen", &address])
            .current_dir(self.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        let mut program = Program(program.expect("it was built"));
        let path = format!("Control.procedures.{procedure}");
        let call = ["call", "--host", &address, &path, request];
        let begin = Instant::now();
        while !hulkgen_in(&self.path(), &call).status.success() {
            assert!(begin.elapsed() < PATIENCE, "nobody answers `{path}`");
            std::thread::sleep(Duration::from_millis(100));
        }
        let asked = Command::new("kill")
            .args(["-INT", &program.0.id().to_string()])
            .status();
        assert!(asked.expect("every Unix has it").success());
        let ended = program.0.wait().expect("it is our child");
        // As shells have it for SIGINT.
        assert_eq!(ended.code(), Some(130), "{ended}");
        let path = format!("Control.frame.{procedure}");
        let calls = hulkgen_in(&self.path(), &["recording", "cat", file, &path]);
        let calls = String::from_utf8_lossy(&calls.stdout).into_owned();
        let calls = calls
            .lines()
            .map(|line| -> Value { serde_json::from_str(line).expect("an object a line") });
        let mut calls = calls.filter(|call| !call["value"].is_null());
        let call = calls.next().expect("it was recorded");
        call["cycle"].as_u64().expect("a number")
    }

    #[track_caller]
    fn replay(&self, words: &[&str]) -> Value {
        let all = ["replay", "tape.mcap", "--format", "json"];
        let all: Vec<_> = all.iter().chain(words).copied().collect();
        let (said, _) = self.hulkgen(&all, 0);
        serde_json::from_str(&said).expect("it is JSON")
    }

    fn edit(&self, from: &str, to: &str) {
        self.edit_in(NODE, from, to);
    }

    fn edit_in(&self, file: &str, from: &str, to: &str) {
        let path = self.path().join(file);
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

/// Ends with the test, also where that fails.
struct Program(Child);

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
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
    capture("wheel_sender", &cycle, 0);
    let name = format!("wheel_sender_control_{cycle}");
    let tested = robot.test(&name);
    assert!(tested.status.success(), "{}", text(&tested));
    let sender = "nodes/src/control/wheel_sender.rs";
    robot.edit_in(
        sender,
        ".write_speed(*context.wheel_speed)?",
        ".write_speed(*context.wheel_speed * 1.01)?",
    );
    let said = text(&robot.test(&name));
    assert!(
        said.contains("command 0 to the hardware is not what was recorded"),
        "{said}"
    );
    let said = capture("odometry_receiver", &cycle, 1);
    assert!(said.contains("a setup node"), "{said}");
    let said = capture("speed_choise", &cycle, 2);
    assert!(said.contains("did you mean"), "{said}");
}

#[test]
fn a_test_brings_hardware_the_past_a_call_and_a_state_that_is_made_whole() {
    let robot = Recorded::new();
    let node = [
        "add-node",
        "nodes::control::everything",
        "--cycler",
        "Control",
    ];
    let added = hulkgen_in(&robot.path(), &node);
    assert!(added.status.success(), "{}", text(&added));
    let file = "nodes/src/control/everything.rs";
    fs::write(robot.path().join(file), EVERYTHING).expect("the folder is ours");
    robot.hulkgen(
        &["run", "--for", "100ms", "--headless", "--record", "off"],
        0,
    );
    let cycle = robot.record_call("call.mcap", "set", "0.25").to_string();
    let words = [
        "capture",
        "call.mcap",
        "--at",
        &cycle,
        "--node",
        "everything",
    ];
    robot.hulkgen(&words, 0);
    let name = format!("everything_control_{cycle}");
    let tested = robot.test(&name);
    assert!(tested.status.success(), "{}", text(&tested));
    assert!(text(&tested).contains("1 passed"), "{}", text(&tested));
    for (right, wrong, message) in [
        (
            "self.sum = *call.request()",
            "self.sum += *call.request()",
            "the state of the node",
        ),
        (
            "call.answer(*context.node)",
            "call.answer(self.sum)",
            "the answer of `set` is not what was recorded",
        ),
        (
            "(past + *context.node)",
            "(past - *context.node)",
            "`newest` is not what",
        ),
        (
            "write_speed(self.sum * 0.0)",
            "write_speed(self.sum)",
            "command 0 to the hardware",
        ),
        (
            "context.past.iter()",
            "context.past.iter().filter(|_| false)",
            "`newest` is not what",
        ),
        (
            "self.factors = Arc::new([*context.factor]);",
            "",
            "index out of bounds",
        ),
    ] {
        robot.edit_in(file, right, wrong);
        let tested = robot.test(&name);
        assert!(!tested.status.success(), "{wrong}");
        assert!(
            text(&tested).contains(message),
            "{wrong}: {}",
            text(&tested)
        );
        match wrong {
            "" => {}
            wrong => robot.edit_in(file, wrong, right),
        }
    }
}

/// What a robot's program says that shows the recording for a moment, and its exit status.
fn shown(robot: &Recorded) -> (String, Option<i32>) {
    let words = [
        "--replay",
        "tape.mcap",
        "--for=10ms",
        "--listen=127.0.0.1:0",
    ];
    let mut program = Command::new(target_folder().join("simulation"));
    let output = program.args(words).current_dir(robot.path()).output();
    let output = output.expect("it was built");
    (text(&output), output.status.code())
}

#[test]
fn of_another_graph_what_fits_is_replayed_and_what_does_not_is_listed() {
    let robot = Recorded::new();
    let add = |node: &str, file: &str, text: &str| {
        let added = hulkgen_in(&robot.path(), &["add-node", node, "--cycler", "Control"]);
        assert!(added.status.success(), "{}", self::text(&added));
        fs::write(robot.path().join(file), text).expect("the folder is ours");
    };
    let verified = |status| -> Value {
        let words = ["replay", "tape.mcap", "--verify", "--format", "json"];
        let (said, _) = robot.hulkgen(&words, status);
        serde_json::from_str(&said).expect("it is JSON")
    };
    add(
        "nodes::control::everything",
        "nodes/src/control/everything.rs",
        EVERYTHING,
    );
    let other = verified(1);
    assert!(other["graph"].is_object(), "{other}");
    let [perception, control] = other["instances"].as_array().expect("a list").as_slice() else {
        panic!("{other}");
    };
    assert_eq!(perception["good"], true, "{other}");
    assert_eq!(perception["verified"], perception["frames"], "{other}");
    let reason = control["unreadable"].as_str().expect("it does not fit");
    assert!(reason.contains("`nodes::control::everything`"), "{reason}");
    let (said, status) = shown(&robot);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.contains("`Control` is not shown: "), "{said}");
    assert!(said.contains("`nodes::control::everything`"), "{said}");
    assert!(said.contains("page: http"), "{said}");
    assert!(!said.contains("`Perception` is not shown"), "{said}");

    // A further parameter: whoever reads parameters cannot read those that were recorded.
    robot.edit_in(
        "parameters/default.toml",
        "cruising = 1.0",
        "braking = 0.5\ncruising = 1.0",
    );
    robot.edit(
        "    cruising: Parameter",
        "    _braking: Parameter<f32, \"speed_choice.braking\">,\n    cruising: Parameter",
    );
    robot.edit(
        "            cruising: &1.0",
        "            _braking: &1.0,\n            cruising: &1.0",
    );
    let other = verified(1);
    let (said, status) = shown(&robot);
    assert_eq!(status, Some(1), "{said}");
    for (place, name) in ["Perception", "Control"].into_iter().enumerate() {
        let unreadable = other["instances"][place]["unreadable"].as_str();
        assert!(
            unreadable.is_some_and(|why| why.contains("of other types")),
            "{other}"
        );
        assert!(said.contains(&format!("`{name}` is not shown: ")), "{said}");
    }
    assert!(said.contains("the field `braking`"), "{said}");
}
