//! What a robot reads of cyclers that do not run where it runs.

use std::collections::BTreeSet;

use serde::Serialize;

use super::cycler::{OutputField, outputs};
use super::names::snake_case;
use crate::resolve::robot::{Cycler, InstanceId, Robot};

/// `databases/<cycler>.rs` of a cycler that is left out.
#[derive(Clone, Debug, Serialize)]
pub struct Outside {
    /// `Vision`.
    pub name: String,
    /// `vision`.
    pub module: String,
    /// Why it does not run here, behind "which".
    pub reason: &'static str,
    /// Main outputs that others read, sorted by name.
    pub outputs: Vec<OutputField>,
}

/// Every cycler that is left out and read, in manifest order.
pub fn describe(robot: &Robot) -> Vec<Outside> {
    let outside = cyclers(robot).map(|(_, cycler)| Outside {
        name: cycler.name.clone(),
        module: snake_case(&cycler.name),
        reason: if cycler.remote {
            "another machine runs"
        } else {
            "is left out"
        },
        outputs: outputs(cycler),
    });
    outside.collect()
}

/// Cyclers that are left out and read, by their position.
pub(super) fn cyclers(robot: &Robot) -> impl Iterator<Item = (usize, &Cycler)> {
    let cyclers = robot.cyclers.iter().enumerate();
    cyclers.filter(|(_, cycler)| cycler.left_out && !cycler.outputs.is_empty())
}

/// Instances that are left out and read, in manifest order.
pub(super) fn instances(robot: &Robot) -> BTreeSet<InstanceId> {
    let nodes = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
    let fields = nodes.flat_map(|node| &node.cycle);
    let read = fields.filter_map(|field| field.binding.read());
    read.flat_map(|read| read.instances)
        .filter(|id| robot.cyclers[id.cycler].left_out)
        .copied()
        .collect()
}
