//! When the files of a workspace were changed last.

use std::collections::BTreeMap;
use std::fs;
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};

use super::Workspace;

/// Every file that may say something about the robot, as it was when somebody looked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Glance {
    files: BTreeMap<Utf8PathBuf, (Option<SystemTime>, u64)>,
}

impl Glance {
    /// Sources and tables in the workspace and in the packages that it names, now.
    pub fn at(workspace: &Workspace) -> Self {
        let outside = workspace.members().folders.iter();
        let outside = outside.filter(|folder| folder.starts_with(".."));
        let read = workspace.read_files();
        let mut files = workspace.files_below(Utf8Path::new(""));
        files.extend(outside.flat_map(|folder| workspace.files_below(folder)));
        files.retain(|file| matches!(file.extension(), Some("rs" | "toml")));
        files.extend(read);
        let now = files.into_iter().map(|file| {
            let metadata = fs::metadata(workspace.root().join(&file)).ok();
            let length = metadata.as_ref().map_or(0, fs::Metadata::len);
            let changed = metadata.and_then(|metadata| metadata.modified().ok());
            (file, (changed, length))
        });
        Self {
            files: now.collect(),
        }
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

#[cfg(test)]
mod tests;
