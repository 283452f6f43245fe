//! Nodes by the names that people give them.

use crate::diagnostics::nearest;
use crate::outcome::Refusal;
use crate::resolve::robot::{Cycler, Node, Robot};

/// A node in one of its cyclers.
#[derive(Clone, Copy)]
pub(super) struct Place<'r> {
    pub(super) robot: &'r Robot,
    /// Position of the cycler in the robot.
    pub(super) cycler: usize,
    /// Position in the nodes of the cycler.
    pub(super) node: usize,
}

impl<'r> Place<'r> {
    pub(super) fn cycler(&self) -> &'r Cycler {
        &self.robot.cyclers[self.cycler]
    }

    pub(super) fn node(&self) -> &'r Node {
        &self.cycler().nodes[self.node]
    }
}

/// Whether a node is meant: by its path or its module's name.
pub(super) fn is_named(path: &str, name: &str) -> bool {
    path == name || path.rsplit("::").next() == Some(name)
}

/// Every place of the nodes of this name.
pub(super) fn find<'r>(robot: &'r Robot, name: &str) -> Result<Vec<Place<'r>>, Refusal> {
    let mut places = Vec::new();
    for (cycler, declared) in robot.cyclers.iter().enumerate() {
        for (node, found) in declared.nodes.iter().enumerate() {
            if is_named(&found.path, name) {
                places.push(Place {
                    robot,
                    cycler,
                    node,
                });
            }
        }
    }
    if places.is_empty() {
        return Err(unknown(robot, name));
    }
    Ok(places)
}

fn unknown(robot: &Robot, name: &str) -> Refusal {
    let nodes = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
    let mut names = Vec::new();
    for node in nodes {
        names.push(node.path.as_str());
        names.extend(node.path.rsplit("::").next());
    }
    let refusal = Refusal::wrong_usage(format!("there is no node `{name}`"));
    refusal.help(match nearest(name, names) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => "`hulkgen show schedule` lists all nodes".to_owned(),
    })
}
