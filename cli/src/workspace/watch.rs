//! When the files of a workspace were changed last.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};

use super::asked::Question;
use super::{Files, Workspace};

/// What was asked for where nobody would look: outside of the workspace, and behind links.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    files: BTreeSet<Utf8PathBuf>,
    folders: BTreeSet<Utf8PathBuf>,
}

/// Every file that may say something about the robot, as it was when somebody looked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Glance {
    files: BTreeMap<Utf8PathBuf, (Option<SystemTime>, u64)>,
}

impl Asked {
    /// Of this workspace so far: files that were read or might have been, and folders.
    pub fn of(workspace: &Workspace) -> Self {
        let mut asked = Self::default();
        let Files::Disk(disk) = &workspace.files else {
            return asked;
        };
        for (question, path) in disk.asked() {
            match question {
                Question::Read => drop(asked.files.insert(path)),
                Question::IsFile if is_ours(&path) => drop(asked.files.insert(path)),
                Question::List => drop(asked.folders.insert(path)),
                Question::IsFile | Question::IsLink | Question::Canonical => {}
            }
        }
        asked
    }
}

impl Glance {
    /// Sources and tables in the workspace, in the packages that it names, and where somebody asked for them, now.
    pub fn at(workspace: &Workspace, asked: &Asked) -> Self {
        let outside = workspace.members().folders.iter();
        let outside = outside.filter(|folder| folder.starts_with(".."));
        let read = workspace.read_files();
        let mut files = workspace.files_below(Utf8Path::new(""));
        files.extend(outside.flat_map(|folder| workspace.files_below(folder)));
        files.extend(
            asked
                .folders
                .iter()
                .flat_map(|folder| workspace.list(folder)),
        );
        files.retain(|file| is_ours(file));
        files.extend(read);
        files.extend(asked.files.iter().cloned());
        let now = files.into_iter().map(|file| {
            let metadata = fs::metadata(workspace.root().join(&file)).ok();
            let metadata = metadata.filter(fs::Metadata::is_file);
            let length = metadata.as_ref().map_or(0, fs::Metadata::len);
            let changed = metadata.and_then(|metadata| metadata.modified().ok());
            (file, (changed, length))
        });
        Self {
            files: now.collect(),
        }
    }

    /// With what somebody else saw and this glance did not.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        for (file, state) in other.files {
            self.files.entry(file).or_insert(state);
        }
        self
    }

    /// Whether this is how things still are, whatever happened in the folder `except`.
    pub fn is_as(&self, earlier: &Self, except: Option<&Utf8Path>) -> bool {
        let others = |glance: &Self| {
            let files = glance.files.iter();
            let others = files
                .filter(|(file, (changed, _))| {
                    // What is gone and what was never there is the same.
                    changed.is_some() && !except.is_some_and(|except| file.starts_with(except))
                })
                .map(|(file, state)| (file.clone(), *state));
            others.collect::<BTreeMap<_, _>>()
        };
        others(self) == others(earlier)
    }
}

fn is_ours(file: &Utf8Path) -> bool {
    matches!(file.extension(), Some("rs" | "toml"))
}

#[cfg(test)]
mod tests;
