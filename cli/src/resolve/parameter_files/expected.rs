//! What a table of a parameter file may hold.

use std::collections::BTreeMap;

use syn::{Attribute, Expr, ExprLit, Lit, Meta, Token, punctuated::Punctuated};

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

/// Fields by the keys that derived serde reads; `None` where an attribute means more than is understood here.
fn fields<'a>(structure: StructFields) -> Option<BTreeMap<String, Child<'a>>> {
    if !crate::scan::derives(&structure.attributes, "Deserialize") {
        return None;
    }
    let container = serde_items(&structure.attributes)?;
    let understood = ["default", "deny_unknown_fields"];
    if !container
        .iter()
        .all(|item| understood.iter().any(|name| item.path().is_ident(name)))
    {
        return None;
    }
    let has_default = container.iter().any(|item| item.path().is_ident("default"));
    let mut children = BTreeMap::new();
    for field in structure.fields {
        let mut key = field.name.clone();
        let mut child = Child {
            required: !has_default && field.data.option_argument().is_none(),
            expected: Expected::Value(field.data),
            aliases: Vec::new(),
        };
        let mut skipped = false;
        for item in serde_items(&field.attributes)? {
            let name = item
                .path()
                .get_ident()
                .map(ToString::to_string)
                .unwrap_or_default();
            match (name.as_str(), text(&item)) {
                ("default", _) => child.required = false,
                ("skip" | "skip_deserializing", _) => skipped = true,
                ("rename", Some(name)) => key = name,
                ("alias", Some(name)) => child.aliases.push(name),
                ("skip_serializing" | "skip_serializing_if" | "serialize_with" | "borrow", _) => {}
                ("deserialize_with" | "with", _) => {
                    child = Child {
                        aliases: child.aliases,
                        ..opaque(child.required)
                    };
                }
                _ => return None,
            }
        }
        if !skipped {
            for alias in child.aliases.clone() {
                children.insert(
                    alias,
                    Child {
                        required: false,
                        ..child.clone()
                    },
                );
            }
            child.aliases.push(field.name);
            children.insert(key, child);
        }
    }
    Some(children)
}

/// Everything in `#[serde(…)]`; `None` if it cannot be read or depends on `cfg`.
fn serde_items(attributes: &[Attribute]) -> Option<Vec<Meta>> {
    let mut items = Vec::new();
    for attribute in attributes {
        if attribute.path().is_ident("cfg_attr") || attribute.path().is_ident("cfg") {
            return None;
        }
        if attribute.path().is_ident("serde") {
            let list = attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
            items.extend(list.ok()?);
        }
    }
    Some(items)
}

fn text(item: &Meta) -> Option<String> {
    match item {
        Meta::NameValue(meta) => match &meta.value {
            Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}
