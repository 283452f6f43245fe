//! The struct of a node: what it derives, and which of its fields are not stored.

use std::ops::Range;

use syn::{Attribute, Item, ItemStruct, Meta, Token, punctuated::Punctuated};

use super::range;

/// A node's struct, if it is written in the node's file.
#[derive(Clone, Debug)]
pub struct StateSource {
    /// Of its name.
    pub range: Range<usize>,
    /// `Serialize` and `Deserialize`, as far as nothing provides them.
    pub missing_derives: Vec<&'static str>,
    /// Fields with `#[serde(skip)]`: name and place.
    pub skipped: Vec<(String, Range<usize>)>,
}

/// Reads the struct of this name; `None` if the file does not have it.
pub(super) fn find(file: &syn::File, node: &syn::Ident) -> Option<StateSource> {
    let item = file.items.iter().find_map(|item| match item {
        Item::Struct(item) if item.ident == *node => Some(item),
        _ => None,
    })?;
    let missing_derives = ["Serialize", "Deserialize"]
        .into_iter()
        .filter(|name| !derives(&item.attrs, name) && !implements(file, item, name))
        .collect();
    let skipped = item
        .fields
        .iter()
        .filter(|field| has_serde(&field.attrs, is_skip));
    let skipped = skipped.map(|field| {
        let name = field.ident.as_ref();
        let place = name.map_or_else(|| syn::spanned::Spanned::span(&field.ty), syn::Ident::span);
        (
            name.map_or_else(|| "0".to_owned(), syn::Ident::to_string),
            range(place),
        )
    });
    Some(StateSource {
        range: range(item.ident.span()),
        missing_derives,
        skipped: skipped.collect(),
    })
}

/// Whether `#[derive(…)]` names this trait; unknown attribute macros may provide anything.
pub(crate) fn derives(attributes: &[Attribute], name: &str) -> bool {
    attributes
        .iter()
        .filter(|attribute| attribute.path().is_ident("derive"))
        .any(|attribute| {
            let paths =
                attribute.parse_args_with(Punctuated::<syn::Path, Token![,]>::parse_terminated);
            paths.is_ok_and(|paths| {
                paths
                    .iter()
                    .any(|path| path.segments.last().is_some_and(|last| last.ident == name))
            })
        })
}

/// Whether one of the items in `#[serde(…)]` fits.
fn has_serde(attributes: &[Attribute], fits: impl Fn(&Meta) -> bool) -> bool {
    attributes
        .iter()
        .filter(|attribute| attribute.path().is_ident("serde"))
        .any(|attribute| {
            let items = attribute.parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated);
            items.is_ok_and(|items| items.iter().any(&fits))
        })
}

fn is_skip(meta: &Meta) -> bool {
    ["skip", "skip_serializing", "skip_deserializing"]
        .iter()
        .any(|name| meta.path().is_ident(name))
}

/// `impl Serialize for Node` in the node's file, or an attribute macro or derive that hides it.
fn implements(file: &syn::File, item: &ItemStruct, name: &str) -> bool {
    let unknown = |attribute: &Attribute| {
        let known = [
            "derive", "doc", "serde", "allow", "expect", "must_use", "repr", "cfg_attr",
        ];
        let serde_by_condition = attribute.path().is_ident("cfg_attr");
        serde_by_condition || !known.iter().any(|known| attribute.path().is_ident(known))
    };
    let by_hand = file.items.iter().any(|other| match other {
        Item::Impl(block) => {
            let named =
                |path: &syn::Path| path.segments.last().is_some_and(|last| last.ident == name);
            let of_node = match &*block.self_ty {
                syn::Type::Path(path) => path.path.is_ident(&item.ident),
                _ => false,
            };
            of_node
                && block
                    .trait_
                    .as_ref()
                    .is_some_and(|(_, path, _)| named(path))
        }
        _ => false,
    });
    by_hand || item.attrs.iter().any(unknown)
}
