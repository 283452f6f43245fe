//! `capture`: one cycle of a recording becomes a test of a node.

use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::Failure;
use super::generate;
use super::run::{Wanted, absolute, build};
use super::session::Session;
use crate::arguments::{Capture, TextOrJson};
use crate::diagnostics::{listed, nearest};
use crate::drift;
use crate::graph::{self, Cycler, Graph, Node};
use crate::outcome::{Outcome, Refusal};
use crate::recording;
use crate::scaffold;

pub(super) fn run(session: &mut Session<'_>, capture: &Capture) -> Result<Outcome, Failure> {
    if !capture.file.is_file() {
        return Err(recording::missing(&capture.file).into());
    }
    let understood = session.understand()?;
    let robot = &understood.robot;
    let graph = graph::describe(robot, &understood.schedule);
    let (cycler, node) = find(&graph, &capture.node)?;
    scaffold::check_capturable(robot, node)?;
    let instance = instance(cycler, node, capture.instance.as_deref())?;
    let wanted = Wanted {
        target: capture.target.as_deref(),
        build: &capture.build,
    };
    let Some(executable) = build(session, &wanted)? else {
        return Ok(Outcome::Bad);
    };
    let output = Command::new(&executable)
        .args(["--replay".into(), absolute(&capture.file)?])
        .args(["--capture", &node.path, "--instance", instance])
        .args(["--at", &capture.at.to_string()])
        .current_dir(session.workspace.root())
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| Refusal::bad(format!("cannot start `{executable}`: {error}")))?;
    if !output.status.success() {
        return Ok(Outcome::Bad);
    }
    let snapshot: Option<Value> = serde_json::from_slice(&output.stdout).ok();
    let mut snapshot = snapshot
        .ok_or_else(|| Refusal::bad("the robot's program did not say what the cycle took"))?;
    snapshot["cyclers"] = graph
        .cyclers
        .iter()
        .map(|cycler| (cycler.name.clone(), json!(cycler.instances)))
        .collect::<serde_json::Map<_, _>>()
        .into();
    let asked = scaffold::Capture {
        cycler,
        node,
        snapshot: &snapshot,
    };
    let changes = scaffold::capture(&session.workspace, robot, asked)?;
    let files: Vec<_> = changes.keys().map(ToString::to_string).collect();
    let root = session.workspace.root().to_owned();
    drift::write_all(&root, &changes).map_err(|error| generate::refusal(&error))?;
    match capture.format {
        TextOrJson::Json => {
            let answer = json!({ "version": 1, "written": files });
            session.terminal.data(&format!("{answer}\n"))?;
        }
        TextOrJson::Text => {
            let files: String = files.iter().map(|file| format!("wrote {file}\n")).collect();
            session.terminal.note(&files);
        }
    }
    Ok(Outcome::Good)
}

/// The node with this path, or whose path ends with this name.
fn find<'g>(graph: &'g Graph, name: &str) -> Result<(&'g Cycler, &'g Node), Refusal> {
    let all = || {
        let cyclers = graph.cyclers.iter();
        cyclers.flat_map(|cycler| cycler.nodes.iter().map(move |node| (cycler, node)))
    };
    let ending = format!("::{name}");
    let is_meant = |node: &Node| node.path == name || node.path.ends_with(&ending);
    let found: Vec<_> = all().filter(|(_, node)| is_meant(node)).collect();
    let paths = || all().map(|(_, node)| node.path.as_str());
    let ends = || paths().filter_map(|path| path.rsplit("::").next());
    match found.as_slice() {
        [] => {
            let refusal = Refusal::wrong_usage(format!("the robot has no node `{name}`"));
            Err(match nearest(name, paths().chain(ends())) {
                Some(nearest) => refusal.help(format!("did you mean `{nearest}`?")),
                None => refusal.help("`hulkgen show nodes` lists them"),
            })
        }
        [first, rest @ ..] if rest.iter().all(|(_, node)| node.path == first.1.path) => Ok(*first),
        several => {
            let several = several.iter().map(|(_, node)| node.path.as_str());
            let message = format!("`{name}` is the end of several paths");
            Err(Refusal::wrong_usage(message).help(format!("name one of {}", listed(several))))
        }
    }
}

/// The instance that is asked for, or the only one.
fn instance<'g>(cycler: &'g Cycler, node: &Node, asked: Option<&str>) -> Result<&'g str, Refusal> {
    let names = || cycler.instances.iter().map(String::as_str);
    let found = match (asked, cycler.instances.as_slice()) {
        (None, [only]) => Some(only),
        (None, _) => None,
        (Some(asked), all) => all.iter().find(|name| *name == asked),
    };
    found.map(String::as_str).ok_or_else(|| {
        let message = match asked {
            Some(asked) => format!("`{}` does not run in an instance `{asked}`", node.path),
            None => format!("`{}` runs in several instances", node.path),
        };
        Refusal::wrong_usage(message).help(format!("name one with --instance: {}", listed(names())))
    })
}
