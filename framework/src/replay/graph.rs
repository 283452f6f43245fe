//! As much as a replay needs of the graph that `hulkgen graph --format json` prints.

use serde::Deserialize;

use crate::error::{Error, Result};

#[derive(Deserialize)]
pub(super) struct Graph {
    pub(super) cyclers: Vec<Cycler>,
}

#[derive(Deserialize)]
pub(super) struct Cycler {
    pub(super) instances: Vec<String>,
    pub(super) nodes: Vec<Node>,
}

#[derive(Deserialize)]
pub(super) struct Node {
    pub(super) path: String,
    pub(super) setup: bool,
    /// Of the calls in a cycle.
    pub(super) order: usize,
    pub(super) fields: Vec<Field>,
}

#[derive(Deserialize)]
pub(super) struct Field {
    pub(super) kind: String,
    #[serde(rename = "type")]
    pub(super) data: Option<String>,
    pub(super) path: Option<String>,
}

impl Graph {
    /// # Errors
    /// If it is no such graph.
    pub(super) fn read(text: &str) -> Result<Self> {
        serde_json::from_str(text)
            .map_err(|_| Error::new("this program does not know its graph: build it again"))
    }
}
