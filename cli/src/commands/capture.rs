//! `capture`: one cycle of a recording becomes a test of a node.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};

use camino::Utf8Path;
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
use crate::resolve::robot::Robot;
use crate::scaffold::{self, Changes};
use crate::workspace::Workspace;

pub(super) fn run(session: &mut Session<'_>, capture: &Capture) -> Result<Outcome, Failure> {
    if !capture.file.is_file() {
        return Err(recording::missing(&capture.file).into());
    }
    let understood = session.understand()?;
    let robot = &understood.robot;
    let graph = graph::describe(robot, &understood.schedule);
    let places = find(&graph, &capture.node)?;
    check_capturable(robot, &places)?;
    let (Place { cycler, node }, instance) = choose(&places, capture.instance.as_deref())?;
    scaffold::check_capturable(robot, node)?;
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
    if !capture.replace {
        refuse_others(&session.workspace, &changes)?;
    }
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

/// Where a node stands.
#[derive(Clone, Copy)]
struct Place<'g> {
    cycler: &'g Cycler,
    node: &'g Node,
}

/// Every place of the node with this path, or whose path ends with this name.
fn find<'g>(graph: &'g Graph, name: &str) -> Result<Vec<Place<'g>>, Refusal> {
    let all = || {
        let cyclers = graph.cyclers.iter();
        cyclers.flat_map(|cycler| {
            let nodes = cycler.nodes.iter();
            nodes.map(move |node| Place { cycler, node })
        })
    };
    let ending = format!("::{name}");
    let is_meant = |node: &Node| node.path == name || node.path.ends_with(&ending);
    let found: Vec<_> = all().filter(|place| is_meant(place.node)).collect();
    let several: BTreeSet<_> = found.iter().map(|place| &*place.node.path).collect();
    if several.len() > 1 {
        let message = format!("`{name}` is the end of several paths");
        return Err(Refusal::wrong_usage(message).help(format!("name one of {}", listed(several))));
    }
    if found.is_empty() {
        let paths = || all().map(|place| place.node.path.as_str());
        let ends = paths().filter_map(|path| path.rsplit("::").next());
        let refusal = Refusal::wrong_usage(format!("the robot has no node `{name}`"));
        return Err(match nearest(name, paths().chain(ends)) {
            Some(nearest) => refusal.help(format!("did you mean `{nearest}`?")),
            None => refusal.help("`hulkgen show nodes` lists them"),
        });
    }
    Ok(found)
}

/// Whether the node can be captured in any of its places, before somebody is asked for one.
fn check_capturable(robot: &Robot, places: &[Place<'_>]) -> Result<(), Refusal> {
    let mut checked = Ok(());
    for place in places {
        checked = scaffold::check_capturable(robot, place.node);
        if checked.is_ok() {
            break;
        }
    }
    checked
}

/// The instance that is asked for, or the only one of all places.
fn choose<'p, 'g>(
    places: &'p [Place<'g>],
    asked: Option<&str>,
) -> Result<(&'p Place<'g>, &'g str), Refusal> {
    let instances = || {
        let places = places.iter();
        places.flat_map(|place| {
            let instances = place.cycler.instances.iter();
            instances.map(move |instance| (place, instance.as_str()))
        })
    };
    let found = match asked {
        Some(asked) => instances().find(|(_, instance)| *instance == asked),
        None => instances().next().filter(|_| instances().count() == 1),
    };
    found.ok_or_else(|| {
        let path = places.first().map_or("", |place| &*place.node.path);
        let message = match asked {
            Some(asked) => format!("`{path}` does not run in an instance `{asked}`"),
            None => format!("`{path}` runs in several instances"),
        };
        let names = listed(instances().map(|(_, instance)| instance));
        Refusal::wrong_usage(message).help(format!("name one with --instance: {names}"))
    })
}

/// What stands there may be of another recording, or written by hand.
fn refuse_others(workspace: &Workspace, changes: &Changes) -> Result<(), Refusal> {
    let is_same = |file: &Utf8Path, text: Option<&str>| {
        let there = workspace.read(file);
        there.is_ok_and(|there| Some(&*there) == text)
    };
    let others = changes
        .iter()
        .filter(|(file, text)| workspace.is_file(file) && !is_same(file, text.as_deref()));
    let others: Vec<_> = others.map(|(file, _)| file.as_str()).collect();
    let what = match others.as_slice() {
        [] => return Ok(()),
        [_] => "is there and says something else",
        _ => "are there and say something else",
    };
    Err(Refusal::wrong_usage(format!("{} {what}", listed(others)))
        .help("`--replace` writes the cycle's own over it; to keep it, give it another name first"))
}

#[cfg(test)]
mod tests {
    use super::{choose, find, refuse_others};
    use crate::graph::{self, Graph, fixture};
    use crate::outcome::Outcome;
    use crate::scaffold::Changes;
    use crate::workspace::Workspace;

    /// A robot whose node `shared::counter` stands in both cyclers.
    fn graph() -> Graph {
        let mut graph = graph::describe(&fixture::robot(), &fixture::schedule());
        for cycler in &mut graph.cyclers {
            let mut counter = cycler.nodes[1].clone();
            counter.path = "shared::counter".to_owned();
            cycler.nodes.push(counter);
        }
        graph
    }

    #[test]
    fn a_node_is_found_in_each_of_its_cyclers() {
        let graph = graph();
        let places = find(&graph, "counter").expect("it is there");
        for (asked, cycler) in [("VisionBottom", "Vision"), ("Control", "Control")] {
            let (place, instance) = choose(&places, Some(asked)).expect("it runs there");
            assert_eq!((&*place.cycler.name, instance), (cycler, asked));
        }
    }

    #[test]
    fn whoever_names_no_instance_of_several_hears_of_those_of_all_cyclers() {
        let graph = graph();
        let places = find(&graph, "shared::counter").expect("it is there");
        for asked in [None, Some("Audio")] {
            let refusal = choose(&places, asked).map(drop).expect_err("which one?");
            assert_eq!(refusal.outcome, Outcome::WrongUsage);
            let help = refusal.help.unwrap_or_default();
            let names = "--instance: `Control`, `VisionBottom` and `VisionTop`";
            assert!(help.ends_with(names), "{help}");
        }
        let detection = find(&graph, "control::head").expect("it is there");
        let only = choose(&detection, None).map(|(_, instance)| instance);
        assert_eq!(only, Ok("Control"));
    }

    #[test]
    fn what_is_there_and_differs_is_not_written_over() {
        let changes = Changes::from([
            ("a.rs".into(), Some("mine".to_owned())),
            ("a.json".into(), Some("{}".to_owned())),
        ]);
        let refused = |json: &[(&str, &str)]| {
            let files = [("a.rs", "mine")].iter().chain(json);
            refuse_others(&Workspace::in_memory(files.copied()), &changes)
        };
        assert_eq!(refused(&[]), Ok(()));
        assert_eq!(refused(&[("a.json", "{}")]), Ok(()), "it says the same");
        let refusal = refused(&[("a.json", "{\"edited\": 1}")]).expect_err("it was edited");
        assert_eq!(
            (refusal.outcome, &*refusal.message),
            (
                Outcome::WrongUsage,
                "`a.json` is there and says something else"
            )
        );
    }
}
