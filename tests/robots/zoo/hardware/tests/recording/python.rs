//! `docs/clients/recording.py` reads all that the zoo records: no byte is left over, and digests are named.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::process::Command;

use framework::replay::{Players, Shelf};
use serde_json::Value;
use zoo_runtime::recording;

use super::{INSTANCES, SMALL, Tape, as_it_is, on, record_in_lockstep};

/// The lines that the program prints; `None` where it cannot run.
fn lines(arguments: &[&str]) -> Option<Vec<Value>> {
    let program = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../../docs/clients/recording.py"
    );
    let output = match Command::new("python3")
        .arg(program)
        .args(arguments)
        .output()
    {
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

#[test]
fn python_decodes_every_message() {
    let tape = Tape::new();
    record_in_lockstep(&tape.path, SMALL, on, &as_it_is);
    let path = tape.path.to_str().expect("the path is UTF-8");
    let Some(channels) = lines(&["list", path]) else {
        return framework::testing::skip("python_decodes_every_message", "pip install mcap");
    };
    let file = tape.read();
    assert!(file.chunks.len() > 3, "{} chunks", file.chunks.len());
    assert_eq!(channels.len(), file.channels.len());
    for ((number, channel), told) in file.channels.iter().zip(&channels) {
        let messages = file.chunks.iter().flat_map(|chunk| chunk.messages());
        let own = messages.filter(|message| message.channel == *number);
        assert_eq!(told["topic"], *channel.topic);
        assert_eq!(told["messages"], own.count(), "{told}");
    }

    let read = lines(&["cat", path]).expect("it ran a moment ago");
    let digests: BTreeMap<_, _> = read
        .iter()
        .map(|one| ((one["path"].as_str(), one["cycle"].as_u64()), &one["value"]))
        .filter(|((path, _), _)| path.is_some_and(|path| path.contains(".digests.")))
        .collect();
    let shelf = Shelf::of(&file).expect("it is of this version");
    let mut players = Players::new(&shelf, recording::INSTANCES).expect("it fits");
    let mut named = 0;
    for instance in INSTANCES {
        let (player, chunks) = players.of(instance).expect("it is an instance");
        player.load_at(0, chunks).expect("its first frame is whole");
        let replay = player.replay().expect("it was loaded").instance();
        for (position, frame) in player.frames.iter().enumerate() {
            let recorded = player.digests(position, chunks);
            let Some(recorded) = recorded.expect("it can be read") else {
                continue;
            };
            for ((node, output), digest) in replay.digested().iter().zip(recorded) {
                let path = format!("{instance}.digests.{node}.{output}");
                let found = digests.get(&(Some(&*path), Some(frame.head.number)));
                assert_eq!(
                    **found.expect("it is named"),
                    format!("{digest:016x}"),
                    "{path}"
                );
                named += 1;
            }
        }
    }
    assert_eq!(named, digests.len());
    assert!(named > 1000, "{named} digests");
}
