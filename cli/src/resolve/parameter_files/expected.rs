//! What a table of a parameter file may hold.

use std::collections::BTreeMap;

use super::keys::keys;
use crate::resolve::robot::{Content, Reader, Tree};
use crate::scan::Sources;
use crate::scan::fields::StructFields;
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
    /// Other keys that mean the same.
    aliases: Vec<String>,
}

impl Child<'_> {
    /// Every key under which the value may stand.
    pub(super) fn names<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a str> {
        std::iter::once(name).chain(self.aliases.iter().map(String::as_str))
    }
}

impl<'a> Expected<'a> {
    /// What stands below, by key; `None` where that cannot be seen.
    pub(super) fn children(&self, sources: &Sources<'_>) -> Option<BTreeMap<String, Child<'a>>> {
        match self {
            Self::Tree(tree) => {
                let branches = tree.branches.iter();
                Some(
                    branches
                        .map(|branch| (branch.name.clone(), child(&branch.content, sources)))
                        .collect(),
                )
            }
            Self::Value(data) => {
                let data = data.option_argument().unwrap_or(data);
                fields(sources.library.fields(data)?)
            }
        }
    }
}

fn child<'a>(content: &'a Content<Reader>, sources: &Sources<'_>) -> Child<'a> {
    match content {
        Content::Leaf { data, users } => {
            let data = users
                .first()
                .and_then(|user| sources.nodes.get(&user.node))
                .map(|node| sources.library.resolve_absolute(&node.module, &data.text));
            match data {
                Some(data) => Child {
                    required: data.option_argument().is_none(),
                    expected: Expected::Value(data),
                    aliases: Vec::new(),
                },
                None => opaque(true),
            }
        }
        Content::Inner(tree) | Content::Instance { tree, .. } => Child {
            expected: Expected::Tree(tree),
            required: false,
            aliases: Vec::new(),
        },
    }
}

fn opaque<'a>(required: bool) -> Child<'a> {
    Child {
        expected: Expected::Value(Resolved::opaque()),
        required,
        aliases: Vec::new(),
    }
}

/// Fields by the keys that derived serde reads; `None` where an attribute means more than is understood.
fn fields<'a>(structure: StructFields) -> Option<BTreeMap<String, Child<'a>>> {
    let mut children = BTreeMap::new();
    for key in keys(structure)? {
        let child = if key.by_function {
            opaque(key.required)
        } else {
            Child {
                required: key.required,
                expected: Expected::Value(key.field.data),
                aliases: Vec::new(),
            }
        };
        for alias in &key.aliases {
            let child = Child {
                required: false,
                ..child.clone()
            };
            children.insert(alias.clone(), child);
        }
        let aliases = key.aliases;
        children.insert(key.name, Child { aliases, ..child });
    }
    Some(children)
}
