//! The list of stages, from the manifest to the files of the generated crate.

use crate::diagnostics::{Diagnostics, Reported};
use crate::manifest;
use crate::model;
use crate::render::{self, GeneratedFiles};
use crate::resolve::parameter_files::Unchecked;
use crate::resolve::robot::Robot;
use crate::resolve::{self, parameter_files};
use crate::scan;
use crate::schedule::{self, Schedule};
use crate::workspace::Workspace;

/// A robot that can be generated: every name bound, every node ordered.
#[derive(Clone, Debug)]
pub struct Understood {
    pub robot: Robot,
    pub schedule: Schedule,
    /// What only the robot's program can say about its parameter files.
    pub unchecked: Unchecked,
}

/// Stages ① to ④: everything that can be wrong with a manifest, its nodes and its parameter files.
pub fn understand(
    workspace: &Workspace,
    diagnostics: &mut Diagnostics,
) -> Result<Understood, Reported> {
    let understood = bind_and_order(workspace, diagnostics);
    diagnostics.silence(workspace);
    understood
}

fn bind_and_order(
    workspace: &Workspace,
    diagnostics: &mut Diagnostics,
) -> Result<Understood, Reported> {
    let manifest = manifest::load(workspace, diagnostics)?;
    let sources = scan::scan(workspace, &manifest, diagnostics)?;
    let robot = resolve::resolve(workspace, &manifest, &sources, diagnostics)?;
    let schedule = schedule::schedule(&robot, diagnostics)?;
    let unchecked = parameter_files::check(workspace, &manifest, &sources, &robot, diagnostics);
    Ok(Understood {
        robot,
        schedule,
        unchecked,
    })
}

/// Stages ① to ⑥: from the manifest and the nodes to the files of the generated crate.
///
/// Parameter files do not change the generated code, so errors in them do not keep it from being written; they are in
/// the diagnostics all the same.
pub fn generate(
    workspace: &Workspace,
    diagnostics: &mut Diagnostics,
) -> Result<GeneratedFiles, Reported> {
    let understood = understand(workspace, diagnostics)?;
    let model = model::describe(&understood.robot, &understood.schedule);
    Ok(render::render(&model))
}
