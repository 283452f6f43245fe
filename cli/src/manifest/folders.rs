//! The folder of the generated crate: everything in it that nobody writes is removed, so nothing else may lie there.

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};

use super::Manifest;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::workspace::{MANIFEST, Workspace, package_table, says_generated};

pub(super) fn check(workspace: &Workspace, manifest: &Manifest, diagnostics: &mut Diagnostics) {
    let robot = &manifest.robot;
    let library = format!("{}_runtime", robot.name.as_str().replace('-', "_"));
    if let Some(message) = mistake(workspace, &robot.generated, &robot.parameters, &library) {
        let range = manifest.generated_range.clone();
        let error = Diagnostic::new(Code::InvalidValue, message)
            .at(Utf8Path::new(MANIFEST), range, "its orphans are removed")
            .help("name a folder of its own below the workspace root, such as `generated`");
        diagnostics.add(error);
    }
}

/// Why this cannot be the folder of a generated crate whose library has this name.
pub fn mistake(
    workspace: &Workspace,
    generated: &Utf8Path,
    parameters: &Utf8Path,
    library: &str,
) -> Option<String> {
    let is_name = |part| matches!(part, Utf8Component::Normal(_));
    if generated.as_str().is_empty() || !generated.components().all(is_name) {
        return Some(format!(
            "`{generated}` cannot be the generated folder: it is no plain path below the workspace root"
        ));
    }
    let parameters = without_dots(parameters);
    if let Some(relation) = relation(generated, &parameters) {
        return Some(format!(
            "`{generated}` cannot be the generated folder: it {relation} the folder of the parameters `{parameters}`"
        ));
    }
    workspace.members().folders.iter().find_map(|member| {
        let member = without_dots(member);
        if *generated == member && is_generated(workspace, &member, library) {
            return None;
        }
        let relation = relation(generated, &member)?;
        Some(format!(
            "`{generated}` cannot be the generated folder: it {relation} the package in `{member}`"
        ))
    })
}

/// How two folders overlap; everything lies in the root, which therefore does not count.
fn relation(generated: &Utf8Path, other: &Utf8Path) -> Option<&'static str> {
    match () {
        () if other.as_str().is_empty() => None,
        () if generated == other => Some("is"),
        () if other.starts_with(generated) => Some("contains"),
        () if generated.starts_with(other) => Some("lies in"),
        () => None,
    }
}

/// Whether the package there may be the generated one: by its name or its header, also if it cannot be parsed.
fn is_generated(workspace: &Workspace, folder: &Utf8Path, library: &str) -> bool {
    let Ok(text) = workspace.read(&folder.join("Cargo.toml")) else {
        return true;
    };
    let Ok(table) = toml::from_str::<toml::Table>(&text) else {
        return true;
    };
    let name = package_table(&table).and_then(|package| package.get("name")?.as_str());
    name == Some(library) || says_generated(&text)
}

/// A path without `.` in it, as other folders are written.
pub fn without_dots(path: &Utf8Path) -> Utf8PathBuf {
    let parts = path.components();
    parts
        .filter(|part| !matches!(part, Utf8Component::CurDir))
        .collect()
}
