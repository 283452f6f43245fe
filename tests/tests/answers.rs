//! What hulkgen answers about the NAO: every example of the help of `explain`, and `diff` against a commit.

use std::path::{Path, PathBuf};
use std::process::Command;

use support::root;

/// The binary beside this test: `cargo test --workspace` builds it.
fn binary() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a path");
    let folder = test.parent().and_then(Path::parent);
    let folder = folder.expect("target/<profile>/deps/<test>");
    folder.join(format!("hulkgen{}", std::env::consts::EXE_SUFFIX))
}

/// What hulkgen prints in this repository, after ending with 0.
#[track_caller]
fn answer(arguments: &str) -> String {
    let mut command = Command::new(binary());
    command
        .args(arguments.split_whitespace())
        .current_dir(root());
    let output = command.output().expect("hulkgen can be started");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {said}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn the_examples_of_the_help_work_on_this_robot() {
    let help = answer("explain --help");
    let examples = help
        .lines()
        .filter_map(|line| line.trim().strip_prefix("hulkgen explain "))
        .map(|line| line.split('#').next().unwrap_or_default());
    let mut tried = 0;
    for example in examples.filter(|example| !example.contains(['<', '['])) {
        assert!(!answer(&format!("explain {example}")).is_empty());
        answer(&format!("explain {example} --format json"));
        tried += 1;
    }
    assert_eq!(tried, 6, "{help}");
}

#[test]
fn a_parameter_names_its_readers_and_its_files() {
    let text = answer("explain player.number");
    assert!(text.contains("read by control::self_report"), "{text}");
    assert!(text.contains("Number of the shirt"), "{text}");
    assert!(text.contains("robotics/parameters/default.toml:"), "{text}");
}

#[test]
fn an_order_is_explained_by_the_field_that_asks_for_it() {
    let text = answer("explain order ball_filter odometry");
    assert!(
        text.contains("control::odometry runs before control::ball_filter"),
        "{text}"
    );
    assert!(text.contains("HistoricInput"), "{text}");
}
