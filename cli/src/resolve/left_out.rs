//! A robot without some of its cyclers: which of them run where its crate runs.
//!
//! Cyclers that are left out keep their place, so that every position in the robot stays right; what others read of them
//! stays as outputs that come from outside, all else of them goes.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::robot::{Branch, Content, Cycler, Node, Reader, Robot, Tree};

/// The robot as its own crate runs it: without what other machines run. A partial robot has what its names say.
pub(crate) fn here(robot: &Robot) -> Cow<'_, Robot> {
    let is_whole = robot.partial.is_none();
    if !(is_whole && robot.cyclers.iter().any(|cycler| cycler.remote)) {
        return Cow::Borrowed(robot);
    }
    let mut robot = robot.clone();
    leave_out(&mut robot, |cycler| cycler.remote);
    Cow::Owned(robot)
}

/// Leaves out every cycler of which this is true.
pub(crate) fn leave_out(robot: &mut Robot, is_left_out: impl Fn(&Cycler) -> bool) {
    for cycler in &mut robot.cyclers {
        cycler.left_out = is_left_out(cycler);
        if cycler.left_out {
            empty(cycler);
        }
        let outputs = cycler.outputs.iter_mut();
        outputs.for_each(|output| output.shared = false);
    }
    super::mark_readers(&mut robot.cyclers);
    for cycler in robot.cyclers.iter_mut().filter(|cycler| cycler.left_out) {
        cycler.outputs.retain(|output| output.shared);
    }
    let running: BTreeSet<usize> = robot.running().map(|(position, _)| position).collect();
    restrict_tree(&mut robot.parameter_tree, &|reader| {
        running.contains(&reader.cycler)
    });
}

/// Its nodes do nothing any more; they still say who writes what in the whole robot.
fn empty(cycler: &mut Cycler) {
    for node in &mut cycler.nodes {
        *node = Node {
            creation: Vec::new(),
            cycle: Vec::new(),
            outputs: Vec::new(),
            restores: false,
            new_bounds: Vec::new(),
            cycle_bounds: Vec::new(),
            restore_bounds: Vec::new(),
            markers: Vec::new(),
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
