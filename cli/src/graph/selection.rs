//! The part of a graph that concerns one cycler.

use super::{Edge, Graph, Node};

impl Graph {
    /// The cycler of this name with all its nodes, and of the others the nodes and fields that it
    /// exchanges values with. None: no cycler has this name.
    pub fn of_cycler(&self, name: &str) -> Option<Graph> {
        self.cyclers.iter().find(|cycler| cycler.name == name)?;
        let mut selected = self.clone();
        selected
            .edges
            .retain(|edge| edge.from.cycler == name || edge.to.cycler == name);
        for cycler in selected
            .cyclers
            .iter_mut()
            .filter(|cycler| cycler.name != name)
        {
            for node in &mut cycler.nodes {
                keep_fields_with_edges(&cycler.name, node, &selected.edges);
            }
            cycler.nodes.retain(|node| !node.fields.is_empty());
        }
        selected
            .cyclers
            .retain(|cycler| !cycler.nodes.is_empty() || cycler.name == name);
        let nodes: Vec<&str> = (selected.cyclers.iter())
            .filter(|cycler| cycler.name == name)
            .flat_map(|cycler| cycler.nodes.iter().map(|node| node.path.as_str()))
            .collect();
        (selected.parameters).retain(|parameter| {
            parameter
                .readers
                .iter()
                .any(|path| nodes.contains(&path.as_str()))
        });
        Some(selected)
    }
}

fn keep_fields_with_edges(cycler: &str, node: &mut Node, edges: &[Edge]) {
    let path = node.path.clone();
    node.fields.retain(|field| {
        edges.iter().any(|edge| {
            let from = &edge.from;
            let to = &edge.to;
            (from.cycler == cycler
                && from.node == path
                && field.kind == "MainOutput"
                && from.output == field.name)
                || (to.cycler == cycler && to.node == path && to.field == field.name)
        })
    });
}
