//! What the generated folder holds, by digest: enough to see that nothing has to be written.

use std::collections::BTreeMap;

use camino::{Utf8Path, Utf8PathBuf};
use serde::{Deserialize, Serialize};

use super::{DriftError, Turn, disk, own};
use crate::digest::Digest;
use crate::render::GeneratedFiles;

/// The digest of every file of the generated crate. Paths are relative to the workspace root.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Content(BTreeMap<Utf8PathBuf, Digest>);

impl Content {
    /// Of these files.
    pub fn of(files: &GeneratedFiles) -> Self {
        let digests = files
            .iter()
            .map(|(path, text)| (path.clone(), Digest::of(text.as_bytes())));
        Self(digests.collect())
    }

    /// Whether [`super::Drift::compare`] with those files would find nothing; also not if it would fail.
    pub fn is_there(&self, turn: &Turn, folder: &Utf8Path) -> bool {
        self.compare(turn.root(), folder).unwrap_or(false)
    }

    fn compare(&self, root: &Utf8Path, folder: &Utf8Path) -> Result<bool, DriftError> {
        own(root, folder)?;
        let there = disk::files(root, folder)?;
        if there.iter().any(|path| !self.0.contains_key(path)) {
            return Ok(false);
        }
        for (path, digest) in &self.0 {
            let content = disk::read(&root.join(path))?;
            if content.is_none_or(|content| Digest::of(&content) != *digest) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
