//! A workspace on disk.

use std::fs;
use std::io;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use super::ReadError;

/// Files below one folder.
#[derive(Debug)]
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
        let text = fs::read_to_string(path).map_err(|error| ReadError {
            file: file.to_owned(),
            reason: error.to_string(),
            missing: error.kind() == io::ErrorKind::NotFound,
        })?;
        Ok(text.into())
    }

    pub(super) fn is_file(&self, file: &Utf8Path) -> bool {
        self.root.join(file).is_file()
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
