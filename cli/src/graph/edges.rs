//! The edges between nodes: one for each read of a value, states from writers to readers.

use super::{Edge, EdgeKind, Sink, Source};
use crate::resolve::robot::{
    Access, CycleBinding, Cycler, DataType, Field, InstanceId, Node, Robot,
};

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
        match &self.field.binding {
            CycleBinding::OwnOutput {
                access,
                producer,
                checked,
                ..
            }
            | CycleBinding::RequiredOwnOutput {
                access,
                producer,
                checked,
                ..
            } => {
                edges.push(self.own(EdgeKind::Input, access, *producer, *checked));
            }
            CycleBinding::Previous {
                access,
                producer,
                checked,
                ..
            } => {
                edges.push(self.own(EdgeKind::Previous, access, *producer, *checked));
            }
            CycleBinding::Historic {
                access,
                producer,
                checked,
                ..
            } => {
                edges.push(self.own(EdgeKind::Historic, access, *producer, *checked));
            }
            CycleBinding::OutputOf {
                instance,
                access,
                producer,
                checked,
                ..
            }
            | CycleBinding::RequiredOutputOf {
                instance,
                access,
                producer,
                checked,
                ..
            }
            | CycleBinding::Latest {
                instance,
                access,
                producer,
                checked,
                ..
            } => {
                edges.push(self.across(EdgeKind::Latest, *instance, access, *producer, *checked));
            }
            CycleBinding::Perception {
                instances,
                access,
                producer,
                checked,
                ..
            } => {
                edges.extend(instances.iter().map(|&instance| {
                    self.across(EdgeKind::Perception, instance, access, *producer, *checked)
                }));
            }
            CycleBinding::CyclerState {
                access,
                data,
                shared: true,
            } => {
                self.add_state_edges(access, data, edges);
            }
            CycleBinding::CyclerState { shared: false, .. }
            | CycleBinding::Parameter { .. }
            | CycleBinding::CycleTime
            | CycleBinding::AdditionalOutput { .. }
            | CycleBinding::Procedure { .. }
            | CycleBinding::HardwareInterface
            | CycleBinding::MainOutput { .. } => {}
        }
    }

    fn own(&self, kind: EdgeKind, access: &Access, producer: usize, checked: bool) -> Edge {
        let from = Source {
            cycler: self.cycler.name.clone(),
            instance: None,
            node: self.cycler.nodes[producer].path.clone(),
            output: root(access),
        };
        Edge {
            from,
            to: self.sink(),
            kind,
            checked,
        }
    }

    fn across(
        &self,
        kind: EdgeKind,
        instance: InstanceId,
        access: &Access,
        producer: usize,
        checked: bool,
    ) -> Edge {
        let cycler = &self.robot.cyclers[instance.cycler];
        let from = Source {
            cycler: cycler.name.clone(),
            instance: Some(cycler.instances[instance.instance].name.clone()),
            node: cycler.nodes[producer].path.clone(),
            output: root(access),
        };
        Edge {
            from,
            to: self.sink(),
            kind,
            checked,
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

/// Whether one path is the other or leads to a field of it.
fn overlap(one: &Access, other: &Access) -> bool {
    one.segments
        .iter()
        .zip(&other.segments)
        .all(|(one, other)| one.name == other.name)
}
