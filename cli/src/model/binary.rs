//! `src/bin/<target>.rs`: one binary for each target.

use serde::Serialize;

use crate::resolve::robot::Robot;
use crate::workspace::MANIFEST;

/// The binary of a target.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Binary {
    /// Name of the target and of the file.
    pub name: String,
    pub robot: String,
    /// The crate of the generated library.
    pub library: String,
    /// Absolute path of the hardware type.
    pub hardware: String,
    /// Folder of the parameter files.
    pub parameters: String,
    pub location: Option<String>,
    pub identities: Vec<String>,
    /// Bytes that a recording keeps before its oldest part goes.
    pub recording_budget: u64,
    /// From the file to the manifest.
    pub manifest: String,
}

/// Decides what the binary of each target says.
pub fn describe(robot: &Robot) -> Vec<Binary> {
    // Out of `src/bin`, and out of the crate.
    let up = "../".repeat(2 + robot.generated.components().count());
    let binary = |target: &crate::resolve::robot::Target| Binary {
        name: target.name.clone(),
        robot: robot.name.clone(),
        library: super::package::library(robot),
        hardware: target.hardware.clone(),
        parameters: robot.parameters.to_string(),
        location: target.location.clone(),
        identities: robot.identities.clone(),
        recording_budget: robot.recording_budget,
        manifest: format!("{up}{MANIFEST}"),
    };
    robot.targets.iter().map(binary).collect()
}
