//! Outputs in channels of their own, read by others.

use std::io::ErrorKind;
use std::process::Command;

use framework::recorded::{About, Recording, Settings};
use framework::{Clock, Lockstep, Timestamp};
use serde_json::Value;

use crate::{Tape, Zoo, assert_good};

/// Records a second with these outputs.
fn record(outputs: &[&str]) -> framework::Result<Tape> {
    let tape = Tape::new();
    let mut zoo = Zoo::new(Clock::stepped());
    let about = About {
        outputs: outputs.iter().map(|output| (*output).to_owned()).collect(),
        ..About::default()
    };
    let mut recording = Recording::start(&tape.path, &zoo.robot, about, Settings::default())?;
    let hardware = zoo.hardware.clone();
    let mut lockstep =
        Lockstep::new(&mut zoo.robot, &*hardware).observed(|instance| recording.observer(instance));
    lockstep
        .run_until(Timestamp::from_nanos(1_000_000_000), |_| {})
        .expect("the zoo goes on");
    drop(lockstep);
    framework::logs::tell_warning("zoo::test", &SAID);
    let report = recording.end();
    assert!(report.ended.is_complete, "{report}");
    Ok(tape)
}

/// In the log of each of these recordings.
const SAID: &str = "somebody opened the cage";

const OUTPUTS: [&str; 2] = [
    "Control.main_outputs.speed",
    "Control.additional_outputs.debug.certainty",
];

#[test]
fn an_output_has_a_channel_of_its_own() {
    let tape = record(&OUTPUTS).expect("it has these outputs");
    assert_good(&tape.verify());
    let file = tape.read();
    for output in OUTPUTS {
        let mut channels = file.channels.iter();
        let (number, channel) = channels
            .find(|(_, channel)| channel.topic == output)
            .expect("it has a channel");
        assert_eq!(channel.encoding, "json");
        let schema = channel.schema.expect("it has a schema");
        let mut schemas = file.schemas.iter();
        let (_, schema) = schemas
            .find(|(known, _)| *known == schema)
            .expect("the schema is there");
        let schema: Value = serde_json::from_slice(&schema.data).expect("it is JSON");
        assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
        let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
        let own = messages.filter(|message| message.channel == *number);
        let values: Vec<Value> = own
            .map(|message| serde_json::from_slice(message.data).expect("it is JSON"))
            .collect();
        assert!(values.len() > 50, "{output}: {} values", values.len());
    }
}

#[test]
fn what_was_said_is_in_a_channel_of_log_messages() {
    let tape = record(&[]).expect("it has no outputs");
    let file = tape.read();
    let mut channels = file.channels.iter();
    let (number, channel) = channels
        .find(|(_, channel)| channel.topic == "logs")
        .expect("every recording has it");
    let schema = file
        .schemas
        .iter()
        .find(|(known, _)| Some(*known) == channel.schema);
    assert_eq!(schema.expect("it is there").1.name, "foxglove.Log");
    let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
    let logs = messages.filter(|message| message.channel == *number);
    let logs = logs.map(|message| serde_json::from_slice(message.data).expect("it is JSON"));
    let logs: Vec<Value> = logs.collect();
    // What a node says is of its cycle.
    let is_placed = |log: &Value| log["instance"].is_string() && log["cycle"].is_u64();
    assert!(logs.iter().any(is_placed), "{logs:?}");
    // Those of tests beside this one are there, too.
    let mut own = logs.iter().filter(|log| log["message"] == SAID);
    let log = own.next_back().expect("it was said before the end");
    assert_eq!(
        (&log["level"], &log["name"]),
        (&3.into(), &"zoo::test".into())
    );
    // Said in no cycle, whichever ran last.
    assert!(log["instance"].is_null() && log["cycle"].is_null(), "{log}");
    // In lockstep it is the time of the run.
    assert_eq!(log["timestamp"]["sec"], 1, "{log}");
}

#[test]
fn an_output_that_nobody_writes_is_refused_with_those_there_are() {
    let error = record(&["Control.main_outputs.speeed"]).err();
    let error = error.expect("there is none").to_string();
    assert!(error.contains("Control.main_outputs.speed"), "{error}");
}

#[test]
fn python_decodes_every_channel() {
    let tape = record(&OUTPUTS).expect("it has these outputs");
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/recording/readers.py");
    let skip = || {
        framework::testing::skip(
            "python_decodes_every_channel",
            "pip install mcap lz4 jsonschema",
        )
    };
    let output = match Command::new("python3").arg(script).arg(&tape.path).output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return skip(),
        output => output.expect("Python can be started"),
    };
    let error = String::from_utf8_lossy(&output.stderr);
    if error.contains("No module named") {
        return skip();
    }
    assert!(output.status.success(), "{error}");
    let counts: Value = serde_json::from_slice(&output.stdout).expect("it prints JSON");
    let file = tape.read();
    for (number, channel) in &file.channels {
        let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
        let own = messages
            .filter(|message| message.channel == *number)
            .count();
        assert_eq!(counts[&channel.topic], own, "{}", channel.topic);
    }
    assert!(counts["logs"].as_u64() > Some(0), "{counts}");
}
