//! Types as an author wrote them, made absolute: what generated code names, and what can be compared.

pub(super) mod absolute;
mod aliases;
mod constants;

use std::collections::BTreeMap;
use std::rc::Rc;

use quote::ToTokens;
use syn::{GenericArgument, Item, PathArguments, Type};

use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::Module;

pub(super) use aliases::substitutions;

/// A type with every name followed as far as possible.
#[derive(Clone, Debug)]
pub struct Resolved {
    /// As generated code names it: absolute, prelude types by bare name, aliases of the workspace expanded.
    pub text: String,
    pub shape: Shape,
    /// Items in it that generated code cannot name.
    pub private: Vec<ItemId>,
    /// Names in it that could not be followed to what they mean, so that they mean nothing elsewhere.
    pub lost: Vec<String>,
    /// Paths in it of which a macro or a condition decides whether generated code can write them.
    pub unsure: Vec<String>,
}

/// What a type is, by definitions instead of names.
#[derive(Clone, Debug)]
pub enum Shape {
    Named {
        definition: Definition,
        arguments: Vec<Resolved>,
    },
    Tuple(Vec<Resolved>),
    /// Element and length.
    Array(Box<Resolved>, Box<Resolved>),
    Slice(Box<Resolved>),
    Reference(Box<Resolved>),
    /// A length or another constant argument, or a lifetime.
    Constant(String),
    /// A name in it could not be followed, or it is nothing that data has.
    Unknown,
}

/// Where a named type is defined.
#[derive(Clone, Debug)]
pub enum Definition {
    /// Primitive, or of the standard prelude.
    Prelude(String),
    /// Below `std`, for example `time::Duration`.
    Standard(String),
    /// A struct, enum or union of the workspace.
    Workspace(ItemId),
    /// Below a crate outside of the workspace, as written there: perhaps a re-export or an alias.
    Foreign {
        path: String,
        /// The crate may depend on crates of the workspace, so it may be a type of theirs.
        knows_members: bool,
    },
}

/// Names of generic parameters and what they stand for.
pub(super) type Substitutions = BTreeMap<String, Resolved>;

/// Types of `std` that the prelude has, too.
const PRELUDE_OF_STANDARD: &[(&str, &str)] = &[
    ("boxed::Box", "Box"),
    ("option::Option", "Option"),
    ("result::Result", "Result"),
    ("string::String", "String"),
    ("vec::Vec", "Vec"),
];

/// Aliases may lead in circles; no honest alias is deeper.
const DEEPEST: usize = 32;

/// Types may double with every step; no honest one has more parts.
const LARGEST: usize = 1000;
/// As text.
const LONGEST: usize = 20_000;

impl Resolved {
    /// Whether every name in it was followed to its end.
    pub fn is_known(&self) -> bool {
        self.shape.is_known()
    }

    /// Whether it has more parts than an honest type, as one that doubles with every alias or field.
    pub fn is_huge(&self) -> bool {
        let mut left = LARGEST;
        self.text.len() > LONGEST || !self.fits(&mut left)
    }

    fn fits(&self, left: &mut usize) -> bool {
        *left = left.saturating_sub(1);
        *left > 0 && self.shape.parts().all(|part| part.fits(left))
    }

    /// `U`, if this is an `Option<U>`.
    pub fn option_argument(&self) -> Option<&Self> {
        match &self.shape {
            Shape::Named {
                definition: Definition::Prelude(name),
                arguments,
            } if name == "Option" => arguments.first(),
            _ => None,
        }
    }

    /// `U`, if this is a `Box<U>`.
    pub fn boxed(&self) -> Option<&Self> {
        match &self.shape {
            Shape::Named {
                definition: Definition::Prelude(name),
                arguments,
            } if name == "Box" => arguments.first(),
            _ => None,
        }
    }

    /// Crates that its text names.
    pub fn libraries(&self, found: &mut Vec<String>) {
        if let Shape::Named { definition, .. } = &self.shape {
            found.extend(definition.library().map(str::to_owned));
        }
        self.shape.parts().for_each(|part| part.libraries(found));
    }

    /// A type without arguments that is in scope everywhere.
    pub fn prelude(name: &str) -> Self {
        let definition = Definition::Prelude(name.to_owned());
        named(name.to_owned(), definition, Vec::new())
    }

    /// A type about which nothing is known.
    pub fn opaque() -> Self {
        Self::unknown("_".to_owned())
    }

    fn unknown(text: String) -> Self {
        Self {
            text,
            shape: Shape::Unknown,
            private: Vec::new(),
            lost: Vec::new(),
            unsure: Vec::new(),
        }
    }

    /// A constant or a lifetime.
    fn constant(text: String, value: String) -> Self {
        Self {
            shape: Shape::Constant(value),
            ..Self::unknown(text)
        }
    }

    /// One from several: `text` and `shape` are made of the parts.
    fn of(
        parts: Vec<Self>,
        text: impl Fn(&[String]) -> String,
        shape: impl Fn(Vec<Self>) -> Shape,
    ) -> Self {
        let texts: Vec<String> = parts.iter().map(|part| part.text.clone()).collect();
        let private = parts.iter().flat_map(|part| part.private.clone()).collect();
        let lost = parts.iter().flat_map(|part| part.lost.clone()).collect();
        let unsure = parts.iter().flat_map(|part| part.unsure.clone()).collect();
        Self {
            text: text(&texts),
            shape: shape(parts),
            private,
            lost,
            unsure,
        }
    }
}

impl Shape {
    fn is_known(&self) -> bool {
        !matches!(self, Self::Unknown) && self.parts().all(Resolved::is_known)
    }

    /// Types and constants that it is made of.
    fn parts(&self) -> impl Iterator<Item = &Resolved> {
        let (list, first, second) = match self {
            Self::Named {
                arguments: list, ..
            }
            | Self::Tuple(list) => (list.as_slice(), None, None),
            Self::Array(element, length) => (&[][..], Some(element), Some(length)),
            Self::Slice(element) | Self::Reference(element) => (&[][..], Some(element), None),
            Self::Constant(_) | Self::Unknown => (&[][..], None, None),
        };
        list.iter()
            .chain(first.into_iter().chain(second).map(|part| &**part))
    }
}

impl Definition {
    fn library(&self) -> Option<&str> {
        match self {
            Self::Prelude(_) | Self::Standard(_) => None,
            Self::Workspace(item) => Some(item.module.library()),
            Self::Foreign { path, .. } => path.split("::").next(),
        }
    }
}

impl Library<'_> {
    /// The absolute form of a type that is written in a module.
    pub fn resolve(&self, module: &Rc<Module>, data: &Type) -> Resolved {
        self.resolve_with(module, data, &Substitutions::new(), 0)
    }

    /// A type from its absolute text, by the names that the module's crate knows.
    pub fn resolve_absolute(&self, module: &Rc<Module>, text: &str) -> Resolved {
        match (syn::parse_str(text), self.root(module.library())) {
            (Ok(data), Some(root)) => self.resolve(&root, &data),
            _ => Resolved::unknown(text.to_owned()),
        }
    }

    pub(super) fn resolve_with(
        &self,
        module: &Rc<Module>,
        data: &Type,
        generics: &Substitutions,
        depth: usize,
    ) -> Resolved {
        let inner = |data: &Type| self.resolve_with(module, data, generics, depth);
        match data {
            Type::Path(path) if path.qself.is_none() && depth < DEEPEST => {
                self.resolve_path(module, &path.path, generics, depth)
            }
            Type::Tuple(tuple) => {
                let parts = tuple.elems.iter().map(inner).collect();
                Resolved::of(parts, tuple_text, Shape::Tuple)
            }
            Type::Array(array) => {
                let length = self.constant(module, &array.len, generics);
                let parts = vec![inner(&array.elem), length];
                Resolved::of(
                    parts,
                    |texts| format!("[{}; {}]", texts[0], texts[1]),
                    |shapes| pair(shapes, Shape::Array),
                )
            }
            Type::Slice(slice) => Resolved::of(
                vec![inner(&slice.elem)],
                |texts| format!("[{}]", texts[0]),
                |shapes| single(shapes, Shape::Slice),
            ),
            Type::Reference(reference) => {
                let lifetime = reference.lifetime.as_ref();
                let lifetime = lifetime.map(|one| format!("{} ", lifetime_text(one, generics)));
                let lifetime = lifetime.unwrap_or_default();
                let mutable = if reference.mutability.is_some() {
                    "mut "
                } else {
                    ""
                };
                Resolved::of(
                    vec![inner(&reference.elem)],
                    |texts| format!("&{lifetime}{mutable}{}", texts[0]),
                    |shapes| single(shapes, Shape::Reference),
                )
            }
            Type::Paren(paren) => inner(&paren.elem),
            Type::Group(group) => inner(&group.elem),
            other => self.absolute_type(module, other, generics),
        }
    }

    fn resolve_path(
        &self,
        module: &Rc<Module>,
        path: &syn::Path,
        generics: &Substitutions,
        depth: usize,
    ) -> Resolved {
        if let Some(ident) = path.get_ident()
            && let Some(argument) = generics.get(&ident.to_string())
        {
            return argument.clone();
        }
        let Some(arguments) = self.arguments(module, path, generics, depth) else {
            return self.absolute_path(module, path, generics);
        };
        match self.find(module, path) {
            Some(Found::Item(item)) => match item.item() {
                Item::Struct(_) | Item::Enum(_) | Item::Union(_) => {
                    self.structure(&item, arguments)
                }
                Item::Type(alias) => self.alias(&item, alias, arguments, depth),
                _ => self.absolute_path(module, path, generics),
            },
            Some(Found::Prelude(name)) => named(name.clone(), Definition::Prelude(name), arguments),
            Some(Found::Standard(path)) => {
                let path = path.join("::");
                let same = PRELUDE_OF_STANDARD
                    .iter()
                    .find(|(standard, _)| *standard == path);
                match same {
                    Some((_, name)) => named(
                        (*name).to_owned(),
                        Definition::Prelude((*name).to_owned()),
                        arguments,
                    ),
                    None => named(
                        format!("std::{path}"),
                        Definition::Standard(path),
                        arguments,
                    ),
                }
            }
            Some(Found::Foreign(path)) => {
                let path = path.join("::");
                let knows_members = self.may_know_members(&path);
                let definition = Definition::Foreign {
                    path: path.clone(),
                    knows_members,
                };
                named(path, definition, arguments)
            }
            Some(Found::Module(_)) | None => self.absolute_path(module, path, generics),
        }
    }

    /// A struct, enum or union by its public path.
    fn structure(&self, item: &ItemId, arguments: Vec<Resolved>) -> Resolved {
        let public = self.public_path(item);
        let text = public.clone().unwrap_or_else(|| item.path());
        let mut resolved = named(text, Definition::Workspace(item.clone()), arguments);
        if self.is_sometimes_public(item) {
            resolved.unsure.extend(public.clone());
        }
        if public.is_none() {
            resolved.private.push(item.clone());
        }
        resolved
    }

    /// Types, constants and lifetimes between `<` and `>`; `None` if something else stands there.
    fn arguments(
        &self,
        module: &Rc<Module>,
        path: &syn::Path,
        generics: &Substitutions,
        depth: usize,
    ) -> Option<Vec<Resolved>> {
        let last = path.segments.len().checked_sub(1)?;
        let mut found = Vec::new();
        for (index, segment) in path.segments.iter().enumerate() {
            match &segment.arguments {
                PathArguments::None => {}
                PathArguments::AngleBracketed(list) if index == last => {
                    for argument in &list.args {
                        found.push(match argument {
                            GenericArgument::Type(data) => {
                                self.type_or_constant(module, data, generics, depth)
                            }
                            GenericArgument::Const(value) => {
                                let constant = self.constant(module, value, generics);
                                in_braces(value, constant)
                            }
                            GenericArgument::Lifetime(lifetime) => {
                                let text = lifetime_text(lifetime, generics);
                                Resolved::constant(text.clone(), text)
                            }
                            _ => return None,
                        });
                    }
                }
                _ => return None,
            }
        }
        Some(found)
    }

    /// An argument that is one name may be a constant.
    fn type_or_constant(
        &self,
        module: &Rc<Module>,
        data: &Type,
        generics: &Substitutions,
        depth: usize,
    ) -> Resolved {
        if let Type::Path(path) = data
            && path.qself.is_none()
            && let Some(Found::Item(item)) = self.find(module, &path.path)
            && matches!(item.item(), Item::Const(_))
        {
            return path_in_braces(self.constant_item(&item));
        }
        self.resolve_with(module, data, generics, depth)
    }
}

/// A computed constant stays in the braces that its author wrote: without them it would be read as a type.
fn in_braces(written: &syn::Expr, constant: Resolved) -> Resolved {
    let is_computed = matches!(constant.shape, Shape::Unknown);
    let bare = is_computed && matches!(written, syn::Expr::Block(_));
    if !bare || constant.text.starts_with('{') {
        return path_in_braces(constant);
    }
    Resolved {
        text: format!("{{ {} }}", constant.text),
        ..constant
    }
}

/// An argument of several names is read as a type, unless braces stand around it.
fn path_in_braces(constant: Resolved) -> Resolved {
    let is_path = syn::parse_str::<syn::Path>(&constant.text);
    if !is_path.is_ok_and(|path| path.segments.len() > 1) {
        return constant;
    }
    Resolved {
        text: format!("{{ {} }}", constant.text),
        ..constant
    }
}

pub(super) fn named(name: String, definition: Definition, arguments: Vec<Resolved>) -> Resolved {
    Resolved::of(
        arguments,
        |texts| {
            if texts.is_empty() {
                name.clone()
            } else {
                format!("{name}<{}>", texts.join(", "))
            }
        },
        |arguments| Shape::Named {
            definition: definition.clone(),
            arguments,
        },
    )
}

/// A lifetime, or what stands for it where it is a parameter.
fn lifetime_text(lifetime: &syn::Lifetime, generics: &Substitutions) -> String {
    let written = lifetime.to_string();
    let given = generics.get(&written).map(|given| given.text.clone());
    given.unwrap_or(written)
}

fn tuple_text(texts: &[String]) -> String {
    match texts {
        [only] => format!("({only},)"),
        several => format!("({})", several.join(", ")),
    }
}

fn single(parts: Vec<Resolved>, shape: fn(Box<Resolved>) -> Shape) -> Shape {
    parts
        .into_iter()
        .next()
        .map_or(Shape::Unknown, |inner| shape(Box::new(inner)))
}

fn pair(parts: Vec<Resolved>, shape: fn(Box<Resolved>, Box<Resolved>) -> Shape) -> Shape {
    let mut parts = parts.into_iter();
    match (parts.next(), parts.next()) {
        (Some(first), Some(second)) => shape(Box::new(first), Box::new(second)),
        _ => Shape::Unknown,
    }
}

/// Tokens as an author would write them.
pub(super) fn written(tokens: &impl ToTokens) -> String {
    let mut text = tokens.to_token_stream().to_string();
    for (spaced, tight) in [
        (" :: ", "::"),
        (":: ", "::"),
        (" < ", "<"),
        ("< ", "<"),
        (" >", ">"),
        (" ,", ","),
        (" ;", ";"),
        ("& ", "&"),
        ("* const ", "*const "),
        ("* mut ", "*mut "),
    ] {
        text = text.replace(spaced, tight);
    }
    text
}
