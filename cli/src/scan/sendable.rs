//! What surely cannot move to another thread, or be shared with one.
//!
//! Invariant: a type is called so only if rustc will certainly agree: what a macro, a crate outside of the workspace or an
//! `impl` by hand may decide is unknown.

mod rules;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

use quote::ToTokens as _;
use syn::punctuated::Punctuated;
use syn::{
    Attribute, Fields, GenericArgument, GenericParam, Generics, Item, PathArguments, Token, Type,
    TypeParamBound,
};

use super::fields::is_harmless;
use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::{Module, is_conditional};
use super::range;
use super::served::derives_nothing_unknown;
use super::state::derives;
use super::types::written;
use rules::Rule;

/// A field of a node's state that keeps the node on the thread that made it.
#[derive(Debug)]
pub struct Tied {
    /// Of the field's type.
    pub range: Range<usize>,
    /// The part that is to blame, as written: `Rc<u8>`.
    pub what: String,
    /// The struct of the workspace in which that part stands, if it is not the state itself.
    pub within: Option<String>,
}

/// What is known of a node's state.
#[derive(Debug, Default)]
pub struct TiedState {
    /// Fields that surely keep it on one thread.
    pub fields: Vec<Tied>,
    /// Nobody but rustc can tell whether something else does.
    pub is_unknown: bool,
}

/// `Send` or `Sync`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Marker {
    Send,
    Sync,
}

/// Whether bounds bring a marker; of several bounds the greatest answer is that of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Brought {
    SurelyNot,
    /// Left to rustc.
    Unknown,
    Surely,
}

type Bounds = Punctuated<TypeParamBound, Token![+]>;

/// The part to blame, and the struct around it.
type Blame = (String, Option<String>);

/// What is known of type parameters: whom to blame for a marker that their arguments lack.
type Parameters = BTreeMap<(String, Marker), Option<Blame>>;

/// Aliases and structs may lead in circles; no honest type is deeper.
const DEEPEST: usize = 16;

impl Marker {
    fn name(self) -> &'static str {
        match self {
            Self::Send => "Send",
            Self::Sync => "Sync",
        }
    }
}

impl Library<'_> {
    /// What keeps a node's state on one thread.
    pub fn tied_state(&self, module: &Rc<Module>, state: &syn::Ident) -> TiedState {
        let unknown = TiedState {
            fields: Vec::new(),
            is_unknown: true,
        };
        let Some(item) = self.item_in(module, &state.to_string()) else {
            return unknown;
        };
        let Item::Struct(definition) = item.item() else {
            return unknown;
        };
        let mut search = Search {
            library: self,
            around: BTreeSet::from([item.path()]),
            // A condition does not change the fields, but the macro of an attribute may.
            is_unknown: !definition
                .attrs
                .iter()
                .all(|one| is_harmless(one) || one.path().is_ident("cfg")),
        };
        let parameters = Parameters::new();
        let mut tied = Vec::new();
        for field in &definition.fields {
            let Some((what, within)) =
                search.blame(&item.module, &field.ty, Marker::Send, &parameters)
            else {
                continue;
            };
            if is_always(field) {
                tied.push(Tied {
                    range: range(syn::spanned::Spanned::span(&field.ty)),
                    what,
                    within,
                });
            } else {
                search.is_unknown = true;
            }
        }
        let attributes = &definition.attrs;
        let is_plain = attributes.iter().all(is_harmless) && derives_nothing_unknown(attributes);
        if tied.is_empty() || is_plain && !self.may_implement(&item, "Send") {
            return TiedState {
                fields: tied,
                is_unknown: search.is_unknown,
            };
        }
        TiedState {
            fields: Vec::new(),
            is_unknown: !self.plainly_implements(&item, "Send"),
        }
    }

    /// Whether a type of the workspace surely can be sent and shared where its parameters are left out.
    pub(super) fn is_free(&self, item: &ItemId) -> bool {
        let parameters = Parameters::new();
        [Marker::Send, Marker::Sync].into_iter().all(|marker| {
            let mut search = Search {
                library: self,
                around: BTreeSet::new(),
                is_unknown: false,
            };
            let blame = search.blame_item(&item.module, item, &[], marker, &parameters);
            blame.is_none() && !search.is_unknown
        })
    }
}

struct Search<'a> {
    library: &'a Library<'a>,
    /// Structs whose fields are being looked at.
    around: BTreeSet<String>,
    /// Something was met of which only rustc knows whether it has the marker.
    is_unknown: bool,
}

impl Search<'_> {
    fn unknown(&mut self) -> Option<Blame> {
        self.is_unknown = true;
        None
    }

    /// What keeps a type from having a marker, if that is certain.
    fn blame(
        &mut self,
        module: &Rc<Module>,
        data: &Type,
        marker: Marker,
        parameters: &Parameters,
    ) -> Option<Blame> {
        match data {
            Type::Ptr(_) => Some((written(data), None)),
            Type::TraitObject(object) => match self.brought(module, &object.bounds, marker, 0) {
                Brought::Surely => None,
                Brought::SurelyNot => Some((written(data), None)),
                Brought::Unknown => self.unknown(),
            },
            Type::BareFn(_) | Type::Never(_) => None,
            Type::Reference(reference) if reference.mutability.is_none() => {
                self.blame(module, &reference.elem, Marker::Sync, parameters)
            }
            Type::Reference(syn::TypeReference { elem, .. })
            | Type::Array(syn::TypeArray { elem, .. })
            | Type::Slice(syn::TypeSlice { elem, .. })
            | Type::Paren(syn::TypeParen { elem, .. })
            | Type::Group(syn::TypeGroup { elem, .. }) => {
                self.blame(module, elem, marker, parameters)
            }
            Type::Tuple(tuple) => {
                let mut parts = tuple.elems.iter();
                parts.find_map(|part| self.blame(module, part, marker, parameters))
            }
            Type::Path(path) if path.qself.is_none() => {
                self.blame_path(module, data, &path.path, marker, parameters)
            }
            _ => self.unknown(),
        }
    }

    fn blame_path(
        &mut self,
        module: &Rc<Module>,
        data: &Type,
        path: &syn::Path,
        marker: Marker,
        parameters: &Parameters,
    ) -> Option<Blame> {
        if let Some(name) = path.get_ident()
            && let Some(known) = parameters.get(&(name.to_string(), marker))
        {
            return known.clone();
        }
        if module.is_uncertain(path.to_token_stream()) {
            return self.unknown();
        }
        let Some(arguments) = arguments(path) else {
            return self.unknown();
        };
        let rule = match self.library.find(module, path) {
            Some(Found::Prelude(name)) => Rule::of(&name, marker),
            Some(Found::Standard(path)) => Rule::of(&path.join("::"), marker),
            Some(Found::Foreign(path)) => Rule::of_foreign(&path),
            Some(Found::Item(item)) => {
                return self.blame_item(module, &item, &arguments, marker, parameters);
            }
            Some(Found::Module(_)) | None => Rule::Unknown,
        };
        let markers: &[Marker] = match rule {
            Rule::Never => return Some((written(data), None)),
            Rule::Always => return None,
            Rule::Unknown => return self.unknown(),
            Rule::NeedsBoth => &[Marker::Send, Marker::Sync],
            Rule::Needs(Marker::Send) => &[Marker::Send],
            Rule::Needs(Marker::Sync) => &[Marker::Sync],
            Rule::AsArguments if marker == Marker::Send => &[Marker::Send],
            Rule::AsArguments => &[Marker::Sync],
        };
        let mut needs = arguments
            .iter()
            .flat_map(|argument| markers.iter().map(move |marker| (*argument, *marker)));
        needs.find_map(|(argument, marker)| self.blame(module, argument, marker, parameters))
    }

    /// An alias by what it stands for, a struct or an enum by its fields.
    fn blame_item(
        &mut self,
        module: &Rc<Module>,
        item: &ItemId,
        arguments: &[&Type],
        marker: Marker,
        parameters: &Parameters,
    ) -> Option<Blame> {
        let (attributes, generics): (&[Attribute], &Generics) = match item.item() {
            Item::Type(item) => (&item.attrs, &item.generics),
            Item::Struct(item) => (&item.attrs, &item.generics),
            Item::Enum(item) => (&item.attrs, &item.generics),
            _ => return self.unknown(),
        };
        let path = item.path();
        if self.around.contains(&path) {
            return None;
        }
        // The macro of an attribute may give it other fields.
        let of_thiserror =
            |one: &Attribute| one.path().is_ident("error") && derives(attributes, "Error");
        let mut attributes_left = attributes.iter().filter(|one| !of_thiserror(one));
        if !attributes_left.all(is_harmless) || self.around.len() > DEEPEST {
            return self.unknown();
        }
        self.around.insert(path.clone());
        let own = self.parameters(module, item, generics, arguments, parameters);
        let found = match item.item() {
            Item::Type(alias) => self.blame(&item.module, &alias.ty, marker, &own),
            _ => self
                .blame_fields(item, marker, &own)
                .map(|(what, within)| (what, within.or(Some(path.clone())))),
        };
        self.around.remove(&path);
        let is_alias = matches!(item.item(), Item::Type(_));
        let may_differ = || {
            !derives_nothing_unknown(attributes) || self.library.may_implement(item, marker.name())
        };
        if found.is_none() || is_alias || !may_differ() {
            return found;
        }
        match self.library.plainly_implements(item, marker.name()) {
            true => None,
            false => self.unknown(),
        }
    }

    fn blame_fields(
        &mut self,
        item: &ItemId,
        marker: Marker,
        parameters: &Parameters,
    ) -> Option<Blame> {
        let fields: Vec<(&Fields, bool)> = match item.item() {
            Item::Struct(item) => vec![(&item.fields, true)],
            Item::Enum(item) => {
                let variants = item.variants.iter();
                variants
                    .map(|one| (&one.fields, !is_conditional(&one.attrs)))
                    .collect()
            }
            _ => Vec::new(),
        };
        for (fields, always) in fields {
            for field in fields {
                let found = self.blame(&item.module, &field.ty, marker, parameters);
                if found.is_some() && always && is_always(field) {
                    return found;
                }
                self.is_unknown |= found.is_some();
            }
        }
        None
    }

    /// What the parameters of an alias or a struct stand for: what is given, else their defaults.
    fn parameters(
        &mut self,
        module: &Rc<Module>,
        item: &ItemId,
        generics: &Generics,
        arguments: &[&Type],
        parameters: &Parameters,
    ) -> Parameters {
        let types = generics
            .params
            .iter()
            .filter_map(|parameter| match parameter {
                GenericParam::Type(parameter) => Some(parameter),
                _ => None,
            });
        let mut own = Parameters::new();
        for (index, parameter) in types.enumerate() {
            for marker in [Marker::Send, Marker::Sync] {
                let blame = match (arguments.get(index), &parameter.default) {
                    (Some(data), _) => self.blame(module, data, marker, parameters),
                    // Defaults may double with every step.
                    (None, Some(default)) if self.around.len() <= DEEPEST / 2 => {
                        self.blame(&item.module, default, marker, &own)
                    }
                    (None, _) => self.unknown(),
                };
                own.insert((parameter.ident.to_string(), marker), blame);
            }
        }
        own
    }

    /// Whether bounds of a `dyn` bring the marker, by themselves or by what they ask for.
    fn brought(
        &self,
        module: &Rc<Module>,
        bounds: &Bounds,
        marker: Marker,
        depth: usize,
    ) -> Brought {
        let each = bounds
            .iter()
            .map(|bound| self.brought_by(module, bound, marker, depth));
        // One bound that brings it is enough, whatever the others are.
        each.max().unwrap_or(Brought::SurelyNot)
    }

    fn brought_by(
        &self,
        module: &Rc<Module>,
        bound: &TypeParamBound,
        marker: Marker,
        depth: usize,
    ) -> Brought {
        let TypeParamBound::Trait(bound) = bound else {
            return Brought::SurelyNot;
        };
        let is_marker = |name: &str| match name == marker.name() {
            true => Brought::Surely,
            false => Brought::SurelyNot,
        };
        match self.library.find(module, &bound.path) {
            Some(Found::Prelude(name)) => is_marker(&name),
            Some(Found::Standard(path)) => match path.last() {
                Some(last) => is_marker(last),
                None => Brought::Unknown,
            },
            Some(Found::Item(item)) if depth < DEEPEST => {
                let Item::Trait(definition) = item.item() else {
                    return Brought::Unknown;
                };
                let above = &definition.supertraits;
                let brought = self.brought(&item.module, above, marker, depth + 1);
                // The macro of an attribute, or `where Self: Send`, may add it.
                let is_plain = definition.attrs.iter().all(is_harmless)
                    && definition.generics.where_clause.is_none();
                match brought {
                    Brought::SurelyNot if !is_plain => Brought::Unknown,
                    brought => brought,
                }
            }
            _ => Brought::Unknown,
        }
    }
}

/// No condition stands at the field.
fn is_always(field: &syn::Field) -> bool {
    let mut attributes = field.attrs.iter();
    !attributes.any(|one| one.path().is_ident("cfg"))
}

/// The types between `<` and `>`; `None` where something else stands there, or at another part of the path.
fn arguments(path: &syn::Path) -> Option<Vec<&Type>> {
    let last = path.segments.last()?;
    match &last.arguments {
        PathArguments::None => Some(Vec::new()),
        PathArguments::AngleBracketed(list) => {
            let types = list.args.iter().filter_map(|argument| match argument {
                GenericArgument::Type(data) => Some(data),
                _ => None,
            });
            Some(types.collect())
        }
        PathArguments::Parenthesized(_) => None,
    }
}
