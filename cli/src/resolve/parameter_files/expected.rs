//! What a table of a parameter file may hold.

use std::collections::{BTreeMap, BTreeSet};

use grammar::{Hints, Range};
use toml::de::DeTable;

use super::form::{Form, is_duration, is_optional};
use super::keys::Key;
use crate::resolve::robot::{Content, Reader, Tree};
use crate::scan::Sources;
use crate::scan::types::Resolved;

/// A place of the parameter tree.
#[derive(Clone, Debug)]
pub(super) enum Expected<'a> {
    /// Declared paths.
    Tree(&'a Tree<Reader>),
    /// A value of this type.
    Value(Resolved),
}

/// What may stand under one key.
#[derive(Clone, Debug)]
pub(super) struct Child<'a> {
    pub(super) expected: Expected<'a>,
    /// It has to be given.
    pub(super) required: bool,
    /// An array of all fields may end before it.
    pub(super) has_default: bool,
    /// Where numbers in it must lie, if the field says so.
    pub(super) limits: Option<Range>,
    /// Other keys that mean the same.
    pub(super) aliases: Vec<String>,
    /// It is another name of the value under this key.
    pub(super) alias_of: Option<String>,
}

/// What stands below a place.
#[derive(Clone, Debug)]
pub(super) enum Children<'a> {
    /// These keys, with the other names of some.
    Named(BTreeMap<String, Child<'a>>),
    /// Any keys, each with a value of this type.
    Any(Resolved),
}

impl<'a> Child<'a> {
    /// A value that has to be there.
    pub(super) fn of(data: Resolved) -> Self {
        Self {
            required: !is_optional(&data),
            has_default: false,
            expected: Expected::Value(data),
            limits: None,
            aliases: Vec::new(),
            alias_of: None,
        }
    }

    /// The declared paths themselves.
    pub(super) fn tree(tree: &'a Tree<Reader>) -> Self {
        Self {
            expected: Expected::Tree(tree),
            ..Self::opaque(false)
        }
    }

    /// In a field whose numbers must lie there; its own limits win.
    pub(super) fn within(self, limits: Option<Range>) -> Self {
        let own = self.limits.or(limits);
        // Meant are seconds, which are two numbers in a file.
        let is_duration = matches!(&self.expected, Expected::Value(data) if is_duration(data));
        Self {
            limits: own.filter(|_| !is_duration),
            ..self
        }
    }

    fn opaque(required: bool) -> Self {
        Self {
            required,
            ..Self::of(Resolved::opaque())
        }
    }

    /// Every key under which the value may stand.
    pub(super) fn names<'n>(&'n self, name: &'n str) -> impl Iterator<Item = &'n str> {
        std::iter::once(name).chain(self.aliases.iter().map(String::as_str))
    }
}

impl<'a> Children<'a> {
    /// What stands under a key.
    pub(super) fn get(&self, name: &str) -> Option<Child<'a>> {
        match self {
            Self::Named(children) => children.get(name).cloned(),
            Self::Any(data) => Some(Child::of(data.clone())),
        }
    }

    /// Every key that is known.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        let children = match self {
            Self::Named(children) => Some(children),
            Self::Any(_) => None,
        };
        children
            .into_iter()
            .flat_map(BTreeMap::keys)
            .map(String::as_str)
    }

    /// What these tables have, and what they should have.
    pub(super) fn of_tables<'t>(
        self,
        tables: impl IntoIterator<Item = &'t DeTable<'t>>,
    ) -> BTreeMap<String, Child<'a>> {
        match self {
            Self::Named(children) => children,
            Self::Any(data) => {
                let keys = tables.into_iter().flat_map(|table| table.keys());
                let names: BTreeSet<String> = keys.map(|key| key.get_ref().to_string()).collect();
                let child = |name| (name, Child::of(data.clone()));
                names.into_iter().map(child).collect()
            }
        }
    }
}

impl<'a> Expected<'a> {
    /// What stands below, by key; `None` where that cannot be seen.
    pub(super) fn children(&self, sources: &Sources<'_>) -> Option<Children<'a>> {
        match self {
            Self::Tree(tree) => {
                let branches = tree.branches.iter();
                let child =
                    |branch: &'a Branch| (branch.name.clone(), child(&branch.content, sources));
                Some(Children::Named(branches.map(child).collect()))
            }
            Self::Value(data) => match Form::of(data, sources) {
                Form::Fields { children, .. } => Some(children),
                Form::Map(data) => Some(Children::Any(data)),
                _ => None,
            },
        }
    }
}

type Branch = crate::resolve::robot::Branch<Reader>;

fn child<'a>(content: &'a Content<Reader>, sources: &Sources<'_>) -> Child<'a> {
    match content {
        Content::Leaf { data, users } => {
            let node = users.first().and_then(|user| sources.nodes.get(&user.node));
            node.map_or_else(
                || Child::opaque(true),
                |node| Child::of(sources.library.resolve_absolute(&node.module, &data.text)),
            )
        }
        Content::Inner(tree) | Content::Instance { tree, .. } => Child::tree(tree),
    }
}

/// What stands under a key that derived serde reads, without its other names.
pub(super) fn of_key(key: &Key) -> Child<'static> {
    let has_default = key.has_default;
    if key.by_function {
        return Child {
            has_default,
            ..Child::opaque(key.required)
        };
    }
    // What cannot be read is told by the macro.
    let hints = Hints::read(&key.field.attributes);
    Child {
        required: key.required,
        has_default,
        limits: hints.ok().and_then(|hints| hints.range),
        ..Child::of(key.field.data.clone())
    }
}

/// Fields by the keys that derived serde reads.
pub(super) fn children(keys: Vec<Key>) -> Children<'static> {
    let mut children = BTreeMap::new();
    for key in keys {
        let child = of_key(&key);
        for alias in &key.aliases {
            let child = Child {
                required: false,
                alias_of: Some(key.name.clone()),
                ..child.clone()
            };
            children.insert(alias.clone(), child);
        }
        let aliases = key.aliases;
        children.insert(key.name, Child { aliases, ..child });
    }
    Children::Named(children)
}
