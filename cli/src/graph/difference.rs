//! What two graphs of one robot differ in, aspect by aspect.
//!
//! Invariant: everything stands in the order of the graphs, what is gone behind what is there.

mod aspects;

use serde::Serialize;
use serde_json::Value;

use super::Graph;

/// Differences from an earlier graph to a later one.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Difference {
    pub targets: Changes,
    pub cyclers: Changes,
    /// Nodes of cyclers that both have.
    pub nodes: Changes,
    /// Fields of nodes that both have: kind, type and path.
    pub fields: Changes,
    pub parameters: Changes,
    pub edges: Changes,
    /// Nodes that run elsewhere among the nodes that both have.
    pub order: Vec<Move>,
}

/// What one aspect gained, lost and says otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Changes {
    pub added: Vec<Item>,
    pub removed: Vec<Item>,
    pub changed: Vec<Changed>,
}

/// A part of a graph.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Item {
    /// By which it is recognised.
    pub name: String,
    /// What else there is to say about it.
    #[serde(skip)]
    pub text: String,
    /// As in `graph --format json`.
    #[serde(flatten)]
    pub value: Value,
}

/// A part that both graphs have and that is not the same.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Changed {
    pub before: Item,
    pub after: Item,
}

/// A node that runs elsewhere.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Move {
    pub cycler: String,
    pub node: String,
    /// Places from 0, as the graphs have them.
    pub before: usize,
    pub after: usize,
    /// The node that now runs directly before it; none: it is the first.
    pub behind: Option<String>,
}

impl Difference {
    /// From one graph to another, both whole.
    pub fn between(before: &Graph, after: &Graph) -> Self {
        let compare = |list: fn(&Graph, &Graph) -> Vec<Item>| {
            Changes::between(list(before, after), list(after, before))
        };
        Self {
            fields: compare(aspects::fields),
            parameters: compare(aspects::parameters),
            edges: compare(aspects::edges),
            order: aspects::moves(before, after),
            ..Self::of_manifests(before, after)
        }
    }

    /// From one graph to another where only their targets, cyclers and nodes are known.
    pub fn of_manifests(before: &Graph, after: &Graph) -> Self {
        let compare = |list: fn(&Graph, &Graph) -> Vec<Item>| {
            Changes::between(list(before, after), list(after, before))
        };
        Self {
            targets: compare(aspects::targets),
            cyclers: compare(aspects::cyclers),
            nodes: compare(aspects::nodes),
            ..Self::default()
        }
    }

    /// Each aspect of parts with its name in the plural.
    pub fn aspects(&self) -> [(&'static str, &Changes); 6] {
        [
            ("targets", &self.targets),
            ("cyclers", &self.cyclers),
            ("nodes", &self.nodes),
            ("fields", &self.fields),
            ("parameters", &self.parameters),
            ("edges", &self.edges),
        ]
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl Changes {
    fn between(before: Vec<Item>, after: Vec<Item>) -> Self {
        let mut changes = Self::default();
        let find = |items: &[Item], name: &str| items.iter().find(|it| it.name == name).cloned();
        for item in &after {
            match find(&before, &item.name) {
                None => changes.added.push(item.clone()),
                Some(earlier) if earlier.text != item.text => changes.changed.push(Changed {
                    before: earlier,
                    after: item.clone(),
                }),
                Some(_) => {}
            }
        }
        changes.removed = before;
        (changes.removed).retain(|item| find(&after, &item.name).is_none());
        changes
    }

    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

#[cfg(test)]
mod tests;
