//! What a recording says of the run, for whoever finds the file alone.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use framework::{Digest, numerics, testing};
use hulkgen_recording::Recording;

use super::{TARGET, TEXT, run, workspace};

/// Where the child of the test below records.
const INTO: &str = "HULKGEN_TEST_RECORDS_INTO";

/// As `hulkgen deploy` tells it.
const REVISION: &str = "HULKGEN_REVISION";

const NAME: &str = "recorded::a_recording_says_what_ran";

#[test]
fn a_recording_says_what_ran() {
    if let Ok(path) = std::env::var(INTO) {
        let words = ["--for", "1ms", "--run-folder", "runs/17-4"];
        let ran = run(
            &workspace(TEXT),
            &[&words[..], &["--record", &path]].concat(),
        );
        assert_eq!(ran.status, 0);
        return;
    }
    let since_epoch = || {
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        since.expect("it is later than 1970").as_secs()
    };
    let folder = tempfile::tempdir().expect("a temporary directory");
    let begun = since_epoch();
    let recording = recorded(folder.path(), None);
    let ended = since_epoch();

    let entries = &recording.metadata("run").expect("it is told").entries;
    let mut entries: BTreeMap<&str, &str> = entries
        .iter()
        .map(|(key, value)| (&**key, &**value))
        .collect();
    let started = entries.remove("started").expect("it is told");
    assert!((begun..=ended).contains(&started.parse().expect("Unix seconds")));
    let mut graph = Digest::new();
    graph.add(TARGET.dataflow).expect("a text has a digest");
    let (graph, ours) = (graph.to_string(), numerics::fingerprint());
    let of_std = numerics::fingerprint_of_std();
    let expected = BTreeMap::from([
        ("run", "17-4"),
        ("robot", "test"),
        ("target", "simulated"),
        // It ran where nothing is checked out.
        ("git", ""),
        ("graph", &graph),
        ("identity.head", "3"),
        ("identity.body", "17"),
        ("identity.tail", "1"),
        ("numerics", &ours),
        ("numerics_of_std", &of_std),
    ]);
    assert_eq!(entries, expected);

    let text = |name: &str| {
        let mut attachments = recording.attachments.iter();
        let attachment = attachments.find(|one| one.name == name);
        let data = attachment.map(|one| one.data.clone());
        String::from_utf8(data.expect("it is there")).expect("text")
    };
    assert_eq!(recording.attachments.len(), 4);
    assert_eq!(text("hulk.toml"), TARGET.manifest);
    assert_eq!(text("DATAFLOW.md"), TARGET.dataflow);
    let json = |name: &str| -> serde_json::Value {
        serde_json::from_str(&text(name)).expect("it is JSON")
    };
    // That of this body.
    assert_eq!(json("parameters.json"), serde_json::json!({ "gain": 17.0 }));
    assert!(json("types.json").is_object());
}

#[test]
fn a_recording_says_of_which_commit_it_is() {
    if Command::new("git").arg("--version").output().is_err() {
        return testing::skip("a_recording_says_of_which_commit_it_is", "install git");
    }
    let folder = tempfile::tempdir().expect("a temporary directory");
    let git = |words: &str| {
        let mut git = Command::new("git");
        let output = git.args(words.split(' ')).current_dir(folder.path());
        let output = output.output().expect("it was there a moment ago");
        assert!(output.status.success(), "git {words}: {output:?}");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    };
    let told = |revision| {
        let recording = recorded(folder.path(), revision);
        let entries = &recording.metadata("run").expect("it is told").entries;
        let git = entries.iter().find(|(key, _)| key == "git");
        git.expect("it is told").1.clone()
    };
    std::fs::write(folder.path().join("file"), "").expect("the folder is ours");
    git("init --quiet");
    git("add --all");
    git("-c user.name=a -c user.email=a@b commit --quiet --message first");
    let commit = git("rev-parse HEAD");
    assert_eq!(told(None), commit);
    std::fs::write(folder.path().join("file"), "changed").expect("the folder is ours");
    assert_eq!(told(None), format!("{commit} with changes"));
    // What was deployed is not what is checked out where it runs.
    assert_eq!(told(Some("0a1b with changes")), "0a1b with changes");
    assert_eq!(told(Some("")), "");
}

/// Recorded by a process that was started in this folder.
fn recorded(folder: &Path, revision: Option<&str>) -> Recording {
    let runs = tempfile::tempdir().expect("a temporary directory");
    let path = runs.path().join("run.mcap");
    let child = Command::new(std::env::current_exe().expect("it runs"))
        .args(["--exact", NAME])
        .current_dir(folder)
        // Whatever is checked out around folders for temporary files.
        .env(
            "GIT_CEILING_DIRECTORIES",
            folder.parent().expect("it is below another one"),
        )
        .env_remove(REVISION)
        .envs(revision.map(|revision| (REVISION, revision)))
        .env(INTO, &path)
        .output()
        .expect("it is a program");
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success(), "{said}");
    Recording::open(&path).expect("it was written")
}
