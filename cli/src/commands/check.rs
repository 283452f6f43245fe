//! `check`: every diagnostic, and a summary.

use super::session::Session;
use super::{Failure, plural};
use crate::arguments::{Check, TextOrJson};
use crate::diagnostics::{self, Diagnostics, Severity};
use crate::graph::{self, Graph};
use crate::outcome::Outcome;

pub(super) fn run(session: &mut Session<'_>, check: &Check) -> Result<Outcome, Failure> {
    let understood = session.understand();
    let found = &session.diagnostics;
    let text = match check.format {
        TextOrJson::Json => {
            let mut text = diagnostics::to_json(found, &session.workspace).to_string();
            text.push('\n');
            text
        }
        TextOrJson::Text => {
            let color = session.terminal.colors_data();
            let mut text = diagnostics::render(found, &session.workspace, color);
            text.push_str(&summary_of_diagnostics(found));
            if let Ok(understood) = &understood {
                let graph = graph::describe(&understood.robot, &understood.schedule);
                text.push_str(&summary_of_robot(&graph));
            }
            text
        }
    };
    session.terminal.data(&text)?;
    let is_bad =
        understood.is_err() || found.has_errors() || (check.deny_warnings && found.has_warnings());
    Ok(if is_bad { Outcome::Bad } else { Outcome::Good })
}

/// "2 errors, 1 warning" on a line; nothing if there is neither.
fn summary_of_diagnostics(found: &Diagnostics) -> String {
    let count = |severity| {
        found
            .sorted()
            .iter()
            .filter(|one| one.severity() == severity)
            .count()
    };
    let parts: Vec<String> = [(Severity::Error, "error"), (Severity::Warning, "warning")]
        .into_iter()
        .map(|(severity, noun)| (count(severity), noun))
        .filter(|(number, _)| *number > 0)
        .map(|(number, noun)| plural(number, noun))
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!("{}\n", parts.join(", "))
    }
}

/// How much there is, and how much of it was checked.
fn summary_of_robot(graph: &Graph) -> String {
    let instances = graph
        .cyclers
        .iter()
        .map(|cycler| cycler.instances.len())
        .sum();
    let nodes = graph.cyclers.iter().map(|cycler| cycler.nodes.len()).sum();
    let left = graph.edges.len() - graph.checked_edges();
    let checked = match left {
        0 => "all checked".to_owned(),
        left => format!("{left} left to rustc"),
    };
    format!(
        "robot {}: {}, {}, {}, {}, {checked}\n",
        graph.robot,
        plural(graph.cyclers.len(), "cycler"),
        plural(instances, "instance"),
        plural(nodes, "node"),
        plural(graph.edges.len(), "edge"),
    )
}
