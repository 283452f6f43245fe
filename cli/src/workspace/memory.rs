//! A workspace in memory: of tests, and of git revisions.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};

use super::ReadError;
use super::links::{BrokenLink, Links};
use super::members::normalized;

/// Files by their path from the root.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// Where the files would lie; empty if nowhere.
    root: Utf8PathBuf,
    files: BTreeMap<Utf8PathBuf, Arc<str>>,
    links: Links,
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
            links: Links::default(),
        }
    }

    /// The same files, as if they lay there.
    pub(super) fn at(self, root: &Utf8Path) -> Self {
        Self {
            root: root.to_owned(),
            ..self
        }
    }

    /// With these links among them.
    pub(super) fn with(self, links: Links) -> Self {
        Self { links, ..self }
    }

    pub(super) fn root(&self) -> &Utf8Path {
        &self.root
    }

    pub(super) fn read(&self, file: &Utf8Path) -> Result<Arc<str>, ReadError> {
        let text = self.found(file).cloned();
        text.ok_or_else(|| ReadError::missing(file))
    }

    pub(super) fn is_file(&self, file: &Utf8Path) -> bool {
        // Whoever looks around asks this of folders and of other people's files, too, and misses none.
        match file.extension() {
            Some("rs" | "toml") => self.found(file).is_some(),
            _ => (self.links.follow(file)).is_some_and(|file| self.files.contains_key(&file)),
        }
    }

    pub(super) fn is_link(&self, entry: &Utf8Path) -> bool {
        self.links.is_link(entry)
    }

    /// What the file is called when every link on the way is followed.
    pub(super) fn canonical(&self, file: &Utf8Path) -> Utf8PathBuf {
        let followed = self.links.follow(file);
        normalized(followed.as_deref().unwrap_or(file))
    }

    /// The first link that somebody followed in vain.
    pub(super) fn broken_link(&self) -> Option<BrokenLink> {
        self.links.broken()
    }

    fn found(&self, file: &Utf8Path) -> Option<&Arc<str>> {
        let followed = self.links.follow(file);
        let found = followed.and_then(|file| self.files.get(&file));
        if found.is_none() {
            let has = |folder: &Utf8Path| self.files.keys().any(|file| file.starts_with(folder));
            self.links.note_missing(file, has);
        }
        found
    }

    pub(super) fn list(&self, folder: &Utf8Path) -> Vec<Utf8PathBuf> {
        let Some(real) = self.links.follow(folder) else {
            return Vec::new();
        };
        let below = self
            .files
            .keys()
            .filter_map(|file| file.strip_prefix(&real).ok())
            .filter_map(|rest| rest.components().next())
            .map(|first| first.as_str());
        let all = below.chain(self.links.names_in(&real));
        let found: BTreeSet<Utf8PathBuf> = all.map(|name| folder.join(name)).collect();
        found.into_iter().collect()
    }
}
