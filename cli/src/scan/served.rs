//! What a target's hardware type implements, as far as the workspace shows it.
//!
//! Invariant: a trait is called lacking only if every place was read where rustc would find the `impl`: the crate of the
//! type and the crate of the trait, without macros, attributes or blanket `impl`s that might write it.

mod arguments;
mod attributes;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

use camino::Utf8PathBuf;
use syn::visit::{self, Visit};
use syn::{
    AngleBracketedGenericArguments, Attribute, GenericArgument, GenericParam, Generics, Item,
    ItemImpl, ItemMod, PathArguments, Type,
};

use super::fields::is_harmless;
use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::{Entry, Module, attributes, is_conditional, only_for_tests};
use super::types::{Definition, Shape};

pub use arguments::Arguments;
pub(super) use attributes::{derives_nothing_unknown, writes_nothing};

/// The hardware type of a target, and everything that was found about it.
#[derive(Debug)]
pub struct Hardware {
    item: ItemId,
    /// What the target gives to the parameters of the type.
    arguments: Arguments,
    /// A parameter that the target gives no argument, and that has no default.
    open: Option<String>,
    /// A condition decides whether it is there under the name that the target gives.
    is_conditional: bool,
    /// By library.
    crates: BTreeMap<String, Option<Implemented>>,
}

/// The `impl`s of one crate for one type; `None` in place of it: something there cannot be read.
#[derive(Debug, Default)]
struct Implemented {
    /// Definitions of traits.
    traits: BTreeSet<String>,
    /// Names of traits that could not be followed, and of those that are implemented for many types at once.
    perhaps: BTreeSet<String>,
}

/// Whether a hardware type implements a trait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Serves {
    Surely,
    /// Under a condition, for other arguments, or something hides it.
    Perhaps,
    Never,
}

impl Hardware {
    /// File and place of the type's name.
    pub fn place(&self, library: &Library<'_>) -> (Utf8PathBuf, Range<usize>) {
        (
            self.item.module.file.clone(),
            library.name_range(&self.item),
        )
    }

    /// Name of the type.
    pub fn name(&self) -> &str {
        &self.item.name
    }

    /// The parameter of the type that nobody says what it is.
    pub fn open_parameter(&self) -> Option<&str> {
        self.open.as_deref()
    }

    /// Whether rustc alone knows if the type is there.
    pub fn is_conditional(&self) -> bool {
        self.is_conditional
    }

    /// Whether rustc will find `framework::Hardware` implemented.
    pub fn serves_framework(&mut self, library: &Library<'_>) -> Serves {
        let none = Some(String::new());
        if self.arguments == none
            && library.quietly(|| library.plainly_implements(&self.item, FRAMEWORK))
        {
            return Serves::Surely;
        }
        let implements = || library.implements(self, (FRAMEWORK, &none), is_of_framework);
        match library.quietly(implements) {
            Some(true) => return Serves::Surely,
            Some(false) => return Serves::Perhaps,
            None => {}
        }
        let found = self.implemented_in(library, self.item.module.library().to_owned());
        let is_lacking = found.is_some_and(|found| {
            let mut traits = found.traits.iter();
            let is_it =
                |path: &String| path.starts_with("framework::") && path.ends_with("::Hardware");
            !found.perhaps.contains(FRAMEWORK) && !traits.any(is_it)
        });
        match is_lacking {
            true => Serves::Never,
            false => Serves::Perhaps,
        }
    }

    /// What one crate implements for the type; `None`: something there cannot be read.
    fn implemented_in(&mut self, library: &Library<'_>, name: String) -> Option<&Implemented> {
        let found = self.crates.entry(name);
        let found = found
            .or_insert_with_key(|name| library.quietly(|| library.implemented(name, &self.item)));
        found.as_ref()
    }

    /// Whether rustc will find the trait implemented with these arguments.
    pub fn serves(
        &mut self,
        library: &Library<'_>,
        asked: &ItemId,
        arguments: &Arguments,
    ) -> Serves {
        let is_asked =
            |found: &Found| matches!(found, Found::Item(item) if item.path() == asked.path());
        let implements = || library.implements(self, (&asked.name, arguments), is_asked);
        match library.quietly(implements) {
            Some(true) => return Serves::Surely,
            Some(false) => return Serves::Perhaps,
            None => {}
        }
        let crates = [self.item.module.library(), asked.module.library()].map(str::to_owned);
        let is_lacking = crates.into_iter().all(|name| {
            self.implemented_in(library, name).is_some_and(|found| {
                !found.traits.contains(&asked.path()) && !found.perhaps.contains(&asked.name)
            })
        });
        match is_lacking {
            true => Serves::Never,
            false => Serves::Perhaps,
        }
    }
}

/// The trait that the framework asks of every hardware.
const FRAMEWORK: &str = "Hardware";

fn is_of_framework(found: &Found) -> bool {
    match found {
        Found::Item(item) => item.name == FRAMEWORK && item.module.library() == "framework",
        Found::Foreign(path) => {
            let ends = (path.first(), path.last());
            matches!(ends, (Some(first), Some(last)) if first == "framework" && last == FRAMEWORK)
        }
        _ => false,
    }
}

impl Library<'_> {
    /// The hardware type `crate::Type` of a target; `None` if it is not plainly a type of the workspace.
    pub fn hardware(&self, path: &str) -> Option<Hardware> {
        let path = self.by_library(path);
        let root = self.root(path.split("::").next()?)?;
        let Shape::Named {
            definition: Definition::Workspace(item),
            arguments,
        } = self.resolve_absolute(&root, &path).shape
        else {
            return None;
        };
        let (attributes, generics) = match item.item() {
            Item::Struct(item) => (&item.attrs, &item.generics),
            Item::Enum(item) => (&item.attrs, &item.generics),
            _ => return None,
        };
        let open = if arguments.is_empty() {
            open_parameter(generics)
        } else {
            None
        };
        // A derive or an attribute that is not known might implement anything, and so might one behind a condition.
        let plain = attributes
            .iter()
            .all(|one| is_harmless(one) && !one.path().is_ident("cfg_attr"))
            && derives_nothing_unknown(attributes);
        let is_conditional = is_conditional(attributes)
            || self.is_conditional(&item.module)
            || self.is_path_conditional(&path);
        plain.then_some(Hardware {
            item,
            arguments: arguments::text(&arguments),
            open,
            is_conditional,
            crates: BTreeMap::new(),
        })
    }

    /// Whether an `impl` of a trait of the standard library may be written for a type of the workspace: one stands in its
    /// crate, the only one where rustc would take it, or something there cannot be read.
    pub(super) fn may_implement(&self, item: &ItemId, name: &str) -> bool {
        let library = item.module.library();
        let found = self.quietly(|| self.implemented(library, item));
        found.is_none_or(|found| found.perhaps.contains(name))
    }

    /// The trait of the workspace that a bound names.
    pub fn trait_of_workspace(&self, module: &Rc<Module>, bound: &syn::Path) -> Option<ItemId> {
        match self.find(module, bound)? {
            Found::Item(item) if matches!(item.item(), Item::Trait(_)) => Some(item),
            _ => None,
        }
    }

    /// Whether the crate of a hardware type plainly has an `impl` of a trait for it, by its name and with its arguments;
    /// `Some(false)`: under a condition, or perhaps with others.
    ///
    /// The usual case, for which few files are needed: those with the trait's name, and those around them.
    fn implements(
        &self,
        hardware: &Hardware,
        (name, arguments): (&str, &Arguments),
        is_asked: impl Fn(&Found) -> bool,
    ) -> Option<bool> {
        let root = self.root(hardware.item.module.library());
        let mut waiting: Vec<(Rc<Module>, bool)> =
            root.into_iter().map(|root| (root, true)).collect();
        let mut found = None;
        while let Some((module, is_always)) = waiting.pop() {
            let is_always = is_always && !is_conditional(&module.syntax.attrs);
            for item in &module.syntax.items {
                let is_always = is_always && !is_conditional(attributes(item));
                match item {
                    _ if only_for_tests(attributes(item)) => {}
                    Item::Impl(item) if self.is_of(&module, item, &hardware.item, &is_asked) => {
                        if is_always
                            && self.has_arguments(&module, item, arguments, &hardware.arguments)
                        {
                            return Some(true);
                        }
                        found = Some(false);
                    }
                    Item::Mod(item) if self.may_name(&module, item, name) => {
                        let below = self.declared(&module, &item.ident.to_string());
                        waiting.extend(below.map(|below| (below, is_always)));
                    }
                    _ => {}
                }
            }
        }
        found
    }

    fn is_of(
        &self,
        module: &Rc<Module>,
        item: &ItemImpl,
        hardware: &ItemId,
        is_asked: impl Fn(&Found) -> bool,
    ) -> bool {
        let Some((None, written, _)) = &item.trait_ else {
            return false;
        };
        !is_parameter(item, &item.self_ty)
            && self.is_type(module, &item.self_ty, hardware) == Some(true)
            && self
                .find(module, written)
                .is_some_and(|found| is_asked(&found))
    }

    /// Whether a module or one inside of it may have an `impl` of a trait under its own name; nobody is lost by a wrong no,
    /// for then everything is read.
    fn may_name(&self, parent: &Module, item: &ItemMod, name: &str) -> bool {
        let names = |text: &str| text.contains(name) || declares_module(text);
        item.content.is_some() || self.text(parent, item).is_none_or(|text| names(&text))
    }

    fn is_type(&self, module: &Rc<Module>, data: &Type, hardware: &ItemId) -> Option<bool> {
        match self.resolve(module, data).shape {
            Shape::Named {
                definition: Definition::Workspace(item),
                ..
            } => Some(item.path() == hardware.path()),
            Shape::Unknown => None,
            _ => Some(false),
        }
    }

    fn implemented(&self, library: &str, hardware: &ItemId) -> Option<Implemented> {
        let mut found = Some(Implemented::default());
        let mut waiting = vec![self.root(library)?];
        while let Some(module) = waiting.pop() {
            let mut reading = Reading {
                library: self,
                hardware,
                module: &module,
                found: &mut found,
            };
            for item in &module.syntax.items {
                reading.visit_item(item);
            }
            for item in &module.syntax.items {
                let Item::Mod(item) = item else { continue };
                if only_for_tests(&item.attrs) {
                    continue;
                }
                if !item.attrs.iter().all(writes_nothing) {
                    return None;
                }
                waiting.push(self.declared(&module, &item.ident.to_string())?);
            }
        }
        found
    }
}

struct Reading<'a> {
    library: &'a Library<'a>,
    hardware: &'a ItemId,
    module: &'a Rc<Module>,
    found: &'a mut Option<Implemented>,
}

impl<'ast> Visit<'ast> for Reading<'_> {
    fn visit_item_mod(&mut self, _: &'ast syn::ItemMod) {}

    fn visit_item(&mut self, item: &'ast Item) {
        if !only_for_tests(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        // The macro of an attribute may write more than the item that it stands at.
        if !writes_nothing(attribute) {
            *self.found = None;
        }
    }

    // What stands at fields and variants is for the derives of their type; rustc knows no macros there.
    fn visit_field(&mut self, _: &'ast syn::Field) {}

    fn visit_variant(&mut self, _: &'ast syn::Variant) {}

    fn visit_item_macro(&mut self, item: &'ast syn::ItemMacro) {
        // `macro_rules!` writes nothing until it is called.
        if item.ident.is_none() && !item.mac.path.is_ident("thread_local") {
            *self.found = None;
        }
    }

    fn visit_item_impl(&mut self, item: &'ast ItemImpl) {
        visit::visit_item_impl(self, item);
        let Some((None, written, _)) = &item.trait_ else {
            return;
        };
        let arguments = written.segments.last().map(|last| &last.arguments);
        if let Some(PathArguments::AngleBracketed(arguments)) = arguments
            && written
                .segments
                .last()
                .is_some_and(|last| last.ident == "From")
        {
            self.add_conversion(&item.self_ty, arguments);
        }
        let serves = if is_parameter(item, &item.self_ty) {
            None
        } else {
            self.library
                .is_type(self.module, &item.self_ty, self.hardware)
        };
        let Some(found) = self.found.as_mut().filter(|_| serves != Some(false)) else {
            return;
        };
        let definition = self.library.trait_of_workspace(self.module, written);
        match (serves, definition) {
            (Some(true), Some(definition)) => {
                found.traits.insert(definition.path());
            }
            // For many types, or for one that could not be followed.
            (_, Some(definition)) => {
                found.perhaps.insert(definition.name);
            }
            (_, None) => {
                let name = written.segments.last().map(|last| last.ident.to_string());
                found.perhaps.extend(name);
                // Its own name, where a `use` gives it another.
                match self.library.find(self.module, written) {
                    Some(Found::Standard(path) | Found::Foreign(path)) => {
                        found.perhaps.extend(path.into_iter().last());
                    }
                    _ => {
                        let first = written
                            .segments
                            .first()
                            .map(|first| first.ident.to_string());
                        let entry = first.and_then(|first| self.module.entries.get(&first));
                        if let Some(Entry::Import(import)) = entry {
                            found.perhaps.extend(import.segments.last().cloned());
                        }
                    }
                }
            }
        }
    }
}

impl Reading<'_> {
    /// Notes an `impl From<Type> for …`, by which the type may become something of another crate.
    fn add_conversion(&mut self, into: &Type, arguments: &AngleBracketedGenericArguments) {
        let is_own = matches!(
            self.library.resolve(self.module, into).shape,
            Shape::Named {
                definition: Definition::Workspace(_),
                ..
            }
        );
        let may_be_it = arguments.args.iter().any(|argument| match argument {
            GenericArgument::Type(data) => {
                self.library.is_type(self.module, data, self.hardware) != Some(false)
            }
            _ => false,
        });
        if let Some(found) = self.found.as_mut().filter(|_| may_be_it && !is_own) {
            found.perhaps.insert("From".to_owned());
        }
    }
}

/// Whether a text has a `mod …;`, as far as that can be seen without parsing it.
fn declares_module(text: &str) -> bool {
    text.match_indices("mod ").any(|(start, word)| {
        let rest = &text[start + word.len()..];
        let end = rest.find([';', '{']);
        end.is_some_and(|end| rest[end..].starts_with(';'))
    })
}

/// A type or a constant that whoever names the type has to give.
fn open_parameter(generics: &Generics) -> Option<String> {
    generics
        .params
        .iter()
        .find_map(|parameter| match parameter {
            GenericParam::Type(parameter) if parameter.default.is_none() => {
                Some(parameter.ident.to_string())
            }
            GenericParam::Const(parameter) if parameter.default.is_none() => {
                Some(parameter.ident.to_string())
            }
            _ => None,
        })
}

/// `impl<T> Trait for T`.
fn is_parameter(item: &ItemImpl, data: &Type) -> bool {
    let Type::Path(path) = data else {
        return false;
    };
    let parameters = item.generics.params.iter();
    let mut types = parameters.filter_map(|parameter| match parameter {
        GenericParam::Type(parameter) => Some(&parameter.ident),
        _ => None,
    });
    types.any(|parameter| path.path.is_ident(parameter))
}
