//! Programs that are asked as another build of the robot is.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use framework::replay::{Elsewhere, Source};

#[test]
fn what_comes_in_place_of_an_answer_is_told_as_what_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, script, told) in [
        (
            "chatters",
            "read question; echo 'the lamp is red'; read question",
            &["says `the lamp is red` where its answer should be"][..],
        ),
        (
            "floods",
            "read question; printf '\\377\\n'; while echo more; do :; done",
            &["where its answer should be"],
        ),
        (
            "dies",
            "read question; echo 'error: no room' >&2; echo 'some help' >&2; exit 3",
            &[
                "ended without an answer",
                "exit status: 3",
                "error: no room",
            ],
        ),
        (
            "breaks_off",
            "read question; printf '{\"outp'; kill -9 $$",
            &["ended without an answer", "signal: 9"],
        ),
        (
            "answers",
            "read question; echo nothing >&2; echo '\"needs_hardware\"'; exit 1",
            &[],
        ),
    ] {
        let program = folder.path().join(name);
        fs::write(&program, format!("#!/bin/sh\n{script}\n")).expect("the folder is ours");
        let executable = fs::Permissions::from_mode(0o755);
        fs::set_permissions(&program, executable).expect("the folder is ours");
        let mut elsewhere = loop {
            match Elsewhere::start(&program, Path::new("run.mcap")) {
                Ok(elsewhere) => break elsewhere,
                // A process that another test starts has the file open until it begins.
                Err(error) if error.to_string().contains("busy") => {}
                Err(error) => panic!("{error}"),
            }
        };
        match elsewhere.play("Legs", 0) {
            Ok(_) => assert!(told.is_empty(), "{name}"),
            Err(error) => {
                let error = error.to_string();
                let is_told = told.iter().all(|part| error.contains(part));
                assert!(is_told && !told.is_empty(), "{name}: {error}");
            }
        }
    }
}
