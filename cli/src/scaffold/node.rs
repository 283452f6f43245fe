//! A new node: its file with a test, its `mod` line, its place in the manifest.

use std::collections::BTreeSet;

use schema::NodePath;

use super::files::{self, NodeFile};
use super::{Changes, document, manifest_change, module, own_member, read, read_manifest, unknown};
use crate::outcome::Refusal;
use crate::resolve::robot::{Cycler, Robot};
use crate::workspace::{MANIFEST, Member, Workspace};

/// What is asked for.
#[derive(Clone, Debug)]
pub struct NewNode<'a> {
    /// `crate::module::path`.
    pub path: &'a str,
    pub cycler: &'a str,
    pub setup: bool,
}

/// What a new node's file names besides its own type.
const NAMED: [&str; 12] = [
    "CreationContext",
    "CycleContext",
    "CycleTime",
    "Debug",
    "Deserialize",
    "Duration",
    "MainOutput",
    "MainOutputs",
    "Ok",
    "Result",
    "Self",
    "Serialize",
];

/// Crates that every node file names.
const NEEDED: [&str; 2] = ["framework", "serde"];

/// Adds a node to a cycler of a robot that is right.
pub fn add_node(
    workspace: &Workspace,
    robot: &Robot,
    node: &NewNode<'_>,
) -> Result<Changes, Refusal> {
    let names = || robot.cyclers.iter().map(|cycler| cycler.name.as_str());
    let cycler = robot
        .cyclers
        .iter()
        .find(|cycler| cycler.name == node.cycler);
    let cycler = cycler.ok_or_else(|| {
        let message = format!("the robot has no cycler `{}`", node.cycler);
        unknown(&message, node.cycler, names, "the cyclers are")
    })?;
    let paced = cycler.nodes.iter().any(|node| node.setup);
    let mut changes = node_files(workspace, robot, node, paced, &outputs(cycler))?;
    let mut manifest = read_manifest(workspace)?;
    let key = if node.setup { "setup_nodes" } else { "nodes" };
    let list =
        document::cycler(&mut manifest, node.cycler).and_then(|table| document::list(table, key));
    let list = list.ok_or_else(|| {
        Refusal::bad(format!(
            "cannot find `{key}` of `{}` in `{MANIFEST}`",
            node.cycler
        ))
    })?;
    document::push(list, node.path);
    changes.extend([manifest_change(workspace, &manifest)?]);
    Ok(changes)
}

/// With what keeps one of the names from being that of a module.
fn misspelled(path: &str, error: &schema::SpellingError) -> Refusal {
    let refusal = Refusal::wrong_usage(error.to_string());
    let plain = |name: &&str| {
        name.chars()
            .all(|one| one.is_ascii_alphanumeric() || one == '_')
    };
    let mut names = path.split("::").map(|name| name.trim_start_matches("r#"));
    let wrong = names.find(|name| !name.is_empty() && !schema::is_identifier(name));
    match wrong {
        Some(name) if plain(&name) && name.starts_with(|one: char| one.is_ascii_alphabetic()) => {
            refusal.help(format!(
                "`{name}` is a keyword of Rust: choose another name"
            ))
        }
        Some(name) => refusal.help(format!(
            "write `{name}` with the letters a to z, digits and `_`, beginning with a letter"
        )),
        None => refusal,
    }
}

/// Everything of a new node but its place in the manifest; `taken` are the outputs that its cycler has.
pub(super) fn node_files(
    workspace: &Workspace,
    robot: &Robot,
    node: &NewNode<'_>,
    paced: bool,
    taken: &BTreeSet<&str>,
) -> Result<Changes, Refusal> {
    let path: NodePath = node
        .path
        .parse()
        .map_err(|error: schema::SpellingError| misspelled(node.path, &error))?;
    let mut segments = path.segments();
    let library = segments.next().unwrap_or_default();
    let names: Vec<&str> = segments.collect();
    for name in &names {
        files::check_module_name(name)?;
    }
    let member = own_member(workspace, robot, library)?;
    let (mut changes, file) = module::declare(workspace, member, &names)?;
    let last = names.last().copied().unwrap_or_default();
    let output = if taken.contains(last) {
        format!("{last}_output")
    } else {
        last.to_owned()
    };
    let text = files::render_node(
        &NodeFile {
            type_name: &type_name(last),
            output: &output,
            paces: !paced,
        },
        node.setup,
    );
    changes.insert(file, Some(text));
    changes.extend(dependencies(workspace, member)?);
    Ok(changes)
}

/// What the state of a node with this name is called.
fn type_name(node: &str) -> String {
    let name = schema::upper_camel_case(node);
    match NAMED.contains(&name.as_str()) {
        true => format!("{name}Node"),
        false => name,
    }
}

/// Names of a cycler's main outputs and of its other outputs.
fn outputs(cycler: &Cycler) -> BTreeSet<&str> {
    let main = cycler.outputs.iter().map(|output| output.name.as_str());
    let additional = &cycler.additional_outputs.branches;
    main.chain(additional.iter().map(|branch| branch.name.as_str()))
        .collect()
}

/// The crate's Cargo.toml with what every node needs, if it lacks something.
fn dependencies(
    workspace: &Workspace,
    member: &Member,
) -> Result<Option<(camino::Utf8PathBuf, Option<String>)>, Refusal> {
    let has = |library: &&str| member.dependencies().any(|known| known == *library);
    let missing: Vec<&str> = NEEDED.into_iter().filter(|library| !has(library)).collect();
    if missing.is_empty() {
        return Ok(None);
    }
    let file = member.folder.join("Cargo.toml");
    let before = read(workspace, &file)?;
    let mut package = document::parse(&file, &before)?;
    for library in missing {
        let found = workspace
            .members()
            .requirement(library, &member.folder, &[]);
        let (key, requirement) = found.ok_or_else(|| {
            Refusal::bad(format!(
                "`{file}` lacks the dependency `{library}` that every node needs"
            ))
            .help(format!("add `{library}` to its `[dependencies]`"))
        })?;
        let mut value: toml_edit::Value = requirement.parse().map_err(|error| {
            Refusal::bad(format!("cannot read the dependency `{library}`: {error}"))
        })?;
        value.decor_mut().clear();
        let table = package
            .entry("dependencies")
            .or_insert_with(toml_edit::table);
        if let Some(table) = table.as_table_like_mut() {
            table.insert(&key, toml_edit::Item::Value(value));
        }
    }
    let text = document::written(&package, &before);
    Ok(Some((file, Some(text))))
}

#[cfg(test)]
mod tests {
    use proc_macro2::{TokenStream, TokenTree};

    use super::*;

    fn names(tokens: TokenStream, found: &mut BTreeSet<String>) {
        for token in tokens {
            match token {
                TokenTree::Group(group) => names(group.stream(), found),
                TokenTree::Ident(name) => {
                    found.insert(name.to_string());
                }
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }

    #[test]
    fn what_is_no_name_of_a_module_is_told_with_what_to_do() {
        for (path, expected) in [
            (
                "nodes::type",
                "`type` is a keyword of Rust: choose another name",
            ),
            ("nodes::r#match", "`match` is a keyword of Rust"),
            ("nodes::größe", "write `größe` with the letters a to z"),
            ("nodes::2d", "beginning with a letter"),
        ] {
            let error = path.parse::<NodePath>().expect_err("it is none");
            let help = misspelled(path, &error).help.unwrap_or_default();
            assert!(help.contains(expected), "{path}: {help}");
        }
    }

    #[test]
    fn no_state_is_called_as_something_else_in_its_file() {
        for setup in [false, true] {
            let file = NodeFile {
                type_name: "Own",
                output: "own",
                paces: true,
            };
            let text = files::render_node(&file, setup);
            let mut found = BTreeSet::new();
            names(text.parse().expect("it is Rust"), &mut found);
            found.remove("Own");
            let types = found
                .iter()
                .filter(|name| name.starts_with(char::is_uppercase));
            // Constants have other names than types.
            for name in types.filter(|name| name.contains(char::is_lowercase)) {
                assert!(NAMED.contains(&name.as_str()), "{name}");
            }
        }
        assert_eq!(type_name("result"), "ResultNode");
        assert_eq!(type_name("self_"), "SelfNode");
        assert_eq!(type_name("ball_filter"), "BallFilter");
    }
}
