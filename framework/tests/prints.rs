//! What code of a robot prints stays out of what its program answers. Both are of a whole process, hence a `main` of its own.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use framework::launch::{self, Target};
use framework::recorded::Types;
use framework::replay::Replayable;
use framework::testing;
use framework::{Error, Hardware, HardwareContext, Reflect, Result, Robot, Start};
use hulkgen_recording::{Channel, Description, Recorder, Settings};
use serde::{Deserialize, Serialize};

const CHATTER: &str = "printed by a node";

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
        Ok(Self)
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

fn main() -> std::process::ExitCode {
    // A process that the one below starts.
    if std::env::args().any(|argument| argument == "--replay") {
        let create = |_: &Arc<NoHardware>, _: Start<Parameters>| -> Result<Robot<Parameters>> {
            Err(Error::new("a replay has no robot"))
        };
        return launch::main(TARGET, create, launch::nobody);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    record(&path);
    let this = std::env::current_exe().expect("this test is a program");
    for words in [&["--verify", "--format", "json"][..], &["--answer"]] {
        let output = Command::new(&this)
            .arg("--replay")
            .arg(&path)
            .args(words)
            .output()
            .expect("this test can be started");
        let [answers, errors] =
            [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
        assert!(errors.contains(CHATTER), "{words:?}: {errors}");
        assert!(!answers.contains(CHATTER), "{words:?}: {answers}");
        for answer in answers.lines() {
            let json: serde_json::Result<serde_json::Value> = serde_json::from_str(answer);
            assert!(json.is_ok(), "{words:?}: {answer}");
        }
        let is_answered = answers.lines().count() == usize::from(words.len() > 1);
        assert!(is_answered, "{words:?}: {answers} {errors}");
    }
    std::process::ExitCode::SUCCESS
}
