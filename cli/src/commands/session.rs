//! One robot's workspace with what was found in it, as long as a command runs.

use camino::{Utf8Path, Utf8PathBuf};

use super::terminal::Terminal;
use crate::arguments::Global;
use crate::cache::Cache;
use crate::diagnostics::{self, Diagnostics, Reported};
use crate::outcome::Refusal;
use crate::pipeline::{self, Understood};
use crate::workspace::{MANIFEST, RUNS, Workspace};

pub(super) struct Session<'a> {
    pub(super) workspace: Workspace,
    pub(super) diagnostics: Diagnostics,
    pub(super) terminal: &'a Terminal,
    /// Answers of earlier runs; none unless the command asks for them.
    pub(super) cache: Cache,
}

impl<'a> Session<'a> {
    /// The workspace that `--manifest` names, or the one around the current folder.
    pub(super) fn open(global: &Global, terminal: &'a Terminal) -> Result<Self, Refusal> {
        let workspace = match &global.manifest {
            Some(path) => Workspace::at_root(&root_of(path)?),
            None => {
                let current = std::env::current_dir().map_err(|error| {
                    Refusal::bad(format!("cannot tell the current folder: {error}"))
                })?;
                let current = Utf8PathBuf::try_from(current).map_err(|error| {
                    Refusal::bad(format!("the current folder's name is no UTF-8: {error}"))
                })?;
                Workspace::open(&current).map_err(|error| {
                    Refusal::bad(error.to_string())
                        .help("go to the folder of a robot, or name it with `--manifest PATH`")
                })?
            }
        };
        Ok(Self {
            workspace,
            diagnostics: Diagnostics::new(),
            terminal,
            cache: Cache::none(),
        })
    }

    /// The folder of the robot's runs, by a path that leads there from the current folder.
    pub(super) fn runs(&self) -> Utf8PathBuf {
        let root = self.workspace.root();
        match std::env::current_dir() {
            Ok(current) if current == root => RUNS.into(),
            _ => root.join(RUNS),
        }
    }

    /// From now on answers are kept, and taken from earlier runs.
    pub(super) fn use_cache(&mut self) {
        self.cache = Cache::of_user(self.workspace.root());
    }

    /// Stages ① to ④.
    pub(super) fn understand(&mut self) -> Result<Understood, Reported> {
        pipeline::understand(&self.workspace, &mut self.diagnostics)
    }

    /// Prints every diagnostic as text to stderr.
    pub(super) fn note_diagnostics(&self) {
        self.terminal.note(&self.rendered_diagnostics());
    }

    /// Every diagnostic as text for stderr.
    pub(super) fn rendered_diagnostics(&self) -> String {
        let color = self.terminal.colors_notes();
        diagnostics::render(&self.diagnostics, &self.workspace, color)
    }
}

/// The folder of the manifest at `path`, which is the file or its folder.
fn root_of(path: &Utf8Path) -> Result<Utf8PathBuf, Refusal> {
    let root = if path.is_dir() {
        path
    } else if path.file_name() == Some(MANIFEST) {
        path.parent()
            .filter(|parent| !parent.as_str().is_empty())
            .unwrap_or(Utf8Path::new("."))
    } else {
        let message = format!("`{path}` is neither a folder nor a file named `{MANIFEST}`");
        return Err(Refusal::wrong_usage(message));
    };
    if !root.join(MANIFEST).is_file() {
        return Err(Refusal::bad(format!(
            "there is no `{MANIFEST}` in `{root}`"
        )));
    }
    root.canonicalize_utf8()
        .map_err(|error| Refusal::bad(format!("cannot open the folder `{root}`: {error}")))
}
