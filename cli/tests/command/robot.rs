//! A small robot in a folder of its own, and the built `hulkgen` in it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

pub(crate) struct Robot {
    folder: TempDir,
    /// For answers of earlier runs: every test is one of them, too.
    cache: TempDir,
}

const FILES: &[(&str, &str)] = &[
    (
        "Cargo.toml",
        "[workspace]\nresolver = \"3\"\nmembers = [\"nodes\"]\n",
    ),
    (
        "hulk.toml",
        r#"[robot]
name = "tiny"

[[cycler]]
name = "Control"
kind = "real-time"
setup_nodes = ["nodes::clock"]
nodes = ["nodes::counter"]

[[target]]
name = "simulated"
hardware = "nodes::Hardware"

[[target]]
name = "real"
hardware = "nodes::Hardware"
"#,
    ),
    ("parameters/default.toml", "step = 1\n"),
    (
        "nodes/Cargo.toml",
        "[package]\nname = \"nodes\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\nframework = \"*\"\nserde = \"*\"\n",
    ),
    (
        "nodes/src/lib.rs",
        "pub mod clock;\npub mod counter;\n\n/// Nothing to control.\npub struct Hardware;\n\nimpl framework::Hardware for Hardware {}\n",
    ),
    (
        "nodes/src/clock.rs",
        r#"//! Gives the pace.

use framework::{MainOutput, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Clock {
    count: u64,
}

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {}

#[context]
pub struct MainOutputs {
    pub ticks: MainOutput<u64>,
}

impl Clock {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self { count: 0 })
    }

    pub fn cycle(&mut self, _context: CycleContext) -> Result<MainOutputs> {
        self.count += 1;
        Ok(MainOutputs { ticks: self.count.into() })
    }
}
"#,
    ),
    (
        "nodes/src/counter.rs",
        r#"//! Counts in steps.

use framework::{Input, MainOutput, Parameter, PreviousInput, Result, context};
use serde::{Deserialize, Serialize};

#[derive(Deserialize, Serialize)]
pub struct Counter;

#[context]
pub struct CreationContext {}

#[context]
pub struct CycleContext {
    ticks: Input<u64, "ticks">,
    step: Parameter<u64, "step">,
    last: PreviousInput<u64, "count">,
}

#[context]
pub struct MainOutputs {
    pub count: MainOutput<u64>,
}

impl Counter {
    pub fn new(_context: CreationContext) -> Result<Self> {
        Ok(Self)
    }

    pub fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> {
        Ok(MainOutputs { count: (context.ticks + context.step + context.last).into() })
    }
}
"#,
    ),
];

impl Robot {
    /// Two nodes, no errors.
    pub(crate) fn tiny() -> Self {
        let robot = Self {
            folder: tempfile::tempdir().expect("a folder can be made"),
            cache: tempfile::tempdir().expect("a folder can be made"),
        };
        for (path, text) in FILES {
            robot.write(path, text);
        }
        robot
    }

    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The user's cache folder.
    pub(crate) fn cache(&self) -> &Path {
        self.cache.path()
    }

    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.folder().join(path)
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.path(path);
        let folder = path.parent().expect("a file lies in a folder");
        std::fs::create_dir_all(folder).expect("the folder can be made");
        std::fs::write(path, text).expect("the file can be written");
    }

    pub(crate) fn read(&self, path: &str) -> String {
        std::fs::read_to_string(self.path(path)).expect("the file can be read")
    }

    /// Every file, by its place in the folder, with its content.
    pub(crate) fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut found = BTreeMap::new();
        let mut folders = vec![self.folder().to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder).expect("the folder can be read") {
                let path = entry.expect("the folder can be read").path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let place = path.strip_prefix(self.folder()).expect("it lies in it");
                    // It may be a temporary file that has just gone.
                    let text = std::fs::read(&path).ok();
                    found.extend(text.map(|text| (place.to_owned(), text)));
                }
            }
        }
        found
    }

    /// Replaces the only place where `from` stands.
    pub(crate) fn edit(&self, path: &str, from: &str, to: &str) {
        let text = self.read(path);
        assert_eq!(text.matches(from).count(), 1, "`{from}` in {path}");
        self.write(path, &text.replace(from, to));
    }

    /// `hulkgen` in the robot's folder.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = hulkgen(arguments);
        command
            .current_dir(self.folder())
            .env("XDG_CACHE_HOME", self.cache());
        command
    }

    pub(crate) fn run(&self, arguments: &str) -> Ended {
        Ended::of(&mut self.command(arguments))
    }
}

/// `hulkgen` with these words, in no robot's folder.
pub(crate) fn hulkgen(arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hulkgen"));
    command
        .args(arguments.split_whitespace())
        .current_dir(std::env::temp_dir())
        .env_remove("NO_COLOR")
        .stdin(Stdio::null());
    command
}

pub(crate) struct Ended {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Ended {
    pub(crate) fn of(command: &mut Command) -> Self {
        Self::from(command.output().expect("hulkgen was built"))
    }

    pub(crate) fn from(output: Output) -> Self {
        let Output {
            status,
            stdout,
            stderr,
        } = output;
        let text = |bytes| String::from_utf8(bytes).expect("hulkgen prints UTF-8");
        Self {
            status: status.code(),
            stdout: text(stdout),
            stderr: text(stderr),
        }
    }

    /// Shows everything if the status is another.
    #[track_caller]
    pub(crate) fn expect(self, status: i32) -> Self {
        let Self { stdout, stderr, .. } = &self;
        assert_eq!(
            self.status,
            Some(status),
            "stdout:\n{stdout}\nstderr:\n{stderr}"
        );
        self
    }
}
