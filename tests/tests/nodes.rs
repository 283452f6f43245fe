//! Every node of the NAO is needed, since without any one of them the generator complains, and has a test of its own.

use std::fs;

use hulkgen::diagnostics::Diagnostics;
use hulkgen::pipeline;
use hulkgen::workspace::Workspace;
use support::{root, sources};

/// What `check --deny-warnings` says first about the NAO with this manifest; `None` if nothing.
fn complaint(files: &[(String, String)], manifest: &str) -> Option<String> {
    let files = files
        .iter()
        .cloned()
        .chain([("hulk.toml".to_owned(), manifest.to_owned())]);
    let workspace = Workspace::in_memory(files);
    let mut diagnostics = Diagnostics::new();
    let _understood = pipeline::understand(&workspace, &mut diagnostics);
    let sorted = diagnostics.sorted();
    sorted
        .first()
        .map(|one| format!("{}: {}", one.code.name(), one.message))
}

/// The files of the workspace that hulkgen reads, without the manifest.
fn files() -> Vec<(String, String)> {
    let mut files: Vec<_> = sources(&["framework", "robotics"], ".rs")
        .into_iter()
        .chain(sources(
            &[
                "cli",
                "docs/examples",
                "framework",
                "generated",
                "robotics",
                "schema",
                "templates",
                "tests",
                "web",
            ],
            ".toml",
        ))
        .map(|source| (source.path, source.text))
        .collect();
    let cargo = fs::read_to_string(root().join("Cargo.toml")).expect("the root has a Cargo.toml");
    files.push(("Cargo.toml".to_owned(), cargo));
    // The manifest names it.
    let unit = "robotics/nao/robot.service";
    let text = fs::read_to_string(root().join(unit)).expect("the NAO has a unit");
    files.push((unit.to_owned(), text));
    files
}

/// The manifest's nodes, each with the manifest without it.
fn without_each_node(manifest: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut rest = manifest;
    while let Some(start) = rest.find("::").and_then(|colons| rest[..colons].rfind('"')) {
        let node = rest[start + 1..]
            .split('"')
            .next()
            .expect("a quoted name ends");
        let quoted = format!("\"{node}\"");
        rest = &rest[start + quoted.len()..];
        let is_hardware = node.ends_with("::Hardware");
        if !is_hardware {
            let without = manifest
                .replace(&format!("    {quoted},\n"), "")
                .replace(
                    &format!("    {{ node = {quoted}, on_failure = \"skip\" }},\n"),
                    "",
                )
                .replace(&format!("[{quoted}]"), "[]");
            assert_ne!(without, manifest, "{node} was removed");
            found.push((node.to_owned(), without));
        }
    }
    found
}

#[test]
fn the_robot_without_any_one_node_is_noticed() {
    let files = files();
    let manifest = fs::read_to_string(root().join("hulk.toml")).expect("the NAO has a manifest");
    assert_eq!(
        complaint(&files, &manifest),
        None,
        "the whole robot is fine"
    );
    let nodes = without_each_node(&manifest);
    assert!(nodes.len() >= 50, "{} nodes", nodes.len());
    let (mut unnoticed, mut table) = (Vec::new(), String::new());
    for (node, manifest) in nodes {
        match complaint(&files, &manifest) {
            Some(noticed) => table.push_str(&format!("| `{node}` | {noticed} |\n")),
            None => unnoticed.push(node),
        }
    }
    println!("{table}");
    assert!(unnoticed.is_empty(), "nobody misses {unnoticed:?}");
    let page = fs::read_to_string(root().join("docs/nao.md")).expect("the NAO has a page");
    assert!(
        page.ends_with(&table),
        "the table of docs/nao.md is another: replace it by the one above"
    );
}

#[test]
fn every_node_has_a_test_in_its_file_or_beside_it() {
    let manifest = fs::read_to_string(root().join("hulk.toml")).expect("the NAO has a manifest");
    let untested: Vec<String> = without_each_node(&manifest)
        .into_iter()
        .map(|(node, _)| node)
        .filter(|node| {
            let (package, module) = node.split_once("::").expect("a node is `crate::module`");
            let module = module.replace("::", "/");
            let folder = root().join(format!("robotics/{package}/src"));
            let file = fs::read_to_string(folder.join(format!("{module}.rs")))
                .expect("the node's file is there");
            let beside = fs::read_to_string(folder.join(format!("{module}/tests.rs")));
            let is_tested = file.contains("#[test]")
                || file.contains("mod tests;")
                    && beside.is_ok_and(|beside| beside.contains("#[test]"));
            !is_tested
        })
        .collect();
    assert!(untested.is_empty(), "no test in {untested:?}");
}
