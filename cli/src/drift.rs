//! The door out: the only part of hulkgen that writes files of the robot's workspace.
//!
//! Compares what would be written with what is there. Unchanged files are not touched, so that
//! cargo builds nothing again; changed ones are replaced whole or not at all.
//!
//! Invariant: the generated folder has one owner. Everything in it that nobody writes is an orphan
//! and goes, except for what cargo puts there (`target/`, `Cargo.lock`). A folder with files of which none says that
//! hulkgen wrote it is somebody else's, and nothing in it is touched.

mod content;
mod disk;
mod transaction;
mod turn;

use std::fmt::Write as _;
use std::io;

use camino::{Utf8Path, Utf8PathBuf};
use similar::TextDiff;

use crate::render::GeneratedFiles;
use crate::workspace::{Changes, says_generated};

pub use content::Content;
pub use disk::write_file;
pub use transaction::{write_all, write_all_asking, write_all_in};
pub use turn::Turn;

/// Files of a folder of its own that are not hulkgen's.
const MARKS_OF_OTHERS: [&str; 2] = ["hulk.toml", ".git"];

/// How the disk differs from what would be written. Paths are relative to the workspace root, sorted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Drift {
    /// Files that are not there yet.
    pub added: Vec<Utf8PathBuf>,
    pub changed: Vec<Changed>,
    /// Files in the generated folder that nobody writes.
    pub orphaned: Vec<Utf8PathBuf>,
}

/// A file that says something else.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Changed {
    pub path: Utf8PathBuf,
    /// What it says now; characters that are no UTF-8 are replaced.
    pub before: String,
    pub after: String,
}

/// A file or folder that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum DriftError {
    /// What was to be done, and why it could not be.
    #[error("cannot {deed} `{path}`: {source}")]
    Io {
        deed: &'static str,
        path: Utf8PathBuf,
        source: io::Error,
    },
    /// Orphans would be removed from a folder that belongs to somebody else.
    #[error("`{folder}` cannot be the generated folder: {reason}")]
    NotOwned { folder: Utf8PathBuf, reason: String },
    /// Somebody else has changed a file since it was read.
    #[error("`{path}` was changed meanwhile")]
    Meanwhile { path: Utf8PathBuf },
    /// One of several files could not be written, and what was written before could not be taken back.
    #[error("{error}; what was written before could not be taken back: {left}")]
    NotUndone {
        error: Box<DriftError>,
        left: Box<DriftError>,
    },
}

impl Drift {
    /// Compares the files with the disk; `folder` is the generated folder, relative to the root.
    pub fn compare(
        root: &Utf8Path,
        folder: &Utf8Path,
        files: &GeneratedFiles,
    ) -> Result<Self, DriftError> {
        // Another hulkgen may be half-way through.
        Self::compare_in(&Turn::wait_for(root)?, folder, files)
    }

    /// As [`Self::compare`], in a turn that somebody has already.
    pub fn compare_in(
        turn: &Turn,
        folder: &Utf8Path,
        files: &GeneratedFiles,
    ) -> Result<Self, DriftError> {
        let root = turn.root();
        own(root, folder)?;
        let there = disk::files(root, folder)?;
        recognize(root, folder, &there, files)?;
        let mut drift = Self::default();
        for (path, after) in files {
            match disk::read(&root.join(path))? {
                None => drift.added.push(path.clone()),
                Some(before) if before == after.as_bytes() => {}
                Some(before) => drift.changed.push(Changed {
                    path: path.clone(),
                    before: String::from_utf8_lossy(&before).into_owned(),
                    after: after.clone(),
                }),
            }
        }
        drift.orphaned = there
            .into_iter()
            .filter(|path| !files.contains_key(path))
            .collect();
        Ok(drift)
    }

    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        self.added.is_empty() && self.changed.is_empty() && self.orphaned.is_empty()
    }

    /// Writes what differs and removes orphans, or changes nothing. The drift must be of the same root and files.
    pub fn write(&self, root: &Utf8Path, files: &GeneratedFiles) -> Result<(), DriftError> {
        write_all(root, &self.changes(files))
    }

    /// What has to be written and removed. The drift must be of the same files.
    pub fn changes(&self, files: &GeneratedFiles) -> Changes {
        let changed = self.changed.iter().map(|changed| &changed.path);
        let written = self.added.iter().chain(changed);
        let written =
            written.filter_map(|path| Some((path.clone(), Some(files.get(path)?.clone()))));
        let removed = self.orphaned.iter().map(|path| (path.clone(), None));
        written.chain(removed).collect()
    }

    /// Everything that differs: a unified diff for each changed file, the names of all others.
    pub fn diff(&self) -> String {
        let mut text = String::new();
        for Changed {
            path,
            before,
            after,
        } in &self.changed
        {
            let diff = TextDiff::from_lines(before, after);
            let (old, new) = (format!("a/{path}"), format!("b/{path}"));
            let _ = write!(
                text,
                "{}",
                diff.unified_diff().context_radius(3).header(&old, &new)
            );
        }
        for path in &self.added {
            let _ = writeln!(text, "missing: {path}");
        }
        for path in &self.orphaned {
            let _ = writeln!(text, "orphaned: {path}");
        }
        text
    }

    /// What differs, one file a line: `+` missing, `~` changed, `-` orphaned.
    pub fn summary(&self) -> String {
        let mut lines: Vec<(&Utf8PathBuf, char)> = Vec::new();
        lines.extend(self.added.iter().map(|path| (path, '+')));
        lines.extend(self.changed.iter().map(|changed| (&changed.path, '~')));
        lines.extend(self.orphaned.iter().map(|path| (path, '-')));
        lines.sort();
        lines
            .into_iter()
            .map(|(path, mark)| format!("{mark} {path}\n"))
            .collect()
    }
}

/// Only a folder of its own below the root may be cleaned.
fn own(root: &Utf8Path, folder: &Utf8Path) -> Result<(), DriftError> {
    let not_owned = |reason: String| DriftError::NotOwned {
        folder: folder.to_owned(),
        reason,
    };
    let below = folder
        .components()
        .all(|part| matches!(part, camino::Utf8Component::Normal(_)));
    if folder.as_str().is_empty() || !below {
        return Err(not_owned(
            "it is no folder below the workspace root".to_owned(),
        ));
    }
    let found = MARKS_OF_OTHERS
        .iter()
        .find(|mark| root.join(folder).join(mark).exists());
    found.map_or(Ok(()), |mark| {
        Err(not_owned(format!("there is `{mark}` in it")))
    })
}

/// A folder with files is hulkgen's if one of those it would write there says so, perhaps between conflict marks.
fn recognize(
    root: &Utf8Path,
    folder: &Utf8Path,
    there: &[Utf8PathBuf],
    files: &GeneratedFiles,
) -> Result<(), DriftError> {
    for path in there.iter().filter(|path| files.contains_key(*path)) {
        let text = disk::read(&root.join(path))?.unwrap_or_default();
        if says_generated(&String::from_utf8_lossy(&text)) {
            return Ok(());
        }
    }
    there.first().map_or(Ok(()), |first| {
        Err(DriftError::NotOwned {
            folder: folder.to_owned(),
            reason: format!("it has files that hulkgen did not write, such as `{first}`"),
        })
    })
}

#[cfg(test)]
mod tests;
