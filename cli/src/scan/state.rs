//! The struct of a node: where it stands, what it derives, and which of its fields are not stored.

use std::ops::Range;
use std::rc::Rc;

use grammar::is_written_for_tests;
use quote::ToTokens as _;
use syn::visit::{self, Visit};
use syn::{Attribute, Ident, Item, ItemImpl, ItemStruct, Meta, Token, punctuated::Punctuated};

use super::beyond::stands_in;
use super::library::Library;
use super::lookup::Found;
use super::module::{Entry, Module, attributes, is_conditional, only_for_tests};
use super::range;
use super::served::{derives_nothing_unknown, writes_nothing};
use super::types::written;

/// A node's struct, or enum, as the node's file has it.
#[derive(Clone, Debug)]
pub struct StateSource {
    /// Of its name.
    pub range: Range<usize>,
    /// `Serialize` and `Deserialize`, as far as nothing provides them.
    pub missing_derives: Vec<&'static str>,
    /// A condition, or what cannot be looked into, decides whether it is there and what it derives.
    pub is_uncertain: bool,
    /// Fields that are read from text which has to live forever: type and place.
    pub borrowing: Vec<(String, Range<usize>)>,
    /// Fields with `#[serde(skip)]`: name and place.
    pub skipped: Vec<(String, Range<usize>)>,
}

/// Reads the struct, or the enum, of this name; `None` if the file does not have it.
pub(super) fn find(
    library: &Library<'_>,
    module: &Rc<Module>,
    node: &Ident,
) -> Option<StateSource> {
    let mut items = module.syntax.items.iter();
    let (name, attributes, item) = items.find_map(|item| {
        let (name, attributes, item) = match item {
            Item::Struct(item) => (&item.ident, &item.attrs, Some(item)),
            Item::Enum(item) => (&item.ident, &item.attrs, None),
            _ => return None,
        };
        let is_it = name == node && !only_for_tests(attributes);
        is_it.then_some((name, attributes, item))
    })?;
    let mut is_uncertain = is_conditional(attributes);
    let mut missing_derives = Vec::new();
    for one in ["Serialize", "Deserialize"] {
        match provides(library, module, (name, attributes), one) {
            Provides::Surely => {}
            Provides::Perhaps => is_uncertain = true,
            Provides::Never => missing_derives.push(one),
        }
    }
    // Another struct may stand in its place, or the condition never holds.
    if is_uncertain {
        missing_derives.clear();
    }
    Some(StateSource {
        range: range(name.span()),
        missing_derives,
        is_uncertain,
        borrowing: item.map(borrowing).unwrap_or_default(),
        skipped: item.map(skipped).unwrap_or_default(),
    })
}

fn skipped(item: &ItemStruct) -> Vec<(String, Range<usize>)> {
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
    skipped.collect()
}

/// Whether a macro of the module may define the type of this name, which does not stand in it as it is written.
pub(super) fn may_be_made(library: &Library<'_>, module: &Rc<Module>, node: &Ident) -> bool {
    let name = node.to_string();
    let may_write = |item: &Item| match item {
        Item::Macro(call) => call.ident.is_none(),
        item => {
            let attributes = attributes(item);
            let plain = |one| writes_nothing(one) || grammar::is_context_attribute(one);
            !attributes.iter().all(plain) || !derives_nothing_unknown(attributes)
        }
    };
    let is_taken = match module.entries.get(&name) {
        None => false,
        // What is brought in may also be a function or a macro of that name.
        Some(Entry::Import(_)) => library.item_in(module, &name).is_some(),
        Some(_) => true,
    };
    !is_taken && module.syntax.items.iter().any(may_write)
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

/// The fields for which `#[derive(Deserialize)]` borrows from what it reads, so that nothing but text which lives forever
/// can be read; `None` of them where attributes may change that.
fn borrowing(item: &ItemStruct) -> Vec<(String, Range<usize>)> {
    let own_way = |meta: &Meta| {
        ["bound", "from", "remote", "try_from", "transparent"]
            .iter()
            .any(|name| meta.path().is_ident(name))
    };
    if !derives(&item.attrs, "Deserialize") || has_serde(&item.attrs, own_way) {
        return Vec::new();
    }
    let read_otherwise = |meta: &Meta| {
        let names = [
            "bound",
            "deserialize_with",
            "skip",
            "skip_deserializing",
            "with",
        ];
        names.iter().any(|name| meta.path().is_ident(name))
    };
    let is_borrow = |meta: &Meta| matches!(meta, Meta::Path(path) if path.is_ident("borrow"));
    let fields = item.fields.iter().filter(|field| {
        let mut attributes = field.attrs.iter();
        !attributes.any(|one| one.path().is_ident("cfg") || one.path().is_ident("cfg_attr"))
            && !has_serde(&field.attrs, read_otherwise)
            && (is_borrowed(&field.ty)
                || has_serde(&field.attrs, is_borrow) && names_static(field.ty.to_token_stream()))
    });
    let found = fields.map(|field| {
        (
            written(&field.ty),
            range(syn::spanned::Spanned::span(&field.ty)),
        )
    });
    found.collect()
}

/// `&'static str` and `&'static [u8]`, also in an `Option`: what serde borrows unasked.
fn is_borrowed(data: &syn::Type) -> bool {
    match data {
        syn::Type::Reference(reference) => {
            let is_static = reference
                .lifetime
                .as_ref()
                .is_some_and(|one| one.ident == "static");
            let is_named = |data: &syn::Type, name: &str| matches!(data, syn::Type::Path(path) if path.path.is_ident(name));
            let is_text = match &*reference.elem {
                syn::Type::Slice(slice) => is_named(&slice.elem, "u8"),
                data => is_named(data, "str"),
            };
            is_static && is_text && reference.mutability.is_none()
        }
        syn::Type::Path(path) => {
            let last = path
                .path
                .segments
                .last()
                .filter(|last| last.ident == "Option");
            match last.map(|last| &last.arguments) {
                Some(syn::PathArguments::AngleBracketed(list)) => match list.args.first() {
                    Some(syn::GenericArgument::Type(inner @ syn::Type::Reference(_))) => {
                        is_borrowed(inner)
                    }
                    _ => false,
                },
                _ => false,
            }
        }
        _ => false,
    }
}

fn names_static(tokens: proc_macro2::TokenStream) -> bool {
    stands_in(tokens, "static")
}

fn is_skip(meta: &Meta) -> bool {
    ["skip", "skip_serializing", "skip_deserializing"]
        .iter()
        .any(|name| meta.path().is_ident(name))
}

/// Whether a node's struct has a trait of serde.
enum Provides {
    Surely,
    /// Under a condition, or something may hide it.
    Perhaps,
    Never,
}

fn provides(
    library: &Library<'_>,
    module: &Rc<Module>,
    (node, above): (&Ident, &[Attribute]),
    name: &str,
) -> Provides {
    if derives(above, name) {
        return Provides::Surely;
    }
    // The macro of an attribute may write anything, and so may what stands behind a condition.
    let unknown = |attribute: &Attribute| {
        let known = [
            "cfg", "derive", "doc", "serde", "allow", "expect", "must_use", "repr",
        ];
        !is_written_for_tests(attribute)
            && !known.iter().any(|known| attribute.path().is_ident(known))
    };
    match by_hand(library, module, node, name) {
        Provides::Never if above.iter().any(unknown) => Provides::Perhaps,
        found => found,
    }
}

/// An `impl` of the trait, which may stand anywhere in the crate, or a call of a macro with the node's name.
fn by_hand(library: &Library<'_>, module: &Rc<Module>, node: &Ident, name: &str) -> Provides {
    let mut found = Provides::Never;
    let mut waiting: Vec<(Rc<Module>, bool)> = vec![(module.clone(), true)];
    let root = library.root(module.library());
    waiting.extend(root.map(|root| (root, true)));
    while let Some((module, always)) = waiting.pop() {
        let mut search = Search {
            library,
            module: &module,
            node,
            name,
            always,
            found: &mut found,
        };
        search.visit_file(&module.syntax);
        if matches!(found, Provides::Surely) {
            break;
        }
        for item in &module.syntax.items {
            let Item::Mod(item) = item else { continue };
            if !only_for_tests(&item.attrs) {
                let below = library.quietly(|| library.declared(&module, &item.ident.to_string()));
                let always = always && !is_conditional(&item.attrs);
                waiting.extend(below.map(|below| (below, always)));
            }
        }
    }
    found
}

struct Search<'a> {
    library: &'a Library<'a>,
    module: &'a Rc<Module>,
    node: &'a syn::Ident,
    name: &'a str,
    always: bool,
    found: &'a mut Provides,
}

impl<'ast> Visit<'ast> for Search<'_> {
    fn visit_item_mod(&mut self, _: &'ast syn::ItemMod) {}

    fn visit_item(&mut self, item: &'ast Item) {
        if !only_for_tests(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_impl(&mut self, block: &'ast ItemImpl) {
        visit::visit_item_impl(self, block);
        let Some((None, written, _)) = &block.trait_ else {
            return;
        };
        let is_named = |path: &syn::Path| {
            path.segments
                .last()
                .is_some_and(|last| last.ident == self.name)
        };
        let is_trait = is_named(written)
            || match self.library.find(self.module, written) {
                Some(Found::Standard(path) | Found::Foreign(path)) => {
                    path.last().is_some_and(|last| last == self.name)
                }
                _ => false,
            };
        let is_of_node = match &*block.self_ty {
            syn::Type::Path(path) => path
                .path
                .segments
                .last()
                .is_some_and(|last| last.ident == *self.node),
            _ => false,
        };
        if is_trait && is_of_node {
            let surely = self.always && !is_conditional(&block.attrs);
            self.note(if surely {
                Provides::Surely
            } else {
                Provides::Perhaps
            });
        }
    }

    fn visit_item_macro(&mut self, call: &'ast syn::ItemMacro) {
        if call.ident.is_none() && stands_in(call.mac.tokens.clone(), &self.node.to_string()) {
            self.note(Provides::Perhaps);
        }
    }
}

impl Search<'_> {
    fn note(&mut self, found: Provides) {
        if !matches!(self.found, Provides::Surely) {
            *self.found = found;
        }
    }
}
