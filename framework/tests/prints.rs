//! What code of a robot prints stays out of what its program answers. Both are of a whole process, hence a `main` of its own.

use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use framework::launch::{self, Target};
use framework::recorded::Types;
use framework::replay::Replayable;
use framework::testing;
use framework::tool::Bench;
use framework::{
    Error, Hardware, HardwareContext, LiveParameters, Reflect, Result, Robot, Start, buffer_of,
};
use hulkgen_recording::{Channel, Description, Recorder, Settings};
use serde::{Deserialize, Serialize};

const CHATTER: &str = "printed by a node";

const SCENARIO: &str =
    "ends = 0.001\n[[assertion]]\nwhat = \"it stands\"\nvalue = \"truth.height\"\nequals = 1\n";

const TARGET: Target = Target {
    replayables: &[Replayable {
        instance: "Legs",
        create: |_, _| Err(Error::new("there are no frames")),
        types: || {
            println!("{CHATTER}");
            Types::default()
        },
    }],
    ..testing::TARGET
};

#[derive(Clone, Debug, Deserialize, Reflect, Serialize)]
struct Parameters {}

struct NoHardware;

impl Hardware for NoHardware {
    fn new(_: HardwareContext) -> Result<Self> {
        println!("{CHATTER}");
        Ok(Self)
    }

    fn check_parameters(_: &HardwareContext) -> Result<()> {
        println!("{CHATTER}");
        Ok(())
    }

    fn truth(&self) -> serde_json::Value {
        serde_json::json!({ "height": 1 })
    }

    fn tools() -> &'static [&'static str] {
        &["measure"]
    }

    fn tool(
        _: &str,
        _: HardwareContext,
        _: &mut dyn Bench<Self>,
        output: &mut dyn Write,
    ) -> Result<()> {
        println!("{CHATTER}");
        Ok(writeln!(output, "1")?)
    }

    fn stop(&self) {}

    fn enter_safe_state(&self) {}
}

fn record(path: &Path) {
    let described = [("version", "2"), ("types", "of another build")];
    let described = described.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let channel = Channel {
        topic: "frames/Legs".to_owned(),
        schema: None,
        encoding: "hulkgen-frames".to_owned(),
        metadata: described.into(),
        once_per_chunk: false,
    };
    let description = Description {
        channels: vec![channel],
        ..Description::default()
    };
    let started = Recorder::start(path, description, &["Legs"], Settings::default());
    let (recorder, tracks) = started.expect("it is new");
    drop(tracks);
    assert!(recorder.end().is_complete);
}

/// A robot without nodes.
fn create(_: &Arc<NoHardware>, start: Start<Parameters>) -> Result<Robot<Parameters>> {
    println!("{CHATTER}");
    let (parameters, [], []) = buffer_of(|| start.parameters.clone(), []);
    Ok(Robot {
        name: "test",
        clock: start.clock.clone(),
        instances: vec![],
        access: vec![],
        left_out: &[],
        remotes: Vec::new(),
        parameters: LiveParameters::new(parameters, start.parameters, start.clock),
    })
}

fn main() -> std::process::ExitCode {
    // A process that the one below starts.
    if std::env::args().any(|argument| argument == "--parameters") {
        return launch::main(TARGET, create, launch::nobody);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path);
    std::fs::write(folder.path().join("default.toml"), "").expect("the folder is ours");
    let scenario = folder.path().join("scenario.toml");
    std::fs::write(&scenario, SCENARIO).expect("the folder is ours");
    let path = path.to_str().expect("it is UTF-8");
    let scenario = scenario.to_str().expect("it is UTF-8");
    // Each with the lines of its answer.
    for (words, lines) in [
        (&["--replay", path, "--verify", "--format", "json"][..], 1),
        (&["--replay", path, "--answer"], 0),
        (&["--for", "1ms", "--format", "json"], 1),
        (&["--check-parameters", "--format", "json"], 1),
        (&["--scenario", scenario, "--format", "json"], 1),
        (&["--tool", "measure"], 1),
    ] {
        let [answers, errors] = said(folder.path(), words);
        assert!(errors.contains(CHATTER), "{words:?}: {errors}");
        assert!(!answers.contains(CHATTER), "{words:?}: {answers}");
        for answer in answers.lines() {
            let json: serde_json::Result<serde_json::Value> = serde_json::from_str(answer);
            assert!(json.is_ok(), "{words:?}: {answer}");
        }
        assert_eq!(
            answers.lines().count(),
            lines,
            "{words:?}: {answers} {errors}"
        );
    }
    // A scenario answers people there, too; a run tells them nothing there, and its nodes may.
    let [answers, errors] = said(folder.path(), &["--scenario", scenario]);
    assert!(
        errors.contains(CHATTER) && !answers.contains(CHATTER),
        "{answers} {errors}"
    );
    let [answers, errors] = said(folder.path(), &["--for", "1ms"]);
    assert!(
        answers.contains(CHATTER) && !errors.contains(CHATTER),
        "{answers} {errors}"
    );
    std::process::ExitCode::SUCCESS
}

/// What the robot's program writes to standard output and to standard error.
fn said(parameters: &Path, words: &[&str]) -> [String; 2] {
    let this = std::env::current_exe().expect("this test is a program");
    let output = Command::new(&this)
        .arg("--parameters")
        .arg(parameters)
        .args(words)
        .current_dir(parameters)
        .output()
        .expect("this test can be started");
    [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned())
}
