//! `show`: a stage between manifest and generated crate, as text or JSON.
//!
//! The texts are short, in manifest order and stable; snapshots of stages hold the same.

pub mod manifest;
pub mod model;
pub mod nodes;
pub mod robot;
pub mod schedule;

use serde_json::{Value, json};

use super::Failure;
use super::session::Session;
use crate::arguments::{Show, Stage, TextOrJson};
use crate::diagnostics::Reported;
use crate::outcome::Outcome;
use crate::{manifest as manifest_stage, model as model_stage, scan};

pub(super) fn run(session: &mut Session<'_>, show: &Show) -> Result<Outcome, Failure> {
    let shown = match show.format {
        TextOrJson::Text => text(session, show.stage)?,
        TextOrJson::Json => {
            let answer = to_json(session, show.stage)?;
            let answer = serde_json::to_string_pretty(&answer);
            format!("{}\n", answer.expect("a stage has only string keys"))
        }
    };
    session.terminal.data(&shown)?;
    Ok(Outcome::Good)
}

fn text(session: &mut Session<'_>, stage: Stage) -> Result<String, Reported> {
    Ok(match stage {
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
    })
}

/// The stage whole: what its type in hulkgen holds, which may change with every version.
fn to_json(session: &mut Session<'_>, stage: Stage) -> Result<Value, Reported> {
    let (name, shown) = match stage {
        Stage::Manifest => {
            let manifest = manifest_stage::load(&session.workspace, &mut session.diagnostics)?;
            ("manifest", manifest::to_json(&manifest))
        }
        Stage::Nodes => {
            let manifest = manifest_stage::load(&session.workspace, &mut session.diagnostics)?;
            let sources = scan::scan(&session.workspace, &manifest, &mut session.diagnostics)?;
            let nodes = nodes::to_json(&session.workspace, &manifest, &sources);
            ("nodes", nodes)
        }
        Stage::Robot => ("robot", json!(session.understand()?.robot)),
        Stage::Schedule => {
            let understood = session.understand()?;
            let cyclers = schedule::to_json(&understood.robot, &understood.schedule);
            ("cyclers", cyclers)
        }
        Stage::Model => {
            let understood = session.understand()?;
            let described = model_stage::describe(&understood.robot, &understood.schedule);
            ("model", json!(described))
        }
    };
    Ok(json!({ "version": 1, name: shown }))
}

#[cfg(test)]
mod tests;
