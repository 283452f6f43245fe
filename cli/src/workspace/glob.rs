//! `*` and `?` in the `members` of a Cargo.toml.

use camino::{Utf8Path, Utf8PathBuf};

use super::Workspace;

/// The folders that a pattern names, relative to `root`, to which `way` leads; a pattern without `*` and `?` names one,
/// whether it exists or not, another only packages, as cargo has it.
pub(super) fn expand(workspace: &Workspace, way: &Utf8Path, pattern: &str) -> Vec<Utf8PathBuf> {
    let mut folders = vec![Utf8PathBuf::new()];
    for part in pattern.split('/').filter(|part| !matches!(*part, "" | ".")) {
        folders = folders
            .into_iter()
            .flat_map(|folder| step(workspace, way, &folder, part))
            .collect();
    }
    if pattern.contains(['*', '?']) {
        folders.retain(|folder| workspace.is_file(&way.join(folder).join("Cargo.toml")));
    }
    folders
}

fn step(workspace: &Workspace, way: &Utf8Path, folder: &Utf8Path, part: &str) -> Vec<Utf8PathBuf> {
    if !part.contains(['*', '?']) {
        return vec![folder.join(part)];
    }
    let found = workspace.list(&way.join(folder));
    let names = found.iter().filter_map(|entry| entry.file_name());
    names
        .filter(|name| matches(part, name))
        .map(|name| folder.join(name))
        .collect()
}

/// Whether a name fits a pattern of `*` (anything) and `?` (one character).
pub(super) fn matches(pattern: &str, name: &str) -> bool {
    let mut letters = pattern.chars();
    match letters.next() {
        None => name.is_empty(),
        Some('*') => {
            let rest = letters.as_str();
            let mut starts = name.char_indices().map(|(start, _)| start);
            starts.any(|start| matches(rest, &name[start..])) || matches(rest, "")
        }
        Some('?') => {
            let mut name = name.chars();
            name.next().is_some() && matches(letters.as_str(), name.as_str())
        }
        Some(letter) => name
            .strip_prefix(letter)
            .is_some_and(|name| matches(letters.as_str(), name)),
    }
}
