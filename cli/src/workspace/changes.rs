//! Changes to a workspace that are not written yet.

use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Path, Utf8PathBuf};

/// The new text of files by their path from the root; `None` removes a file.
pub type Changes = BTreeMap<Utf8PathBuf, Option<String>>;

/// What a folder holds after the changes; `found` is what it holds before.
pub(super) fn list(
    changes: &Changes,
    folder: &Utf8Path,
    found: Vec<Utf8PathBuf>,
) -> Vec<Utf8PathBuf> {
    let written = changes.iter().filter(|(_, change)| change.is_some());
    let below = written
        .filter_map(|(file, _)| file.strip_prefix(folder).ok())
        .filter_map(|rest| rest.components().next())
        .map(|first| folder.join(first.as_str()));
    let kept = found
        .into_iter()
        .filter(|entry| !matches!(changes.get(entry), Some(None)));
    let all: BTreeSet<Utf8PathBuf> = kept.chain(below).collect();
    all.into_iter().collect()
}
