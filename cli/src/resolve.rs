//! Stage ③: the robot, every name bound to what it means.
//!
//! Everything that two nodes, or a node and the manifest, can disagree about is found here, before rustc ever runs. A type
//! error is given only where both types could be followed to their definitions; else the edge is left to rustc and
//! counted.

mod bridges;
mod consumers;
mod crates;
mod declared;
mod failures;
mod hardware;
mod hints;
mod inputs;
mod left_out;
mod nodes;
pub mod parameter_files;
mod parameters;
mod paths;
mod procedures;
mod readers;
pub(crate) mod record;
pub mod robot;
mod scene;
mod sendable;
mod states;
mod tree;
mod warnings;

use std::time::Duration;

use crate::diagnostics::{Diagnostics, Reported};
use crate::manifest::{self, Manifest};
use crate::scan::Sources;
use crate::workspace::Workspace;

use robot::{Cycler, CyclerKind, Instance, Node, OnFailure, Output, Robot, Scheduling};
use scene::Scene;

pub(crate) use crates::dependencies;
pub(crate) use left_out::{here, leave_out};
use readers::mark_readers;

/// `pending_timeout` where the manifest says nothing.
const PENDING_TIMEOUT: Duration = Duration::from_secs(1);
/// `watchdog` where the manifest says nothing.
const WATCHDOG: Duration = Duration::from_millis(300);
/// `queue` where the manifest says nothing.
const QUEUE: usize = 32;

/// Binds every name of the manifest and the nodes.
///
/// # Errors
/// Whatever two places disagree about; see the catalogue. Warnings are added, too.
pub fn resolve(
    workspace: &Workspace,
    manifest: &Manifest,
    sources: &Sources<'_>,
    diagnostics: &mut Diagnostics,
) -> Result<Robot, Reported> {
    let scene = Scene::new(manifest, sources, diagnostics);
    let (mut left_to_rustc, mut besides_edges) = (0, 0);
    let mut cyclers: Vec<Cycler> = Vec::new();
    for index in 0..scene.cyclers.len() {
        let (cycler, unchecked, hidden) = resolve_cycler(workspace, &scene, index, diagnostics);
        left_to_rustc += unchecked;
        besides_edges += hidden;
        cyclers.push(cycler);
    }
    mark_readers(&mut cyclers);
    consumers::check(manifest, &cyclers, diagnostics);
    let parameters = parameters::parameters(&scene, diagnostics);
    left_to_rustc += parameters.unchecked;
    besides_edges += parameters.unchecked;
    let mut robot = Robot {
        name: manifest.robot.name.to_string(),
        generated: manifest.robot.generated.clone(),
        parameters: manifest.robot.parameters.clone(),
        identities: manifest
            .robot
            .identities
            .iter()
            .map(ToString::to_string)
            .collect(),
        recording_budget: manifest.robot.recording_budget.bytes(),
        targets: hardware::targets(workspace, manifest, &sources.library, diagnostics),
        left_to_rustc: left_to_rustc + cyclers.iter().map(unchecked_edges).sum::<usize>(),
        besides_edges,
        cyclers,
        partial: None,
        parameter_tree: parameters.tree,
        parameter_hints: parameters.hints,
        bridges: bridges::bridges(manifest, &scene, diagnostics),
        crates: Vec::new(),
        inherited: workspace.members().inherited.clone(),
    };
    let left = check_nodes(manifest, sources, diagnostics);
    robot.left_to_rustc += left;
    robot.besides_edges += left;
    robot.crates = dependencies(workspace, &here(&robot));
    sources.library.report_problems(diagnostics);
    diagnostics.stop_at_errors()?;
    warnings::warn(&robot, manifest, sources, diagnostics);
    Ok(robot)
}

/// What makes a node as a whole useless for the generated crate; the number of questions that are left to rustc.
fn check_nodes(manifest: &Manifest, sources: &Sources<'_>, diagnostics: &mut Diagnostics) -> usize {
    let here = || hardware::running_here(manifest, sources);
    let uncertain =
        here().filter(|node| node.is_uncertain() || sources.library.is_conditional(&node.module));
    let made = here().filter(|node| node.state.is_none());
    uncertain.count()
        + made.count()
        + declared::unsure(here(), &sources.library)
        + hardware::foreign_bounds(here(), &sources.library)
        + sendable::check_states(here(), sources, diagnostics)
        + failures::check(here(), sources, diagnostics)
        + hardware::check_served(manifest, sources, diagnostics)
}

fn resolve_cycler(
    workspace: &Workspace,
    scene: &Scene<'_>,
    index: usize,
    diagnostics: &mut Diagnostics,
) -> (Cycler, usize, usize) {
    let cycler = &scene.cyclers[index];
    let declared = &cycler.declared.declared;
    let nodes = cycler.nodes.iter().map(|node| {
        let text = workspace.text(node.source.file()).unwrap_or_default();
        nodes::bind(scene, index, *node, &text, diagnostics)
    });
    let nodes: Vec<Node> = nodes.collect();
    procedures::check(cycler, diagnostics);
    let (states, unchecked, hidden) = states::states(scene, cycler, diagnostics);
    let resolved = Cycler {
        name: cycler.declared.name().to_owned(),
        left_out: false,
        remote: declared.remote,
        kind: match declared.kind {
            schema::CyclerKind::Perception => CyclerKind::Perception,
            schema::CyclerKind::RealTime => CyclerKind::RealTime,
        },
        instances: cycler
            .declared
            .instances
            .iter()
            .map(|one| instance(scene, index, one, diagnostics))
            .collect(),
        outputs: outputs(cycler, &nodes),
        nodes,
        additional_outputs: states::additional_outputs(scene, cycler, diagnostics),
        states,
        on_failure: nodes::on_failure(declared.on_failure),
        pending_timeout: declared.pending_timeout.map_or(PENDING_TIMEOUT, Into::into),
        queue: declared.queue.unwrap_or(QUEUE),
        watchdog: declared.watchdog.map_or(WATCHDOG, Into::into),
        history: declared
            .history
            .map_or_else(|| longest_pending_timeout(scene), Into::into),
        lockstep_duration: declared.lockstep_duration.map(Into::into),
    };
    (resolved, unchecked, hidden)
}

fn longest_pending_timeout(scene: &Scene<'_>) -> Duration {
    let declared = scene.cyclers.iter().map(|cycler| &cycler.declared.declared);
    let perception = declared.filter(|one| one.kind == schema::CyclerKind::Perception);
    let timeouts = perception.map(|one| one.pending_timeout.map_or(PENDING_TIMEOUT, Into::into));
    timeouts.max().unwrap_or(PENDING_TIMEOUT)
}

fn instance(
    scene: &Scene<'_>,
    index: usize,
    instance: &manifest::Instance,
    diagnostics: &mut Diagnostics,
) -> Instance {
    let located = scene.cyclers[index].declared;
    let cycler = &located.declared;
    let own = instance.table.as_ref();
    let declared = own
        .and_then(|own| Some((own.record.as_ref()?, instance.record_range.clone())))
        .or_else(|| Some((cycler.record.as_ref()?, located.record_range.clone())));
    let record = declared.and_then(|(record, place)| {
        record::record(scene, index, record, place.unwrap_or_default(), diagnostics)
    });
    let scheduling = own
        .and_then(|own| own.scheduling.as_ref())
        .or(cycler.scheduling.as_ref());
    let deadline = own.and_then(|own| own.deadline).or(cycler.deadline);
    Instance {
        name: instance.name.to_string(),
        deadline: deadline.map(Into::into),
        scheduling: scheduling.map_or_else(Scheduling::default, |scheduling| Scheduling {
            policy: scheduling.policy.map(|policy| match policy {
                schema::Policy::Fifo => "fifo".to_owned(),
                schema::Policy::RoundRobin => "round-robin".to_owned(),
            }),
            priority: scheduling.priority,
            cores: scheduling.cores.clone(),
        }),
        record: record.unwrap_or_default(),
    }
}

fn outputs(cycler: &scene::SceneCycler<'_>, nodes: &[Node]) -> Vec<Output> {
    let outputs = cycler.outputs.iter().map(|(name, producer)| Output {
        name: name.clone(),
        data: (&producer.data).into(),
        producer: producer.node,
        in_place: producer.in_place,
        shared: false,
        historic: false,
        previous: nodes
            .get(producer.node)
            .is_some_and(|node| node.on_failure == OnFailure::Hold),
    });
    outputs.collect()
}

fn unchecked_edges(cycler: &Cycler) -> usize {
    let fields = cycler.nodes.iter().flat_map(|node| &node.cycle);
    let reads = fields.filter_map(|field| field.binding.read());
    reads.filter(|read| !read.checked).count()
}

#[cfg(test)]
mod tests;
