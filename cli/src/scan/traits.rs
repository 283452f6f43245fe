//! Hardware traits: where they are, and whether they read.

mod methods;

use std::rc::Rc;

use serde::Serialize;
use syn::{
    GenericArgument, Generics, Item, ItemTrait, PathArguments, ReturnType, TraitItem, Type,
    TypeParamBound, WherePredicate,
};

use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::Module;
use super::types::{Definition, Resolved, Shape, Substitutions};
use crate::diagnostics::listed;

pub use methods::{Answer, Method};

/// A hardware trait that a node asks for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Interface {
    /// Absolute path with arguments: `hardware::CameraInterface`, `hardware::Drives<types::Arm>`.
    pub path: String,
    /// Whether a method returns anything but nothing; `None` where the trait was not found.
    pub reading: Option<bool>,
    /// Whether it may let a node act, whatever else it reads: by a method of its own or of a trait that it asks for.
    #[serde(skip)]
    pub acting: bool,
    /// What whoever implements it writes; `None` where that cannot be told.
    #[serde(skip)]
    pub methods: Option<Vec<Method>>,
}

/// A trait that a node asks of the hardware.
#[derive(Clone, Debug)]
pub struct HardwareTrait {
    pub interface: Interface,
    /// The trait, if generated code cannot name it.
    pub private: Option<ItemId>,
    /// Names in it that could not be followed.
    pub lost: Vec<String>,
}

/// What a bound of a node asks for.
#[derive(Clone, Debug)]
pub enum Bound {
    /// What every hardware is; its name.
    Marker(String),
    /// What no generated code passes on; its name.
    Refused(String),
    Trait(Box<HardwareTrait>),
}

/// Supertraits may lead in circles; no honest trait has more.
const DEEPEST: usize = 8;

/// Traits without methods that say nothing about hardware.
const MARKERS: &[&str] = &["Send", "Sized", "Sync", "Unpin"];

/// Modules of `std` whose traits say what a value is, not what it does.
const HARMLESS: &[&str] = &[
    "any", "clone", "cmp", "default", "fmt", "hash", "marker", "ops",
];

/// Traits there, or in scope everywhere, that do.
const ACTING: &[&str] = &[
    "AsMut",
    "AsyncFn",
    "AsyncFnMut",
    "AsyncFnOnce",
    "Deref",
    "DerefMut",
    "Extend",
    "Fn",
    "FnMut",
    "FnOnce",
];

impl Interface {
    /// The trait's own name.
    pub fn name(&self) -> &str {
        let path = self.path.split('<').next().unwrap_or(&self.path);
        path.rsplit("::").next().unwrap_or(path)
    }
}

impl Library<'_> {
    /// The trait of a bound that is written in a module.
    pub fn hardware_trait(&self, module: &Rc<Module>, bound: &syn::Path) -> Bound {
        let name = match self.find(module, bound) {
            Some(Found::Prelude(name)) => Some(name),
            Some(Found::Standard(path)) if path.first().is_some_and(|one| one == "marker") => {
                path.into_iter().last()
            }
            _ => None,
        };
        if let Some(name) = name.filter(|name| MARKERS.contains(&name.as_str())) {
            return match name.as_str() {
                // Nothing says that a hardware is.
                "Unpin" => Bound::Refused(name),
                _ => Bound::Marker(name),
            };
        }
        Bound::Trait(Box::new(self.proper_trait(module, bound)))
    }

    fn proper_trait(&self, module: &Rc<Module>, bound: &syn::Path) -> HardwareTrait {
        let arguments = bound.segments.last().map(|last| &last.arguments);
        let arguments = arguments.unwrap_or(&PathArguments::None);
        let arguments = self.absolute_arguments(module, arguments);
        let known = |path: String, reading, private: Option<ItemId>| {
            let interface = Interface {
                path: format!("{path}{}", arguments.text),
                reading,
                acting: reading != Some(true),
                methods: None,
            };
            let private = private.or_else(|| arguments.private.first().cloned());
            let lost = arguments.lost.clone();
            HardwareTrait {
                interface,
                private,
                lost,
            }
        };
        match self.find(module, bound) {
            Some(Found::Prelude(name)) => known(name, None, None),
            Some(Found::Standard(path)) => known(format!("std::{}", path.join("::")), None, None),
            Some(Found::Foreign(path)) => known(path.join("::"), None, None),
            Some(Found::Item(item)) => {
                let reading = self.is_reading(&item, 0);
                let mut found = match self.public_path(&item) {
                    Some(path) => known(path, reading, None),
                    None => known(item.path(), reading, Some(item.clone())),
                };
                found.interface.acting |= self.is_acting(&item, 0);
                found.interface.methods = self.quietly(|| self.methods(&item));
                found
            }
            Some(Found::Module(_)) | None => self.lost_trait(module, bound),
        }
    }

    /// A trait whose definition is not to be seen.
    fn lost_trait(&self, module: &Rc<Module>, bound: &syn::Path) -> HardwareTrait {
        let found = self.absolute_path(module, bound, &Substitutions::new());
        let interface = Interface {
            path: found.text,
            reading: None,
            acting: true,
            methods: None,
        };
        let private = found.private.into_iter().next();
        HardwareTrait {
            interface,
            private,
            lost: found.lost,
        }
    }

    /// Why `crate::Type` of a member names no type that others can name, and what to do; `None`: nothing is wrong.
    pub fn missing_type(&self, path: &str) -> Option<(String, String)> {
        let (modules, name) = path.rsplit_once("::")?;
        let mut module = self.root(modules.split("::").next()?)?;
        let mut hidden = None;
        for part in modules.split("::").skip(1) {
            let Some(below) = self.module_in(&module, part) else {
                let near = crate::diagnostics::nearest(part, module.module_names());
                let help = near.map_or_else(
                    || {
                        format!(
                            "`{}` declares {}",
                            module.path,
                            listed(module.module_names())
                        )
                    },
                    |near| format!("did you mean `{near}`?"),
                );
                return Some((
                    format!("there is no module `{}::{part}`", module.path),
                    help,
                ));
            };
            if hidden.is_none() && self.is_hidden(&module, part) {
                hidden = Some(format!("module `{}::{part}`", module.path));
            }
            module = below;
        }
        let name_alone = syn::Path::from(syn::parse_str::<syn::Ident>(name).ok()?);
        let found = self.find(&module, &name_alone);
        let item = match &found {
            Some(Found::Item(item)) => Some(item),
            _ => None,
        };
        // A macro may define it.
        if found.is_some() || module.calls_macros() {
            let is_hidden = item.is_some() && self.is_hidden(&module, name);
            let hidden = hidden.or_else(|| is_hidden.then(|| format!("`{path}`")))?;
            let help = match item.and_then(|item| self.public_path(item)) {
                Some(path) => format!("write `{path}`"),
                None => format!("write `pub` at `{name}` and its modules"),
            };
            return Some((format!("{hidden} is private"), help));
        }
        let names = module.public_names();
        let help = match crate::diagnostics::nearest(name, names.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{modules}::{near}`?"),
            None => format!("define `pub struct {name}` in `{}`", module.file),
        };
        Some((format!("`{modules}` has no `{name}`"), help))
    }

    /// Whether a method of the trait or of a trait that it asks for returns anything but nothing; `None` if that cannot
    /// be known.
    fn is_reading(&self, item: &ItemId, depth: usize) -> Option<bool> {
        let Item::Trait(definition) = item.item() else {
            return None;
        };
        if self.has_reading_method(&item.module, definition) {
            return Some(true);
        }
        let mut answer = Some(false);
        for bound in asked_of_self(definition) {
            let TypeParamBound::Trait(bound) = bound else {
                continue;
            };
            match self.find(&item.module, &bound.path) {
                Some(Found::Prelude(name)) if MARKERS.contains(&name.as_str()) => {}
                Some(Found::Standard(_)) => {}
                Some(Found::Item(above)) if depth < DEEPEST => {
                    match self.is_reading(&above, depth + 1) {
                        Some(true) => return Some(true),
                        Some(false) => {}
                        None => answer = None,
                    }
                }
                _ => answer = None,
            }
        }
        answer
    }

    /// Whether a method of the trait or of a trait that it asks for gives nothing back, so that it is there for what it
    /// does; a trait that cannot be seen may have one.
    fn is_acting(&self, item: &ItemId, depth: usize) -> bool {
        let Item::Trait(definition) = item.item() else {
            return true;
        };
        let acts = |one: &TraitItem| match one {
            TraitItem::Fn(method) => {
                let output = &method.sig.output;
                self.answer(&item.module, output) != Answer::Something
                    || may_be_nothing(output, &definition.generics)
            }
            _ => false,
        };
        let brings = |bound: &TypeParamBound| {
            let TypeParamBound::Trait(bound) = bound else {
                return false;
            };
            match self.find(&item.module, &bound.path) {
                Some(Found::Prelude(name)) => ACTING.contains(&name.as_str()),
                Some(Found::Standard(path)) => !is_harmless(&path),
                Some(Found::Item(above)) if depth < DEEPEST => self.is_acting(&above, depth + 1),
                _ => true,
            }
        };
        definition.items.iter().any(acts) || asked_of_self(definition).any(brings)
    }

    fn has_reading_method(&self, module: &Rc<Module>, definition: &ItemTrait) -> bool {
        definition.items.iter().any(|item| match item {
            TraitItem::Fn(method) => self.answer(module, &method.sig.output) == Answer::Something,
            _ => false,
        })
    }

    /// What a method gives, by what the names of its module stand for.
    fn answer(&self, module: &Rc<Module>, output: &ReturnType) -> Answer {
        let data = match output {
            ReturnType::Default => return Answer::Nothing,
            ReturnType::Type(_, data) if is_nothing(data) => return Answer::Nothing,
            ReturnType::Type(_, data) => data,
        };
        let is_empty =
            |one: &Resolved| matches!(&one.shape, Shape::Tuple(parts) if parts.is_empty());
        let resolved = self.quietly(|| self.resolve(module, data));
        let is_result = match &resolved.shape {
            Shape::Tuple(parts) if parts.is_empty() => return Answer::Nothing,
            Shape::Named {
                definition,
                arguments,
            } => {
                let is_result = match definition {
                    Definition::Prelude(name) => name == "Result",
                    Definition::Standard(path) | Definition::Foreign { path, .. } => {
                        path.ends_with("::Result")
                    }
                    Definition::Workspace(_) => false,
                };
                let is_plain =
                    matches!(definition, Definition::Standard(path) if path == "fmt::Result");
                is_plain || is_result && arguments.first().is_some_and(is_empty)
            }
            Shape::Unknown => is_written_as_result_of_nothing(data),
            _ => false,
        };
        match is_result {
            true => Answer::ResultOfNothing,
            false => Answer::Something,
        }
    }
}

/// What a trait asks of whoever implements it: `Body: Wheels` and `Body where Self: Wheels` are the same.
fn asked_of_self(definition: &ItemTrait) -> impl Iterator<Item = &TypeParamBound> {
    let clauses = definition.generics.where_clause.iter();
    let of_self = clauses
        .flat_map(|clause| &clause.predicates)
        .filter_map(|predicate| match predicate {
            WherePredicate::Type(one) => match &one.bounded_ty {
                Type::Path(path) if path.path.is_ident("Self") => Some(&one.bounds),
                _ => None,
            },
            _ => None,
        });
    definition.supertraits.iter().chain(of_self.flatten())
}

/// Whether a trait below `std` lets nobody act.
fn is_harmless(path: &[String]) -> bool {
    let is_of = |list: &[&str], name: Option<&String>| {
        name.is_some_and(|name| list.contains(&name.as_str()))
    };
    is_of(HARMLESS, path.first()) && !is_of(ACTING, path.last())
}

/// Whether a method gives what others choose, who may choose `()`: `T` of `trait Wheels<T>`, `Self::Answer`.
fn may_be_nothing(output: &ReturnType, generics: &Generics) -> bool {
    match output {
        ReturnType::Default => true,
        ReturnType::Type(_, data) => is_chosen(data, generics),
    }
}

fn is_chosen(data: &Type, generics: &Generics) -> bool {
    let path = match data {
        Type::Paren(paren) => return is_chosen(&paren.elem, generics),
        Type::Path(path) if path.qself.is_some() => return true,
        Type::Path(path) => &path.path,
        _ => return false,
    };
    let (Some(first), Some(last)) = (path.segments.first(), path.segments.last()) else {
        return false;
    };
    if generics.type_params().any(|one| one.ident == first.ident) {
        return true;
    }
    match &last.arguments {
        PathArguments::AngleBracketed(list) if last.ident == "Result" => {
            matches!(list.args.first(), Some(GenericArgument::Type(inner)) if is_chosen(inner, generics))
        }
        _ => first.ident == "Self" && path.segments.len() > 1,
    }
}

fn is_nothing(data: &Type) -> bool {
    match data {
        Type::Tuple(tuple) => tuple.elems.is_empty(),
        Type::Never(_) => true,
        Type::Paren(paren) => is_nothing(&paren.elem),
        _ => false,
    }
}

/// `Result<()>` by its letters, for what no name leads to: a macro or another crate may define it.
fn is_written_as_result_of_nothing(data: &Type) -> bool {
    let Type::Path(path) = data else {
        return false;
    };
    let last = path.path.segments.last();
    let Some(last) = last.filter(|last| last.ident == "Result") else {
        return false;
    };
    match &last.arguments {
        PathArguments::AngleBracketed(arguments) => arguments.args.first().is_some_and(
            |argument| matches!(argument, GenericArgument::Type(data) if is_nothing(data)),
        ),
        _ => false,
    }
}
