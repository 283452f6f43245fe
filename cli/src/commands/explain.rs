//! `explain`: the page of a diagnostic's code; who reads and writes a node's or an output's values.

mod page;
mod subject;

use serde_json::json;

use super::Failure;
use super::session::Session;
use super::terminal::Terminal;
use crate::arguments::{Explain, TextOrJson};
use crate::diagnostics::{Code, nearest};
use crate::graph::{self, Graph};
use crate::outcome::{Outcome, Refusal};
use subject::Subject;

/// Codes have pages that need no robot; None for anything else.
pub(super) fn run_without_robot(
    terminal: &Terminal,
    explain: &Explain,
) -> Result<Option<Outcome>, Refusal> {
    let Some(code) = Code::from_name(&explain.subject) else {
        return Ok(None);
    };
    terminal.data(&match explain.format {
        TextOrJson::Text => page::of_code(code),
        TextOrJson::Json => format!(
            "{}\n",
            json!({
                "version": 1,
                "code": code.name(),
                "severity": code.severity().name(),
                "title": code.title(),
                "explanation": code.explanation(),
            })
        ),
    })?;
    Ok(Some(Outcome::Good))
}

pub(super) fn run(session: &mut Session<'_>, explain: &Explain) -> Result<Outcome, Failure> {
    let understood = session.understand()?;
    let graph = graph::describe(&understood.robot, &understood.schedule);
    let subject = Subject::find(&graph, &explain.subject);
    if subject.is_empty() {
        return Err(unknown(&graph, &explain.subject).into());
    }
    session.terminal.data(&match explain.format {
        TextOrJson::Text => page::of_subject(&subject),
        TextOrJson::Json => format!("{}\n", subject.to_json()),
    })?;
    Ok(Outcome::Good)
}

fn unknown(graph: &Graph, name: &str) -> Refusal {
    let codes = Code::ALL.iter().map(|code| code.name());
    let known = subject::names(graph);
    let candidates = codes.chain(known.iter().map(String::as_str));
    let refusal = Refusal::wrong_usage(format!("there is no code, node or output `{name}`"));
    match nearest(name, candidates) {
        Some(nearest) => refusal.help(format!("did you mean `{nearest}`?")),
        None => refusal.help("`hulkgen graph` shows all nodes and outputs"),
    }
}
