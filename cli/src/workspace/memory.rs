//! A workspace in memory: of tests, and of git revisions.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use super::ReadError;

/// Files by their path from the root.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// Where the files would lie; empty if nowhere.
    root: Utf8PathBuf,
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
        Self {
            root: Utf8PathBuf::new(),
            files,
        }
    }

    /// The same files, as if they lay there.
    pub(super) fn at(self, root: &Utf8Path) -> Self {
        Self {
            root: root.to_owned(),
            ..self
        }
    }

    pub(super) fn root(&self) -> &Utf8Path {
        &self.root
    }

    pub(super) fn read(&self, file: &Utf8Path) -> Result<Arc<str>, ReadError> {
        let text = self.files.get(file).cloned();
        text.ok_or_else(|| ReadError::missing(file))
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
