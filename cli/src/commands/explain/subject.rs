//! What a name means in a robot: nodes, outputs and procedures, with the edges that touch them.

use serde_json::{Value, json};

use super::nodes;
use super::parameter::ParameterSubject;
use crate::diagnostics::nearest;
use crate::graph::{Bridge, BridgeKind, Cycler, Edge, EdgeKind, Field, Graph, Node};

/// Everything of one name.
pub(super) struct Subject<'g> {
    pub(super) nodes: Vec<NodeSubject<'g>>,
    pub(super) outputs: Vec<OutputSubject<'g>>,
    /// Additional outputs and procedures.
    pub(super) endpoints: Vec<Endpoint<'g>>,
    pub(super) parameters: Vec<ParameterSubject>,
    /// What of all this goes to other machines.
    pub(super) bridges: Vec<&'g Bridge>,
}

/// What clients of a running robot name: an additional output or a procedure.
pub(super) struct Endpoint<'g> {
    pub(super) cycler: &'g Cycler,
    pub(super) node: &'g Node,
    pub(super) field: &'g Field,
    /// As clients name it, `$cycler_instance` kept.
    pub(super) name: &'g str,
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
    /// Nodes by path or module name; outputs and procedures by name, also behind their cycler or instance.
    pub(super) fn find(graph: &'g Graph, name: &str) -> Self {
        let mut subject = Self {
            nodes: Vec::new(),
            outputs: Vec::new(),
            endpoints: Vec::new(),
            parameters: Vec::new(),
            bridges: Vec::new(),
        };
        for cycler in &graph.cyclers {
            for node in &cycler.nodes {
                if nodes::is_named(&node.path, name) {
                    subject.nodes.push(node_subject(graph, cycler, node));
                }
                for field in &node.fields {
                    let Some(group) = group(field) else {
                        continue;
                    };
                    let own = own_name(field);
                    if !is_named(cycler, group, own, name) {
                        continue;
                    }
                    if field.kind == "MainOutput" {
                        let output = output_subject(graph, cycler, node, field);
                        subject.outputs.push(output);
                    } else {
                        subject.endpoints.push(Endpoint {
                            cycler,
                            node,
                            field,
                            name: own,
                        });
                    }
                }
            }
        }
        subject
    }

    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
            && self.outputs.is_empty()
            && self.endpoints.is_empty()
            && self.parameters.is_empty()
    }

    /// Finds the bridges of what was found.
    pub(super) fn find_bridges(&mut self, graph: &'g Graph) {
        let bridges = graph.bridges.iter();
        self.bridges = bridges.filter(|bridge| self.touches(bridge)).collect();
    }

    fn touches(&self, bridge: &Bridge) -> bool {
        let is_part = |whole: &str, part: &str| {
            let rest = part.strip_prefix(whole);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        if bridge.kind == BridgeKind::Parameter {
            let path = bridge.path.split_once('.').map_or("", |(_, path)| path);
            let mut parameters = self.parameters.iter();
            return parameters.any(|one| is_part(&one.path, path) || is_part(path, &one.path));
        }
        if bridge.kind == BridgeKind::Remote {
            let mut outputs = self.outputs.iter();
            return outputs.any(|one| one.cycler.instances.contains(&bridge.path));
        }
        let mut words = bridge.path.splitn(3, '.');
        let (Some(instance), Some(group_of_bridge), Some(name)) =
            (words.next(), words.next(), words.next())
        else {
            return false;
        };
        let outputs = self.outputs.iter().map(|one| (one.cycler, one.field));
        let endpoints = self.endpoints.iter().map(|one| (one.cycler, one.field));
        let mut all = outputs.chain(endpoints);
        all.any(|(cycler, field)| {
            let own = own_name(field).replace("$cycler_instance", &schema::snake_case(instance));
            group(field) == Some(group_of_bridge)
                && cycler.instances.iter().any(|one| one == instance)
                && is_part(&own, name)
        })
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
        let mut value = json!({
            "version": 1,
            "nodes": nodes,
            "outputs": outputs,
            "additional_outputs": self.endpoints_to_json("AdditionalOutput"),
            "procedures": self.endpoints_to_json("Procedure"),
            "parameters": self.parameters,
        });
        if !self.bridges.is_empty() {
            value["bridges"] = json!(self.bridges);
        }
        value
    }

    fn endpoints_to_json(&self, kind: &str) -> Vec<Value> {
        let endpoints = self.endpoints.iter().filter(|one| one.field.kind == kind);
        let endpoints = endpoints.map(|found| {
            json!({
                "cycler": found.cycler.name,
                "name": found.name,
                "type": found.field.data,
                "node": found.node.path,
                "file": found.node.file,
                "line": found.field.line,
            })
        });
        endpoints.collect()
    }
}

/// Every name that has an explanation.
pub(super) fn names(graph: &Graph) -> Vec<String> {
    let mut names = Vec::new();
    for node in graph.cyclers.iter().flat_map(|cycler| &cycler.nodes) {
        names.push(node.path.clone());
        names.extend(node.path.rsplit("::").next().map(str::to_owned));
        let fields = node.fields.iter().filter(|field| group(field).is_some());
        names.extend(fields.map(|field| own_name(field).to_owned()));
    }
    names.extend(graph.parameters.iter().map(|one| one.path.clone()));
    names
}

/// The nearest to `Cycler.name`, `Cycler.group.name`, and the same with an instance, where nothing is called so.
pub(super) fn near_behind_owner(graph: &Graph, name: &str) -> Option<String> {
    let (owner, rest) = name.split_once('.')?;
    let owners = graph.cyclers.iter().flat_map(|cycler| {
        let names = std::iter::once(&cycler.name).chain(&cycler.instances);
        names.map(move |name| (name.as_str(), cycler))
    });
    let owners: Vec<_> = owners.collect();
    let is_meant = |name: &str| owners.iter().find(|(known, _)| *known == name);
    let &(owner, cycler) = is_meant(owner)
        .or_else(|| is_meant(nearest(owner, owners.iter().map(|(known, _)| *known))?))?;
    let fields = cycler.nodes.iter().flat_map(|node| &node.fields);
    let names = fields.filter_map(|field| {
        let (group, own) = (group(field)?, own_name(field));
        Some([own.to_owned(), format!("{group}.{own}")])
    });
    let names: Vec<String> = names.flatten().collect();
    let exact = names.iter().find(|known| *known == rest);
    let near = exact.map(String::as_str);
    let near = near.or_else(|| nearest(rest, names.iter().map(String::as_str)))?;
    Some(format!("{owner}.{near}"))
}

/// The word between cycler and name with which clients of a running robot name it.
fn group(field: &Field) -> Option<&'static str> {
    match field.kind {
        "MainOutput" => Some("main_outputs"),
        "AdditionalOutput" => Some("additional_outputs"),
        "Procedure" => Some("procedures"),
        _ => None,
    }
}

fn own_name(field: &Field) -> &str {
    match field.kind {
        "MainOutput" => &field.name,
        _ => field.path.as_deref().unwrap_or(&field.name),
    }
}

/// `walk`, `Control.walk`, `Control.procedures.walk`, and instances in place of the cycler.
fn is_named(cycler: &Cycler, group: &str, own: &str, name: &str) -> bool {
    let owners = std::iter::once(&cycler.name).chain(&cycler.instances);
    let mut rests = owners.filter_map(|owner| name.strip_prefix(owner.as_str())?.strip_prefix('.'));
    name == own
        || rests.any(|rest| {
            let behind = rest.strip_prefix(group);
            rest == own || behind.and_then(|it| it.strip_prefix('.')) == Some(own)
        })
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

#[cfg(test)]
mod tests {
    use super::near_behind_owner;
    use crate::graph::{describe, fixture};

    #[test]
    fn a_slip_behind_or_in_the_owner_is_seen() {
        let graph = describe(&fixture::robot(), &fixture::schedule());
        let near = |name: &str| near_behind_owner(&graph, name);
        for (name, meant) in [
            ("Control.bal", "Control.ball"),
            ("Contrl.ball", "Control.ball"),
            ("VisionTop.imgae", "VisionTop.image"),
            ("Control.main_outputs.bal", "Control.main_outputs.ball"),
        ] {
            assert_eq!(near(name).as_deref(), Some(meant), "{name}");
        }
        assert_eq!(near("Control.nothing_like_it"), None);
        assert_eq!(near("ball"), None);
    }
}
