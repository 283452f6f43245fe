//! Crates that generated code names, and where they come from.

use std::collections::{BTreeMap, BTreeSet};

use camino::Utf8Path;

use super::robot::{Content, CycleBinding, Dependency, Node, Robot, Tree};
use crate::scan::lookup::is_prelude;
use crate::workspace::{OF_GENERATED, Workspace};

/// Crates that every generated crate names.
const ALWAYS: [&str; 2] = [OF_GENERATED[0], OF_GENERATED[1]];

/// What every target names.
const SERVER: &str = OF_GENERATED[2];

/// Every crate of the generated crate's `[dependencies]`, sorted by name.
pub(crate) fn dependencies(workspace: &Workspace, robot: &Robot) -> Vec<Dependency> {
    let mut by_name: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for target in &robot.targets {
        for name in [root_of(&target.hardware), SERVER.to_owned()] {
            let targets = by_name.entry(name).or_default();
            targets.insert(target.name.clone());
        }
    }
    let running = robot.running().flat_map(|(_, cycler)| &cycler.nodes);
    let libraries = running.map(|node| root_of(&node.path));
    let always = ALWAYS.iter().map(|name| (*name).to_owned());
    let texts = names_in_code(robot);
    let named = texts.iter().flat_map(|text| crates_of(text));
    for name in libraries.chain(always).chain(named) {
        // Named by code of every target, also where it is the hardware of one.
        by_name.insert(name, BTreeSet::new());
    }
    let nodes = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
    let users: BTreeSet<String> = nodes.map(|node| root_of(&node.path)).collect();
    let users: Vec<&str> = users.iter().map(String::as_str).collect();
    by_name
        .into_iter()
        .map(|(name, targets)| {
            let targets = targets.into_iter().collect();
            dependency(workspace, &robot.generated, &users, name, targets)
        })
        .collect()
}

/// The first name of an absolute path: its crate.
fn root_of(path: &str) -> String {
    path.split("::").next().unwrap_or(path).to_owned()
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
        SERVER => ("hulkgen-communication".to_owned(), "\"*\"".to_owned()),
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

/// First names of all paths in a type, but for the standard library's; `#` stands in raw names.
fn crates_of(text: &str) -> impl Iterator<Item = String> {
    let paths =
        text.split(|letter: char| !(letter.is_alphanumeric() || matches!(letter, '_' | ':' | '#')));
    let roots = paths.filter_map(|path| path.split_once("::").map(|(root, _)| root));
    let is_crate = |root: &&str| {
        let is_standard = matches!(*root, "std" | "core" | "alloc");
        !root.is_empty() && !is_standard && !is_prelude(root)
    };
    let roots = roots.filter(is_crate);
    roots.map(str::to_owned).collect::<Vec<_>>().into_iter()
}

/// Every type and path that generated code writes.
fn names_in_code(robot: &Robot) -> Vec<String> {
    let mut texts = Vec::new();
    for cycler in &robot.cyclers {
        texts.extend(cycler.outputs.iter().map(|output| output.data.text.clone()));
        collect_types(&cycler.additional_outputs, &mut texts);
        collect_types(&cycler.states, &mut texts);
        for node in &cycler.nodes {
            let bounds = node
                .new_bounds
                .iter()
                .chain(&node.cycle_bounds)
                .chain(&node.restore_bounds);
            for interface in bounds {
                texts.push(interface.path.clone());
                let methods = interface.methods.iter().flatten();
                texts.extend(methods.map(|method| method.signature.clone()));
            }
            for field in &node.cycle {
                if let CycleBinding::Procedure {
                    request, response, ..
                } = &field.binding
                {
                    texts.extend([request.text.clone(), response.text.clone()]);
                }
            }
            texts.extend(parts_of_instances(node));
        }
    }
    collect_types(&robot.parameter_tree, &mut texts);
    texts
}

/// Types behind `$cycler_instance`: `Frame` may name them, and they may lie below a leaf of the tree.
fn parts_of_instances(node: &Node) -> impl Iterator<Item = String> {
    let parts = node
        .parameters()
        .filter(|(access, _)| access.segments.iter().any(|one| one.instance));
    parts.map(|(_, data)| data.text.clone())
}

fn collect_types<U>(tree: &Tree<U>, texts: &mut Vec<String>) {
    for branch in &tree.branches {
        match &branch.content {
            Content::Leaf { data, .. } => texts.push(data.text.clone()),
            Content::Inner(tree) | Content::Instance { tree, .. } => collect_types(tree, texts),
        }
    }
}
