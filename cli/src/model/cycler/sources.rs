//! Which other instances a cycler reads.

use std::collections::BTreeSet;

use super::{FIELDS_OF_BODIES, Interleaving, Perception, Source};
use crate::model::frame::InstanceParameters;
use crate::model::names::{Names, snake_case};
use crate::resolve::robot::{CycleBinding, Cycler, InstanceId, Robot};

/// Every perception instance that any node consumes, once; `latest` are those of which it reads the newest cycle.
pub(super) fn perception(robot: &Robot, cycler: &Cycler, latest: &[Source]) -> Option<Perception> {
    let mut lanes = BTreeSet::new();
    let mut cyclers = BTreeSet::new();
    for field in cycler.nodes.iter().flat_map(|node| &node.cycle) {
        if let CycleBinding::Perception { instances, .. } = &field.binding {
            lanes.extend(instances.iter().copied());
            if let [first, _, ..] = instances.as_slice() {
                cyclers.insert(first.cycler);
            }
        }
    }
    if lanes.is_empty() {
        return None;
    }
    let taken = latest.iter().map(|source| source.writer.clone());
    let mut writers = Names::with(taken.chain(FIELDS_OF_BODIES.map(str::to_owned)));
    let lanes = lanes.into_iter().map(|id| source(robot, id));
    let lanes: Vec<Source> = lanes
        .map(|source| Source {
            writer: writers.give(&source.field),
            ..source
        })
        .collect();
    let interleavings = cyclers.into_iter().map(|cycler| Interleaving {
        field: snake_case(&robot.cyclers[cycler].name),
        lanes: lanes
            .iter()
            .filter(|lane| lane.id.cycler == cycler)
            .map(|lane| lane.field.clone())
            .collect(),
    });
    let interleavings: Vec<Interleaving> = interleavings.collect();
    let orders = interleavings.iter().map(|order| order.field.clone());
    let fields = lanes.iter().map(|lane| lane.field.clone()).chain(orders);
    Some(Perception {
        horizon: Names::with(fields).give("horizon"),
        interleavings,
        lanes,
    })
}

/// Every instance whose newest cycle any node reads, once.
pub(super) fn latest(robot: &Robot, cycler: &Cycler, parts: &[InstanceParameters]) -> Vec<Source> {
    let instances: BTreeSet<InstanceId> = cycler
        .nodes
        .iter()
        .flat_map(|node| &node.cycle)
        .filter_map(|field| match &field.binding {
            CycleBinding::OutputOf { instance, .. }
            | CycleBinding::RequiredOutputOf { instance, .. }
            | CycleBinding::Latest { instance, .. } => Some(*instance),
            _ => None,
        })
        .collect();
    let selects = parts.iter().map(|part| part.select.clone());
    let fields = FIELDS_OF_BODIES.map(str::to_owned);
    let mut names = Names::with(fields.into_iter().chain(selects));
    let sources = instances.into_iter().map(|id| source(robot, id));
    sources
        .map(|source| {
            let reader = names.give(&source.field);
            Source {
                writer: reader.clone(),
                reader,
                ..source
            }
        })
        .collect()
}

/// An instance as those name it who read it.
fn source(robot: &Robot, id: InstanceId) -> Source {
    let cycler = &robot.cyclers[id.cycler];
    let instance = cycler.instances[id.instance].name.clone();
    let field = snake_case(&instance);
    Source {
        id,
        reader: field.clone(),
        writer: field.clone(),
        field,
        instance,
        module: snake_case(&cycler.name),
    }
}
