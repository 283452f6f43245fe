//! What a graph can say of a robot whose nodes are not understood: what the manifest lists.

use super::{Cycler, Graph, Kind, Node, Target};
use crate::manifest::{self, Manifest};

/// Targets, cyclers and nodes in manifest order; no fields, parameters or edges, and no hash.
pub(crate) fn describe(manifest: &Manifest) -> Graph {
    let targets = manifest.targets.iter().map(|target| Target {
        name: target.declared.name.to_string(),
        hardware: target.declared.hardware.to_string(),
        triple: target.declared.triple.clone(),
    });
    Graph {
        version: super::describe::VERSION,
        robot: manifest.robot.name.to_string(),
        hash: String::new(),
        targets: targets.collect(),
        parameters: Vec::new(),
        bridges: Vec::new(),
        cyclers: manifest.cyclers.iter().map(describe_cycler).collect(),
        edges: Vec::new(),
    }
}

fn describe_cycler(cycler: &manifest::Cycler) -> Cycler {
    let nodes = cycler.nodes.iter().enumerate().map(|(order, node)| Node {
        path: node.path.to_string(),
        type_name: String::new(),
        setup: node.setup,
        order,
        file: String::new(),
        interfaces: Vec::new(),
        fields: Vec::new(),
    });
    Cycler {
        name: cycler.name().to_owned(),
        kind: match cycler.declared.kind {
            schema::CyclerKind::Perception => Kind::Perception,
            schema::CyclerKind::RealTime => Kind::RealTime,
        },
        remote: cycler.declared.remote,
        instances: (cycler.instances.iter())
            .map(|instance| instance.name.to_string())
            .collect(),
        nodes: nodes.collect(),
    }
}
