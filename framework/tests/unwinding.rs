//! A robot that would end at the first panic is not built.

use std::path::Path;
use std::process::{Command, Output};

/// The file alone, as cargo would compile it in a profile with this strategy.
fn compiled(panic: &str) -> Output {
    let folder = tempfile::tempdir().expect("there is room for a file");
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    Command::new(rustc)
        .args([
            "--crate-type",
            "lib",
            "--edition",
            "2024",
            "--emit",
            "metadata",
        ])
        .args(["-C", &format!("panic={panic}"), "--out-dir"])
        .arg(folder.path())
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/unwinding.rs"))
        .output()
        .expect("rustc compiled this test")
}

#[test]
fn panic_abort_is_refused_with_the_deed() {
    let output = compiled("abort");
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "it compiles");
    assert!(
        words.contains("must not be built with `panic = \"abort\"`"),
        "{words}"
    );
    assert!(
        words.contains("remove the line from the profile"),
        "{words}"
    );
}

#[test]
fn unwinding_compiles() {
    let output = compiled("unwind");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn the_framework_asks_for_it() {
    let library = include_str!("../src/lib.rs");
    assert!(library.contains("\nmod unwinding;\n"));
}
