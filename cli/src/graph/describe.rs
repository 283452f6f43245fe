//! From the resolved robot and the order of its nodes to the graph.

use super::{Bridge, Cycler, Graph, Kind, Node, Parameter, Target, edges, fields, json};
use crate::resolve::robot::{self, Content, CyclerKind, Robot, Tree};
use crate::schedule::Schedule;

/// Version of the JSON form; keys may be added within a version.
pub(super) const VERSION: u32 = 1;

/// The graph of a robot whose nodes run in the order of `schedule`.
pub fn describe(robot: &Robot, schedule: &Schedule) -> Graph {
    let mut parameters = Vec::new();
    collect_parameters(&robot.parameter_tree, "", &mut parameters);
    parameters.sort_by(|one, other| one.path.cmp(&other.path));
    let mut graph = Graph {
        version: VERSION,
        robot: robot.name.clone(),
        hash: String::new(),
        targets: robot.targets.iter().map(describe_target).collect(),
        parameters,
        bridges: robot.bridges.iter().map(describe_bridge).collect(),
        cyclers: Vec::new(),
        edges: edges::describe_edges(robot),
    };
    for (position, cycler) in robot.cyclers.iter().enumerate() {
        let order = &schedule.cyclers[position].order;
        graph.cyclers.push(describe_cycler(robot, cycler, order));
    }
    graph.hash = json::hash(&graph);
    graph
}

fn describe_target(target: &robot::Target) -> Target {
    Target {
        name: target.name.clone(),
        hardware: target.hardware.clone(),
        triple: target.triple.clone(),
    }
}

fn describe_bridge(bridge: &robot::Bridge) -> Bridge {
    Bridge {
        path: bridge.path.clone(),
        kind: bridge.kind,
        data: bridge.data.clone(),
        key: bridge.key.clone(),
        direction: bridge.direction,
        encoding: bridge.encoding,
        rate: bridge.rate,
    }
}

fn describe_cycler(robot: &Robot, cycler: &robot::Cycler, run_order: &[usize]) -> Cycler {
    let nodes = cycler.nodes.iter().enumerate().map(|(position, node)| {
        let order = run_order.iter().position(|&ordered| ordered == position);
        describe_node(
            robot,
            node,
            order.expect("a schedule holds every node of its cycler"),
        )
    });
    Cycler {
        name: cycler.name.clone(),
        kind: match cycler.kind {
            CyclerKind::Perception => Kind::Perception,
            CyclerKind::RealTime => Kind::RealTime,
        },
        remote: cycler.remote,
        instances: cycler
            .instances
            .iter()
            .map(|instance| instance.name.clone())
            .collect(),
        nodes: nodes.collect(),
    }
}

fn describe_node(robot: &Robot, node: &robot::Node, order: usize) -> Node {
    let mut interfaces: Vec<String> = node
        .new_bounds
        .iter()
        .chain(&node.cycle_bounds)
        .map(|bound| bound.path.clone())
        .collect();
    interfaces.sort();
    interfaces.dedup();
    Node {
        path: node.path.clone(),
        type_name: node.type_name.clone(),
        setup: node.setup,
        order,
        file: node.file.to_string(),
        interfaces,
        fields: fields::describe_fields(robot, node),
    }
}

fn collect_parameters(tree: &Tree<robot::Reader>, above: &str, parameters: &mut Vec<Parameter>) {
    for branch in &tree.branches {
        let path = match above {
            "" => branch.name.clone(),
            above => format!("{above}.{}", branch.name),
        };
        match &branch.content {
            Content::Leaf { data, users } => {
                let mut readers: Vec<String> = users.iter().map(|user| user.node.clone()).collect();
                readers.sort();
                readers.dedup();
                parameters.push(Parameter {
                    path,
                    data: data.text.clone(),
                    readers,
                });
            }
            Content::Inner(tree) | Content::Instance { tree, .. } => {
                collect_parameters(tree, &path, parameters);
            }
        }
    }
}
