//! The edges between nodes: one for each read of a value, states from writers to readers.

use super::{Edge, EdgeKind, Sink, Source};
use crate::resolve::robot::{
    Access, CycleBinding, Cycler, DataType, Field, Node, OutputRead, Robot,
};
use crate::schedule::overlap;

pub(crate) fn describe_edges(robot: &Robot) -> Vec<Edge> {
    let mut edges = Vec::new();
    for cycler in &robot.cyclers {
        for node in &cycler.nodes {
            for field in &node.cycle {
                let reader = Reader {
                    robot,
                    cycler,
                    node,
                    field,
                };
                reader.add_edges(&mut edges);
            }
        }
    }
    edges
}

/// A field of a cycle context with all that stands around it.
struct Reader<'a> {
    robot: &'a Robot,
    cycler: &'a Cycler,
    node: &'a Node,
    field: &'a Field<CycleBinding>,
}

impl Reader<'_> {
    fn add_edges(&self, edges: &mut Vec<Edge>) {
        let binding = &self.field.binding;
        if let Some(read) = binding.read() {
            let kind = match binding {
                CycleBinding::Previous { .. } => EdgeKind::Previous,
                CycleBinding::Historic { .. } => EdgeKind::Historic,
                CycleBinding::Perception { .. } => EdgeKind::Perception,
                _ if read.instances.is_empty() => EdgeKind::Input,
                _ => EdgeKind::Latest,
            };
            if read.instances.is_empty() {
                edges.push(self.edge(kind, self.cycler, None, read));
            }
            edges.extend(read.instances.iter().map(|&id| {
                let cycler = &self.robot.cyclers[id.cycler];
                let instance = cycler.instances[id.instance].name.clone();
                self.edge(kind, cycler, Some(instance), read)
            }));
        } else if let CycleBinding::CyclerState {
            access,
            data,
            shared: true,
        } = binding
        {
            self.add_state_edges(access, data, edges);
        }
    }

    fn edge(
        &self,
        kind: EdgeKind,
        cycler: &Cycler,
        instance: Option<String>,
        read: OutputRead<'_>,
    ) -> Edge {
        let from = Source {
            cycler: cycler.name.clone(),
            instance,
            node: cycler.nodes[read.producer].path.clone(),
            output: root(read.access),
        };
        Edge {
            from,
            to: self.sink(),
            kind,
            checked: read.checked,
        }
    }

    fn add_state_edges(&self, read: &Access, read_data: &DataType, edges: &mut Vec<Edge>) {
        for writer in self
            .cycler
            .nodes
            .iter()
            .filter(|writer| writer.path != self.node.path)
        {
            for field in &writer.cycle {
                let CycleBinding::CyclerState {
                    access,
                    data,
                    shared: false,
                } = &field.binding
                else {
                    continue;
                };
                if !overlap(access, read) {
                    continue;
                }
                let from = Source {
                    cycler: self.cycler.name.clone(),
                    instance: None,
                    node: writer.path.clone(),
                    output: access.written.clone(),
                };
                let checked = data.resolved && read_data.resolved;
                edges.push(Edge {
                    from,
                    to: self.sink(),
                    kind: EdgeKind::State,
                    checked,
                });
            }
        }
    }

    fn sink(&self) -> Sink {
        Sink {
            cycler: self.cycler.name.clone(),
            node: self.node.path.clone(),
            field: self.field.name.clone(),
        }
    }
}

/// The output that a path begins with.
fn root(access: &Access) -> String {
    access
        .segments
        .first()
        .map(|segment| segment.name.clone())
        .unwrap_or_default()
}
