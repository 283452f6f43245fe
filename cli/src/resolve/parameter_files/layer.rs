//! Which parameter files there are.

use std::ops::Range;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use toml::de::DeTable;

use super::choice::Choice;
use super::given::Robots;
use super::unset::is_unset;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, nearest};
use crate::manifest::Manifest;
use crate::workspace::{MANIFEST, Workspace};

/// A parsed file.
pub(super) struct Layer<'a> {
    pub(super) file: &'a Utf8Path,
    pub(super) robots: Robots,
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

    /// The key of a path, if the file gives it a value.
    pub(super) fn given(&self, path: &[String]) -> Option<Range<usize>> {
        let (last, above) = path.split_last()?;
        let mut table = &self.table;
        for name in above {
            table = table.get(name.as_str())?.get_ref().as_table()?;
        }
        let (key, value) = table.get_key_value(last.as_str())?;
        (!is_unset(value.get_ref())).then(|| key.span())
    }
}

/// A default that has to be there, and where it is asked for.
struct Asked<'a> {
    /// `None`: the default of all locations.
    location: Option<&'a str>,
    file: &'a Utf8Path,
    range: Range<usize>,
}

impl Asked<'_> {
    fn folder(&self, parameters: &Utf8Path) -> Utf8PathBuf {
        self.location.map_or_else(
            || parameters.to_owned(),
            |location| parameters.join(location),
        )
    }

    fn file(&self, parameters: &Utf8Path) -> Utf8PathBuf {
        self.folder(parameters).join("default.toml")
    }

    /// The location's folder is missing, or the file in it.
    fn missing(&self, workspace: &Workspace, parameters: &Utf8Path, reason: &str) -> Diagnostic {
        let file = self.file(parameters);
        let folder = self.folder(parameters);
        let beside = workspace.list(folder.parent().unwrap_or(parameters));
        let error = match self.location {
            Some(location) if !beside.contains(&folder) => {
                let locations = workspace.list(parameters);
                let names = locations
                    .iter()
                    .filter(|entry| !workspace.is_file(entry))
                    .filter_map(|entry| entry.file_name());
                let near = nearest(location, names).map(|near| format!("did you mean `{near}`?"));
                let message = format!("`{parameters}` has no location `{location}`");
                Diagnostic::new(Code::MissingParameterFile, message)
                    .help(format!("create `{file}`"))
                    .help_if(near)
            }
            _ => {
                Diagnostic::new(Code::MissingParameterFile, reason).help(format!("create `{file}`"))
            }
        };
        error.at(self.file, self.range.clone(), "asked for here")
    }
}

/// Every file that may be a layer of some robot: defaults of the folder and of its locations, and identities' files.
///
/// A default that a target or `parameters.toml` asks for and that is not there is a `missing-parameter-file`.
pub(super) fn find(
    workspace: &Workspace,
    manifest: &Manifest,
    choice: Option<&Choice>,
    diagnostics: &mut Diagnostics,
) -> Vec<(Utf8PathBuf, Arc<str>)> {
    let folder = &manifest.robot.parameters;
    let asked = asked(manifest, choice);
    let mut files: Vec<Utf8PathBuf> = asked.iter().map(|one| one.file(folder)).collect();
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
            Err(error) => {
                if !error.missing {
                    let error = Diagnostic::new(Code::Syntax, error.to_string());
                    diagnostics.add(error.at(&file, 0..0, ""));
                } else if let Some(asked) = asked.get(index) {
                    diagnostics.add(asked.missing(workspace, folder, &error.to_string()));
                }
            }
        }
    }
    found
}

fn asked<'a>(manifest: &'a Manifest, choice: Option<&'a Choice>) -> Vec<Asked<'a>> {
    let file = Utf8Path::new(MANIFEST);
    let mut asked = vec![Asked {
        location: None,
        file,
        range: manifest.parameters_range.clone(),
    }];
    asked.extend(manifest.targets.iter().filter_map(|target| {
        Some(Asked {
            location: Some(target.declared.location.as_deref()?),
            file,
            range: target.location_range.clone()?,
        })
    }));
    asked.extend(choice.map(|choice| Asked {
        location: Some(&choice.location),
        file: &choice.file,
        range: choice.range.clone(),
    }));
    asked
}

/// `head.P123.toml`.
pub(super) fn is_of_identity(file: &Utf8Path, manifest: &Manifest) -> bool {
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
