//! What becomes of values downstream while a node fails, under its `on_failure`.

mod page;
mod spread;

use camino::Utf8PathBuf;
use serde::{Serialize, Serializer};

use super::nodes::{self, Place};
use crate::outcome::Refusal;
use crate::pipeline::Understood;
use crate::resolve::robot::{CycleBinding, CyclerKind, Node, OnFailure, OutputBinding};
use crate::schedule::CyclerSchedule;
use spread::Spread;

pub(super) use page::text;

/// What there is to say about a node.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    version: u32,
    /// In every cycler that has it.
    failures: Vec<Failure>,
}

#[derive(Debug, Serialize)]
struct Failure {
    cycler: String,
    node: String,
    setup: bool,
    #[serde(serialize_with = "by_name")]
    on_failure: OnFailure,
    real_time: bool,
    /// What becomes of the cycle in which it fails.
    cycle: Fate,
    outputs: Vec<String>,
    /// Nodes of the cycler that do not run in this cycle.
    not_run: Vec<String>,
    /// Procedures whose calls are refused.
    refused: Vec<String>,
    effects: Vec<Effect>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Fate {
    /// The other nodes run, and others see the cycle.
    Completed,
    /// Nobody sees it.
    Abandoned,
    /// It never begins: setup starts over.
    NotBegun,
}

/// What a field of another node sees.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
struct Effect {
    cycler: String,
    node: String,
    field: String,
    /// `Input`, `RequiredInput` …
    kind: &'static str,
    /// Whose output or state: an instance, or the own cycler.
    from: String,
    output: String,
    becomes: Becomes,
    /// The node is skipped, and its outputs are defaults.
    skipped: bool,
    file: Utf8PathBuf,
    line: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Becomes {
    Absent,
    /// Whether it is absent is decided by the default of the output's type.
    PerhapsAbsent,
    Default,
    /// It stays what it was.
    Held,
    /// The entry of this cycle never comes.
    Abandoned,
    /// The robot stops.
    Stopped,
}

/// Looks the node up.
pub(super) fn explain(understood: &Understood, name: &str) -> Result<Answer, Refusal> {
    let places = nodes::find(&understood.robot, name)?;
    Ok(Answer {
        version: 1,
        failures: (places.into_iter())
            .map(|place| failure(place, &understood.schedule.cyclers[place.cycler]))
            .collect(),
    })
}

fn failure(place: Place<'_>, schedule: &CyclerSchedule) -> Failure {
    let (cycler, node) = (place.cycler(), place.node());
    let cycle = match node.on_failure {
        OnFailure::Stop | OnFailure::Restart => Fate::Abandoned,
        OnFailure::Skip | OnFailure::Hold if node.setup => Fate::NotBegun,
        OnFailure::Skip | OnFailure::Hold => Fate::Completed,
    };
    let mut spread = Spread::new(place.robot);
    match cycle {
        Fate::Completed => spread.defaults(place),
        Fate::Abandoned if node.on_failure == OnFailure::Stop => {
            spread.without_cycle(place, Becomes::Stopped, Becomes::Stopped);
        }
        Fate::Abandoned => spread.without_cycle(place, Becomes::Held, Becomes::Abandoned),
        Fate::NotBegun => spread.without_cycle(place, Becomes::Held, Becomes::Absent),
    }
    Failure {
        cycler: cycler.name.clone(),
        node: node.path.clone(),
        setup: node.setup,
        on_failure: node.on_failure,
        real_time: cycler.kind == CyclerKind::RealTime,
        cycle,
        outputs: outputs(node),
        not_run: match cycle {
            Fate::Completed => Vec::new(),
            Fate::Abandoned | Fate::NotBegun => behind(place, schedule),
        },
        refused: procedures(node),
        effects: spread.effects,
    }
}

/// As the manifest writes it.
fn by_name<S: Serializer>(policy: &OnFailure, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(policy.name())
}

/// Nodes that would run later.
fn behind(place: Place<'_>, schedule: &CyclerSchedule) -> Vec<String> {
    let nodes = schedule.order.iter();
    let behind = nodes.skip_while(|node| **node != place.node).skip(1);
    behind
        .map(|node| place.cycler().nodes[*node].path.clone())
        .collect()
}

/// Names of main outputs.
fn outputs(node: &Node) -> Vec<String> {
    let in_place = node.cycle.iter().filter_map(|field| match field.binding {
        CycleBinding::MainOutput { .. } => Some(field.name.clone()),
        _ => None,
    });
    let returned = node.outputs.iter().filter_map(|field| match field.binding {
        OutputBinding::MainOutput { .. } => Some(field.name.clone()),
        OutputBinding::CaptureTime => None,
    });
    in_place.chain(returned).collect()
}

fn procedures(node: &Node) -> Vec<String> {
    let names = node.cycle.iter().filter_map(|field| match &field.binding {
        CycleBinding::Procedure { name, .. } => Some(name.clone()),
        _ => None,
    });
    names.collect()
}

#[cfg(test)]
mod tests;
