//! What a name means in a robot: nodes and outputs, with the edges that touch them.

use serde_json::{Value, json};

use crate::graph::{Cycler, Edge, EdgeKind, Field, Graph, Node};

/// Everything of one name.
pub(super) struct Subject<'g> {
    pub(super) nodes: Vec<NodeSubject<'g>>,
    pub(super) outputs: Vec<OutputSubject<'g>>,
}

pub(super) struct NodeSubject<'g> {
    pub(super) cycler: &'g Cycler,
    pub(super) node: &'g Node,
    /// Edges that end at the node.
    pub(super) reads: Vec<&'g Edge>,
    /// Edges that begin at the node.
    pub(super) writes: Vec<&'g Edge>,
}

pub(super) struct OutputSubject<'g> {
    pub(super) cycler: &'g Cycler,
    pub(super) node: &'g Node,
    pub(super) field: &'g Field,
    /// Edges that begin at the output.
    pub(super) reads: Vec<&'g Edge>,
}

impl<'g> Subject<'g> {
    /// Nodes by path or module name; main outputs by name, also behind their cycler or instance.
    pub(super) fn find(graph: &'g Graph, name: &str) -> Self {
        let mut subject = Self {
            nodes: Vec::new(),
            outputs: Vec::new(),
        };
        for cycler in &graph.cyclers {
            for node in &cycler.nodes {
                if node.path == name || node.path.rsplit("::").next() == Some(name) {
                    subject.nodes.push(node_subject(graph, cycler, node));
                }
                let outputs = node
                    .fields
                    .iter()
                    .filter(|field| field.kind == "MainOutput");
                for field in outputs.filter(|field| is_named(cycler, field, name)) {
                    subject
                        .outputs
                        .push(output_subject(graph, cycler, node, field));
                }
            }
        }
        subject
    }

    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.outputs.is_empty()
    }

    /// With nodes, fields and edges as in `graph --format json`.
    pub(super) fn to_json(&self) -> Value {
        let nodes: Vec<Value> = (self.nodes.iter())
            .map(|found| {
                json!({
                    "cycler": found.cycler.name,
                    "node": found.node,
                    "reads": found.reads,
                    "writes": found.writes,
                })
            })
            .collect();
        let outputs: Vec<Value> = (self.outputs.iter())
            .map(|found| {
                json!({
                    "cycler": found.cycler.name,
                    "output": found.field.name,
                    "type": found.field.data,
                    "node": found.node.path,
                    "reads": found.reads,
                })
            })
            .collect();
        json!({ "version": 1, "nodes": nodes, "outputs": outputs })
    }
}

/// Every name that has an explanation.
pub(super) fn names(graph: &Graph) -> Vec<String> {
    let mut names = Vec::new();
    for node in graph.cyclers.iter().flat_map(|cycler| &cycler.nodes) {
        names.push(node.path.clone());
        let outputs = node
            .fields
            .iter()
            .filter(|field| field.kind == "MainOutput");
        names.extend(outputs.map(|field| field.name.clone()));
    }
    names
}

fn is_named(cycler: &Cycler, field: &Field, name: &str) -> bool {
    match name.split_once('.') {
        None => field.name == name,
        Some((owner, output)) => {
            field.name == output
                && (cycler.name == owner || cycler.instances.iter().any(|one| one == owner))
        }
    }
}

fn node_subject<'g>(graph: &'g Graph, cycler: &'g Cycler, node: &'g Node) -> NodeSubject<'g> {
    let reads = |edge: &&Edge| edge.to.cycler == cycler.name && edge.to.node == node.path;
    let writes = |edge: &&Edge| edge.from.cycler == cycler.name && edge.from.node == node.path;
    NodeSubject {
        cycler,
        node,
        reads: graph.edges.iter().filter(reads).collect(),
        writes: graph.edges.iter().filter(writes).collect(),
    }
}

fn output_subject<'g>(
    graph: &'g Graph,
    cycler: &'g Cycler,
    node: &'g Node,
    field: &'g Field,
) -> OutputSubject<'g> {
    let node_subject = node_subject(graph, cycler, node);
    let mut reads = node_subject.writes;
    reads.retain(|edge| edge.from.output == field.name && edge.kind != EdgeKind::State);
    OutputSubject {
        cycler,
        node,
        field,
        reads,
    }
}
