//! What each generated file will say: stage ⑤, from [`Robot`] and [`Schedule`] to [`RuntimeModel`].
//!
//! Identifiers are final, accessors and sentences decided; rendering only writes them down.
//!
//! Invariant: cannot fail. What could be wrong with a robot was found before.

pub mod accessor;
pub mod binary;
pub mod cycler;
pub mod dataflow;
pub mod frame;
pub mod names;
pub mod node;
pub mod outside;
pub mod package;
pub mod parameters;
pub mod recording;
pub mod runtime;
mod sentences;
pub mod structs;

use camino::Utf8PathBuf;
use serde::Serialize;

use crate::graph::{self, json};
use crate::resolve;
use crate::resolve::robot::{Partial, Robot};
use crate::schedule::Schedule;

pub use crate::resolve::robot::{CyclerKind, InstanceId, OnFailure, Scheduling};

pub use binary::Binary;
pub use cycler::CyclerModel;
pub use dataflow::Dataflow;
pub use outside::Outside;
pub use package::Package;
pub use parameters::Parameters;
pub use recording::Sink;
pub use runtime::Runtime;

/// The sentence that stands in the header of every generated file.
pub const DO_NOT_EDIT: &str =
    "Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.";

/// The generated crate, file by file.
#[derive(Clone, Debug, Serialize)]
pub struct RuntimeModel {
    /// What the crate is, as a sentence.
    pub title: String,
    /// Folder of the generated crate, relative to the workspace root.
    pub folder: Utf8PathBuf,
    /// Options of the `hulkgen generate` that writes it.
    pub options: Vec<String>,
    /// `Cargo.toml`.
    pub package: Package,
    /// `DATAFLOW.md`.
    pub dataflow: Dataflow,
    /// `src/parameters.rs`.
    pub parameters: Parameters,
    /// `src/databases/…`, `src/cyclers/…` and `src/runtime/…` of each cycler that runs, in manifest order.
    pub cyclers: Vec<CyclerModel>,
    /// `src/databases/…` of each cycler that is left out and read, in manifest order.
    pub outside: Vec<Outside>,
    /// `src/runtime.rs`.
    pub runtime: Runtime,
    /// `src/recording.rs`.
    pub sink: Sink,
    /// `src/bin/…`, in manifest order.
    pub binaries: Vec<Binary>,
    /// `graph.json`, which the binaries show their clients.
    pub graph: String,
}

/// Decides what the generated crate of a robot says.
pub fn describe(robot: &Robot, schedule: &Schedule) -> RuntimeModel {
    // Clients see the whole robot, also what runs elsewhere.
    let graph = json::render_for_clients(&graph::describe(robot, schedule));
    let robot = &*resolve::here(robot);
    let parameters = parameters::describe(robot);
    let cyclers: Vec<CyclerModel> = robot
        .running()
        .map(|(position, _)| cycler::describe(robot, position, schedule, &parameters))
        .collect();
    RuntimeModel {
        title: sentences::crate_title(robot),
        folder: robot.generated.clone(),
        options: (robot.partial.as_ref()).map_or_else(Vec::new, Partial::options),
        package: package::describe(robot),
        dataflow: dataflow::describe(robot, schedule),
        runtime: runtime::describe(robot, &cyclers),
        sink: recording::sink(robot),
        binaries: binary::describe(robot),
        graph,
        outside: outside::describe(robot),
        parameters,
        cyclers,
    }
}

impl RuntimeModel {
    /// The cycler of an instance that runs.
    pub fn cycler_of(&self, id: InstanceId) -> &CyclerModel {
        cycler::at(&self.cyclers, id.cycler)
    }
}

#[cfg(test)]
pub(crate) mod tests;
