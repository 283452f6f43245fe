//! `src/runtime.rs`: instances, what connects them, and how to create them.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use serde::Serialize;

use super::cycler::{self, CyclerModel};
use super::frame::Hardware;
use super::names::{Names, constant_case, joined, snake_case};
use super::node::asked;
use super::outside;
use super::recording::{self, RecordModel};
use super::sentences;
use crate::resolve::robot::{Cycler, CyclerKind, InstanceId, OnFailure, Robot, Scheduling};

/// Names that `create` uses itself.
const VARIABLES_OF_CREATE: [&str; 6] = [
    "creation",
    "cycler_state",
    "hardware",
    "parameters",
    "start",
    "stubs",
];

/// What `create` puts behind the variable of an instance.
const SUFFIXES_OF_CREATE: [&str; 4] = ["injected", "injections", "subscriptions", "writer"];

/// Everything that `create` puts together.
#[derive(Clone, Debug, Serialize)]
pub struct Runtime {
    pub robot: String,
    /// One for each instance that runs or is read, in manifest order.
    pub buffers: Vec<Buffer>,
    /// In manifest order.
    pub instances: Vec<InstanceModel>,
    /// What stands in for instances that are left out and read, in manifest order.
    pub stubs: Vec<StubModel>,
    /// What stands in for instances that another machine runs, in manifest order.
    pub remotes: Vec<RemoteModel>,
    /// Names of all instances that are left out, in manifest order.
    pub left_out: Vec<String>,
    /// What all nodes ask of the hardware, sorted.
    pub hardware: Vec<String>,
    /// Whether any node touches the hardware.
    pub uses_hardware: bool,
}

/// What others read of an instance.
#[derive(Clone, Debug, Serialize)]
pub struct Buffer {
    pub id: InstanceId,
    /// The variable of the instance, whose writing end has a suffix: `vision_top`.
    pub variable: String,
    /// Readers of its newest cycle, in manifest order.
    pub readers: Vec<String>,
    /// Consumers of its cycles, in manifest order.
    pub consumers: Vec<String>,
    /// Cycles that a consumer may lag.
    pub queue: usize,
    /// For how long consumers wait for an announced cycle.
    pub pending_timeout: Duration,
}

/// What stands in for an instance that is left out.
#[derive(Clone, Debug, Serialize)]
pub struct StubModel {
    /// `VisionTop`.
    pub name: String,
    /// As in its buffer, and its field in `Stubs`: `vision_top`.
    pub variable: String,
    /// Module of its database: `vision`.
    pub module: String,
    /// Who reads it, as a sentence.
    pub about: String,
}

/// What stands in for an instance that another machine runs.
#[derive(Clone, Debug, Serialize)]
pub struct RemoteModel {
    /// `VisionTop`.
    pub name: String,
    /// As in its buffer: `vision_top`.
    pub variable: String,
    /// For how long consumers wait for an announced cycle.
    pub pending_timeout: Duration,
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
    pub record: RecordModel,
}

impl Runtime {
    /// What others read of an instance that runs or is read.
    pub fn buffer(&self, id: InstanceId) -> &Buffer {
        let mut all = self.buffers.iter();
        all.find(|buffer| buffer.id == id)
            .expect("an instance that runs or is read has a buffer")
    }
}

/// Decides how the instances are connected.
pub fn describe(robot: &Robot, cyclers: &[CyclerModel]) -> Runtime {
    let variables = variables(robot);
    let buffers: Vec<Buffer> = variables
        .keys()
        .map(|id| buffer(robot, cyclers, &variables, *id))
        .collect();
    let mut instances: Vec<InstanceModel> = buffers
        .iter()
        .filter(|buffer| !robot.cyclers[buffer.id.cycler].left_out)
        .map(|buffer| instance_model(robot, buffer))
        .collect();
    name_procedures(&mut instances, &buffers, cyclers);
    let bounds: Vec<_> = robot
        .cyclers
        .iter()
        .flat_map(|cycler| &cycler.nodes)
        .flat_map(|node| [&node.new_bounds, &node.cycle_bounds, &node.restore_bounds])
        .flatten()
        .cloned()
        .collect();
    let hardware = match asked(true, &bounds, &[]) {
        Hardware::Asked(traits) => traits,
        Hardware::Absent => Vec::new(),
    };
    Runtime {
        robot: robot.name.clone(),
        instances,
        stubs: stubs(robot, cyclers, &buffers),
        remotes: remotes(robot, &buffers),
        left_out: left_out(robot),
        buffers,
        hardware,
        uses_hardware: cyclers.iter().any(CyclerModel::is_generic),
    }
}

/// What each instance that runs or is read is called in `create`.
fn variables(robot: &Robot) -> BTreeMap<InstanceId, String> {
    let running = robot.running().flat_map(|(cycler, declared)| {
        let instances = 0..declared.instances.len();
        instances.map(move |instance| InstanceId { cycler, instance })
    });
    let ids: BTreeSet<InstanceId> = running.chain(outside::instances(robot)).collect();
    let mut names = Names::with(VARIABLES_OF_CREATE.map(str::to_owned));
    let mut given = Vec::new();
    let variables = ids.into_iter().map(|id| {
        let name = &robot.cyclers[id.cycler].instances[id.instance].name;
        let variable = names.give_with(&snake_case(name), |variable| derived(variable, &given));
        given.push(variable.clone());
        (id, variable)
    });
    variables.collect()
}

/// What else may stand in `create` because of this instance, beside instances that have their variables.
fn derived(variable: &str, others: &[String]) -> Vec<String> {
    // Else an end of `eye_queue` could be called like a queue of `eye`.
    let mut names = vec![end("parameters", variable), format!("{variable}_queue")];
    names.extend(SUFFIXES_OF_CREATE.map(|suffix| format!("{variable}_{suffix}")));
    for other in others {
        for (from, to) in [(variable, other.as_str()), (other, variable)] {
            names.extend([end(from, to), queue(from, to)]);
        }
    }
    names
}

fn buffer(
    robot: &Robot,
    cyclers: &[CyclerModel],
    variables: &BTreeMap<InstanceId, String>,
    id: InstanceId,
) -> Buffer {
    let cycler = &robot.cyclers[id.cycler];
    let variable = &variables[&id];
    // Variables of the instances whose cycler reads this one, in manifest order.
    let reading = |sources: &dyn Fn(&CyclerModel) -> bool| -> Vec<&String> {
        let running = |id: &InstanceId| !robot.cyclers[id.cycler].left_out;
        let reading = variables
            .iter()
            .filter(|(id, _)| running(id) && sources(cycler::at(cyclers, id.cycler)));
        reading.map(|(_, variable)| variable).collect()
    };
    let readers = reading(&|cycler| reads_newest(cycler, id));
    let consumers = reading(&|cycler| consumes(cycler, id));
    Buffer {
        id,
        variable: variable.clone(),
        readers: readers
            .into_iter()
            .map(|reader| end(variable, reader))
            .collect(),
        consumers: consumers
            .into_iter()
            .map(|consumer| queue(variable, consumer))
            .collect(),
        queue: cycler.queue,
        pending_timeout: cycler.pending_timeout,
    }
}

fn reads_newest(cycler: &CyclerModel, id: InstanceId) -> bool {
    cycler.latest.iter().any(|source| source.id == id)
}

fn consumes(cycler: &CyclerModel, id: InstanceId) -> bool {
    let lanes = cycler.perception.iter().flat_map(|one| &one.lanes);
    lanes.into_iter().any(|source| source.id == id)
}

fn instance_model(robot: &Robot, buffer: &Buffer) -> InstanceModel {
    let id = buffer.id;
    let cycler = &robot.cyclers[id.cycler];
    let name = &cycler.instances[id.instance].name;
    InstanceModel {
        id,
        name: name.clone(),
        variable: buffer.variable.clone(),
        constant: constant_case(name),
        description: description(robot, cycler, id.instance),
        procedures: Vec::new(),
    }
}

fn stubs(robot: &Robot, cyclers: &[CyclerModel], buffers: &[Buffer]) -> Vec<StubModel> {
    let outside = buffers.iter().filter(|buffer| {
        let cycler = &robot.cyclers[buffer.id.cycler];
        cycler.left_out && !cycler.remote
    });
    let stubs = outside.map(|Buffer { id, variable, .. }| {
        let cycler = &robot.cyclers[id.cycler];
        let names = |reads: &dyn Fn(&CyclerModel) -> bool| -> Vec<String> {
            let reading = cyclers.iter().filter(|cycler| reads(cycler));
            reading.map(|cycler| cycler.name.clone()).collect()
        };
        let ways = [
            ("latest", names(&|cycler| reads_newest(cycler, *id))),
            ("in order of time", names(&|cycler| consumes(cycler, *id))),
        ];
        let ways = ways.into_iter().filter(|(_, names)| !names.is_empty());
        let ways = ways.map(|(how, names)| format!("{how} by {}", sentences::and(&names)));
        let ways: Vec<String> = ways.collect();
        StubModel {
            name: cycler.instances[id.instance].name.clone(),
            variable: variable.clone(),
            module: snake_case(&cycler.name),
            about: format!("Read {}.", ways.join(", ")),
        }
    });
    stubs.collect()
}

fn remotes(robot: &Robot, buffers: &[Buffer]) -> Vec<RemoteModel> {
    let remote = buffers.iter().filter(|buffer| {
        let cycler = &robot.cyclers[buffer.id.cycler];
        cycler.left_out && cycler.remote
    });
    let remotes = remote.map(|buffer| RemoteModel {
        name: robot.cyclers[buffer.id.cycler].instances[buffer.id.instance]
            .name
            .clone(),
        variable: buffer.variable.clone(),
        pending_timeout: buffer.pending_timeout,
    });
    remotes.collect()
}

fn left_out(robot: &Robot) -> Vec<String> {
    let cyclers = robot.cyclers.iter().filter(|cycler| cycler.left_out);
    let instances = cyclers.flat_map(|cycler| &cycler.instances);
    instances.map(|instance| instance.name.clone()).collect()
}

/// Gives every procedure variables of its own.
fn name_procedures(instances: &mut [InstanceModel], buffers: &[Buffer], cyclers: &[CyclerModel]) {
    let fixed = VARIABLES_OF_CREATE.map(str::to_owned);
    let given = buffers.iter().flat_map(variables_of);
    let mut names = Names::with(fixed.into_iter().chain(given));
    for instance in instances {
        for procedure in &cycler::at(cyclers, instance.id.cycler).procedures {
            let caller = names.give(&joined([instance.variable.as_str(), &procedure.name]));
            let answerer = names.give(&format!("{caller}_answerer"));
            instance.procedures.push(ProcedureEnds { caller, answerer });
        }
    }
}

/// Variables of an instance, procedures aside.
fn variables_of(buffer: &Buffer) -> Vec<String> {
    let variable = &buffer.variable;
    let mut variables = vec![variable.clone(), end("parameters", variable)];
    variables.extend(SUFFIXES_OF_CREATE.map(|suffix| format!("{variable}_{suffix}")));
    variables.extend(buffer.readers.iter().chain(&buffer.consumers).cloned());
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

fn description(robot: &Robot, cycler: &Cycler, instance: usize) -> Description {
    let declared = &cycler.instances[instance];
    Description {
        record: recording::record(robot, &declared.name, &declared.record),
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
