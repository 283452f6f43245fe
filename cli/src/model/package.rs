//! `Cargo.toml` of the generated crate.

use serde::Serialize;

use super::names::snake_case;
use super::sentences;
use crate::resolve::robot::{Dependency, Robot};

/// The package that the generated crate is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Package {
    /// What the crate is, as a sentence.
    pub title: String,
    pub description: String,
    pub header: &'static str,
    /// The command that writes it, if that is not the header's.
    pub command: Option<String>,
    /// `nao_runtime`.
    pub name: String,
    /// Keys that the workspace gives to its packages.
    pub inherited: Vec<String>,
    /// Lines for what a package needs and the workspace does not give.
    pub own: Vec<&'static str>,
    /// Lines of `[dependencies]`, sorted.
    pub dependencies: Vec<String>,
    /// In manifest order; the first is the default.
    pub targets: Vec<PackageTarget>,
}

/// A binary behind its feature.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PackageTarget {
    pub name: String,
    pub feature: String,
    /// Optional dependencies that its feature turns on.
    pub dependencies: Vec<String>,
}

/// Keys that the generated package inherits if it can, in the order of its manifest.
const INHERITED: [&str; 4] = ["version", "edition", "rust-version", "license"];

/// Decides what the manifest of the generated crate says.
pub fn describe(robot: &Robot) -> Package {
    let inherits = |key: &&str| robot.inherited.iter().any(|known| known == key);
    let target = |target: &crate::resolve::robot::Target| PackageTarget {
        name: target.name.clone(),
        feature: feature(&target.name),
        dependencies: robot
            .crates
            .iter()
            .filter(|dependency| dependency.targets.contains(&target.name))
            .map(|dependency| dependency.key.clone())
            .collect(),
    };
    Package {
        title: sentences::crate_title(robot),
        description: sentences::crate_description(robot),
        header: super::DO_NOT_EDIT,
        command: robot.partial.as_ref().map(|_| robot.command()),
        name: library(robot),
        inherited: INHERITED
            .iter()
            .filter(|key| inherits(key))
            .map(|key| (*key).to_owned())
            .collect(),
        // Generated code is written in this edition.
        own: if inherits(&"edition") {
            Vec::new()
        } else {
            vec!["edition = \"2024\""]
        },
        dependencies: robot.crates.iter().map(line).collect(),
        targets: robot.targets.iter().map(target).collect(),
    }
}

/// The generated package and its library.
pub fn library(robot: &Robot) -> String {
    let name = robot.name.replace('-', "_");
    let only = robot.partial.iter().flat_map(|partial| &partial.only);
    let only = only.map(|cycler| format!("_{}", snake_case(cycler)));
    format!("{name}{}_runtime", only.collect::<String>())
}

/// The feature that brings the binary of a target.
pub fn feature(target: &str) -> String {
    format!("target-{target}")
}

/// A dependency's line; one that belongs to targets only is optional.
fn line(dependency: &Dependency) -> String {
    let Dependency {
        key,
        requirement,
        targets,
        ..
    } = dependency;
    let requirement = requirement.trim();
    let table = requirement
        .strip_prefix('{')
        .and_then(|table| table.strip_suffix('}'));
    match table.map(str::trim) {
        Some("workspace = true") if targets.is_empty() => format!("{key}.workspace = true"),
        _ if targets.is_empty() => format!("{key} = {requirement}"),
        Some(table) => format!("{key} = {{ {table}, optional = true }}"),
        None => format!("{key} = {{ version = {requirement}, optional = true }}"),
    }
}
