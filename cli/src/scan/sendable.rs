//! What surely cannot move to another thread, or be shared with one.
//!
//! Invariant: a type is called so only if rustc will certainly agree: what a macro, a crate outside of the workspace or an
//! `impl` by hand may decide is passed over.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

use quote::ToTokens as _;
use syn::{
    Attribute, Fields, GenericArgument, GenericParam, Generics, Item, PathArguments, Type,
    TypeParamBound,
};

use super::fields::is_harmless;
use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::{Module, is_conditional};
use super::range;
use super::served::derives_nothing_unknown;
use super::types::written;

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

/// `Send` or `Sync`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Marker {
    Send,
    Sync,
}

/// How a type of the standard library comes by a marker.
enum Rule {
    Never,
    /// If all its arguments have it.
    AsArguments,
    /// If all its arguments have both.
    NeedsBoth,
    /// If all its arguments have this one.
    Needs(Marker),
    Unknown,
}

/// The part to blame, and the struct around it.
type Blame = (String, Option<String>);

/// What is known of type parameters: whom to blame for a marker that their arguments lack.
type Parameters = BTreeMap<(String, Marker), Option<Blame>>;

/// Aliases and structs may lead in circles; no honest type is deeper.
const DEEPEST: usize = 16;

/// Below `std`: neither can be sent nor shared.
const TIED: &[&str] = &[
    "cell::Ref",
    "cell::RefMut",
    "ptr::NonNull",
    "rc::Rc",
    "rc::Weak",
];

/// Below `std`: what is locked is unlocked where it was locked.
const GUARDS: &[&str] = &[
    "io::StderrLock",
    "io::StdinLock",
    "io::StdoutLock",
    "sync::MutexGuard",
    "sync::RwLockReadGuard",
    "sync::RwLockWriteGuard",
];

/// Below `std`: can be sent if what is inside can, and never be shared.
const CELLS: &[&str] = &[
    "cell::Cell",
    "cell::OnceCell",
    "cell::RefCell",
    "cell::UnsafeCell",
    "sync::mpsc::Receiver",
];

/// Below `std` or everywhere: as what is inside.
const CONTAINERS: &[&str] = &[
    "Box",
    "Option",
    "Result",
    "Vec",
    "boxed::Box",
    "cmp::Reverse",
    "collections::BTreeMap",
    "collections::BTreeSet",
    "collections::BinaryHeap",
    "collections::HashMap",
    "collections::HashSet",
    "collections::LinkedList",
    "collections::VecDeque",
    "marker::PhantomData",
    "mem::ManuallyDrop",
    "mem::MaybeUninit",
    "num::Wrapping",
    "option::Option",
    "pin::Pin",
    "result::Result",
    "vec::Vec",
];

impl Rule {
    fn of(path: &str, marker: Marker) -> Self {
        match (path, marker) {
            (path, _) if TIED.contains(&path) => Self::Never,
            (path, Marker::Send) if GUARDS.contains(&path) => Self::Never,
            (path, Marker::Sync) if CELLS.contains(&path) => Self::Never,
            (path, Marker::Send) if CELLS.contains(&path) => Self::AsArguments,
            (path, _) if CONTAINERS.contains(&path) => Self::AsArguments,
            ("sync::Arc" | "sync::Weak", _) => Self::NeedsBoth,
            ("sync::Mutex" | "sync::mpsc::Sender", _) => Self::Needs(Marker::Send),
            ("sync::OnceLock" | "sync::RwLock", Marker::Send) => Self::Needs(Marker::Send),
            ("sync::OnceLock" | "sync::RwLock", Marker::Sync) => Self::NeedsBoth,
            _ => Self::Unknown,
        }
    }
}

impl Marker {
    fn name(self) -> &'static str {
        match self {
            Self::Send => "Send",
            Self::Sync => "Sync",
        }
    }
}

impl Library<'_> {
    /// Fields of a node's state that surely keep it on one thread.
    pub fn tied_fields(&self, module: &Rc<Module>, state: &syn::Ident) -> Vec<Tied> {
        let Some(item) = self.item_in(module, &state.to_string()) else {
            return Vec::new();
        };
        let Item::Struct(definition) = item.item() else {
            return Vec::new();
        };
        let mut search = Search {
            library: self,
            around: BTreeSet::from([item.path()]),
        };
        let parameters = Parameters::new();
        let fields = definition.fields.iter().filter(|field| is_always(field));
        let tied = fields.filter_map(|field| {
            let (what, within) =
                search.blame(&item.module, &field.ty, Marker::Send, &parameters)?;
            Some(Tied {
                range: range(syn::spanned::Spanned::span(&field.ty)),
                what,
                within,
            })
        });
        let tied: Vec<Tied> = tied.collect();
        let by_hand = || self.may_implement(&item, "Send");
        let attributes = &definition.attrs;
        let is_plain = attributes.iter().all(is_harmless) && derives_nothing_unknown(attributes);
        if tied.is_empty() || !is_plain || by_hand() {
            return Vec::new();
        }
        tied
    }
}

struct Search<'a> {
    library: &'a Library<'a>,
    /// Structs whose fields are being looked at.
    around: BTreeSet<String>,
}

impl Search<'_> {
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
            Type::TraitObject(object) => {
                let mut bounds = object.bounds.iter();
                bounds
                    .all(|bound| self.is_without(module, bound, marker, 0))
                    .then(|| (written(data), None))
            }
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
            _ => None,
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
            return None;
        }
        let arguments = arguments(path)?;
        let rule = match self.library.find(module, path)? {
            Found::Prelude(name) => Rule::of(&name, marker),
            Found::Standard(path) => Rule::of(&path.join("::"), marker),
            Found::Item(item) => {
                return self.blame_item(module, &item, &arguments, marker, parameters);
            }
            Found::Module(_) | Found::Foreign(_) => return None,
        };
        let markers: &[Marker] = match rule {
            Rule::Never => return Some((written(data), None)),
            Rule::Unknown => return None,
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
            _ => return None,
        };
        let is_plain = attributes.iter().all(is_harmless) && derives_nothing_unknown(attributes);
        let path = item.path();
        if !is_plain || self.around.len() > DEEPEST || !self.around.insert(path.clone()) {
            return None;
        }
        let own = self.parameters(module, generics, arguments, parameters);
        let fields: Vec<&Fields> = match item.item() {
            Item::Struct(item) => vec![&item.fields],
            Item::Enum(item) => {
                let variants = item.variants.iter();
                let always = variants.filter(|one| !is_conditional(&one.attrs));
                always.map(|one| &one.fields).collect()
            }
            _ => Vec::new(),
        };
        let mut fields = fields.into_iter().flatten().filter(|one| is_always(one));
        let found = match item.item() {
            Item::Type(alias) => self.blame(&item.module, &alias.ty, marker, &own),
            _ => fields
                .find_map(|field| self.blame(&item.module, &field.ty, marker, &own))
                .filter(|_| !self.library.may_implement(item, marker.name()))
                .map(|(what, within)| (what, within.or(Some(path.clone())))),
        };
        self.around.remove(&path);
        found
    }

    /// What the parameters of an alias or a struct stand for; nothing is known of those with a default.
    fn parameters(
        &mut self,
        module: &Rc<Module>,
        generics: &Generics,
        arguments: &[&Type],
        parameters: &Parameters,
    ) -> Parameters {
        let types = generics
            .params
            .iter()
            .filter_map(|parameter| match parameter {
                GenericParam::Type(parameter) => Some(&parameter.ident),
                _ => None,
            });
        let mut own = Parameters::new();
        for (index, name) in types.enumerate() {
            for marker in [Marker::Send, Marker::Sync] {
                let argument = arguments.get(index);
                let blame = argument.and_then(|data| self.blame(module, data, marker, parameters));
                own.insert((name.to_string(), marker), blame);
            }
        }
        own
    }

    /// Whether a bound of a `dyn` certainly does not bring the marker, by itself or by what it asks for.
    fn is_without(
        &self,
        module: &Rc<Module>,
        bound: &TypeParamBound,
        marker: Marker,
        depth: usize,
    ) -> bool {
        let TypeParamBound::Trait(bound) = bound else {
            return true;
        };
        match self.library.find(module, &bound.path) {
            Some(Found::Prelude(name)) => name != marker.name(),
            Some(Found::Standard(path)) => path.last().is_some_and(|last| last != marker.name()),
            Some(Found::Item(item)) if depth < DEEPEST => {
                let Item::Trait(definition) = item.item() else {
                    return false;
                };
                let mut above = definition.supertraits.iter();
                definition.attrs.iter().all(is_harmless)
                    && definition.generics.where_clause.is_none()
                    && above.all(|bound| self.is_without(&item.module, bound, marker, depth + 1))
            }
            _ => false,
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
