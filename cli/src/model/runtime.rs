//! `src/runtime.rs`: instances, what connects them, and how to create them.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;

use super::cycler::{CyclerModel, Source};
use super::frame::Hardware;
use super::names::{Names, constant_case, joined, snake_case};
use super::node::asked;
use crate::resolve::robot::{Cycler, CyclerKind, InstanceId, OnFailure, Robot, Scheduling};

/// Names that `create` uses itself.
const VARIABLES_OF_CREATE: [&str; 5] = [
    "creation",
    "cycler_state",
    "hardware",
    "parameters",
    "start",
];

/// What `create` puts behind the variable of an instance.
const SUFFIXES_OF_CREATE: [&str; 4] = ["injected", "injections", "subscriptions", "writer"];

/// Everything that `create` puts together.
#[derive(Clone, Debug, Serialize)]
pub struct Runtime {
    pub robot: String,
    /// In manifest order.
    pub instances: Vec<InstanceModel>,
    /// What all nodes ask of the hardware, sorted.
    pub hardware: Vec<String>,
    /// Whether any node touches the hardware.
    pub uses_hardware: bool,
}

/// One instance between its buffers.
#[derive(Clone, Debug, Serialize)]
pub struct InstanceModel {
    pub id: InstanceId,
    /// `VisionTop`.
    pub name: String,
    /// `vision_top`.
    pub variable: String,
    /// The constant that describes it: `VISION_TOP`.
    pub constant: String,
    pub description: Description,
    /// Readers of its newest cycle, in manifest order.
    pub readers: Vec<String>,
    /// Consumers of its cycles, in manifest order.
    pub consumers: Vec<String>,
    /// Cycles that a consumer may lag.
    pub queue: usize,
    /// In the order of its cycler's procedures.
    pub procedures: Vec<ProcedureEnds>,
}

/// The variables of one procedure of one instance.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProcedureEnds {
    /// What clients call.
    pub caller: String,
    /// What the node answers.
    pub answerer: String,
}

/// What the manifest says about an instance.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Description {
    pub cycler: String,
    pub kind: CyclerKind,
    pub on_failure: OnFailure,
    pub deadline: Option<Duration>,
    pub pending_timeout: Duration,
    pub watchdog: Duration,
    pub history: Duration,
    pub lockstep_duration: Option<Duration>,
    pub scheduling: Scheduling,
}

/// Decides how the instances are connected.
pub fn describe(robot: &Robot, cyclers: &[CyclerModel]) -> Runtime {
    let variables = variables(robot);
    let mut instances: Vec<InstanceModel> = variables
        .keys()
        .map(|id| instance_model(robot, cyclers, &variables, *id))
        .collect();
    name_procedures(&mut instances, cyclers);
    let bounds: Vec<_> = robot
        .cyclers
        .iter()
        .flat_map(|cycler| &cycler.nodes)
        .flat_map(|node| [&node.new_bounds, &node.cycle_bounds, &node.restore_bounds])
        .flatten()
        .cloned()
        .collect();
    let hardware = match asked(true, &bounds) {
        Hardware::Asked(traits) => traits,
        Hardware::Absent => Vec::new(),
    };
    Runtime {
        robot: robot.name.clone(),
        instances,
        hardware,
        uses_hardware: cyclers.iter().any(CyclerModel::is_generic),
    }
}

/// What each instance is called in `create`.
fn variables(robot: &Robot) -> BTreeMap<InstanceId, String> {
    let mut names = Names::with(VARIABLES_OF_CREATE.map(str::to_owned));
    let mut variables = BTreeMap::new();
    for (position, cycler) in robot.cyclers.iter().enumerate() {
        for (instance, named) in cycler.instances.iter().enumerate() {
            let id = InstanceId {
                cycler: position,
                instance,
            };
            variables.insert(id, names.give(&snake_case(&named.name)));
        }
    }
    variables
}

fn instance_model(
    robot: &Robot,
    cyclers: &[CyclerModel],
    variables: &BTreeMap<InstanceId, String>,
    id: InstanceId,
) -> InstanceModel {
    let cycler = &robot.cyclers[id.cycler];
    let instance = &cycler.instances[id.instance];
    let variable = &variables[&id];
    // Variables of the instances whose cycler reads this one, in manifest order.
    let reading = |sources: &dyn Fn(&CyclerModel) -> bool| -> Vec<&String> {
        let reading = variables
            .iter()
            .filter(|(id, _)| sources(&cyclers[id.cycler]));
        reading.map(|(_, variable)| variable).collect()
    };
    let is_this = |source: &Source| source.id == id;
    let readers = reading(&|cycler| cycler.latest.iter().any(is_this));
    let consumers = reading(&|cycler| {
        cycler
            .perception
            .iter()
            .any(|perception| perception.lanes.iter().any(is_this))
    });
    InstanceModel {
        id,
        name: instance.name.clone(),
        variable: variable.clone(),
        constant: constant_case(&instance.name),
        description: description(cycler, id.instance),
        readers: readers
            .into_iter()
            .map(|reader| end(variable, reader))
            .collect(),
        consumers: consumers
            .into_iter()
            .map(|consumer| queue(variable, consumer))
            .collect(),
        queue: cycler.queue,
        procedures: Vec::new(),
    }
}

/// Gives every procedure variables of its own.
fn name_procedures(instances: &mut [InstanceModel], cyclers: &[CyclerModel]) {
    let fixed = VARIABLES_OF_CREATE.map(str::to_owned);
    let given = instances.iter().flat_map(variables_of);
    let mut names = Names::with(fixed.into_iter().chain(given));
    for instance in instances {
        for procedure in &cyclers[instance.id.cycler].procedures {
            let caller = names.give(&joined([instance.variable.as_str(), &procedure.name]));
            let answerer = names.give(&format!("{caller}_answerer"));
            instance.procedures.push(ProcedureEnds { caller, answerer });
        }
    }
}

/// Variables of an instance, procedures aside.
fn variables_of(instance: &InstanceModel) -> Vec<String> {
    let variable = &instance.variable;
    let mut variables = vec![variable.clone(), end("parameters", variable)];
    variables.extend(SUFFIXES_OF_CREATE.map(|suffix| format!("{variable}_{suffix}")));
    variables.extend(instance.readers.iter().chain(&instance.consumers).cloned());
    variables
}

/// The variable of an instance's reading end of another instance's buffer.
pub fn end(variable: &str, reader: &str) -> String {
    format!("{variable}_for_{reader}")
}

/// The variable of an instance's queue of another instance's cycles.
pub fn queue(variable: &str, consumer: &str) -> String {
    format!("{variable}_queue_for_{consumer}")
}

fn description(cycler: &Cycler, instance: usize) -> Description {
    Description {
        cycler: cycler.name.clone(),
        kind: cycler.kind,
        on_failure: cycler.on_failure,
        deadline: cycler.instances[instance].deadline,
        pending_timeout: cycler.pending_timeout,
        watchdog: cycler.watchdog,
        history: cycler.history,
        lockstep_duration: cycler.lockstep_duration,
        scheduling: cycler.instances[instance].scheduling.clone(),
    }
}
