//! `explain`: pages of codes; what nodes, outputs, procedures and parameters are; orders; what follows from a failure.

mod failure;
mod nodes;
mod order;
mod page;
mod parameter;
mod subject;

use serde::Serialize;
use serde_json::json;

use super::Failure;
use super::session::Session;
use super::terminal::Terminal;
use crate::arguments::{Explain, TextOrJson};
use crate::diagnostics::{Code, nearest};
use crate::graph::{self, Graph};
use crate::outcome::{Outcome, Refusal};
use crate::pipeline::Understood;
use subject::Subject;

/// The word before two nodes.
const ORDER: &str = "order";

/// Codes have pages that need no robot; None for anything else.
pub(super) fn run_without_robot(
    terminal: &Terminal,
    explain: &Explain,
) -> Result<Option<Outcome>, Refusal> {
    let [name] = explain.subject.as_slice() else {
        return Ok(None);
    };
    let Some(code) = Code::from_name(name) else {
        return Ok(None);
    };
    terminal.data(&match explain.format {
        TextOrJson::Text => code.page().trim_start_matches("# ").to_owned(),
        TextOrJson::Json => format!(
            "{}\n",
            json!({
                "version": 1,
                "code": code.name(),
                "severity": code.severity().name(),
                "title": code.title(),
                "explanation": code.explanation().replace('\n', " "),
                "page": code.page(),
            })
        ),
    })?;
    Ok(Some(Outcome::Good))
}

pub(super) fn run(session: &mut Session<'_>, explain: &Explain) -> Result<Outcome, Failure> {
    let understood = session.understand()?;
    let words: Vec<&str> = explain.subject.iter().map(String::as_str).collect();
    let text = match (&explain.if_fails, words.as_slice()) {
        (Some(node), _) => {
            let answer = failure::explain(&understood, node)?;
            write(explain, &answer, failure::text)
        }
        (None, [ORDER, one, other]) => {
            let graph = graph::describe(&understood.robot, &understood.schedule);
            let answer = order::explain(&understood, &graph, [one, other])?;
            write(explain, &answer, order::text)
        }
        (None, [name]) => of_name(session, &understood, explain, name)?,
        _ => {
            let message = "one name is explained, or `order` and two nodes";
            return Err(Refusal::wrong_usage(message).into());
        }
    };
    session.terminal.data(&text)?;
    Ok(Outcome::Good)
}

fn write<A: Serialize>(explain: &Explain, answer: &A, text: impl Fn(&A) -> String) -> String {
    match explain.format {
        TextOrJson::Text => text(answer),
        TextOrJson::Json => format!("{}\n", json!(answer)),
    }
}

fn of_name(
    session: &Session<'_>,
    understood: &Understood,
    explain: &Explain,
    name: &str,
) -> Result<String, Failure> {
    let graph = graph::describe(&understood.robot, &understood.schedule);
    let mut subject = Subject::find(&graph, name);
    subject.parameters = parameter::find(&session.workspace, understood, &graph, name)?;
    subject.find_bridges(&graph);
    if subject.is_empty() {
        return Err(unknown(&graph, name).into());
    }
    Ok(match explain.format {
        TextOrJson::Text => page::of_subject(&subject),
        TextOrJson::Json => format!("{}\n", subject.to_json()),
    })
}

fn unknown(graph: &Graph, name: &str) -> Refusal {
    let codes = Code::ALL.iter().map(|code| code.name());
    let known = subject::names(graph);
    let candidates = codes.chain(known.iter().map(String::as_str));
    let message =
        format!("there is no code, node, output, parameter or procedure of the name `{name}`");
    let refusal = Refusal::wrong_usage(message);
    // The last part alone is a good question about a path.
    let mut paths = graph.parameters.iter().map(|one| one.path.as_str());
    let ending = paths.find(|path| path.rsplit('.').next() == Some(name));
    let near = ending.map(str::to_owned);
    let near = near.or_else(|| subject::near_behind_owner(graph, name));
    let near = near.or_else(|| nearest(name, candidates).map(str::to_owned));
    match near {
        Some(near) => refusal.help(format!("did you mean `{near}`?")),
        None => refusal.help("`hulkgen graph` shows all nodes and outputs"),
    }
}
