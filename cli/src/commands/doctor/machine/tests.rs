//! What programs and limits say, read without them.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt as _;

use super::{answer, disk, numbers, pip, rustc};
use crate::commands::doctor::State;

#[test]
fn an_old_rustc_is_bad() {
    assert_eq!(rustc(None).state, State::Bad);
    assert_eq!(rustc(Some("rustc 1.70.0 (x)")).state, State::Bad);
    assert_eq!(rustc(Some("rustc 2.0.0-nightly (x)")).state, State::Ok);
    assert_eq!(numbers("1.95"), [1, 95, 0]);
}

#[test]
fn little_free_space_is_a_warning_and_none_is_bad() {
    let said = |kibibytes: &str| format!("Filesystem …\n/dev/sda 9 9 {kibibytes} 1% /\n");
    assert_eq!(disk(Some(&said("1000"))).state, State::Bad);
    assert_eq!(disk(Some(&said("2097152"))).state, State::Warning);
    assert_eq!(disk(Some(&said("20971520"))).message, "20 GiB free");
    assert_eq!(disk(Some("")).state, State::Warning);
}

#[test]
fn a_program_that_is_not_there_has_no_answer() {
    assert_eq!(answer("hulkgen-is-not-called-so", &[], ".".into()), None);
}

#[test]
fn the_python_that_brings_compilers_is_asked_for_pip() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let python = folder.path().join("python");
    let python = camino::Utf8Path::from_path(&python).expect("it is UTF-8");
    for (has, state) in [
        ("-m pip --version", State::Ok),
        ("-m venv --help", State::Warning),
    ] {
        let script = format!("#!/bin/sh\n[ \"$*\" = \"{has}\" ] && echo pip 25\n");
        fs::write(python, script).expect("the folder is ours");
        fs::set_permissions(python, Permissions::from_mode(0o755)).expect("it is ours");
        assert_eq!(pip(python.as_str(), ".".into()).state, state, "{has}");
    }
}

#[test]
fn a_program_is_asked_in_the_folder_of_the_robot() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path().canonicalize().expect("it is there");
    let folder = camino::Utf8Path::from_path(&folder).expect("it is UTF-8");
    let said = answer("sh", &["-c", "pwd -P"], folder);
    assert_eq!(said.as_deref(), Some(folder.as_str()));
}
