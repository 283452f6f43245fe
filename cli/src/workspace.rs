//! The door in: the only part of hulkgen that reads files of the robot's workspace.
//!
//! Paths are relative to the workspace root and use `/`. Every text that was read is kept, so that diagnostics can show
//! it later, also if the file has changed meanwhile.
//!
//! Invariant: the generated crate is never looked at to understand the robot, so it may be missing or hold anything.

mod asked;
mod changes;
mod disk;
mod glob;
mod links;
mod members;
mod memory;
mod parsed;
mod profiles;
mod revision;
mod watch;

use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use disk::Disk;
use memory::Memory;
use parsed::Parsed;

pub use asked::Answers;
pub use changes::Changes;
pub(crate) use disk::content_of;
pub use links::BrokenLink;
pub use members::{BrokenPackage, Member, Members, OF_GENERATED, Origin};
pub(crate) use members::{normalized, package_table, relative};
pub use revision::{Missing, RevisionError};
pub use watch::{Asked, Glance};

/// Name of the manifest at the workspace root.
pub const MANIFEST: &str = "hulk.toml";

/// The folder at a workspace's root in which each run has its own.
pub const RUNS: &str = "runs";

/// The byte order mark, which some editors write.
const MARK: char = '\u{feff}';

/// How the header of every generated file begins, whatever the version of hulkgen.
pub const SIGNATURE: &str = "Written by `hulkgen generate`";

/// Whether a file says that hulkgen wrote it.
pub fn says_generated(text: &str) -> bool {
    text.contains(SIGNATURE)
}

/// A robot's workspace, on disk or in memory.
#[derive(Debug)]
pub struct Workspace {
    files: Files,
    /// What is taken to be written already.
    changes: Changes,
    texts: RefCell<BTreeMap<Utf8PathBuf, Arc<str>>>,
    /// Files that begin with a byte order mark, which their texts do not have.
    marked: RefCell<BTreeSet<Utf8PathBuf>>,
    parsed: Parsed,
    members: OnceCell<Members>,
}

#[derive(Clone, Debug)]
enum Files {
    Disk(Disk),
    Memory(Memory),
}

/// A file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot read `{file}`: {reason}")]
pub struct ReadError {
    /// Relative to the workspace root.
    pub file: Utf8PathBuf,
    pub reason: String,
    /// The file does not exist, as opposed to one that exists and cannot be read.
    pub missing: bool,
}

/// There is no robot here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no `hulk.toml` in `{start}` or any folder above it")]
pub struct NoManifest {
    pub start: Utf8PathBuf,
}

impl ReadError {
    fn missing(file: &Utf8Path) -> Self {
        Self {
            file: file.to_owned(),
            reason: "no such file".to_owned(),
            missing: true,
        }
    }
}

impl Workspace {
    /// The workspace whose `hulk.toml` lies in `start` or the nearest folder above it.
    pub fn open(start: &Utf8Path) -> Result<Self, NoManifest> {
        let disk = Disk::above(start, MANIFEST).ok_or_else(|| NoManifest {
            start: start.to_owned(),
        })?;
        Ok(Self::new(Files::Disk(disk)))
    }

    /// The workspace whose root is this folder, whether it has a manifest or not.
    pub fn at_root(root: &Utf8Path) -> Self {
        Self::new(Files::Disk(Disk::new(root)))
    }

    /// A workspace of these files, for tests; paths are relative to its root.
    pub fn in_memory<P, T>(files: impl IntoIterator<Item = (P, T)>) -> Self
    where
        P: Into<Utf8PathBuf>,
        T: Into<String>,
    {
        Self::new(Files::Memory(Memory::new(files)))
    }

    /// This workspace as it was in a git revision.
    pub fn at_revision(&self, revision: &str) -> Result<Self, RevisionError> {
        let files = revision::load(self.root(), revision)?;
        Ok(Self::new(Files::Memory(files)))
    }

    /// This workspace as it would be after some changes, of which nothing is written.
    ///
    /// Files that were read before are kept as they were read, and those that stay are not parsed again.
    #[must_use]
    pub fn after(&self, changes: &Changes) -> Self {
        let mut all = self.changes.clone();
        all.extend(changes.clone());
        let mut texts = self.texts.borrow().clone();
        texts.retain(|file, _| !all.contains_key(file));
        Self {
            files: self.files.clone(),
            changes: all,
            texts: RefCell::new(texts),
            marked: self.marked.clone(),
            parsed: self.parsed.clone(),
            members: OnceCell::new(),
        }
    }

    fn new(files: Files) -> Self {
        Self {
            files,
            changes: Changes::default(),
            texts: RefCell::default(),
            marked: RefCell::default(),
            parsed: Parsed::default(),
            members: OnceCell::new(),
        }
    }

    /// The root folder; empty for a workspace that only ever was in memory.
    pub fn root(&self) -> &Utf8Path {
        match &self.files {
            Files::Disk(disk) => disk.root(),
            Files::Memory(memory) => memory.root(),
        }
    }

    /// The text of a file without byte order mark, read once.
    pub fn read(&self, file: &Utf8Path) -> Result<Arc<str>, ReadError> {
        if let Some(text) = self.text(file) {
            return Ok(text);
        }
        let text = match (self.changes.get(file), &self.files) {
            (Some(Some(text)), _) => Ok(text.as_str().into()),
            (Some(None), _) => Err(ReadError::missing(file)),
            (None, Files::Disk(disk)) => disk.read(file),
            (None, Files::Memory(memory)) => memory.read(file),
        }?;
        // Not every parser counts it, so places would not fit each other.
        let text = match text.strip_prefix(MARK) {
            Some(unmarked) => {
                self.marked.borrow_mut().insert(file.to_owned());
                unmarked.into()
            }
            None => text,
        };
        self.texts
            .borrow_mut()
            .insert(file.to_owned(), text.clone());
        Ok(text)
    }

    /// The text of a file that was read before, as it was then.
    pub fn text(&self, file: &Utf8Path) -> Option<Arc<str>> {
        self.texts.borrow().get(file).cloned()
    }

    /// Has to be called before the files of a robot are parsed: [`Self::parsed`] gives what was parsed since.
    pub(crate) fn begin_parsing(&self) {
        self.parsed.begin();
    }

    /// A Rust file that this workspace, or one that this is made [`after`](Self::after), has parsed with this text.
    pub(crate) fn parsed(&self, file: &Utf8Path, text: &str) -> Option<Rc<syn::File>> {
        self.parsed.get(file, text)
    }

    /// Keeps a file that was parsed.
    pub(crate) fn keep_parsed(&self, file: &Utf8Path, text: &Arc<str>, syntax: &Rc<syn::File>) {
        self.parsed.keep(file, text, syntax);
    }

    /// The new text of a file with the byte order mark that the file had when it was read.
    pub fn marked(&self, file: &Utf8Path, text: String) -> String {
        match self.marked.borrow().contains(file) {
            true => format!("{MARK}{text}"),
            false => text,
        }
    }

    /// What the files of some changes said when they were read, in the form of changes; `None` where none was there.
    pub fn as_read(&self, changes: &Changes) -> Changes {
        let said = |file: &Utf8PathBuf| {
            let text = self.text(file)?;
            Some(self.marked(file, text.to_string()))
        };
        let files = changes.keys();
        files.map(|file| (file.clone(), said(file))).collect()
    }

    /// Every file that was read so far, sorted: what the answer depends on.
    pub fn read_files(&self) -> Vec<Utf8PathBuf> {
        self.texts.borrow().keys().cloned().collect()
    }

    /// Whether every file that was read says the same now.
    pub fn is_as_read(&self) -> bool {
        let now = Self::new(self.files.clone());
        let read = self.texts.borrow();
        read.iter()
            .all(|(file, text)| now.read(file).is_ok_and(|now| now == *text))
    }

    /// Every question to the disk so far with its answer: what hulkgen's own answer depends on, and nothing else.
    ///
    /// `None` where the files do not lie on the disk as they are, or changed between two questions.
    pub fn answers(&self) -> Option<Answers> {
        match &self.files {
            Files::Disk(disk) if self.changes.is_empty() => disk.answers(),
            Files::Disk(_) | Files::Memory(_) => None,
        }
    }

    /// Whether the disk gives these answers now.
    pub fn still_answers(&self, answers: &Answers) -> bool {
        match &self.files {
            Files::Disk(disk) if self.changes.is_empty() => disk.still_answers(answers),
            Files::Disk(_) | Files::Memory(_) => false,
        }
    }

    /// Whether two paths lead to one file, also through links.
    pub fn is_same_file(&self, one: &Utf8Path, other: &Utf8Path) -> bool {
        let canonical = |file: &Utf8Path| match &self.files {
            Files::Disk(disk) => disk.canonical(file).unwrap_or_else(|| normalized(file)),
            Files::Memory(memory) => memory.canonical(file),
        };
        one == other || canonical(one) == canonical(other)
    }

    /// Whether this is a file.
    pub fn is_file(&self, file: &Utf8Path) -> bool {
        match (self.changes.get(file), &self.files) {
            (Some(change), _) => change.is_some(),
            (None, Files::Disk(disk)) => disk.is_file(file),
            (None, Files::Memory(memory)) => memory.is_file(file),
        }
    }

    /// Files and folders directly in a folder, sorted; none if there is no such folder.
    pub fn list(&self, folder: &Utf8Path) -> Vec<Utf8PathBuf> {
        let found = match &self.files {
            Files::Disk(disk) => disk.list(folder),
            Files::Memory(memory) => memory.list(folder),
        };
        changes::list(&self.changes, folder, found)
    }

    /// Every file in a folder and below, sorted; not what cargo builds, what is hidden, and what a link to a folder leads to:
    /// links may lead in circles.
    pub fn files_below(&self, folder: &Utf8Path) -> Vec<Utf8PathBuf> {
        let is_own = |entry: &Utf8PathBuf| {
            let name = entry.file_name().unwrap_or_default();
            name != "target" && !name.starts_with('.')
        };
        let mut found = Vec::new();
        for entry in self.list(folder).into_iter().filter(is_own) {
            if self.is_file(&entry) {
                found.push(entry);
            } else if !self.is_link(&entry) {
                found.extend(self.files_below(&entry));
            }
        }
        found
    }

    fn is_link(&self, entry: &Utf8Path) -> bool {
        match &self.files {
            Files::Disk(disk) => disk.is_link(entry),
            Files::Memory(memory) => memory.is_link(entry),
        }
    }

    /// The first link of a git revision that was followed in vain.
    pub fn broken_link(&self) -> Option<BrokenLink> {
        match &self.files {
            Files::Disk(_) => None,
            Files::Memory(memory) => memory.broken_link(),
        }
    }

    /// A path from the root of cargo's workspace as one from the robot's.
    pub fn below_cargo_root(&self, file: &Utf8Path) -> Utf8PathBuf {
        if file.is_absolute() {
            return file.to_owned();
        }
        relative(&self.members().own, file)
    }

    /// The packages of the workspace and what the root says about dependencies, read once and without cargo.
    pub fn members(&self) -> &Members {
        self.members.get_or_init(|| Members::read(self))
    }
}

#[cfg(test)]
mod tests;
