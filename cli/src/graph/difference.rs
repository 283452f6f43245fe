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
    /// The robot's name, if it has another.
    pub robot: Option<Both<String>>,
    pub targets: Changes,
    /// Names of those that both have, if they stand otherwise: the first is the default.
    pub target_order: Option<Both<Vec<String>>>,
    pub cyclers: Changes,
    /// Names of those that both have, if they stand otherwise: ties are decided by it.
    pub cycler_order: Option<Both<Vec<String>>>,
    /// Nodes of cyclers that both have.
    pub nodes: Changes,
    /// Fields of nodes that both have: kind, type and path.
    pub fields: Changes,
    pub parameters: Changes,
    pub bridges: Changes,
    pub edges: Changes,
    /// Nodes that run elsewhere among the nodes that both have.
    pub order: Vec<Move>,
}

/// What it was, and what it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Both<T> {
    pub before: T,
    pub after: T,
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
            bridges: compare(aspects::bridges),
            edges: compare(aspects::edges),
            order: aspects::moves(before, after),
            ..Self::of_manifests(before, after)
        }
    }

    /// From one graph to another where only their names, targets, cyclers and nodes are known.
    pub fn of_manifests(before: &Graph, after: &Graph) -> Self {
        let compare = |list: fn(&Graph, &Graph) -> Vec<Item>| {
            Changes::between(list(before, after), list(after, before))
        };
        Self {
            robot: Both::of(before.robot.clone(), after.robot.clone()),
            target_order: order_of(&before.targets, &after.targets, |one| &one.name),
            cycler_order: order_of(&before.cyclers, &after.cyclers, |one| &one.name),
            targets: compare(aspects::targets),
            cyclers: compare(aspects::cyclers),
            nodes: compare(aspects::nodes),
            ..Self::default()
        }
    }

    /// Each aspect of parts with its name in the plural.
    pub fn aspects(&self) -> [(&'static str, &Changes); 7] {
        [
            ("targets", &self.targets),
            ("cyclers", &self.cyclers),
            ("nodes", &self.nodes),
            ("fields", &self.fields),
            ("parameters", &self.parameters),
            ("bridges", &self.bridges),
            ("edges", &self.edges),
        ]
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl<T: PartialEq> Both<T> {
    /// Nothing if the two are one.
    fn of(before: T, after: T) -> Option<Self> {
        (before != after).then_some(Self { before, after })
    }
}

/// How the parts that both lists have stand in each, if that differs.
fn order_of<T>(
    before: &[T],
    after: &[T],
    name: impl Fn(&T) -> &String,
) -> Option<Both<Vec<String>>> {
    let shared = |of: &[T], other: &[T]| -> Vec<String> {
        let names = of.iter().map(&name);
        let shared = names.filter(|one| other.iter().any(|other| name(other) == *one));
        shared.cloned().collect()
    };
    Both::of(shared(before, after), shared(after, before))
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
