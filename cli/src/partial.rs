//! A robot of some of its cyclers: between stages ④ and ⑤, from [`Robot`] to [`Robot`].
//!
//! Cyclers that are left out keep their place, so that every position in the robot stays right; what others read of them
//! stays as outputs that come from outside, all else of them goes.
//!
//! Invariant: with all cyclers named nothing of what runs differs from the whole robot.

use std::collections::BTreeSet;

use camino::{Utf8Path, Utf8PathBuf};
use schema::snake_case;

use crate::resolve;
use crate::resolve::robot::{Branch, Content, Cycler, Node, Partial, Reader, Robot, Tree};
use crate::workspace::Workspace;

/// The robot has no cycler of this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownCycler {
    pub name: String,
    /// The cycler that has an instance of this name.
    pub of_instance: Option<String>,
}

/// The robot with only the cyclers of these names, in whatever order and however often they are named.
///
/// `output` is the folder of its crate; without it the folder follows from the names.
///
/// # Errors
/// For the first name that is no cycler's.
pub fn restrict(
    workspace: &Workspace,
    robot: &Robot,
    names: &[String],
    output: Option<&Utf8Path>,
) -> Result<Robot, UnknownCycler> {
    let mut robot = robot.clone();
    let unknown = |name: &&String| robot.cyclers.iter().all(|cycler| cycler.name != **name);
    if let Some(name) = names.iter().find(unknown) {
        return Err(unknown_cycler(&robot, name));
    }
    for cycler in &mut robot.cyclers {
        cycler.left_out = !names.contains(&cycler.name);
        if cycler.left_out {
            leave_out(cycler);
        }
        let outputs = cycler.outputs.iter_mut();
        outputs.for_each(|output| output.shared = false);
    }
    resolve::mark_readers(&mut robot.cyclers);
    for cycler in robot.cyclers.iter_mut().filter(|cycler| cycler.left_out) {
        cycler.outputs.retain(|output| output.shared);
    }
    let running: BTreeSet<usize> = robot.running().map(|(position, _)| position).collect();
    restrict_tree(&mut robot.parameter_tree, &|reader| {
        running.contains(&reader.cycler)
    });
    let only: Vec<String> = robot
        .running()
        .map(|(_, cycler)| cycler.name.clone())
        .collect();
    let default = default_folder(&robot.generated, &only);
    let output = output.filter(|output| *output != default);
    robot.generated = output.map_or(default, Utf8Path::to_owned);
    robot.partial = Some(Partial {
        only,
        output: output.map(Utf8Path::to_owned),
    });
    // Whoever uses it brings the hardware.
    robot.targets.clear();
    robot.bridges.clear();
    robot.crates = resolve::dependencies(workspace, &robot);
    Ok(robot)
}

/// `generated-vision-control` beside `generated`.
fn default_folder(generated: &Utf8Path, only: &[String]) -> Utf8PathBuf {
    let names = only.iter().map(|name| format!("-{}", snake_case(name)));
    format!("{generated}{}", names.collect::<String>()).into()
}

fn unknown_cycler(robot: &Robot, name: &str) -> UnknownCycler {
    let has = |cycler: &&Cycler| cycler.instances.iter().any(|one| one.name == name);
    let of_instance = robot.cyclers.iter().find(has);
    UnknownCycler {
        name: name.to_owned(),
        of_instance: of_instance.map(|cycler| cycler.name.clone()),
    }
}

/// Its nodes do nothing any more; they still say who writes what in the whole robot.
fn leave_out(cycler: &mut Cycler) {
    for node in &mut cycler.nodes {
        *node = Node {
            creation: Vec::new(),
            cycle: Vec::new(),
            outputs: Vec::new(),
            restores: false,
            new_bounds: Vec::new(),
            cycle_bounds: Vec::new(),
            restore_bounds: Vec::new(),
            ..node.clone()
        };
    }
    cycler.states.branches.clear();
    cycler.additional_outputs.branches.clear();
}

/// Keeps the values that somebody reads who is there, and notes the levels that have lost some.
fn restrict_tree(tree: &mut Tree<Reader>, is_there: &dyn Fn(&Reader) -> bool) {
    let before = tree.branches.len();
    tree.branches
        .retain_mut(|Branch { content, .. }| match content {
            Content::Leaf { users, .. } => {
                users.retain(is_there);
                !users.is_empty()
            }
            Content::Inner(tree) | Content::Instance { tree, .. } => {
                restrict_tree(tree, is_there);
                !tree.branches.is_empty()
            }
        });
    tree.open = tree.branches.len() < before;
}
