//! A workspace on disk.

use std::fs;
use std::io;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use super::ReadError;

/// Bytes; what people write themselves is far smaller, and a larger file would be read for minutes.
const LARGEST: u64 = 4 << 20;

/// Files below one folder.
#[derive(Clone, Debug)]
pub(super) struct Disk {
    root: Utf8PathBuf,
}

impl Disk {
    pub(super) fn new(root: &Utf8Path) -> Self {
        Self {
            root: root.to_owned(),
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
        let path = self.root.join(file);
        let failed = |error: io::Error| ReadError {
            file: file.to_owned(),
            reason: error.to_string(),
            missing: error.kind() == io::ErrorKind::NotFound,
        };
        let refused = |reason: String| ReadError {
            file: file.to_owned(),
            reason,
            missing: false,
        };
        // Asked before it is opened: a pipe would wait for somebody who writes.
        let about = fs::metadata(&path).map_err(failed)?;
        if !about.is_file() {
            return Err(refused("it is no file".to_owned()));
        }
        if about.len() > LARGEST {
            let mebibytes = LARGEST >> 20;
            return Err(refused(format!("it is larger than {mebibytes} MiB")));
        }
        let bytes = fs::read(path).map_err(failed)?;
        match String::from_utf8(bytes) {
            Ok(text) => Ok(text.into()),
            Err(error) => {
                let byte = error.utf8_error().valid_up_to();
                let line = error.as_bytes()[..byte]
                    .split(|byte| *byte == b'\n')
                    .count();
                Err(refused(format!(
                    "line {line} is no UTF-8; save it as UTF-8"
                )))
            }
        }
    }

    /// What the file is called when every link on the way is followed.
    pub(super) fn canonical(&self, file: &Utf8Path) -> Option<Utf8PathBuf> {
        self.root.join(file).canonicalize_utf8().ok()
    }

    pub(super) fn is_file(&self, file: &Utf8Path) -> bool {
        self.root.join(file).is_file()
    }

    pub(super) fn is_link(&self, entry: &Utf8Path) -> bool {
        self.root.join(entry).is_symlink()
    }

    pub(super) fn list(&self, folder: &Utf8Path) -> Vec<Utf8PathBuf> {
        let Ok(entries) = self.root.join(folder).read_dir_utf8() else {
            return Vec::new();
        };
        let mut found: Vec<Utf8PathBuf> = entries
            .flatten()
            .map(|entry| folder.join(entry.file_name()))
            .collect();
        found.sort();
        found
    }
}
