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
pub mod package;
pub mod parameters;
pub mod runtime;
mod sentences;
pub mod structs;

use camino::Utf8PathBuf;
use serde::Serialize;

use crate::resolve::robot::Robot;
use crate::schedule::Schedule;

pub use crate::resolve::robot::{CyclerKind, InstanceId, OnFailure, Scheduling};

pub use binary::Binary;
pub use cycler::CyclerModel;
pub use dataflow::Dataflow;
pub use package::Package;
pub use parameters::Parameters;
pub use runtime::Runtime;

/// The sentence that stands in the header of every generated file.
pub const DO_NOT_EDIT: &str =
    "Written by `hulkgen generate` from hulk.toml and the nodes it names. Do not edit.";

/// The generated crate, file by file.
#[derive(Clone, Debug, Serialize)]
pub struct RuntimeModel {
    pub robot: String,
    /// Folder of the generated crate, relative to the workspace root.
    pub folder: Utf8PathBuf,
    /// `Cargo.toml`.
    pub package: Package,
    /// `DATAFLOW.md`.
    pub dataflow: Dataflow,
    /// `src/parameters.rs`.
    pub parameters: Parameters,
    /// `src/databases/…`, `src/cyclers/…` and `src/runtime/…` of each cycler, in manifest order.
    pub cyclers: Vec<CyclerModel>,
    /// `src/runtime.rs`.
    pub runtime: Runtime,
    /// `src/bin/…`, in manifest order.
    pub binaries: Vec<Binary>,
}

/// Decides what the generated crate of a robot says.
pub fn describe(robot: &Robot, schedule: &Schedule) -> RuntimeModel {
    let parameters = parameters::describe(robot);
    let cyclers: Vec<CyclerModel> = robot
        .cyclers
        .iter()
        .zip(&schedule.cyclers)
        .map(|(cycler, schedule)| cycler::describe(robot, cycler, schedule, &parameters))
        .collect();
    RuntimeModel {
        robot: robot.name.clone(),
        folder: robot.generated.clone(),
        package: package::describe(robot),
        dataflow: dataflow::describe(robot, schedule),
        runtime: runtime::describe(robot, &cyclers),
        binaries: binary::describe(robot),
        parameters,
        cyclers,
    }
}

#[cfg(test)]
pub(crate) mod tests;
