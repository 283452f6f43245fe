//! Compiling the robot with cargo: where its program is, and what rustc found.

mod processor;

use std::ffi::OsString;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use camino::{Utf8Path, Utf8PathBuf};

pub(super) use processor::ForProcessor;

use super::generate;
use super::session::Session;
use super::terminal::Terminal;
use crate::cross::Tools;
use crate::diagnostics::Diagnostics;
use crate::late::rustc::{Line, Message};
use crate::late::{self, Home};
use crate::manifest;
use crate::model::{self, package};
use crate::outcome::Refusal;
use crate::pipeline::Understood;
use crate::resolve::robot::{Robot, Target};

/// The profile that hulkgen itself was built with, so that crates of both are compiled once.
pub(super) const OWN_PROFILE: &str = if cfg!(debug_assertions) {
    "dev"
} else {
    "release"
};

/// What cargo said.
#[derive(Debug, Default)]
pub(super) struct Said {
    pub(super) success: bool,
    /// The program that was asked for, if it was built.
    pub(super) executable: Option<Utf8PathBuf>,
    messages: Vec<Message>,
}

/// What cargo is asked for.
pub(super) struct Request<'a> {
    arguments: Vec<OsString>,
    /// For rustc where it compiles the program itself, behind everything else.
    of_program: &'static [&'static str],
    /// The program that is wanted.
    program: Option<&'a str>,
    /// What stands in for cargo.
    stand_in: Option<Utf8PathBuf>,
    /// Variables of its environment.
    variables: Vec<(String, OsString)>,
}

impl<'a> Request<'a> {
    /// Builds the program of one target; `target_dir` is absolute.
    pub(super) fn build(
        robot: &Robot,
        target: &'a Target,
        profile: &str,
        target_dir: Option<OsString>,
    ) -> Self {
        let mut arguments = arguments("build", robot, [target]);
        arguments.extend(["--profile", profile].map(OsString::from));
        arguments.extend(
            target_dir
                .into_iter()
                .flat_map(|folder| ["--target-dir".into(), folder]),
        );
        Self {
            arguments,
            of_program: &[],
            program: Some(&target.name),
            stand_in: None,
            variables: Vec::new(),
        }
    }

    /// Checks everything that these targets need, as far as cargo can go.
    pub(super) fn check<'t>(robot: &Robot, targets: impl IntoIterator<Item = &'t Target>) -> Self {
        let mut arguments = arguments("check", robot, targets);
        arguments.extend(["--lib", "--keep-going"].map(OsString::from));
        Self {
            arguments,
            of_program: &[],
            program: None,
            stand_in: None,
            variables: Vec::new(),
        }
    }

    /// Leaves symbols out of the program, and nowhere else: a profile that says so compiles every crate anew for it.
    pub(super) fn strip(&mut self) {
        self.arguments[0] = "rustc".into();
        self.of_program = &["--", "-Cstrip=symbols"];
    }

    /// Builds for another machine; the triple may end with a version of glibc.
    pub(super) fn cross(&mut self, tools: &Tools, triple: &str) {
        self.arguments
            .extend(["--target", triple].map(OsString::from));
        self.stand_in = Some(tools.zigbuild.clone());
        self.set("CARGO_ZIGBUILD_ZIG_PATH", tools.zig.as_str().into());
    }

    /// Sets a variable of cargo's environment.
    pub(super) fn set(&mut self, variable: &str, value: OsString) {
        self.variables.push((variable.to_owned(), value));
    }

    /// Runs cargo in the robot's folder; what is not for programs goes to stderr as cargo says it.
    pub(super) fn said(&self, session: &Session<'_>, color: bool) -> Result<Said, Refusal> {
        self.said_in(session.workspace.root(), session, color)
    }

    /// The same in another folder.
    pub(super) fn said_in(
        &self,
        folder: &Utf8Path,
        session: &Session<'_>,
        color: bool,
    ) -> Result<Said, Refusal> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
        let form = if color {
            "--message-format=json-diagnostic-rendered-ansi"
        } else {
            "--message-format=json"
        };
        let program = match &self.stand_in {
            Some(tool) => tool.as_os_str(),
            None => cargo.as_os_str(),
        };
        let mut child = Command::new(program)
            .args(&self.arguments)
            .arg(form)
            .args(self.of_program)
            .envs(self.variables.iter().map(|(name, value)| (name, value)))
            .env("CARGO", &cargo)
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| {
                Refusal::bad(format!("cannot start `{}`: {error}", program.display()))
                    .help("install Rust from rustup.rs, or name cargo in the variable CARGO")
            })?;
        let stdout = child.stdout.take().expect("it was asked for above");
        let mut said = self.read(BufReader::new(stdout), session.terminal)?;
        let status = child
            .wait()
            .map_err(|error| Refusal::bad(format!("cannot wait for cargo: {error}")))?;
        said.success = status.success();
        Ok(said)
    }

    fn read(&self, stdout: impl BufRead, terminal: &Terminal) -> Result<Said, Refusal> {
        let mut said = Said::default();
        for line in stdout.lines() {
            let line = line
                .map_err(|error| Refusal::bad(format!("cannot read what cargo says: {error}")))?;
            match serde_json::from_str::<Line>(&line) {
                Ok(line) if self.is_program(&line) => {
                    said.executable = line.executable.map(Utf8PathBuf::from);
                }
                Ok(line) => said.messages.extend(line.message),
                // A procedural macro or a wrapper printed something.
                Err(_) => terminal.note(&format!("{line}\n")),
            }
        }
        Ok(said)
    }

    fn is_program(&self, line: &Line) -> bool {
        let name = line.target.as_ref().map(|target| target.name.as_str());
        line.reason == "compiler-artifact" && line.executable.is_some() && name == self.program
    }
}

impl Said {
    /// What rustc found, brought home to the robot's own files.
    pub(super) fn diagnostics(
        &self,
        session: &Session<'_>,
        understood: &Understood,
    ) -> Result<Diagnostics, super::Failure> {
        let mut told = Diagnostics::new();
        let manifest = manifest::load(&session.workspace, &mut told)?;
        let home = Home {
            workspace: &session.workspace,
            manifest: &manifest,
            robot: &understood.robot,
            model: &model::describe(&understood.robot, &understood.schedule),
            files: &generate::render(&session.workspace, understood),
        };
        Ok(late::diagnose(&self.messages, &home))
    }
}

/// The generated package with these targets' binaries and nothing else.
fn arguments<'t>(
    deed: &str,
    robot: &Robot,
    targets: impl IntoIterator<Item = &'t Target>,
) -> Vec<OsString> {
    let package = package::library(robot);
    let mut arguments: Vec<String> = [deed, "--package", &package, "--no-default-features"]
        .map(str::to_owned)
        .to_vec();
    for target in targets {
        let feature = format!("target-{}", target.name);
        arguments.extend([
            "--bin".to_owned(),
            target.name.clone(),
            "--features".to_owned(),
            feature,
        ]);
    }
    arguments.into_iter().map(OsString::from).collect()
}

#[cfg(test)]
mod tests {
    use super::Request;
    use crate::arguments::Color;
    use crate::commands::terminal::Terminal;
    use crate::cross::Tools;
    use crate::graph::fixture;

    #[test]
    fn the_program_is_where_cargo_says() {
        let output = "\
{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"build-script-build\"},\"executable\":\"/t/build\"}
{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"simulated\"},\"executable\":null}
{\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"simulated\"},\"executable\":\"/t/simulated\"}
{\"reason\":\"build-finished\",\"success\":true}
";
        let robot = fixture::robot();
        let request = Request::build(&robot, &robot.targets[0], "dev", None);
        let said = request.read(output.as_bytes(), &Terminal::new(Color::Never));
        let executable = said.map(|said| said.executable);
        assert_eq!(executable, Ok(Some("/t/simulated".into())));
    }

    #[test]
    fn a_stand_in_for_cargo_gets_the_triple_and_its_linker() {
        let robot = fixture::robot();
        let mut request = Request::build(&robot, &robot.targets[0], "dev", None);
        let tools = Tools {
            zigbuild: "/tools/cargo-zigbuild".into(),
            zig: "/tools/zig".into(),
        };
        request.cross(&tools, "x86_64-unknown-linux-gnu.2.28");
        let end = &request.arguments[request.arguments.len() - 2..];
        assert_eq!(end, ["--target", "x86_64-unknown-linux-gnu.2.28"]);
        assert_eq!(request.stand_in, Some(tools.zigbuild));
        assert_eq!(request.variables[0].1, "/tools/zig");
    }

    #[test]
    fn symbols_are_left_out_where_the_program_is_compiled_and_nowhere_else() {
        let robot = fixture::robot();
        let mut request = Request::build(&robot, &robot.targets[0], "release", None);
        request.strip();
        assert_eq!(request.arguments[0], "rustc");
        assert_eq!(request.of_program, ["--", "-Cstrip=symbols"]);
        assert_eq!(request.variables, []);
    }

    #[test]
    fn a_target_is_built_with_its_feature_alone() {
        let robot = fixture::robot();
        let request = Request::build(&robot, &robot.targets[0], "dev", None);
        let arguments: Vec<_> = request
            .arguments
            .iter()
            .map(|argument| argument.to_string_lossy())
            .collect();
        let text = arguments.join(" ");
        for part in [
            "--package walker_runtime --no-default-features",
            "--bin simulated --features target-simulated",
            "--profile dev",
        ] {
            assert!(text.contains(part), "{text}");
        }
        assert!(!text.contains("target-nao"), "{text}");
    }
}
