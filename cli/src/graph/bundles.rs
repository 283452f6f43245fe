//! Edges of one kind between the same two nodes, for pictures that draw them as one line.

use super::{Cycler, Edge, EdgeKind, Graph, Node};

/// One line of a picture.
pub(super) struct Bundle<'a> {
    pub(super) from: (&'a Cycler, &'a Node),
    pub(super) to: (&'a Cycler, &'a Node),
    pub(super) kind: EdgeKind,
    /// What it carries: the output, with its instance where that is not the only one.
    pub(super) labels: Vec<String>,
}

impl Graph {
    /// Lines in the order of their first edges.
    pub(super) fn bundles(&self) -> Vec<Bundle<'_>> {
        let mut bundles: Vec<Bundle<'_>> = Vec::new();
        for edge in &self.edges {
            let from = self.node(&edge.from.cycler, &edge.from.node);
            let to = self.node(&edge.to.cycler, &edge.to.node);
            let label = label(from.0, edge);
            let same = bundles.iter_mut().find(|bundle| {
                bundle.kind == edge.kind && is_same(bundle.from, from) && is_same(bundle.to, to)
            });
            match same {
                Some(bundle) if bundle.labels.contains(&label) => {}
                Some(bundle) => bundle.labels.push(label),
                None => bundles.push(Bundle {
                    from,
                    to,
                    kind: edge.kind,
                    labels: vec![label],
                }),
            }
        }
        bundles
    }

    fn node(&self, cycler: &str, path: &str) -> (&Cycler, &Node) {
        let cycler = (self.cyclers.iter())
            .find(|candidate| candidate.name == cycler)
            .expect("an edge ends in cyclers of its graph");
        let node = (cycler.nodes.iter())
            .find(|candidate| candidate.path == path)
            .expect("an edge ends in nodes of its cyclers");
        (cycler, node)
    }
}

fn is_same(one: (&Cycler, &Node), other: (&Cycler, &Node)) -> bool {
    one.0.name == other.0.name && one.1.path == other.1.path
}

fn label(from: &Cycler, edge: &Edge) -> String {
    match &edge.from.instance {
        Some(instance) if from.instances.len() > 1 => format!("{instance}.{}", edge.from.output),
        _ => edge.from.output.clone(),
    }
}
