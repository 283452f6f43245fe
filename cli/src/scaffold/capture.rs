//! A test of a node from one cycle of a recording: what the node took as a data file, and the test that reads it.

mod writing;

use camino::Utf8PathBuf;
use serde::Serialize;
use serde_json::{Value, json};

use super::{Changes, own_member};
use crate::diagnostics::listed;
use crate::graph::{Context, Cycler, Field, Node};
use crate::model::recording::traits;
use crate::outcome::Refusal;
use crate::render::{render_stand_in, render_template};
use crate::resolve::robot::{Interface, Node as Resolved, Robot};
use crate::workspace::Workspace;
use writing::Writing;

/// Which call of which node.
#[derive(Clone, Copy, Debug)]
pub struct Capture<'a> {
    pub cycler: &'a Cycler,
    pub node: &'a Node,
    /// What the robot's program says of the cycle.
    pub snapshot: &'a Value,
}

/// What the template is told.
#[derive(Serialize)]
struct Test<'a> {
    name: &'a str,
    function: String,
    node: &'a str,
    module: &'a str,
    type_name: &'a str,
    instance: &'a str,
    cycle: u64,
    probes: bool,
    /// The hardware's place is taken by this; empty: the node asks for none.
    stand_in: String,
    /// Where the state is made whole by `restore`.
    restored: Option<Literal>,
    before: Vec<String>,
    fields: Vec<Line>,
    after: Vec<String>,
    uses_outputs: bool,
}

/// A context, and what its fields refer to.
#[derive(Serialize)]
struct Literal {
    before: Vec<String>,
    fields: Vec<Line>,
}

#[derive(Serialize)]
struct Line {
    name: String,
    value: String,
}

/// Whether a node can be captured at all, as far as that is known without a recording.
///
/// # Errors
/// With what stands against it.
pub fn check_capturable(robot: &Robot, node: &Node) -> Result<(), Refusal> {
    let refuse = |what: &str, help: &str| {
        let message = format!("`{}` cannot be captured: {what}", node.path);
        Err(Refusal::bad(message).help(help.to_owned()))
    };
    if node.setup {
        let what = "it is a setup node, which a replay does not call";
        return refuse(what, "capture a node that reads what it writes");
    }
    let Some(resolved) = resolved(robot, node) else {
        return Ok(());
    };
    let is_reading = |interface: &&Interface| interface.reading != Some(false);
    if let Some(interface) = resolved.restore_bounds.iter().find(is_reading) {
        let what = format!(
            "its `restore` asks `{}`, whose answers are not recorded",
            interface.path
        );
        return refuse(&what, "keep in its state what `restore` asks for");
    }
    let unknown = asked(resolved).filter(|interface| interface.methods.is_none());
    let unknown: Vec<_> = unknown.map(|interface| interface.path.as_str()).collect();
    if !unknown.is_empty() {
        let what = format!(
            "nothing can be written that stands in for {}",
            listed(unknown)
        );
        let help =
            "hardware traits of the workspace without generics and supertraits can be stood in for";
        return refuse(&what, help);
    }
    Ok(())
}

fn resolved<'r>(robot: &'r Robot, node: &Node) -> Option<&'r Resolved> {
    let mut nodes = robot.cyclers.iter().flat_map(|cycler| &cycler.nodes);
    nodes.find(|one| one.path == node.path)
}

/// What a test of the node asks of the hardware: it does not call `new`.
fn asked(node: &Resolved) -> impl Iterator<Item = &Interface> {
    node.cycle_bounds.iter().chain(&node.restore_bounds)
}

/// The test and its data, in the node's crate.
///
/// # Errors
/// If the snapshot does not have what the node reads.
pub fn capture(
    workspace: &Workspace,
    robot: &Robot,
    capture: Capture<'_>,
) -> Result<Changes, Refusal> {
    let Capture { node, snapshot, .. } = capture;
    let library = node.path.split("::").next().unwrap_or_default();
    let member = own_member(workspace, robot, library)?;
    let instance = snapshot["instance"].as_str().unwrap_or_default();
    let cycle = snapshot["cycle"].as_u64().unwrap_or_default();
    let last = last(&node.path);
    let name = name(capture, instance, cycle);
    let mut writing = Writing::new(capture, instance);
    let resolved = resolved(robot, node);
    let restored = resolved
        .filter(|resolved| resolved.restores)
        .map(|_| {
            literal(
                &mut writing,
                node,
                Context::Creation,
                Writing::creation_field,
            )
        })
        .transpose()?;
    let Literal { before, fields } = literal(&mut writing, node, Context::Cycle, Writing::field)?;
    let stand_in = stand_in(node, resolved, restored.is_some());
    let (returned, uses_outputs) = returned(node);
    let mut after = std::mem::take(&mut writing.after);
    after.extend(returned);
    after.push("captured.assert_state(&node);".to_owned());
    if !stand_in.is_empty() {
        after.push("captured.assert_commands();".to_owned());
    }
    let test = Test {
        name: &name,
        function: format!(
            "{last}_computes_cycle_{cycle}_of_{}_again",
            schema::snake_case(instance)
        ),
        node: &node.path,
        module: &node.path,
        type_name: &node.type_name,
        instance,
        cycle,
        probes: writing.probes,
        stand_in,
        restored,
        before,
        fields,
        after,
        uses_outputs,
    };
    let data = data(&writing, capture);
    let folder: Utf8PathBuf = member.folder.join("tests");
    let text = render_template("captured", templates::node::CAPTURED_RS, &test);
    Ok(Changes::from([
        (folder.join(format!("{name}.rs")), Some(text)),
        (
            folder.join(format!("captured/{name}.json")),
            Some(format!("{data}\n")),
        ),
    ]))
}

/// What sets the test apart from those of all other nodes of the crate, instances and cycles.
fn name(Capture { cycler, node, .. }: Capture<'_>, instance: &str, cycle: u64) -> String {
    let (library, module) = node.path.split_once("::").unwrap_or(("", &node.path));
    let others = cycler.nodes.iter().filter(|other| other.path != node.path);
    let is_of_crate = |path: &str| path.split("::").next() == Some(library);
    // Of other cyclers' nodes its instance sets it apart.
    let mut likes = others.filter(|other| last(&other.path) == last(module));
    let node = match likes.any(|other| is_of_crate(&other.path)) {
        true => module.replace("::", "_"),
        false => last(module).to_owned(),
    };
    format!("{node}_{}_{cycle}", schema::snake_case(instance))
}

/// The node's own module.
fn last(path: &str) -> &str {
    path.rsplit("::").next().unwrap_or_default()
}

/// The file that the test reads.
fn data(writing: &Writing<'_>, Capture { node, snapshot, .. }: Capture<'_>) -> String {
    let data = json!({
        "version": snapshot["version"],
        "node": node.path,
        "instance": snapshot["instance"],
        "cycle": snapshot["cycle"],
        "start_ns": snapshot["start_ns"],
        "since_last_ns": snapshot["since_last_ns"],
        "state": snapshot["state"],
        "creation": writing.creation,
        "fields": writing.values,
        "latest": writing.latest,
        "calls": writing.calls,
        "outputs": snapshot["outputs"],
        "state_after": snapshot["state_after"],
        "commands": snapshot["commands"],
    });
    serde_json::to_string_pretty(&data).expect("JSON has only string keys")
}

/// How a method of [`Writing`] fills a field.
type Fill<'a> = fn(&mut Writing<'a>, &Field) -> Result<String, Refusal>;

/// One of the node's contexts.
fn literal<'a>(
    writing: &mut Writing<'a>,
    node: &Node,
    context: Context,
    fill: Fill<'a>,
) -> Result<Literal, Refusal> {
    let mut fields = Vec::new();
    for field in node.fields.iter().filter(|one| one.context == context) {
        let value = fill(writing, field)?;
        let name = field.name.clone();
        fields.push(Line { name, value });
    }
    let before = std::mem::take(&mut writing.before);
    Ok(Literal { before, fields })
}

/// What takes the node's commands, where its contexts have hardware.
fn stand_in(node: &Node, resolved: Option<&Resolved>, restored: bool) -> String {
    let has_hardware = |field: &Field| {
        let is_written = match field.context {
            Context::Creation => restored,
            _ => true,
        };
        is_written && field.kind == "HardwareInterface"
    };
    if !node.fields.iter().any(has_hardware) {
        return String::new();
    }
    let traits = resolved.map(|node| traits(asked(node))).unwrap_or_default();
    let about = "In place of the hardware: what the node tells it is compared with what it told it when it was recorded.";
    render_stand_in("Commanded", about, &traits)
}

/// Statements that compare the outputs which `cycle` returns, and whether there are any.
fn returned(node: &Node) -> (Vec<String>, bool) {
    let outputs = node
        .fields
        .iter()
        .filter(|field| field.kind == "MainOutput" && field.context == Context::Outputs);
    let lines = outputs.map(|field| {
        let name = &field.name;
        format!("captured.assert_output({name:?}, &outputs.{name}.value);")
    });
    let lines: Vec<_> = lines.collect();
    let are_there = !lines.is_empty();
    (lines, are_there)
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::{Capture, name};
    use crate::graph::{self, fixture};

    #[test]
    fn modules_stand_in_the_name_where_two_nodes_of_the_crate_would_have_the_same() {
        let mut graph = graph::describe(&fixture::robot(), &fixture::schedule());
        let control = &mut graph.cyclers[1];
        let paths = [
            "crate_a::left::filter",
            "crate_a::right::filter",
            "crate_b::deep::filter",
            "crate_a::walk",
        ];
        for (node, path) in control.nodes.iter_mut().zip(paths) {
            node.path = path.to_owned();
        }
        let snapshot = Value::Null;
        let names = control.nodes.iter().map(|node| {
            let capture = Capture {
                cycler: control,
                node,
                snapshot: &snapshot,
            };
            name(capture, "Control", 7)
        });
        assert_eq!(
            names.collect::<Vec<_>>(),
            [
                "left_filter_control_7",
                "right_filter_control_7",
                "filter_control_7",
                "walk_control_7"
            ]
        );
    }
}
