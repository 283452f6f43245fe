//! Which parameter files there are.

use std::ops::Range;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use toml::de::DeTable;

use super::asked_for;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::manifest::Manifest;
use crate::workspace::{MANIFEST, Workspace};

/// A parsed file.
pub(super) struct Layer<'a> {
    pub(super) file: &'a Utf8Path,
    pub(super) table: DeTable<'a>,
}

impl Layer<'_> {
    /// The deepest key on the way to a path; the beginning of the file if there is none.
    pub(super) fn nearest(&self, path: &[String]) -> Range<usize> {
        let mut table = &self.table;
        let mut place = 0..0;
        for name in path {
            let Some((key, value)) = table.get_key_value(name.as_str()) else {
                break;
            };
            place = key.span();
            let Some(below) = value.get_ref().as_table() else {
                break;
            };
            table = below;
        }
        place
    }
}

/// `location` in the folder's `parameters.toml`.
pub(super) fn default_location(workspace: &Workspace, folder: &Utf8Path) -> Option<String> {
    let text = workspace.read(&folder.join("parameters.toml")).ok()?;
    let table: toml::Table = toml::from_str(&text).ok()?;
    table.get("location")?.as_str().map(str::to_owned)
}

/// Every file that may be a layer of some robot: defaults of the folder and of its locations, and identities' files.
///
/// A default that a target asks for and that is not there is a `missing-parameter-file`.
pub(super) fn find(
    workspace: &Workspace,
    manifest: &Manifest,
    diagnostics: &mut Diagnostics,
) -> Vec<(Utf8PathBuf, Arc<str>)> {
    let folder = &manifest.robot.parameters;
    let mut files = vec![folder.join("default.toml")];
    for target in &manifest.targets {
        if let Some(location) = &target.declared.location {
            files.push(folder.join(location).join("default.toml"));
        }
    }
    let asked = files.len();
    for entry in workspace.list(folder) {
        if is_of_identity(&entry, manifest) {
            files.push(entry);
            continue;
        }
        let inside = workspace.list(&entry);
        let is_layer = |file: &Utf8PathBuf| {
            file.file_name() == Some("default.toml") || is_of_identity(file, manifest)
        };
        files.extend(inside.into_iter().filter(is_layer));
    }
    let mut found: Vec<(Utf8PathBuf, Arc<str>)> = Vec::new();
    for (index, file) in files.into_iter().enumerate() {
        if found.iter().any(|(other, _)| *other == file) {
            continue;
        }
        match workspace.read(&file) {
            Ok(text) => found.push((file, text)),
            Err(error) if index < asked => {
                report_missing(manifest, &file, &error.to_string(), diagnostics)
            }
            Err(_) => {}
        }
    }
    found
}

/// `head.P123.toml`.
fn is_of_identity(file: &Utf8Path, manifest: &Manifest) -> bool {
    let name = file.file_name().and_then(|name| name.strip_suffix(".toml"));
    let identity = name
        .and_then(|name| name.split_once('.'))
        .map(|(identity, _)| identity);
    identity.is_some_and(|identity| {
        manifest
            .robot
            .identities
            .iter()
            .any(|one| one.as_str() == identity)
    })
}

fn report_missing(
    manifest: &Manifest,
    file: &Utf8Path,
    reason: &str,
    diagnostics: &mut Diagnostics,
) {
    let location = file
        .strip_prefix(&manifest.robot.parameters)
        .ok()
        .and_then(Utf8Path::parent)
        .map(Utf8Path::as_str)
        .unwrap_or_default();
    let place = asked_for(manifest, location).or_else(|| {
        let key = manifest.text.find("parameters")?;
        Some(key..key + "parameters".len())
    });
    let error = Diagnostic::new(Code::MissingParameterFile, reason)
        .at(
            Utf8Path::new(MANIFEST),
            place.unwrap_or(0..0),
            "asked for here",
        )
        .help(format!("create `{file}`"));
    diagnostics.add(error);
}
