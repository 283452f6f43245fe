//! A node leaves the manifest and, where that is asked for, the disk.

use camino::Utf8PathBuf;
use toml_edit::{Item, Value};

use super::{Changes, document, manifest_change, module, own_member, read, read_manifest, unknown};
use crate::outcome::Refusal;
use crate::resolve::robot::{Cycler, Node, Robot};
use crate::workspace::{MANIFEST, Workspace};

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Removal<'a> {
    /// `crate::module::path`.
    pub path: &'a str,
    /// Only from this cycler; from all of them if left out.
    pub cycler: Option<&'a str>,
    /// Its file and its `mod` line, too.
    pub delete: bool,
}

/// Removes a node from a robot that is right.
pub fn remove_node(
    workspace: &Workspace,
    robot: &Robot,
    removal: &Removal<'_>,
) -> Result<Changes, Refusal> {
    if let Some(name) = removal.cycler
        && robot.cyclers.iter().all(|cycler| cycler.name != name)
    {
        let names = || robot.cyclers.iter().map(|cycler| cycler.name.as_str());
        let message = format!("the robot has no cycler `{name}`");
        return Err(unknown(&message, name, names, "the cyclers are"));
    }
    let has = |cycler: &&Cycler| cycler.nodes.iter().any(|node| node.path == removal.path);
    let all: Vec<&Cycler> = robot.cyclers.iter().filter(has).collect();
    let chosen = all
        .iter()
        .filter(|cycler| removal.cycler.is_none_or(|name| cycler.name == name));
    let chosen: Vec<&str> = chosen.map(|cycler| cycler.name.as_str()).collect();
    if chosen.is_empty() {
        return Err(unknown_node(robot, removal));
    }
    let mut changes = Changes::from([without_entries(workspace, removal.path, &chosen)?]);
    if removal.delete {
        if chosen.len() < all.len() {
            let message = format!("`{}` stays a node of other cyclers", removal.path);
            return Err(
                Refusal::wrong_usage(message).help("leave out `--delete`, or leave out `--cycler`")
            );
        }
        let node = all
            .iter()
            .flat_map(|cycler| &cycler.nodes)
            .find(|node| node.path == removal.path);
        if let Some(node) = node {
            changes.extend(deletion(workspace, robot, node)?);
        }
    }
    Ok(changes)
}

/// The manifest without a node in these cyclers.
fn without_entries(
    workspace: &Workspace,
    path: &str,
    cyclers: &[&str],
) -> Result<(Utf8PathBuf, Option<String>), Refusal> {
    let mut manifest = read_manifest(workspace)?;
    for name in cyclers {
        let table = document::cycler(&mut manifest, name);
        let table = table
            .ok_or_else(|| Refusal::bad(format!("cannot find cycler `{name}` in `{MANIFEST}`")))?;
        for key in ["setup_nodes", "nodes"] {
            let Some(list) = table.get_mut(key).and_then(Item::as_array_mut) else {
                continue;
            };
            let is_node = |entry: &Value| path_of(entry) == Some(path);
            let index = list.iter().position(is_node);
            if let Some(index) = index {
                document::remove(list, index);
            }
        }
    }
    manifest_change(workspace, &manifest)
}

/// The node's file and the line that declares it.
fn deletion(
    workspace: &Workspace,
    robot: &Robot,
    node: &Node,
) -> Result<Vec<(Utf8PathBuf, Option<String>)>, Refusal> {
    let mut segments = node.path.split("::");
    let member = own_member(workspace, robot, segments.next().unwrap_or_default())?;
    let names: Vec<&str> = segments.collect();
    if module::has_modules(&read(workspace, &node.file)?) {
        let message = format!("`{}` declares modules of its own", node.file);
        return Err(Refusal::bad(message)
            .help("leave out `--delete`, and delete by hand what is no longer needed"));
    }
    let (file, text) = module::undeclare(workspace, member, &names)?;
    Ok(vec![(node.file.clone(), None), (file, Some(text))])
}

/// The path of an entry, also of one with settings.
fn path_of(entry: &Value) -> Option<&str> {
    entry
        .as_str()
        .or_else(|| entry.as_inline_table()?.get("node")?.as_str())
}

fn unknown_node(robot: &Robot, removal: &Removal<'_>) -> Refusal {
    let cyclers = || {
        let all = robot.cyclers.iter();
        all.filter(|cycler| removal.cycler.is_none_or(|name| cycler.name == name))
    };
    let names = || cyclers().flat_map(|cycler| cycler.nodes.iter().map(|node| node.path.as_str()));
    let place = removal
        .cycler
        .map_or("the robot".to_owned(), |name| format!("cycler `{name}`"));
    unknown(
        &format!("{place} has no node `{}`", removal.path),
        removal.path,
        names,
        "the nodes are",
    )
}
