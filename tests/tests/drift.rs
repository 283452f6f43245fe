//! The checked-in generated crates are what hulkgen would write, and hulkgen restores them whatever happened to them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::SystemTime;

use support::root;

/// hulkgen as a user runs it, in a folder.
fn hulkgen(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(binary())
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("hulkgen can be started")
}

/// The binary beside this test: `cargo test --workspace` builds it.
fn binary() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a path");
    let folder = test
        .parent()
        .and_then(Path::parent)
        .expect("target/<profile>/deps/<test>");
    folder.join(format!("hulkgen{}", std::env::consts::EXE_SUFFIX))
}

fn assert_success(output: &Output) {
    assert!(
        output.status.success(),
        "{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
}

/// A copy of everything hulkgen reads and writes of the robot at `manifest`'s folder.
fn copy_of_the_workspace() -> tempfile::TempDir {
    let copy = tempfile::tempdir().expect("a temporary folder");
    for entry in [
        "Cargo.toml",
        "hulk.toml",
        "cli",
        "docs",
        "framework",
        "generated",
        "robotics",
        "schema",
        "templates",
        "tests",
        "web",
    ] {
        copy_all(&root().join(entry), &copy.path().join(entry));
    }
    copy
}

fn copy_all(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).expect("a folder in a temporary folder");
        for entry in fs::read_dir(from).expect("a folder of the repository") {
            let entry = entry.expect("an entry of a folder that was just listed");
            if entry.file_name() != "target" {
                copy_all(&entry.path(), &to.join(entry.file_name()));
            }
        }
    } else {
        fs::copy(from, to).expect("a file of the repository");
    }
}

/// Every file of a folder with its text, sorted.
fn files(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).expect("a folder that exists") {
            let path = entry
                .expect("an entry of a folder that was just listed")
                .path();
            if path.is_dir() {
                open.push(path);
            } else {
                let text = fs::read_to_string(&path).expect("generated files are text");
                found.push((path.strip_prefix(folder).expect("below").to_owned(), text));
            }
        }
    }
    found.sort();
    found
}

#[test]
fn the_nao_is_current() {
    assert_success(&hulkgen(&root(), &["generate", "--check"]));
}

#[test]
fn the_zoo_is_current() {
    assert_success(&hulkgen(
        &root().join("tests/robots/zoo"),
        &["generate", "--check"],
    ));
}

#[test]
fn the_second_body_is_current() {
    assert_success(&hulkgen(
        &root().join("tests/robots/k1"),
        &["generate", "--check"],
    ));
}

#[test]
fn the_outpost_is_current() {
    let folder = root().join("tests/robots/outpost");
    assert_success(&hulkgen(&folder, &["generate", "--check"]));
    assert_success(&hulkgen(&folder, &["check", "--deny-warnings"]));
}

#[test]
fn the_examples_are_current() {
    for example in ["rover", "sprinkler", "timing"] {
        let folder = root().join("docs/examples").join(example);
        assert_success(&hulkgen(&folder, &["generate", "--check"]));
        assert_success(&hulkgen(&folder, &["check", "--deny-warnings"]));
    }
}

#[test]
fn the_partial_zoos_are_current() {
    for only in ["Control", "Vision,Reflexes,Lights"] {
        assert_success(&hulkgen(
            &root().join("tests/robots/zoo"),
            &["generate", "--check", "--only", only],
        ));
    }
}

#[test]
fn the_picture_of_the_nao_is_current() {
    let graph = hulkgen(&root(), &["graph", "--format", "svg"]);
    assert_success(&graph);
    let picture = fs::read(root().join("docs/nao.svg")).expect("the NAO has a picture");
    assert!(
        picture == graph.stdout,
        "write it anew: cargo run -- graph --format svg > docs/nao.svg"
    );
}

#[test]
fn a_deleted_crate_is_restored_byte_by_byte() {
    let copy = copy_of_the_workspace();
    let generated = copy.path().join("generated");
    let before = files(&generated);
    fs::remove_dir_all(&generated).expect("it was just copied");
    assert_success(&hulkgen(copy.path(), &["generate"]));
    assert_eq!(before, files(&generated));
}

/// What git leaves in a file that two have changed.
fn in_conflict(text: &str) -> String {
    format!("<<<<<<< ours\n{text}=======\n>>>>>>> theirs\n")
}

#[test]
fn conflict_marks_in_any_file_are_repaired() {
    let copy = copy_of_the_workspace();
    let zoo = copy.path().join("tests/robots/zoo");
    let generated = zoo.join("generated");
    let before = files(&generated);
    assert!(
        before
            .iter()
            .any(|(path, _)| path == Path::new("Cargo.toml"))
    );
    for (path, text) in &before {
        fs::write(generated.join(path), in_conflict(text)).expect("it was just copied");
        let check = hulkgen(&zoo, &["generate", "--check"]);
        assert_eq!(check.status.code(), Some(3), "{} is drift", path.display());
        assert_success(&hulkgen(&zoo, &["generate"]));
        assert_eq!(
            before,
            files(&generated),
            "after marks in {}",
            path.display()
        );
    }
}

#[test]
fn conflict_marks_in_all_files_are_repaired() {
    let copy = copy_of_the_workspace();
    let generated = copy.path().join("generated");
    let before = files(&generated);
    for (path, text) in &before {
        fs::write(generated.join(path), in_conflict(text)).expect("it was just copied");
    }
    let check = hulkgen(copy.path(), &["generate", "--check"]);
    assert_eq!(check.status.code(), Some(3));
    let told = String::from_utf8_lossy(&check.stderr).into_owned()
        + &String::from_utf8_lossy(&check.stdout);
    for (path, _) in &before {
        let path = Path::new("generated").join(path);
        assert!(told.contains(&*path.to_string_lossy()), "{told}");
    }
    assert_success(&hulkgen(copy.path(), &["generate"]));
    assert_eq!(before, files(&generated));
}

#[test]
fn an_orphan_is_drift_and_is_removed() {
    let copy = copy_of_the_workspace();
    let orphan = copy.path().join("generated/src/cyclers/left_over.rs");
    fs::write(&orphan, "fn left_over() {}\n").expect("it was just copied");
    let check = hulkgen(copy.path(), &["generate", "--check"]);
    assert_eq!(check.status.code(), Some(3));
    assert!(orphan.exists(), "--check writes nothing");
    assert_success(&hulkgen(copy.path(), &["generate"]));
    assert!(!orphan.exists());
}

#[test]
fn a_second_run_touches_no_file() {
    let copy = copy_of_the_workspace();
    assert_success(&hulkgen(copy.path(), &["generate"]));
    let times = |folder: &Path| -> Vec<(PathBuf, SystemTime)> {
        files(folder)
            .into_iter()
            .map(|(path, _)| {
                let metadata = fs::metadata(folder.join(&path)).expect("it was just listed");
                (path, metadata.modified().expect("times are kept here"))
            })
            .collect()
    };
    let before = times(&copy.path().join("generated"));
    assert_success(&hulkgen(copy.path(), &["generate"]));
    assert_eq!(before, times(&copy.path().join("generated")));
}

#[test]
fn a_broken_node_writes_nothing_and_says_where() {
    let copy = copy_of_the_workspace();
    let generated = copy.path().join("generated");
    let before = files(&generated);
    let node = copy.path().join("robotics/vision/src/ball_detection.rs");
    let text = fs::read_to_string(&node).expect("the node is there");
    let broken = text.replace("\"camera_matrix?\"", "\"camera_matrx?\"");
    assert_ne!(text, broken, "the node reads the camera matrix");
    fs::write(&node, broken).expect("it was just copied");
    fs::write(generated.join("DATAFLOW.md"), "changed\n").expect("it was just copied");
    let output = hulkgen(copy.path(), &["generate"]);
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("unknown-output"), "{message}");
    assert!(
        message.contains("robotics/vision/src/ball_detection.rs"),
        "{message}"
    );
    assert!(
        message.contains("`camera_matrix`"),
        "the nearest name is missing: {message}"
    );
    let after = files(&generated);
    for ((path, old), (_, new)) in before.iter().zip(&after) {
        if path != Path::new("DATAFLOW.md") {
            assert_eq!(old, new, "{} was written", path.display());
        }
    }
    assert_eq!(
        fs::read_to_string(generated.join("DATAFLOW.md")).expect("it is there"),
        "changed\n"
    );
}
