//! A fixture robot in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use support::fixture_files;

use crate::{Ended, hulkgen};

pub(crate) struct Robot {
    folder: tempfile::TempDir,
}

impl Robot {
    /// A copy of `tests/robots/NAME`.
    pub(crate) fn new(name: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let robot = Self { folder };
        for (path, text) in fixture_files(name) {
            robot.write(&path, &text);
        }
        robot
    }

    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.folder().join(path)
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.path(path);
        fs::create_dir_all(path.parent().expect("it lies in a folder"))
            .expect("the folder is ours");
        fs::write(path, text).expect("the folder is ours");
    }

    pub(crate) fn read(&self, path: &str) -> String {
        let path = self.path(path);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// Replaces the only place where `from` stands.
    #[track_caller]
    pub(crate) fn edit(&self, path: &str, from: &str, to: &str) {
        let text = self.read(path);
        assert_eq!(text.matches(from).count(), 1, "`{from}` in {path}");
        self.write(path, &text.replace(from, to));
    }

    /// Calls of hulkgen in the robot's folder.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        hulkgen(self.folder(), arguments)
    }

    pub(crate) fn run(&self, arguments: &str) -> Ended {
        Ended::of(&mut self.command(arguments))
    }
}
