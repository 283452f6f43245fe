//! Files among the parameters that are a layer of no robot: a misspelt name would leave one out without a word.

use camino::{Utf8Path, Utf8PathBuf};

use super::layer::is_of_identity;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, nearest};
use crate::manifest::Manifest;
use crate::workspace::Workspace;

/// What names the location, beside the layers.
const CHOICE: &str = "parameters.toml";
const DEFAULT: &str = "default.toml";

/// Warns of each of them, in the folder and in those of its locations.
pub(super) fn check(workspace: &Workspace, manifest: &Manifest, diagnostics: &mut Diagnostics) {
    let folder = &manifest.robot.parameters;
    for entry in workspace.list(folder) {
        if workspace.is_file(&entry) {
            if entry.file_name() != Some(CHOICE) {
                warn(&entry, manifest, diagnostics);
            }
            continue;
        }
        for file in workspace.list(&entry) {
            if workspace.is_file(&file) {
                warn(&file, manifest, diagnostics);
            }
        }
    }
}

fn warn(file: &Utf8PathBuf, manifest: &Manifest, diagnostics: &mut Diagnostics) {
    let Some(stem) = stem(file) else {
        return;
    };
    if file.file_name() == Some(DEFAULT) || is_of_identity(file, manifest) {
        return;
    }
    let message = format!("`{file}` is read for no robot");
    let warning = Diagnostic::new(Code::UnusedFile, message).at(file, 0..0, "");
    let warning = match stem.split_once('.') {
        Some((name, id)) => {
            let identities = manifest.robot.identities.iter().map(|one| one.as_str());
            let near = nearest(name, identities);
            let help = format!(
                "remove it, or add `\"{name}\"` to the `identities` of hulk.toml if the hardware reports one"
            );
            let near = near.map(|near| format!("did you mean `{near}.{id}.toml`?"));
            warning.help(help).help_if(near)
        }
        None => {
            let near = nearest(stem, ["default"]);
            let near = near.map(|_| format!("did you mean `{DEFAULT}`?"));
            warning
                .help(format!(
                    "remove it, or call it `{DEFAULT}` or `IDENTITY.ID.toml`"
                ))
                .help_if(near)
        }
    };
    diagnostics.add(warning);
}

/// The name of a TOML file without its end; hidden files are an editor's.
fn stem(file: &Utf8Path) -> Option<&str> {
    let stem = file.file_name()?.strip_suffix(".toml")?;
    (!stem.starts_with('.')).then_some(stem)
}
