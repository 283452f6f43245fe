//! Workspaces that `--workspace` leaves out were built and tested as they are now, with the crates of this one as they are now.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use hulkgen::digest::Digest;
use support::api::public_api;
use support::{root, sources};

/// In each of these workspaces: the digest of what was tested. `.ci/run --excluded` writes it.
const FILE: &str = "tested.txt";

/// The folders that the root's manifest excludes.
fn excluded() -> Vec<String> {
    let manifest = table(&root().join("Cargo.toml"));
    let folders = manifest["workspace"]["exclude"].as_array().expect("a list");
    let folders = folders.iter().filter_map(|folder| folder.as_str());
    folders.map(str::to_owned).collect()
}

fn table(manifest: &Path) -> toml::Table {
    let text = fs::read_to_string(manifest).expect("it is there");
    text.parse().expect("it is TOML")
}

/// What decides whether a workspace works: its files by path, and the interfaces of the crates of this one that it names.
fn parts(folder: &str) -> BTreeMap<String, String> {
    let files = sources(&[folder], "");
    let files = files.into_iter().filter(|file| !file.path.ends_with(FILE));
    let mut parts: BTreeMap<_, _> = files.map(|file| (file.path, file.text)).collect();
    let manifests: Vec<_> = parts
        .iter()
        .filter(|(path, _)| path.ends_with("Cargo.toml"))
        .collect();
    let outside: BTreeSet<_> = manifests
        .into_iter()
        .flat_map(|(path, text)| named(path, text))
        .filter(|named| !named.starts_with(folder))
        .collect();
    for named in outside {
        let sources = named.join("src");
        let interface = public_api(&sources.to_string_lossy());
        parts.insert(format!("{} promises", named.display()), interface);
    }
    parts
}

/// The folders that a manifest names by `path = "…"`, as the root sees them.
fn named(manifest: &str, text: &str) -> Vec<PathBuf> {
    let folder = Path::new(manifest).parent().expect("a file is in a folder");
    let words = text.split("path = \"").skip(1);
    let paths = words.filter_map(|rest| rest.split('"').next());
    let paths = paths.map(|path| normalized(&folder.join(path)));
    let is_crate = |path: &PathBuf| root().join(path).join("Cargo.toml").is_file();
    paths.filter(is_crate).collect()
}

fn normalized(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => _ = normal.pop(),
            component => normal.push(component),
        }
    }
    normal
}

fn digest(parts: &BTreeMap<String, String>) -> String {
    let parts = parts.iter();
    let parts: Vec<_> = parts
        .flat_map(|(name, text)| [name.as_bytes(), text.as_bytes()])
        .collect();
    format!("{}\n", Digest::of_parts(parts))
}

#[test]
fn excluded_workspaces_were_tested_as_they_are() {
    let mut outdated = Vec::new();
    for folder in excluded() {
        let (file, digest) = (root().join(&folder).join(FILE), digest(&parts(&folder)));
        if std::env::var_os("HULKGEN_TESTED").is_some() {
            fs::write(&file, digest).expect("the folder can be written to");
        } else if fs::read_to_string(&file).unwrap_or_default() != digest {
            outdated.push(folder);
        }
    }
    assert!(
        outdated.is_empty(),
        "{outdated:?}, or the interface of a crate that they name, changed since they were tested: run `.ci/run --excluded`"
    );
}

#[test]
fn a_digest_knows_every_file_and_every_crate_that_is_named() {
    for folder in excluded() {
        let parts = parts(&folder);
        let promises: Vec<_> = parts
            .keys()
            .filter(|name| name.ends_with(" promises"))
            .collect();
        assert!(
            !promises.is_empty(),
            "{folder} names no crate of this workspace"
        );
        let whole = digest(&parts);
        for name in parts.keys() {
            let mut changed = parts.clone();
            changed.entry(name.clone()).or_default().push('!');
            assert_ne!(digest(&changed), whole, "{name}");
        }
    }
}
