//! `graph`: the picture, in the language asked for.

use super::Failure;
use super::session::Session;
use crate::arguments::{self, GraphFormat};
use crate::diagnostics::suggestion;
use crate::graph::{self, Graph, dot, html, json, mermaid, svg};
use crate::outcome::{Outcome, Refusal};

pub(super) fn run(
    session: &mut Session<'_>,
    arguments: &arguments::Graph,
) -> Result<Outcome, Failure> {
    let understood = session.understand()?;
    let graph = graph::describe(&understood.robot, &understood.schedule);
    let graph = match &arguments.cycler {
        Some(name) => graph
            .of_cycler(name)
            .ok_or_else(|| unknown_cycler(&graph, name))?,
        None => graph,
    };
    let text = match arguments.format {
        GraphFormat::Svg => svg::render(&graph),
        GraphFormat::Dot => dot::render(&graph),
        GraphFormat::Mermaid => mermaid::render(&graph),
        GraphFormat::Json => json::render(&graph),
        GraphFormat::Html => html::render(&graph),
    };
    session.terminal.data(&text)?;
    Ok(Outcome::Good)
}

fn unknown_cycler(graph: &Graph, name: &str) -> Refusal {
    let names = graph.cyclers.iter().map(|cycler| cycler.name.as_str());
    let refusal = Refusal::wrong_usage(format!("there is no cycler `{name}`"));
    refusal.help(suggestion(name, names, "the robot has"))
}
