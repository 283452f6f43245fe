//! `docs/clients/recording.py`, with the package `mcap` alone: it decodes every message, and prints what `hulkgen recording
//! cat` does.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::process::Command;

use camino::Utf8Path;
use framework::Record;
use framework::recorded::About;
use hulkgen::recording::{Selection, Span, cat, open};
use serde_json::Value;
use support::{root, skip};

use super::{BUSY, Tape, large};

/// What everything lies below; frames, values, what was said.
const ALL: [&str; 7] = [
    "VisionTop",
    "VisionBottom",
    "Audio",
    "SplNetwork",
    "Control",
    "parameters",
    "logs",
];

/// The lines that the program prints; `None` where it cannot run.
fn lines(arguments: &[&str]) -> Option<Vec<Value>> {
    let mut python = Command::new("python3");
    python.arg(root().join("docs/clients/recording.py"));
    let output = match python.args(arguments).output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return None,
        output => output.expect("Python can be started"),
    };
    let error = String::from_utf8_lossy(&output.stderr);
    if error.contains("No module named") {
        return None;
    }
    assert!(output.status.success(), "{error}");
    let text = String::from_utf8(output.stdout).expect("it prints JSON");
    let lines = text.lines().map(serde_json::from_str);
    Some(lines.collect::<Result<_, _>>().expect("it prints JSON"))
}

/// What `recording cat` prints, and the paths of which there is nothing.
fn printed(path: &Utf8Path, selection: &Selection) -> (Vec<Value>, Vec<String>) {
    let mut printed = Vec::new();
    let shown = cat(&open(path).expect("it is there"), selection, &mut |found| {
        printed.push(found.to_json());
        Ok(true)
    });
    let silent = shown.and_then(|shown| shown.complete(None));
    (printed, silent.expect("all of it can be read"))
}

#[test]
fn python_decodes_every_message_and_prints_what_cat_prints() {
    const NAME: &str = "python_decodes_every_message_and_prints_what_cat_prints";
    let about = About {
        // Printed from its own channel, not from frames.
        outputs: vec!["Control.main_outputs.sensor_data".to_owned()],
        ..About::default()
    };
    let tape = Tape::record_with(1, about, large(), |_| Record::On);
    assert!(tape.report.ended.is_complete, "{}", tape.report);
    let path = Utf8Path::from_path(&tape.path).expect("the path is UTF-8");
    let Some(channels) = lines(&["list", path.as_str()]) else {
        return skip(NAME, "pip install mcap");
    };
    let file = tape.open();
    let mut messages = BTreeMap::<u16, u64>::new();
    for message in file.chunks.iter().flat_map(|chunk| chunk.messages()) {
        *messages.entry(message.channel).or_default() += 1;
    }
    assert_eq!(channels.len(), file.channels.len());
    for ((number, channel), told) in file.channels.iter().zip(&channels) {
        assert_eq!(told["topic"], *channel.topic);
        let count = messages.get(number).copied().unwrap_or_default();
        assert_eq!(told["messages"], count, "{told}");
    }

    let selection = Selection {
        paths: ALL.map(str::to_owned).to_vec(),
        span: Span {
            cycles: Some(5..7),
            times: None,
        },
    };
    let (printed, _) = printed(path, &selection);
    let arguments = [&["cat", path.as_str()], &ALL[..], &["--cycles", "5..7"]].concat();
    let read = lines(&arguments).expect("it ran a moment ago");
    let is_digest = |one: &&Value| {
        one["path"]
            .as_str()
            .is_some_and(|path| path.contains(".digests."))
    };
    let (digests, read): (Vec<&Value>, Vec<&Value>) = read.iter().partition(is_digest);
    for (read, printed) in read.iter().zip(&printed) {
        assert_eq!(*read, printed);
    }
    assert_eq!(read.len(), printed.len());
    // What nothing but frames has, and what nothing but values has.
    for instance in BUSY {
        for below in ["states.", "main_outputs."] {
            let path = format!("{instance}.{below}");
            let is_there = |one: &Value| {
                one["path"]
                    .as_str()
                    .is_some_and(|one| one.starts_with(&path))
            };
            assert!(printed.iter().any(is_there), "{path}");
        }
        let path = format!("{instance}.digests.");
        let own = digests.iter().filter(|one| {
            one["path"]
                .as_str()
                .is_some_and(|one| one.starts_with(&path))
        });
        assert!(own.count() >= 2, "{path}");
    }
}

#[test]
fn python_and_cat_read_the_parameters_to_their_end() {
    const NAME: &str = "python_and_cat_read_the_parameters_to_their_end";
    let tape = Tape::record(1, large(), |one| match one.name {
        "Control" => Record::On,
        _ => Record::Off,
    });
    let path = Utf8Path::from_path(&tape.path).expect("the path is UTF-8");
    // Its first part is a movement, whose type refuses all that has no pictures; the last one stands behind everything.
    let paths = ["parameters.motions", "parameters.whistle_filter"];
    let selection = Selection {
        paths: paths.map(str::to_owned).to_vec(),
        span: Span::default(),
    };
    let (printed, silent) = printed(path, &selection);
    assert_eq!(silent, Vec::<String>::new());
    assert_eq!(printed.len(), paths.len());
    let frames = printed[0]["value"]["stand_up_front"]["frames"].as_array();
    assert!(
        frames.is_some_and(|frames| !frames.is_empty()),
        "{}",
        printed[0]
    );
    let arguments = [&["cat", path.as_str()], &paths[..]].concat();
    let Some(read) = lines(&arguments) else {
        return skip(NAME, "pip install mcap");
    };
    assert_eq!(read, printed);
}
