//! The rules of deny.toml, and how many crates hulkgen may need.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use support::{root, skip};

fn cargo(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(root())
        .output()
        .expect("cargo can be started");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("cargo prints UTF-8")
}

fn packages() -> Vec<Value> {
    let metadata: Value =
        serde_json::from_str(&cargo(&["metadata", "--format-version", "1", "--locked"]))
            .expect("cargo prints JSON");
    metadata["packages"]
        .as_array()
        .expect("packages are a list")
        .clone()
}

fn rules() -> toml::Table {
    let text = std::fs::read_to_string(root().join("deny.toml")).expect("deny.toml is there");
    text.parse().expect("deny.toml is TOML")
}

#[test]
fn every_licence_is_allowed() {
    let rules = rules();
    let allowed: Vec<_> = rules["licenses"]["allow"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|licence| licence.as_str())
        .collect();
    let refused: Vec<_> = packages()
        .iter()
        .filter(|package| {
            let expression = package["license"].as_str().unwrap_or_default();
            !is_allowed(expression, &allowed)
        })
        .map(|package| {
            format!(
                "{} {}: {}",
                package["name"], package["version"], package["license"]
            )
        })
        .collect();
    assert!(refused.is_empty(), "{refused:#?}");
}

/// Whether an SPDX expression of `OR`s and `AND`s can be met by allowed licences.
fn is_allowed(expression: &str, allowed: &[&str]) -> bool {
    let expression = expression.trim();
    if let Some(inner) = expression
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'))
        && !inner.contains('(')
    {
        return is_allowed(inner, allowed);
    }
    for (operator, all) in [(" AND ", true), (" OR ", false), ("/", false)] {
        let parts = split_outside_parentheses(expression, operator);
        if parts.len() > 1 {
            let mut met = parts.into_iter().map(|part| is_allowed(part, allowed));
            return if all {
                met.all(|met| met)
            } else {
                met.any(|met| met)
            };
        }
    }
    allowed.contains(&expression)
}

fn split_outside_parentheses<'a>(expression: &'a str, operator: &str) -> Vec<&'a str> {
    let mut parts = Vec::new();
    let (mut start, mut depth) = (0, 0);
    for (position, character) in expression.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ if depth == 0
                && position >= start
                && expression[position..].starts_with(operator) =>
            {
                parts.push(&expression[start..position]);
                start = position + operator.len();
            }
            _ => {}
        }
    }
    parts.push(&expression[start..]);
    parts
}

#[test]
fn licence_expressions_are_understood() {
    let allowed = ["MIT", "Apache-2.0", "Unicode-3.0"];
    for (expression, expected) in [
        ("MIT OR Apache-2.0", true),
        ("MIT/Apache-2.0", true),
        ("GPL-3.0", false),
        ("GPL-3.0 OR MIT", true),
        ("(MIT OR GPL-3.0) AND Unicode-3.0", true),
        ("(GPL-3.0 OR LGPL-3.0) AND Unicode-3.0", false),
        ("MIT AND GPL-3.0", false),
        ("", false),
    ] {
        assert_eq!(is_allowed(expression, &allowed), expected, "{expression}");
    }
}

#[test]
fn no_denied_crate_is_used() {
    let rules = rules();
    let denied: Vec<_> = rules["bans"]["deny"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|rule| rule["name"].as_str())
        .collect();
    for package in packages() {
        let name = package["name"].as_str().expect("a package has a name");
        assert!(!denied.contains(&name), "{name} is denied by deny.toml");
    }
}

#[test]
fn crates_in_two_versions_are_those_that_are_known() {
    let rules = rules();
    assert_eq!(rules["bans"]["multiple-versions"].as_str(), Some("deny"));
    let known = rules["bans"]["skip"].as_array().expect("a list");
    let known: BTreeSet<_> = known
        .iter()
        .map(|rule| {
            let reason = rule["reason"].as_str().unwrap_or_default();
            let name = rule["name"].as_str().expect("a crate has a name");
            assert!(!reason.is_empty(), "why does {name} come twice?");
            name.to_owned()
        })
        .collect();
    let mut versions = BTreeMap::<String, BTreeSet<String>>::new();
    for package in packages() {
        let of = |key: &str| package[key].as_str().expect("a text").to_owned();
        let all = versions.entry(of("name")).or_default();
        all.insert(of("version"));
    }
    versions.retain(|_, all| all.len() > 1);
    let found: BTreeSet<_> = versions.keys().cloned().collect();
    assert_eq!(
        found, known,
        "in several versions on the left, `skip` of deny.toml on the right: {versions:?}"
    );
}

#[test]
fn every_crate_comes_from_the_registry_or_the_workspace() {
    for package in packages() {
        let source = package["source"].as_str().unwrap_or("path");
        let known = source == "path" || source.starts_with("registry+");
        assert!(known, "{} comes from {source}", package["name"]);
    }
}

#[test]
fn hulkgen_needs_fewer_than_120_crates() {
    let tree = cargo(&[
        "tree", "--locked", "-p", "hulkgen", "-e", "normal", "--prefix", "none",
    ]);
    let mut crates: Vec<_> = tree
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    crates.sort_unstable();
    crates.dedup();
    assert!(
        crates.contains(&"syn") && crates.len() < 120,
        "{} crates: {crates:?}",
        crates.len()
    );
}

#[test]
fn hulkgen_does_not_contain_the_robot() {
    let tree = cargo(&[
        "tree", "--locked", "-p", "hulkgen", "-e", "normal", "--prefix", "none",
    ]);
    for robot in ["nalgebra", "hulkgen-framework ", "nao_runtime"] {
        assert!(!tree.contains(robot), "hulkgen links {robot}");
    }
}

/// What cargo would build, as (package, profile, features) of each library and macro.
fn units(arguments: &[&str]) -> Vec<(String, String)> {
    let output = Command::new(env!("CARGO"))
        .args([
            "build",
            "--release",
            "--locked",
            "--unit-graph",
            "-Zunstable-options",
        ])
        .args(arguments)
        // The graph of units is not stable yet, but no other question has this answer.
        .env("RUSTC_BOOTSTRAP", "1")
        .current_dir(root())
        .output()
        .expect("cargo can be started");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let graph: Value = serde_json::from_slice(&output.stdout).expect("cargo prints JSON");
    let units = graph["units"].as_array().expect("units are a list");
    units
        .iter()
        .filter(|unit| {
            let kind = unit["target"]["kind"][0].as_str();
            kind == Some("lib") || kind == Some("proc-macro")
        })
        .map(|unit| {
            let how = format!("{} {} {}", unit["profile"], unit["features"], unit["mode"]);
            (unit["pkg_id"].to_string(), how)
        })
        .collect()
}

#[test]
fn no_crate_is_compiled_twice_on_the_way_of_the_first_command() {
    let hulkgen = units(&[]);
    let target = [
        "--bin",
        "simulated",
        "--no-default-features",
        "--features",
        "target-simulated",
    ];
    let robot = units(&[&["-p", "nao_runtime"][..], &target].concat());
    let mut ways = BTreeMap::<_, BTreeSet<_>>::new();
    for (package, how) in hulkgen.iter().chain(&robot) {
        ways.entry(package).or_default().insert(how);
    }
    let twice: Vec<_> = ways.iter().filter(|(_, ways)| ways.len() > 1).collect();
    assert!(
        ways.len() > 50 && twice.is_empty(),
        "compiled in more than one way: {twice:#?}"
    );
}

/// Packages that `cargo publish` may take.
fn publishable() -> Vec<Value> {
    let all = packages().into_iter();
    all.filter(|package| package["source"].is_null() && package["publish"].is_null())
        .collect()
}

fn publishable_names() -> Vec<String> {
    let name = |package: &Value| package["name"].as_str().expect("a name").to_owned();
    publishable().iter().map(name).collect()
}

fn publishable_folders() -> Vec<PathBuf> {
    let folder = |package: &Value| {
        let manifest = package["manifest_path"].as_str().expect("a path");
        let folder = Path::new(manifest).parent();
        folder.expect("it is in a folder").to_owned()
    };
    publishable().iter().map(folder).collect()
}

#[test]
fn what_is_published_can_be_packaged_in_one_call() {
    let names = publishable_names();
    assert!(
        names.iter().any(|name| name == "hulkgen") && names.len() > 5,
        "{names:?}"
    );
    let folder = tempfile::tempdir().expect("a temporary folder");
    let target = folder.path().to_str().expect("UTF-8");
    // It is built by hand before a release (CONTRIBUTING.md), which takes minutes.
    let mut arguments = vec!["package", "--no-verify", "--allow-dirty", "--offline"];
    arguments.extend(["--target-dir", target]);
    for name in &names {
        arguments.extend(["--package", name]);
    }
    cargo(&arguments);
    let guide = std::fs::read_to_string(root().join("CONTRIBUTING.md")).expect("it is there");
    let packed = folder.path().join("package");
    for name in &names {
        let found = packed.join(format!("{name}-{}.crate", env!("CARGO_PKG_VERSION")));
        assert!(found.is_file(), "{name} was not packaged");
        let is_told = guide
            .lines()
            .any(|line| line.contains("cargo package") && line.split(' ').any(|word| word == name));
        assert!(is_told, "CONTRIBUTING.md packages no {name}");
    }
}

#[test]
fn packages_bring_the_texts_of_their_licences() {
    for folder in publishable_folders() {
        for text in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let own = std::fs::read_to_string(folder.join(text));
            let own = own.unwrap_or_else(|error| panic!("{} {text}: {error}", folder.display()));
            let whole = std::fs::read_to_string(root().join(text)).expect("it is there");
            assert!(own == whole, "{} {text}", folder.display());
        }
    }
}

#[test]
fn the_licences_of_all_that_is_linked_are_collected() {
    if Command::new("python3").arg("--version").output().is_err() {
        return skip(
            "the_licences_of_all_that_is_linked_are_collected",
            "python3 (apt install python3)",
        );
    }
    let output = Command::new(root().join(".ci/licences"))
        .arg("hulkgen")
        .output()
        .expect("it can be started");
    let notes = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{notes}");
    assert!(!notes.contains("comes without a text"), "{notes}");
    let texts = String::from_utf8(output.stdout).expect("licences are UTF-8");
    let tree = cargo(&[
        "tree", "--locked", "-p", "hulkgen", "-e", "normal", "--prefix", "none", "--format", "{p}",
    ]);
    let mut linked: Vec<_> = tree
        .lines()
        .filter(|line| !line.contains("(/"))
        .filter_map(|line| line.trim_end_matches(" (*)").split_once(" v"))
        .collect();
    linked.sort_unstable();
    linked.dedup();
    assert!(linked.len() > 50, "{linked:?}");
    for (name, version) in linked {
        let version = version.split(' ').next().unwrap_or_default();
        let head = format!("== {name} {version}: ");
        assert_eq!(texts.matches(&head).count(), 1, "{head}");
    }
}

#[test]
fn packages_include_no_file_from_outside() {
    for folder in publishable_folders() {
        let relative = folder.strip_prefix(root()).expect("it is in the workspace");
        for file in support::sources(&[&format!("{}/src", relative.display())], ".rs") {
            let levels =
                Path::new(&file.path).components().count() - relative.components().count() - 1;
            let outside = format!("\"{}", "../".repeat(levels + 1));
            let includes = file.text.lines().filter(|line| line.contains("include"));
            let wrong: Vec<_> = includes.filter(|line| line.contains(&outside)).collect();
            assert!(wrong.is_empty(), "{}: {wrong:?}", file.path);
        }
    }
}
