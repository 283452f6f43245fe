//! Several files written as one: all of them, or none.

use std::fs;
use std::io;

use camino::{Utf8Path, Utf8PathBuf};

use super::{DriftError, Turn, disk};
use crate::interrupt;
use crate::workspace::Changes;

/// Writes every change, or restores what was there and says why.
///
/// Two hulkgens at once write one after the other. A signal that would end this one waits until all is written. Paths are relative to `root`; folders that are needed are created, folders that become empty are removed.
pub fn write_all(root: &Utf8Path, changes: &Changes) -> Result<(), DriftError> {
    write_all_asking(root, changes, |_| Ok(()))
}

/// As [`write_all`], in a turn that somebody has already, if every file of `read` still says what it said when it was read.
///
/// Editors wait for no turn: what they have saved since is not written over.
pub fn write_all_in(turn: &Turn, changes: &Changes, read: &Changes) -> Result<(), DriftError> {
    for (path, text) in read {
        let now = Before::read(&turn.root().join(path))?;
        now.expect(path, text)?;
    }
    interrupt::postpone(|| write(turn, changes, read, |_| Ok(())))
}

/// As [`write_all`]; `permit` is asked before each file is touched and may fail in the place of the disk.
pub fn write_all_asking(
    root: &Utf8Path,
    changes: &Changes,
    permit: impl FnMut(&Utf8Path) -> io::Result<()>,
) -> Result<(), DriftError> {
    let turn = Turn::wait_for(root)?;
    interrupt::postpone(|| write(&turn, changes, &Changes::new(), permit))
}

fn write(
    turn: &Turn,
    changes: &Changes,
    read: &Changes,
    mut permit: impl FnMut(&Utf8Path) -> io::Result<()>,
) -> Result<(), DriftError> {
    let mut done = Done {
        root: turn.root(),
        read,
        files: Vec::new(),
        folders: Vec::new(),
    };
    // What goes makes room: a folder may come where a file was.
    let (removed, written): (Vec<_>, Vec<_>) = changes.iter().partition(|(_, text)| text.is_none());
    for (path, text) in removed.into_iter().chain(written) {
        let permitted = permit(path).map_err(|source| disk::failed("write", path, source));
        let result = permitted.and_then(|()| done.change(path, text.as_deref()));
        if let Err(error) = result {
            return Err(match done.undo() {
                Ok(()) => error,
                Err(left) => DriftError::NotUndone {
                    error: Box::new(error),
                    left: Box::new(left),
                },
            });
        }
    }
    Ok(())
}

/// What was changed so far, and what was there before.
struct Done<'a> {
    root: &'a Utf8Path,
    /// What files have to say still.
    read: &'a Changes,
    files: Vec<(Utf8PathBuf, Before)>,
    /// Folders that were not there before, outer ones first.
    folders: Vec<Utf8PathBuf>,
}

/// What was in a place.
#[derive(PartialEq, Eq)]
enum Before {
    Nothing,
    File(Vec<u8>),
    /// It goes alone, and not what it leads to, which may be a folder or nowhere.
    Link(Utf8PathBuf),
}

impl Before {
    fn read(file: &Utf8Path) -> Result<Self, DriftError> {
        let content = disk::read(file)?;
        Ok(content.map_or(Self::Nothing, Self::File))
    }

    /// As [`Self::read`], of what is to be removed.
    fn read_itself(file: &Utf8Path) -> Result<Self, DriftError> {
        if !file.is_symlink() {
            return Self::read(file);
        }
        let target = file.read_link_utf8();
        target
            .map(Self::Link)
            .map_err(|source| disk::failed("read", file, source))
    }

    /// Whether it is what was read: this text, or nothing.
    fn expect(&self, path: &Utf8Path, text: &Option<String>) -> Result<(), DriftError> {
        let is_same = match (self, text) {
            (Self::Nothing, None) => true,
            (Self::File(now), Some(text)) => now == text.as_bytes(),
            // It leads to what was read, and goes alone.
            (Self::Link(_), Some(_)) => true,
            _ => false,
        };
        match is_same {
            true => Ok(()),
            false => Err(DriftError::Meanwhile {
                path: path.to_owned(),
            }),
        }
    }

    /// Where something else is now.
    fn restore(&self, file: &Utf8Path) -> Result<(), DriftError> {
        let restored = match self {
            Self::Nothing => fs::remove_file(file),
            Self::File(content) => return disk::write_bytes(file, content),
            Self::Link(target) => {
                let folder = file.parent().unwrap_or(Utf8Path::new("."));
                fs::create_dir_all(folder).and_then(|()| std::os::unix::fs::symlink(target, file))
            }
        };
        restored.map_err(|source| disk::failed("restore", file, source))
    }
}

impl Done<'_> {
    fn change(&mut self, path: &Utf8Path, text: Option<&str>) -> Result<(), DriftError> {
        let file = self.root.join(path);
        let Some(text) = text else {
            let before = Before::read_itself(&file)?;
            self.expect(path, &before)?;
            if before == Before::Nothing {
                return Ok(());
            }
            self.files.push((path.to_owned(), before));
            return disk::remove(self.root, path);
        };
        let before = Before::read(&file)?;
        if before == Before::File(text.as_bytes().to_vec()) {
            // Also where it is another path of a file that has just been written.
            return Ok(());
        }
        self.expect(path, &before)?;
        self.folders.extend(missing_folders(&file));
        self.files.push((path.to_owned(), before));
        disk::write_bytes(&file, text.as_bytes())
    }

    /// Once more, right before the file is touched.
    fn expect(&self, path: &Utf8Path, before: &Before) -> Result<(), DriftError> {
        let read = self.read.get(path);
        read.map_or(Ok(()), |text| before.expect(path, text))
    }

    /// Restores everything that can be restored; the first failure is told.
    fn undo(self) -> Result<(), DriftError> {
        let mut first = Ok(());
        for (path, before) in self.files.iter().rev() {
            let file = self.root.join(path);
            let now = match before {
                Before::Link(_) => Before::read_itself(&file),
                Before::Nothing | Before::File(_) => Before::read(&file),
            };
            let is_restored = now.is_ok_and(|now| now == *before);
            if !is_restored {
                first = first.and(before.restore(&file));
            }
        }
        for folder in self.folders.iter().rev() {
            // It stays if somebody else has put something there meanwhile.
            let _ = fs::remove_dir(folder);
        }
        first
    }
}

/// Folders above a file that have to be created, outer ones first.
fn missing_folders(file: &Utf8Path) -> Vec<Utf8PathBuf> {
    let above = file.ancestors().skip(1);
    let mut missing: Vec<Utf8PathBuf> = above
        .take_while(|folder| !folder.as_str().is_empty() && !folder.exists())
        .map(Utf8Path::to_owned)
        .collect();
    missing.reverse();
    missing
}
