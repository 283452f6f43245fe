//! Whether a generated crate is what hulkgen would write now.

use std::env;
use std::ffi::OsString;
use std::io::ErrorKind;
use std::process::Command;

use super::skip;

/// Names the program where it is not `hulkgen` on the PATH.
const PROGRAM: &str = "HULKGEN";
/// What `generate --check` ends with if something would be written.
const DRIFT: i32 = 3;

/// Asks hulkgen whether the generated crate of the robot in the folder `root` is current.
///
/// Without hulkgen the test says that it was skipped: a robot's tests never compile the generator.
///
/// # Panics
/// If the crate is not current, or if the robot has errors; the message says what to run.
pub fn assert_generated(root: &str) {
    let program = env::var_os(PROGRAM).unwrap_or_else(|| OsString::from("hulkgen"));
    let answer = Command::new(&program)
        .args([
            "generate",
            "--check",
            "--color",
            "never",
            "--manifest",
            root,
        ])
        .output();
    let program = program.display();
    let output = match answer {
        Ok(output) => output,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let install = format!("install hulkgen, or name it in the variable {PROGRAM}");
            return skip("the generated crate is current", &install);
        }
        Err(error) => panic!("cannot start `{program}`: {error}"),
    };
    let said = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => {}
        Some(DRIFT) => {
            panic!("the generated crate is not current: run `{program} generate`\n{said}")
        }
        _ => panic!("`{program} generate --check` failed:\n{said}"),
    }
}
