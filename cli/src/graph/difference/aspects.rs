//! The parts of a graph as items that are compared by name and text.

use serde::Serialize;
use serde_json::{Value, json};
use similar::{Algorithm, DiffOp, capture_diff_slices};

use super::{Item, Move};
use crate::graph::{Cycler, Graph, Node, fields as written_fields};

pub(super) fn targets(graph: &Graph, _: &Graph) -> Vec<Item> {
    let targets = graph.targets.iter().map(|target| {
        let triple = target.triple.as_deref();
        let triple = triple.map_or(String::new(), |triple| format!(" for {triple}"));
        item(
            target.name.clone(),
            format!("{}{triple}", target.hardware),
            target,
        )
    });
    targets.collect()
}

pub(super) fn cyclers(graph: &Graph, _: &Graph) -> Vec<Item> {
    let cyclers = graph.cyclers.iter().map(|cycler| {
        let instances = cycler.instances.join(", ");
        let text = format!("{}, {instances}", cycler.kind_in_words());
        let mut value = json!({ "kind": cycler.kind, "instances": cycler.instances });
        if cycler.remote {
            value["remote"] = true.into();
        }
        item(cycler.name.clone(), text, &value)
    });
    cyclers.collect()
}

pub(super) fn nodes(graph: &Graph, other: &Graph) -> Vec<Item> {
    let mut items = Vec::new();
    for cycler in graph.cyclers.iter().filter(|one| has_cycler(other, one)) {
        items.extend(cycler.nodes.iter().map(|node| {
            let mut text = if node.setup { "setup node" } else { "node" }.to_owned();
            if !node.interfaces.is_empty() {
                text.push_str(&format!(", asks {}", node.interfaces.join(" + ")));
            }
            let value = json!({
                "cycler": cycler.name,
                "node": node.path,
                "setup": node.setup,
                "interfaces": node.interfaces,
            });
            item(format!("{} of {}", node.path, cycler.name), text, &value)
        }));
    }
    items
}

pub(super) fn fields(graph: &Graph, other: &Graph) -> Vec<Item> {
    let mut items = Vec::new();
    for (cycler, node) in shared_nodes(graph, other) {
        for field in &node.fields {
            let mut value = json!({ "cycler": cycler.name, "node": node.path, "field": field });
            // Where it stands is nothing that a graph differs in.
            if let Some(field) = value["field"].as_object_mut() {
                field.shift_remove("line");
            }
            let name = match field.context {
                crate::graph::Context::Creation => format!("{} (creation)", field.name),
                crate::graph::Context::Cycle | crate::graph::Context::Outputs => field.name.clone(),
            };
            let name = format!("{}.{name} of {}", node.path, cycler.name);
            items.push(item(name, written_fields::written(field), &value));
        }
    }
    items
}

pub(super) fn parameters(graph: &Graph, _: &Graph) -> Vec<Item> {
    let parameters = graph.parameters.iter().map(|parameter| {
        item(
            parameter.path.clone(),
            parameter.data.clone(),
            &json!({ "path": parameter.path, "type": parameter.data }),
        )
    });
    parameters.collect()
}

pub(super) fn bridges(graph: &Graph, _: &Graph) -> Vec<Item> {
    let bridges = graph.bridges.iter().map(|bridge| {
        let name = format!("{} at {}", bridge.path, bridge.key);
        let value = serde_json::to_value(bridge).expect("a bridge has only string keys");
        let words = ["kind", "type", "direction", "encoding", "rate"].map(|key| &value[key]);
        let words = words.into_iter().filter(|word| !word.is_null());
        let words = words.map(|word| {
            word.as_str()
                .map_or_else(|| word.to_string(), str::to_owned)
        });
        item(name, words.collect::<Vec<_>>().join(", "), &value)
    });
    bridges.collect()
}

pub(super) fn edges(graph: &Graph, _: &Graph) -> Vec<Item> {
    let edges = graph.edges.iter().map(|edge| {
        let (from, to) = (&edge.from, &edge.to);
        let owner = from.instance.as_ref().unwrap_or(&from.cycler);
        let name = format!(
            "{owner}.{} of {} → {}.{} of {}",
            from.output, from.node, to.node, to.field, to.cycler
        );
        item(name, edge.kind.word().to_owned(), edge)
    });
    edges.collect()
}

/// Nodes that stand elsewhere among those that both graphs have; as few as explain the new order.
pub(super) fn moves(before: &Graph, after: &Graph) -> Vec<Move> {
    let mut moves = Vec::new();
    for cycler in &after.cyclers {
        let Some(earlier) = before.cyclers.iter().find(|one| one.name == cycler.name) else {
            continue;
        };
        let (old, new) = (shared_paths(earlier, cycler), shared_paths(cycler, earlier));
        for operation in capture_diff_slices(Algorithm::Myers, &old, &new) {
            let (DiffOp::Insert {
                new_index, new_len, ..
            }
            | DiffOp::Replace {
                new_index, new_len, ..
            }) = operation
            else {
                continue;
            };
            for index in new_index..new_index + new_len {
                moves.push(moved(earlier, cycler, &new, index));
            }
        }
    }
    moves
}

fn moved(before: &Cycler, after: &Cycler, paths: &[&str], index: usize) -> Move {
    let place = |cycler: &Cycler| {
        let node = cycler.nodes.iter().find(|node| node.path == paths[index]);
        node.map_or(0, |node| node.order)
    };
    let behind = index.checked_sub(1).map(|before| paths[before].to_owned());
    Move {
        cycler: after.name.clone(),
        node: paths[index].to_owned(),
        before: place(before),
        after: place(after),
        behind,
    }
}

/// Nodes of `cycler` that `other` has, too, in the order they run.
fn shared_paths<'g>(cycler: &'g Cycler, other: &Cycler) -> Vec<&'g str> {
    let nodes = cycler.in_run_order().into_iter();
    let shared = nodes.filter(|node| other.nodes.iter().any(|one| one.path == node.path));
    shared.map(|node| node.path.as_str()).collect()
}

fn shared_nodes<'g>(graph: &'g Graph, other: &Graph) -> Vec<(&'g Cycler, &'g Node)> {
    let mut shared = Vec::new();
    for cycler in &graph.cyclers {
        let Some(opposite) = other.cyclers.iter().find(|one| one.name == cycler.name) else {
            continue;
        };
        let nodes = cycler.nodes.iter();
        let nodes = nodes.filter(|node| opposite.nodes.iter().any(|one| one.path == node.path));
        shared.extend(nodes.map(|node| (cycler, node)));
    }
    shared
}

fn has_cycler(graph: &Graph, cycler: &Cycler) -> bool {
    graph.cyclers.iter().any(|one| one.name == cycler.name)
}

fn item(name: String, text: String, value: &impl Serialize) -> Item {
    let mut value = serde_json::to_value(value).expect("a graph has only string keys");
    // The item has it already.
    if let Value::Object(entries) = &mut value {
        entries.shift_remove("name");
    }
    Item { name, text, value }
}
