//! Crates that generated code names, and where they come from.

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8Path;

use super::robot::Dependency;
use super::scene::Scene;
use crate::manifest::Manifest;
use crate::workspace::Workspace;

/// Crates that every generated crate names.
const ALWAYS: &[&str] = &["framework", "serde"];

/// Every crate of the generated crate's `[dependencies]`, sorted by name.
///
/// `texts` are absolute paths and types as generated code writes them.
pub(super) fn dependencies<'a>(
    workspace: &Workspace,
    manifest: &Manifest,
    scene: &Scene<'_>,
    texts: impl Iterator<Item = &'a str>,
) -> Vec<Dependency> {
    let mut by_name: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for target in &manifest.targets {
        if let Some(name) = target.declared.hardware.segments().next() {
            let targets = by_name.entry(name.to_owned()).or_default();
            targets.insert(target.declared.name.to_string());
        }
    }
    let nodes = scene.sources.nodes.values();
    let libraries: BTreeSet<&str> = nodes.map(|node| node.module.library()).collect();
    let always = libraries
        .iter()
        .chain(ALWAYS)
        .map(|name| (*name).to_owned());
    for name in always.chain(texts.flat_map(crates_of)) {
        // Named by code of every target, also where it is the hardware of one.
        by_name.insert(name, BTreeSet::new());
    }
    let users: Vec<&str> = libraries.into_iter().collect();
    by_name
        .into_iter()
        .map(|(name, targets)| {
            let targets = targets.into_iter().collect();
            dependency(workspace, &manifest.robot.generated, &users, name, targets)
        })
        .collect()
}

fn dependency(
    workspace: &Workspace,
    generated: &Utf8Path,
    users: &[&str],
    name: String,
    targets: Vec<String>,
) -> Dependency {
    let line = workspace.members().requirement(&name, generated, users);
    let (key, requirement) = line.unwrap_or_else(|| match name.as_str() {
        "framework" => (
            "framework".to_owned(),
            "{ package = \"hulkgen-framework\", version = \"*\" }".to_owned(),
        ),
        "serde" => (
            "serde".to_owned(),
            "{ version = \"1\", features = [\"derive\"] }".to_owned(),
        ),
        other => (other.to_owned(), "\"*\"".to_owned()),
    });
    Dependency {
        name,
        key,
        requirement,
        targets,
    }
}

/// First names of all paths in a type, but for the standard library's.
fn crates_of(text: &str) -> impl Iterator<Item = String> {
    let paths =
        text.split(|letter: char| !(letter.is_alphanumeric() || matches!(letter, '_' | ':')));
    let roots = paths.filter_map(|path| path.split_once("::").map(|(root, _)| root));
    let roots = roots.filter(|root| !root.is_empty() && !matches!(*root, "std" | "core" | "alloc"));
    roots.map(str::to_owned).collect::<Vec<_>>().into_iter()
}
