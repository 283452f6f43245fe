//! `show`: a stage between manifest and generated crate as text.
//!
//! The texts are short, in manifest order and stable; snapshots of stages hold the same.

pub mod manifest;
pub mod model;
pub mod nodes;
pub mod robot;
pub mod schedule;

use super::Failure;
use super::session::Session;
use crate::arguments::{Show, Stage};
use crate::outcome::Outcome;
use crate::{manifest as manifest_stage, model as model_stage, scan};

pub(super) fn run(session: &mut Session<'_>, show: &Show) -> Result<Outcome, Failure> {
    let text = match show.stage {
        Stage::Manifest => {
            let manifest = manifest_stage::load(&session.workspace, &mut session.diagnostics)?;
            manifest::text(&manifest)
        }
        Stage::Nodes => {
            let manifest = manifest_stage::load(&session.workspace, &mut session.diagnostics)?;
            let sources = scan::scan(&session.workspace, &manifest, &mut session.diagnostics)?;
            nodes::text(&session.workspace, &manifest, &sources)
        }
        Stage::Robot => robot::text(&session.understand()?.robot),
        Stage::Schedule => {
            let understood = session.understand()?;
            schedule::text(&understood.robot, &understood.schedule)
        }
        Stage::Model => {
            let understood = session.understand()?;
            let described = model_stage::describe(&understood.robot, &understood.schedule);
            model::text(&described)
        }
    };
    session.terminal.data(&text)?;
    Ok(Outcome::Good)
}

#[cfg(test)]
mod tests;
