//! The readers in other languages, written from docs/protocol/binary.md: they read what the reference reads, and refuse what
//! it refuses.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use framework::Reflect;
use framework::reflect::Shape;
use framework::reflect::binary::decode;
use framework::testing::skip;
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;
use serde_json::json;

use super::binary::{bytes_of, layout};
use super::odd::{Odd, odd};
use super::{Everything, everything};

/// Values of each of the two types that have a field of every kind.
const VALUES: usize = 60;

/// For each value: it, and it again with so many bytes changed or with its end cut off.
const CHANGED: usize = 6;

/// One object a line: a layout, bytes, and what the reference makes of them; without `value` it refuses them.
fn corpus() -> String {
    let mut runner = TestRunner::deterministic();
    let mut lines = String::new();
    for _ in 0..VALUES {
        let value = everything().new_tree(&mut runner);
        add(
            &Everything::shape(),
            &value.expect("it makes values").current(),
            &mut runner,
            &mut lines,
        );
        let value = odd().new_tree(&mut runner);
        add(
            &Odd::shape(),
            &value.expect("it makes values").current(),
            &mut runner,
            &mut lines,
        );
    }
    lines
}

fn add(shape: &Shape, value: &dyn Reflect, runner: &mut TestRunner, lines: &mut String) {
    let layout = layout(shape);
    let whole = bytes_of(value);
    for change in 0..=CHANGED {
        let mut bytes = whole.clone();
        if change > 0 {
            let drawn = (any::<prop::sample::Index>(), any::<u8>(), any::<bool>()).new_tree(runner);
            let (at, byte, is_cut) = drawn.expect("it draws").current();
            let at = at.index(bytes.len());
            bytes[at] = byte;
            if is_cut {
                bytes.truncate(at);
            }
        }
        let mut text = String::new();
        for byte in &bytes {
            write!(text, "{byte:02x}").expect("texts take everything");
        }
        let mut line = json!({ "layout": layout, "bytes": text });
        if let Ok(value) = decode(&layout, &bytes) {
            line["value"] = value;
        }
        writeln!(lines, "{line}").expect("texts take everything");
    }
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Lets a program read the corpus; it ends with 0 if it finds no difference.
fn read_with(command: &mut Command) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("corpus");
    fs::write(&file, corpus()).expect("the folder is ours");
    let output = command
        .arg(&file)
        .output()
        .expect("it was there a moment ago");
    let said = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{stderr}");
    let all = format!("{} read", 2 * VALUES * (CHANGED + 1));
    assert_eq!(said.trim(), all);
}

#[test]
fn python_reads_every_type() {
    let mut has_websockets = Command::new("python3");
    has_websockets
        .args(["-c", "import websockets.sync.client"])
        .stderr(Stdio::null());
    if !has_websockets.status().is_ok_and(|status| status.success()) {
        skip(
            "python_reads_every_type",
            "python3 -m pip install websockets",
        );
        return;
    }
    read_with(Command::new("python3").arg(root().join("docs/clients/test_hulk.py")));
}

#[test]
fn the_page_reads_every_type() {
    let page = root().join("web/page");
    if !page.join("node_modules/rolldown").is_dir() {
        skip(
            "the_page_reads_every_type",
            "node 20 and `npm ci` in web/page",
        );
        return;
    }
    read_with(Command::new("node").arg(page.join("test/decode.mjs")));
}
