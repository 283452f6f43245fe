//! Building a target with cargo, which says where the program is.

use std::ffi::OsString;
use std::io::BufReader;
use std::process::{Command, Stdio};

use camino::{Utf8Path, Utf8PathBuf};
use serde::Deserialize;

use super::program::absolute;
use crate::commands::terminal::Terminal;
use crate::outcome::Refusal;

/// What cargo is asked for.
pub(super) struct Build<'a> {
    pub(super) root: &'a Utf8Path,
    /// The generated package.
    pub(super) package: &'a str,
    pub(super) target: &'a str,
    pub(super) profile: Option<&'a str>,
    /// Relative to the current folder.
    pub(super) target_dir: Option<&'a Utf8Path>,
}

/// A line of `cargo build --message-format=json`.
#[derive(Deserialize)]
struct Message {
    reason: String,
    target: Option<MessageTarget>,
    executable: Option<String>,
}

#[derive(Deserialize)]
struct MessageTarget {
    name: String,
}

impl Build<'_> {
    /// The path of the built program; None if cargo has said on stderr why there is none.
    pub(super) fn executable(&self, terminal: &Terminal) -> Result<Option<Utf8PathBuf>, Refusal> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
        let mut child = Command::new(&cargo)
            .args(self.arguments()?)
            .current_dir(self.root)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| {
                Refusal::bad(format!("cannot start `{}`: {error}", cargo.display()))
                    .help("install Rust from rustup.rs, or name cargo in the variable CARGO")
            })?;
        let stdout = child.stdout.take().expect("it was asked for above");
        let executable = self.read_messages(BufReader::new(stdout), terminal)?;
        let status = child
            .wait()
            .map_err(|error| Refusal::bad(format!("cannot wait for cargo: {error}")))?;
        match (status.success(), executable) {
            (true, Some(executable)) => Ok(Some(executable)),
            (true, None) => Err(Refusal::bad("cargo did not say where the program is")),
            (false, _) => Ok(None),
        }
    }

    fn arguments(&self) -> Result<Vec<OsString>, Refusal> {
        let feature = format!("target-{}", self.target);
        let mut arguments: Vec<OsString> = [
            "build",
            "--message-format=json-render-diagnostics",
            "--package",
            self.package,
            "--bin",
            self.target,
            "--no-default-features",
            "--features",
            &feature,
            "--profile",
            self.profile.unwrap_or(OWN_PROFILE),
        ]
        .map(OsString::from)
        .to_vec();
        if let Some(folder) = self.target_dir {
            arguments.extend([OsString::from("--target-dir"), absolute(folder)?]);
        }
        Ok(arguments)
    }

    fn read_messages(
        &self,
        stdout: impl std::io::BufRead,
        terminal: &Terminal,
    ) -> Result<Option<Utf8PathBuf>, Refusal> {
        let mut executable = None;
        for line in stdout.lines() {
            let line = line
                .map_err(|error| Refusal::bad(format!("cannot read what cargo says: {error}")))?;
            match serde_json::from_str::<Message>(&line) {
                Ok(message) if message.is_program(self.target) => {
                    executable = message.executable.map(Utf8PathBuf::from);
                }
                Ok(_) => {}
                // A procedural macro or a wrapper printed something.
                Err(_) => terminal.note(&format!("{line}\n")),
            }
        }
        Ok(executable)
    }
}

/// The profile that hulkgen itself was built with, so that crates of both are compiled once.
const OWN_PROFILE: &str = if cfg!(debug_assertions) {
    "dev"
} else {
    "release"
};

impl Message {
    fn is_program(&self, name: &str) -> bool {
        self.reason == "compiler-artifact"
            && self.executable.is_some()
            && self
                .target
                .as_ref()
                .is_some_and(|target| target.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::{Build, OWN_PROFILE};
    use crate::arguments::Color;
    use crate::commands::terminal::Terminal;

    fn build() -> Build<'static> {
        Build {
            root: ".".into(),
            package: "nao_runtime",
            target: "simulated",
            profile: None,
            target_dir: None,
        }
    }

    #[test]
    fn the_program_is_where_cargo_says() {
        let output = "\
{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"build-script-build\"},\"executable\":\"/t/build\"}
{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"simulated\"},\"executable\":null}
{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"simulated\"},\"executable\":\"/t/simulated\"}
{\"reason\":\"build-finished\",\"success\":true}
";
        let executable = build().read_messages(output.as_bytes(), &Terminal::new(Color::Never));
        assert_eq!(executable, Ok(Some("/t/simulated".into())));
    }

    #[test]
    fn a_target_is_built_with_its_feature_alone() {
        let arguments = build().arguments().expect("nothing is asked of the disk");
        let arguments: Vec<_> = arguments
            .iter()
            .map(|argument| argument.to_string_lossy())
            .collect();
        let text = arguments.join(" ");
        assert!(
            text.contains("--package nao_runtime --bin simulated"),
            "{text}"
        );
        assert!(
            text.contains("--no-default-features --features target-simulated"),
            "{text}"
        );
        assert!(
            text.ends_with(&format!("--profile {OWN_PROFILE}")),
            "{text}"
        );
    }
}
