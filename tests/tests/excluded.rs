//! Workspaces that `--workspace` leaves out were built and tested as they are now, with the framework as it is now.

use std::fs;

use hulkgen::digest::Digest;
use support::api::public_api;
use support::{root, sources};

/// In each of these workspaces: the digest of what was tested. `.ci/run --excluded` writes it.
const FILE: &str = "tested.txt";

/// The folders that the root's manifest excludes.
fn excluded() -> Vec<String> {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("it is there");
    let manifest: toml::Table = manifest.parse().expect("it is TOML");
    let folders = manifest["workspace"]["exclude"].as_array().expect("a list");
    let folders = folders.iter().filter_map(|folder| folder.as_str());
    folders.map(str::to_owned).collect()
}

/// Of the workspace's files by path and content, and of what the framework promises.
fn digest(folder: &str) -> String {
    let files = sources(&[folder], "");
    let files = files.iter().filter(|file| !file.path.ends_with(FILE));
    let api = public_api("framework/src");
    let mut parts: Vec<_> = files
        .flat_map(|file| [file.path.as_bytes(), file.text.as_bytes()])
        .collect();
    parts.push(api.as_bytes());
    format!("{}\n", Digest::of_parts(parts))
}

#[test]
fn excluded_workspaces_were_tested_as_they_are() {
    let mut stale = Vec::new();
    for folder in excluded() {
        let (file, digest) = (root().join(&folder).join(FILE), digest(&folder));
        if std::env::var_os("HULKGEN_TESTED").is_some() {
            fs::write(&file, digest).expect("the folder can be written to");
        } else if fs::read_to_string(&file).unwrap_or_default() != digest {
            stale.push(folder);
        }
    }
    assert!(
        stale.is_empty(),
        "{stale:?} or the framework's interface changed since these workspaces were tested: run `.ci/run --excluded`"
    );
}

#[test]
fn a_digest_knows_the_framework_and_every_file() {
    let all: Vec<_> = excluded().iter().map(|folder| digest(folder)).collect();
    assert!(all.len() >= 3, "{all:?}");
    for (index, digest) in all.iter().enumerate() {
        assert!(!all[..index].contains(digest), "two workspaces look alike");
    }
}
