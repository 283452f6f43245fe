//! A workspace in memory, for tests.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use super::ReadError;

/// Files by their path from the root.
#[derive(Debug)]
pub(super) struct Memory {
    files: BTreeMap<Utf8PathBuf, Arc<str>>,
}

impl Memory {
    pub(super) fn new<P, T>(files: impl IntoIterator<Item = (P, T)>) -> Self
    where
        P: Into<Utf8PathBuf>,
        T: Into<String>,
    {
        let files = files
            .into_iter()
            .map(|(path, text)| (path.into(), text.into().into()))
            .collect();
        Self { files }
    }

    pub(super) fn read(&self, file: &Utf8Path) -> Result<Arc<str>, ReadError> {
        self.files.get(file).cloned().ok_or_else(|| ReadError {
            file: file.to_owned(),
            reason: "no such file".to_owned(),
            missing: true,
        })
    }

    pub(super) fn is_file(&self, file: &Utf8Path) -> bool {
        self.files.contains_key(file)
    }

    pub(super) fn list(&self, folder: &Utf8Path) -> Vec<Utf8PathBuf> {
        let below = self
            .files
            .keys()
            .filter_map(|file| file.strip_prefix(folder).ok())
            .filter_map(|rest| rest.components().next());
        let found: BTreeSet<Utf8PathBuf> = below.map(|first| folder.join(first.as_str())).collect();
        found.into_iter().collect()
    }
}
