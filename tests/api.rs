//! What a crate shows to those who use it, as text: public items without bodies, documentation and what only tests have.
//!
//! The lint `unreachable_pub` holds in every crate, so that what is `pub` is what can be reached.

use quote::ToTokens as _;
use syn::{Attribute, Fields, ImplItem, Item, Visibility};

use crate::sources;

/// The public items of the sources below this folder, file by file.
pub fn public_api(folder: &str) -> String {
    let mut api = String::new();
    for source in sources(&[folder], ".rs") {
        let file = syn::parse_file(&source.text)
            .unwrap_or_else(|error| panic!("{}: {error}", source.path));
        let items: Vec<_> = file.items.into_iter().filter_map(shown).collect();
        if !items.is_empty() {
            let file = syn::File {
                shebang: None,
                attrs: Vec::new(),
                items,
            };
            api += &format!("// {}\n\n{}\n", source.path, prettyplease::unparse(&file));
        }
    }
    api
}

/// What others see of an item.
fn shown(mut item: Item) -> Option<Item> {
    let (attributes, visibility) = parts(&mut item)?;
    if attributes.iter().any(is_for_tests) || visibility.is_some_and(|seen| !is_public(seen)) {
        return None;
    }
    attributes.retain(is_told);
    match &mut item {
        Item::Fn(function) => function.block.stmts.clear(),
        Item::Struct(structure) => show_fields(&mut structure.fields),
        Item::Enum(enumeration) => {
            for variant in &mut enumeration.variants {
                variant.attrs.clear();
                show_fields(&mut variant.fields);
            }
        }
        Item::Const(constant) => *constant.expr = syn::parse_quote!(_),
        Item::Static(value) => *value.expr = syn::parse_quote!(_),
        Item::Trait(seen) => seen.items.iter_mut().for_each(show_of_trait),
        Item::Impl(block) => {
            let of_trait = block.trait_.is_some();
            block.items.retain_mut(|item| show_of_impl(item, of_trait));
            if block.items.is_empty() && !of_trait {
                return None;
            }
        }
        Item::Mod(module) => {
            if let Some((_, items)) = &mut module.content {
                *items = std::mem::take(items)
                    .into_iter()
                    .filter_map(shown)
                    .collect();
            }
        }
        _ => {}
    }
    Some(item)
}

/// Attributes and visibility; `None` of the latter: it has none of its own.
fn parts(item: &mut Item) -> Option<(&mut Vec<Attribute>, Option<&Visibility>)> {
    Some(match item {
        Item::Const(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Enum(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Fn(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Impl(item) => (&mut item.attrs, None),
        Item::Mod(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Static(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Struct(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Trait(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Type(item) => (&mut item.attrs, Some(&item.vis)),
        Item::Use(item) => (&mut item.attrs, Some(&item.vis)),
        // Exported or not, it says so itself.
        Item::Macro(item)
            if item
                .attrs
                .iter()
                .any(|seen| seen.path().is_ident("macro_export")) =>
        {
            (&mut item.attrs, None)
        }
        _ => return None,
    })
}

fn show_fields(fields: &mut Fields) {
    if let Fields::Named(named) = fields {
        let fields = std::mem::take(&mut named.named).into_iter();
        named.named = fields
            .filter(|field| !matches!(field.vis, Visibility::Restricted(_)))
            .collect();
    }
    fields.iter_mut().for_each(|field| field.attrs.clear());
}

fn show_of_trait(item: &mut syn::TraitItem) {
    match item {
        syn::TraitItem::Fn(function) => {
            function.attrs.retain(is_told);
            // That there is a body is to be seen: nobody has to write one.
            if let Some(block) = &mut function.default {
                block.stmts.clear();
            }
        }
        syn::TraitItem::Type(kind) => kind.attrs.retain(is_told),
        syn::TraitItem::Const(constant) => constant.attrs.retain(is_told),
        _ => {}
    }
}

fn show_of_impl(item: &mut ImplItem, of_trait: bool) -> bool {
    match item {
        ImplItem::Fn(function) => {
            function.attrs.retain(is_told);
            function.block.stmts.clear();
            !of_trait && is_public(&function.vis)
        }
        ImplItem::Const(constant) => {
            constant.attrs.retain(is_told);
            !of_trait && is_public(&constant.vis)
        }
        ImplItem::Type(_) => of_trait,
        _ => false,
    }
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

fn is_for_tests(attribute: &Attribute) -> bool {
    attribute.path().is_ident("cfg") && attribute.to_token_stream().to_string().contains("test")
}

/// Derives and conditions are part of what is promised.
fn is_told(attribute: &Attribute) -> bool {
    let told = ["cfg", "derive", "non_exhaustive", "must_use", "repr"];
    told.iter().any(|name| attribute.path().is_ident(name))
}
