//! `src/recording.rs` and `src/recording/…`: what instances are replayed with.

use std::collections::BTreeMap;

use serde::Serialize;

use super::cycler::CyclerModel;
use super::frame::{Hardware, is_marker};
use crate::resolve::robot::{Condition, Interface, Record, Robot};

pub use crate::resolve::robot::{Answer, Method};

/// What stands in for the hardware in a replay.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Sink {
    /// Traits that can be written down, sorted by path.
    pub traits: Vec<SinkTrait>,
}

/// A hardware trait and the methods that it asks for.
#[derive(Clone, Debug, Serialize)]
pub struct SinkTrait {
    pub path: String,
    pub methods: Vec<Method>,
}

/// Which cycles of an instance are recorded.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum RecordModel {
    On,
    Off,
    Every(u32),
    While { instance: String, path: String },
}

impl Sink {
    /// Whether it is hardware enough for the nodes of a cycler.
    pub fn serves(&self, cycler: &CyclerModel) -> bool {
        match &cycler.hardware {
            Hardware::Absent => true,
            Hardware::Asked(traits) => {
                let is_served = |asked: &String| {
                    is_marker(asked) || self.traits.iter().any(|one| one.path == *asked)
                };
                traits.iter().all(is_served)
            }
        }
    }
}

/// Decides what stands in for the hardware.
pub fn sink(robot: &Robot) -> Sink {
    let nodes = robot.running().flat_map(|(_, cycler)| &cycler.nodes);
    let asked = nodes.flat_map(|node| [&node.new_bounds, &node.cycle_bounds, &node.restore_bounds]);
    Sink {
        traits: traits(asked.flatten()),
    }
}

/// Those of the traits that can be written down, each once, sorted by path.
pub fn traits<'a>(asked: impl Iterator<Item = &'a Interface>) -> Vec<SinkTrait> {
    let known = |interface: &Interface| Some((interface.path.clone(), interface.methods.clone()?));
    let traits: BTreeMap<_, _> = asked.filter_map(known).collect();
    let traits = traits.into_iter();
    traits
        .map(|(path, methods)| SinkTrait { path, methods })
        .collect()
}

/// Decides what an instance records.
pub fn record(robot: &Robot, instance: &str, record: &Record) -> RecordModel {
    match record {
        Record::On => RecordModel::On,
        Record::Off => RecordModel::Off,
        Record::Every(cycles) => RecordModel::Every(*cycles),
        Record::While(Condition {
            instance: of,
            access,
            ..
        }) => {
            let other = of.map(|of| robot.cyclers[of.cycler].instances[of.instance].name.clone());
            let names = access.segments.iter().map(|segment| segment.name.as_str());
            RecordModel::While {
                instance: other.unwrap_or_else(|| instance.to_owned()),
                path: names.collect::<Vec<_>>().join("."),
            }
        }
    }
}
