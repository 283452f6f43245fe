//! The robot as a graph for other programs and for people: who writes what, who reads it, how.
//!
//! [`describe`] makes it from the resolved robot and the order of its nodes; the modules below print it.
//!
//! Invariant: everything stands in manifest order, so the same robot gives the same bytes.

mod bundles;
mod describe;
pub mod difference;
pub mod dot;
pub(crate) mod edges;
pub(crate) mod fields;
#[cfg(test)]
pub(crate) mod fixture;
pub mod html;
pub mod json;
mod lines;
pub(crate) mod listed;
pub mod mermaid;
mod selection;
pub mod svg;

use serde::Serialize;

pub use crate::resolve::robot::BridgeKind;
pub use describe::describe;

/// A whole robot, or what [`Graph::of_cycler`] left of it.
#[derive(Clone, Debug, Serialize)]
pub struct Graph {
    pub version: u32,
    pub robot: String,
    /// Hash of what the whole robot's graph means, see [`json::hash`].
    pub hash: String,
    pub targets: Vec<Target>,
    /// Sorted by path.
    pub parameters: Vec<Parameter>,
    /// In manifest order; left out where there is none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bridges: Vec<Bridge>,
    pub cyclers: Vec<Cycler>,
    /// By reader in manifest order; a perception read of a cycler is one edge for each instance.
    pub edges: Vec<Edge>,
}

/// A binary with its hardware.
#[derive(Clone, Debug, Serialize)]
pub struct Target {
    pub name: String,
    pub hardware: String,
    pub triple: Option<String>,
}

/// A declared parameter, instances expanded.
#[derive(Clone, Debug, Serialize)]
pub struct Parameter {
    pub path: String,
    #[serde(rename = "type")]
    pub data: String,
    /// Paths of the nodes that read it or a field of it.
    pub readers: Vec<String>,
}

/// What a bridge to other machines maps to a key.
#[derive(Clone, Debug, Serialize)]
pub struct Bridge {
    /// As clients of the running robot write it.
    pub path: String,
    /// `main_output`, `additional_output`, `parameter`, `procedure` or `remote`.
    pub kind: BridgeKind,
    /// None where it is no value, or one of which only the running robot knows the type.
    #[serde(rename = "type")]
    pub data: Option<String>,
    pub key: String,
    /// None for procedures.
    pub direction: Option<schema::Direction>,
    pub encoding: schema::BridgeEncoding,
    /// Values in a second; None: one for each cycle.
    pub rate: Option<f64>,
}

/// A cycler with its nodes: setup nodes first, then nodes, both in manifest order.
#[derive(Clone, Debug, Serialize)]
pub struct Cycler {
    pub name: String,
    pub kind: Kind,
    /// Another machine runs it; left out where none does.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub remote: bool,
    pub instances: Vec<String>,
    pub nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    Perception,
    RealTime,
}

#[derive(Clone, Debug, Serialize)]
pub struct Node {
    pub path: String,
    #[serde(rename = "type")]
    pub type_name: String,
    pub setup: bool,
    /// Place in the cycle from 0, setup nodes first.
    pub order: usize,
    pub file: String,
    /// Hardware traits that `new` or `cycle` ask for, sorted.
    pub interfaces: Vec<String>,
    pub fields: Vec<Field>,
}

/// A field of one of the node's contexts, as its author wrote it, types absolute.
#[derive(Clone, Debug, Serialize)]
pub struct Field {
    pub context: Context,
    pub name: String,
    /// The written kind: `Input`, `Parameter` …
    pub kind: &'static str,
    #[serde(rename = "type")]
    pub data: Option<String>,
    /// The written instance, or cycler for an interleaved perception input.
    pub instance: Option<String>,
    pub path: Option<String>,
    pub line: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Context {
    Creation,
    Cycle,
    Outputs,
}

/// A value on its way from the node that writes it to a field that reads it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Edge {
    pub from: Source,
    pub to: Sink,
    pub kind: EdgeKind,
    /// Whether both types were compared; if not, rustc will.
    pub checked: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Source {
    pub cycler: String,
    /// None inside a cycler: each instance reads its own.
    pub instance: Option<String>,
    pub node: String,
    /// Name of the main output; of a state its path.
    pub output: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Sink {
    pub cycler: String,
    pub node: String,
    pub field: String,
}

/// How the reader sees the value. In the order in which legends list them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum EdgeKind {
    Input,
    Previous,
    Historic,
    Latest,
    Perception,
    State,
}

impl EdgeKind {
    /// The word of the JSON form.
    pub fn word(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Previous => "previous",
            Self::Historic => "historic",
            Self::Latest => "latest",
            Self::Perception => "perception",
            Self::State => "state",
        }
    }
}

impl Kind {
    /// The word of the manifest.
    pub fn word(self) -> &'static str {
        match self {
            Self::Perception => "perception",
            Self::RealTime => "real-time",
        }
    }
}

impl Cycler {
    /// Its kind, and whether another machine runs it.
    pub fn kind_in_words(&self) -> &'static str {
        match (self.kind, self.remote) {
            (Kind::Perception, true) => "perception, on another machine",
            (kind, _) => kind.word(),
        }
    }

    /// The nodes as they run in a cycle.
    pub fn in_run_order(&self) -> Vec<&Node> {
        let mut nodes: Vec<&Node> = self.nodes.iter().collect();
        nodes.sort_by_key(|node| node.order);
        nodes
    }
}

impl Graph {
    /// Edges whose types were compared.
    pub fn checked_edges(&self) -> usize {
        self.edges.iter().filter(|edge| edge.checked).count()
    }
}

#[cfg(test)]
mod tests;
