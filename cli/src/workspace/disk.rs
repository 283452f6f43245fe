//! A workspace on disk.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use super::ReadError;
use super::asked::{Answers, Asked, Question};
use crate::digest::Digest;

/// Bytes; what people write themselves is far smaller, and a larger file would be read for minutes.
const LARGEST: u64 = 4 << 20;

/// Of a file that may be anywhere and of any size, such as a program that was built; `None` if it cannot be read.
pub(crate) fn content_of(file: &Utf8Path) -> Option<Digest> {
    fs::read(file).ok().map(|bytes| Digest::of(&bytes))
}

/// Files below one folder.
#[derive(Clone, Debug)]
pub(super) struct Disk {
    root: Utf8PathBuf,
    asked: Asked,
    folders: RefCell<Folders>,
}

/// Folders with every link followed: for each the disk looks at all folders above it.
type Folders = BTreeMap<Utf8PathBuf, Option<Utf8PathBuf>>;

impl Disk {
    pub(super) fn new(root: &Utf8Path) -> Self {
        Self {
            root: root.to_owned(),
            asked: Asked::default(),
            folders: RefCell::default(),
        }
    }

    /// The nearest folder, from `start` upwards, that has this file.
    pub(super) fn above(start: &Utf8Path, file: &str) -> Option<Self> {
        let absolute = camino::absolute_utf8(start).ok()?;
        let mut folders = absolute.ancestors();
        let root = folders.find(|folder| folder.join(file).is_file())?;
        Some(Self::new(root))
    }

    pub(super) fn root(&self) -> &Utf8Path {
        &self.root
    }

    pub(super) fn read(&self, file: &Utf8Path) -> Result<Arc<str>, ReadError> {
        let bytes = self.bytes(file);
        self.asked.note(Question::Read, file, of_content(&bytes));
        match String::from_utf8(bytes?) {
            Ok(text) => Ok(text.into()),
            Err(error) => {
                let byte = error.utf8_error().valid_up_to();
                let line = error.as_bytes()[..byte]
                    .split(|byte| *byte == b'\n')
                    .count();
                Err(refused(
                    file,
                    format!("line {line} is no UTF-8; save it as UTF-8"),
                ))
            }
        }
    }

    /// What the file is called when every link on the way is followed.
    pub(super) fn canonical(&self, file: &Utf8Path) -> Option<Utf8PathBuf> {
        let path = self.canonical_among(file, &mut self.folders.borrow_mut());
        self.asked.note(Question::Canonical, file, of_path(&path));
        path
    }

    pub(super) fn is_file(&self, file: &Utf8Path) -> bool {
        let is_file = self.root.join(file).is_file();
        self.asked.note(Question::IsFile, file, of_fact(is_file));
        is_file
    }

    pub(super) fn is_link(&self, entry: &Utf8Path) -> bool {
        let is_link = self.root.join(entry).is_symlink();
        self.asked.note(Question::IsLink, entry, of_fact(is_link));
        is_link
    }

    pub(super) fn list(&self, folder: &Utf8Path) -> Vec<Utf8PathBuf> {
        let names = self.names(folder);
        self.asked.note(Question::List, folder, of_names(&names));
        names.iter().map(|name| folder.join(name)).collect()
    }

    /// Every path that was asked for, with what was asked.
    pub(super) fn asked(&self) -> Vec<(Question, Utf8PathBuf)> {
        self.asked.paths()
    }

    /// Everything that was asked; `None` if one question had two answers.
    pub(super) fn answers(&self) -> Option<Answers> {
        self.asked.answers()
    }

    /// Whether every question has the same answer now.
    pub(super) fn still_answers(&self, answers: &Answers) -> bool {
        let mut folders = Folders::new();
        answers.0.iter().all(|(question, path, answer)| {
            let full = self.root.join(path);
            let now = match question {
                Question::Canonical => of_path(&self.canonical_among(path, &mut folders)),
                Question::IsFile => of_fact(full.is_file()),
                Question::IsLink => of_fact(full.is_symlink()),
                Question::List => of_names(&self.names(path)),
                Question::Read => of_content(&self.bytes(path)),
            };
            now == *answer
        })
    }

    fn canonical_among(&self, file: &Utf8Path, folders: &mut Folders) -> Option<Utf8PathBuf> {
        let path = self.root.join(file);
        let is_link = fs::symlink_metadata(&path).ok()?.is_symlink();
        let (Some(folder), Some(name), false) = (path.parent(), path.file_name(), is_link) else {
            return path.canonicalize_utf8().ok();
        };
        let real = folders
            .entry(folder.to_owned())
            .or_insert_with(|| folder.canonicalize_utf8().ok());
        Some(real.as_ref()?.join(name))
    }

    fn bytes(&self, file: &Utf8Path) -> Result<Vec<u8>, ReadError> {
        let path = self.root.join(file);
        let failed = |error: io::Error| ReadError {
            file: file.to_owned(),
            reason: error.to_string(),
            missing: error.kind() == io::ErrorKind::NotFound,
        };
        // Asked before it is opened: a pipe would wait for somebody who writes.
        let about = fs::metadata(&path).map_err(failed)?;
        if !about.is_file() {
            return Err(refused(file, "it is no file".to_owned()));
        }
        if about.len() > LARGEST {
            let mebibytes = LARGEST >> 20;
            return Err(refused(file, format!("it is larger than {mebibytes} MiB")));
        }
        fs::read(path).map_err(failed)
    }

    /// What is in a folder, sorted; names that are no UTF-8 are left out.
    fn names(&self, folder: &Utf8Path) -> Vec<String> {
        let Ok(entries) = self.root.join(folder).read_dir_utf8() else {
            return Vec::new();
        };
        let mut names: Vec<String> = entries
            .flatten()
            .map(|entry| entry.file_name().to_owned())
            .collect();
        names.sort();
        names
    }
}

fn refused(file: &Utf8Path, reason: String) -> ReadError {
    ReadError {
        file: file.to_owned(),
        reason,
        missing: false,
    }
}

/// What a file says, or why it cannot be read.
fn of_content(content: &Result<Vec<u8>, ReadError>) -> Digest {
    match content {
        Ok(bytes) => Digest::of_parts([b"text".as_slice(), bytes]),
        Err(error) => {
            let missing = if error.missing { "missing" } else { "there" };
            Digest::of_parts(["error", missing, &error.reason].map(str::as_bytes))
        }
    }
}

fn of_path(path: &Option<Utf8PathBuf>) -> Digest {
    Digest::of_parts(path.iter().map(|path| path.as_str().as_bytes()))
}

fn of_fact(fact: bool) -> Digest {
    Digest::of_parts([[u8::from(fact)].as_slice()])
}

fn of_names(names: &[String]) -> Digest {
    Digest::of_parts(names.iter().map(String::as_bytes))
}
