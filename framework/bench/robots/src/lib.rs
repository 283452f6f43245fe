//! The robots that are measured, as texts: 61 trivial nodes, and the mix of fields of a real body's cycler.
//!
//! Invariant: same program, same bytes.

mod by_hand;
mod copper;
mod mix;
mod node;
mod robot;
mod trivial;

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Every file with its text, by its path.
pub fn files() -> BTreeMap<PathBuf, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../written");
    let mut files = BTreeMap::new();
    for robot in [trivial::robot(), mix::robot(), mix::robot_at_83_hz()] {
        for (path, text) in robot.render_files() {
            let text = match path.ends_with(".rs") {
                true => formatted(&text),
                false => text,
            };
            files.insert(folder.join(robot.name).join(path), text);
        }
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../copper");
    for (path, text) in copper::files() {
        files.insert(folder.join(path), text);
    }
    files
}

/// As `cargo fmt` would have it.
fn formatted(text: &str) -> String {
    let mut rustfmt = Command::new("rustfmt")
        .args(["--edition", "2024"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .spawn()
        .expect("rustfmt comes with Rust");
    let mut input = rustfmt.stdin.take().expect("it was asked for");
    let text = text.to_owned();
    let writing = std::thread::spawn(move || input.write_all(text.as_bytes()));
    let output = rustfmt.wait_with_output().expect("rustfmt ends");
    writing
        .join()
        .expect("writing does not panic")
        .expect("rustfmt reads everything");
    assert!(output.status.success(), "rustfmt refuses a file");
    String::from_utf8(output.stdout).expect("rustfmt writes UTF-8")
}
