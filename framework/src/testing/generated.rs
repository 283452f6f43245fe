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
    assert_generated_with(root, &[]);
}

/// The same for the crate that `hulkgen generate` writes with these options.
///
/// # Panics
/// As [`assert_generated`].
pub fn assert_generated_with(root: &str, options: &[&str]) {
    let program = env::var_os(PROGRAM).unwrap_or_else(|| OsString::from("hulkgen"));
    let answer = Command::new(&program)
        .arg("generate")
        .args(options)
        .args(["--check", "--color", "never", "--manifest", root])
        .output();
    let command: Vec<String> = [format!("{} generate", program.display())]
        .into_iter()
        .chain(options.iter().map(|option| quoted(option)))
        .collect();
    let command = command.join(" ");
    let output = match answer {
        Ok(output) => output,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let install = format!("install hulkgen, or name it in the variable {PROGRAM}");
            return skip("the generated crate is current", &install);
        }
        Err(error) => panic!("cannot start `{}`: {error}", program.display()),
    };
    let said = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => {}
        Some(DRIFT) => panic!("the generated crate is not current: run `{command}`\n{said}"),
        _ => panic!("`{command} --check` failed:\n{said}"),
    }
}

/// As a shell takes it for one word.
fn quoted(word: &str) -> String {
    if word.contains(char::is_whitespace) {
        format!("'{word}'")
    } else {
        word.to_owned()
    }
}
