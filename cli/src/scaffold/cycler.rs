//! A new cycler with the setup node that will wait for its data.

use std::collections::BTreeSet;

use schema::{CyclerKind, CyclerName, InstanceSuffix, SpellingError};
use toml_edit::{Array, Table};

use super::node::{NewNode, node_files};
use super::{Changes, document, manifest_change, read_manifest};
use crate::outcome::Refusal;
use crate::resolve::robot::Robot;
use crate::workspace::{MANIFEST, Workspace};

/// What is asked for.
#[derive(Clone, Debug)]
pub struct NewCycler<'a> {
    pub name: &'a str,
    pub kind: CyclerKind,
    /// Suffixes; empty for one instance that is named like the cycler.
    pub instances: &'a [String],
    /// `crate::module::path` of a node that is new, too: a cycler has at least one.
    pub setup_node: &'a str,
}

/// Adds a cycler behind the others of a robot that is right.
pub fn add_cycler(
    workspace: &Workspace,
    robot: &Robot,
    cycler: &NewCycler<'_>,
) -> Result<Changes, Refusal> {
    let misspelled = |error: SpellingError| Refusal::wrong_usage(error.to_string());
    let name: CyclerName = cycler.name.parse().map_err(misspelled)?;
    for suffix in cycler.instances {
        suffix.parse::<InstanceSuffix>().map_err(misspelled)?;
    }
    if robot
        .cyclers
        .iter()
        .any(|known| known.name == name.as_str())
    {
        let message = format!("the cycler `{name}` is there already");
        return Err(
            Refusal::wrong_usage(message).help("choose another name, or use `hulkgen add-node`")
        );
    }
    let node = NewNode {
        path: cycler.setup_node,
        cycler: cycler.name,
        setup: true,
    };
    let mut changes = node_files(workspace, robot, &node, false, &BTreeSet::new())?;
    let mut manifest = read_manifest(workspace)?;
    let pushed = document::push_table(&mut manifest, "cycler", table(cycler));
    pushed.ok_or_else(|| {
        Refusal::bad(format!(
            "the cyclers of `{MANIFEST}` are no `[[cycler]]` tables"
        ))
        .help("write each as `[[cycler]]`")
    })?;
    changes.extend([manifest_change(workspace, &manifest)?]);
    Ok(changes)
}

fn table(cycler: &NewCycler<'_>) -> Table {
    let mut table = Table::new();
    let kind = match cycler.kind {
        CyclerKind::Perception => "perception",
        CyclerKind::RealTime => "real-time",
    };
    table.insert("name", toml_edit::value(cycler.name));
    table.insert("kind", toml_edit::value(kind));
    if !cycler.instances.is_empty() {
        let instances: Array = cycler.instances.iter().map(String::as_str).collect();
        table.insert("instances", toml_edit::value(instances));
    }
    let nodes: Array = [cycler.setup_node].into_iter().collect();
    table.insert("setup_nodes", toml_edit::value(nodes));
    table.decor_mut().set_prefix("\n");
    table
}
