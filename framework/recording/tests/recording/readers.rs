//! Readers that others wrote: the package `mcap` for Python.

use std::io::ErrorKind;
use std::process::Command;

use hulkgen_recording::{Recording, Settings};

use crate::description::settings;
use crate::support::{drawn_places, record};

/// The lines that the script prints; `None` where it cannot run.
fn read(arguments: &[String]) -> Option<Vec<serde_json::Value>> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/recording/readers.py");
    let output = match Command::new("python3").arg(script).args(arguments).output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return None,
        output => output.expect("Python can be started"),
    };
    let error = String::from_utf8_lossy(&output.stderr);
    if error.contains("No module named 'mcap'") {
        return None;
    }
    assert!(output.status.success(), "{error}");
    let text = String::from_utf8(output.stdout).expect("JSON");
    let lines = text.lines().map(serde_json::from_str);
    Some(lines.collect::<Result<_, _>>().expect("JSON"))
}

fn numbers(value: &serde_json::Value) -> Vec<u64> {
    let list = value.as_array().expect("a list");
    list.iter().filter_map(serde_json::Value::as_u64).collect()
}

#[test]
fn python_reads_what_we_write() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let ring = folder.path().join("ring.mcap");
    record(&path, 1500, 20, settings());
    let budget = 64 << 10;
    record(
        &ring,
        60_000,
        1,
        Settings {
            budget,
            ..settings()
        },
    );
    let bytes = std::fs::read(&path).expect("it was written");
    let recording = Recording::read(&bytes).expect("it can be read");
    let boundaries = recording.chunks.iter().map(|chunk| chunk.offset as usize);
    let cuts: Vec<_> = drawn_places(8..bytes.len()).chain(boundaries).collect();
    let offsets: Vec<_> = cuts.iter().map(usize::to_string).collect();
    let [path, ring] = [path, ring].map(|path| path.to_str().expect("UTF-8").to_owned());
    let Some(lines) = read(&[
        path.clone(),
        ring.clone(),
        format!("{path}:{}", offsets.join(",")),
    ]) else {
        return framework::testing::skip("python_reads_what_we_write", "pip install mcap");
    };
    let [whole, ring_read, cut @ ..] = lines.as_slice() else {
        panic!("a line for each file");
    };
    assert_eq!(numbers(&whole["frames"]), Vec::from_iter(0..1500));
    assert_eq!(whole["messages"], whole["statistics"]);
    assert_eq!(whole["attachments"][0], "hulk.toml");
    assert_eq!(whole["metadata"]["run"]["id"], "1");
    assert_eq!(whole["metadata"]["end"]["Control.recorded"], "1500");
    let frames = numbers(&ring_read["frames"]);
    assert!(frames.first().is_some_and(|first| *first > 0));
    assert_eq!(frames.last(), Some(&59_999));
    assert_eq!(cut.len(), cuts.len());
    for (offset, line) in cuts.iter().zip(cut) {
        let ours = Recording::read(&bytes[..*offset]).expect("its beginning is there");
        assert_eq!(line["chunks"], ours.chunks.len(), "cut at {offset}");
        let found = numbers(&line["frames"]);
        assert_eq!(found, Vec::from_iter(0..found.len() as u64));
    }
}
