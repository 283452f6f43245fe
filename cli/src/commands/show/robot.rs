//! The robot as text: every field of every node, bound to what fills it.

use crate::graph::edges::describe_edges;
use crate::graph::fields::{describe_fields, written};
use crate::graph::{Context, Edge, Field};
use crate::resolve::robot::{Content, Cycler, CyclerKind, Interface, Node, OnFailure, Robot, Tree};

/// Cyclers with nodes and what they write, then the parameter tree.
pub fn text(robot: &Robot) -> String {
    let mut text = format!(
        "robot {}\n  generated in {}, parameters in {}\n",
        robot.name, robot.generated, robot.parameters
    );
    for target in &robot.targets {
        text.push_str(&format!("  target {}: {}\n", target.name, target.hardware));
    }
    let edges = describe_edges(robot);
    for cycler in &robot.cyclers {
        write_cycler(&mut text, robot, cycler, &edges);
    }
    if !robot.parameter_tree.branches.is_empty() {
        text.push_str("\nparameters\n");
        write_tree(&mut text, &robot.parameter_tree, 1, &|reader| {
            reader.node.clone()
        });
    }
    if robot.left_to_rustc > 0 {
        text.push_str(&format!("\nleft to rustc: {}\n", robot.left_to_rustc));
    }
    text
}

fn write_cycler(text: &mut String, robot: &Robot, cycler: &Cycler, edges: &[Edge]) {
    let kind = match cycler.kind {
        CyclerKind::Perception => "perception",
        CyclerKind::RealTime => "real-time",
    };
    let instances: Vec<&str> = cycler
        .instances
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    text.push_str(&format!(
        "\ncycler {} ({kind}): {}\n",
        cycler.name,
        instances.join(", ")
    ));
    text.push_str(&format!("  {}\n", settings(cycler).join(", ")));
    for node in &cycler.nodes {
        let edges: Vec<&Edge> = (edges.iter())
            .filter(|edge| edge.to.cycler == cycler.name && edge.to.node == node.path)
            .collect();
        write_node(text, robot, node, &edges);
    }
    if !cycler.outputs.is_empty() {
        text.push_str("  main outputs\n");
    }
    for output in &cycler.outputs {
        let marks = [
            (output.in_place, "in place"),
            (output.shared, "shared"),
            (output.historic, "historic"),
            (output.previous, "previous"),
        ];
        let marks: String = marks
            .iter()
            .filter(|mark| mark.0)
            .map(|mark| format!(", {}", mark.1))
            .collect();
        let producer = &cycler.nodes[output.producer].path;
        text.push_str(&format!(
            "    {}: {} by {producer}{marks}\n",
            output.name, output.data.text
        ));
    }
    if !cycler.additional_outputs.branches.is_empty() {
        text.push_str("  additional outputs\n");
        write_tree(text, &cycler.additional_outputs, 2, &|writer| {
            writer.node.clone()
        });
    }
    if !cycler.states.branches.is_empty() {
        text.push_str("  cycler state\n");
        write_tree(text, &cycler.states, 2, &|user| {
            let mark = if user.shared { " (reads)" } else { "" };
            format!("{}{mark}", user.node)
        });
    }
}

fn settings(cycler: &Cycler) -> Vec<String> {
    let mut settings = vec![format!("on failure {}", cycler.on_failure.name())];
    settings.extend(cycler.remote.then(|| "run by another machine".to_owned()));
    match cycler.kind {
        CyclerKind::Perception => {
            settings.push(format!("pending timeout {:?}", cycler.pending_timeout));
            settings.push(format!("queue {}", cycler.queue));
        }
        CyclerKind::RealTime => {
            settings.push(format!("watchdog {:?}", cycler.watchdog));
            settings.push(format!("history {:?}", cycler.history));
        }
    }
    for instance in &cycler.instances {
        settings.extend(
            instance
                .deadline
                .map(|it| format!("{} within {it:?}", instance.name)),
        );
    }
    settings.extend(
        cycler
            .lockstep_duration
            .map(|it| format!("lockstep duration {it:?}")),
    );
    settings
}

/// `edges`: those that end at the node.
fn write_node(text: &mut String, robot: &Robot, node: &Node, edges: &[&Edge]) {
    let kind = if node.setup { "setup node" } else { "node" };
    text.push_str(&format!(
        "  {kind} {}: {} in {}\n",
        node.path, node.type_name, node.file
    ));
    if node.on_failure != OnFailure::Stop {
        text.push_str(&format!("    on failure {}\n", node.on_failure.name()));
    }
    let fields = describe_fields(robot, node);
    let sections = [
        ("new", Context::Creation, &node.new_bounds),
        ("cycle", Context::Cycle, &node.cycle_bounds),
        ("outputs", Context::Outputs, &Vec::new()),
    ];
    for (title, context, bounds) in sections {
        let fields: Vec<&Field> = fields
            .iter()
            .filter(|field| field.context == context)
            .collect();
        if fields.is_empty() && bounds.is_empty() {
            continue;
        }
        text.push_str(&format!("    {title}{}\n", hardware(bounds)));
        for field in fields {
            let source = match context {
                Context::Cycle => source(field, edges),
                Context::Creation | Context::Outputs => String::new(),
            };
            text.push_str(&format!(
                "      {}: {}{source}\n",
                field.name,
                written(field)
            ));
        }
    }
    if node.restores {
        text.push_str(&format!("    restore{}\n", hardware(&node.restore_bounds)));
    }
}

/// Who writes what the field reads.
fn source(field: &Field, edges: &[&Edge]) -> String {
    let mut nodes: Vec<&str> = Vec::new();
    let mut checked = true;
    for edge in edges.iter().filter(|edge| edge.to.field == field.name) {
        checked &= edge.checked;
        if !nodes.contains(&&*edge.from.node) {
            nodes.push(&edge.from.node);
        }
    }
    let left = if checked { "" } else { ", type left to rustc" };
    match nodes.as_slice() {
        [] => String::new(),
        nodes => format!(" from {}{left}", nodes.join(", ")),
    }
}

fn hardware(bounds: &[Interface]) -> String {
    let bounds: Vec<String> = (bounds.iter())
        .map(|bound| {
            let access = match bound.reading {
                Some(true) => " (reading)",
                Some(false) => " (writing)",
                None => "",
            };
            format!("{}{access}", bound.path)
        })
        .collect();
    if bounds.is_empty() {
        String::new()
    } else {
        format!(" asks {}", bounds.join(", "))
    }
}

fn write_tree<U>(text: &mut String, tree: &Tree<U>, depth: usize, user: &dyn Fn(&U) -> String) {
    let indent = "  ".repeat(depth);
    for branch in &tree.branches {
        match &branch.content {
            Content::Leaf { data, users } => {
                let mut users: Vec<String> = users.iter().map(user).collect();
                users.sort();
                users.dedup();
                let users = users.join(", ");
                text.push_str(&format!(
                    "{indent}{}: {} by {users}\n",
                    branch.name, data.text
                ));
            }
            Content::Inner(tree) | Content::Instance { tree, .. } => {
                text.push_str(&format!("{indent}{}\n", branch.name));
                write_tree(text, tree, depth + 1, user);
            }
        }
    }
}
