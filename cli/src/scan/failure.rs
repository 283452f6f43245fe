//! What the functions of a node return where they fail: whether it becomes the framework's error.
//!
//! Invariant: an error is called unusable only if rustc will certainly agree; what macros and other crates decide is
//! `Unknown`.

use std::rc::Rc;

use grammar::Meaning;
use quote::ToTokens as _;
use syn::{Item, Type};

use super::fields::is_harmless;
use super::library::Library;
use super::lookup::ItemId;
use super::module::Module;
use super::served::derives_nothing_unknown;
use super::state::derives;
use super::types::{Definition, Resolved, Shape};

/// What is known about the error of a result.
#[derive(Debug)]
pub enum Failure {
    Converts,
    /// Generated code may not handle a value of this type.
    Private(ItemId),
    /// This type is no error and does not convert into one.
    Never(String),
    Unknown,
}

/// Crates whose errors become a boxed error of the standard library.
const CONVERTING: &[&str] = &["anyhow", "color_eyre", "eyre", "framework"];

/// Types that are in scope everywhere and are no error.
const NO_ERRORS: &[&str] = &[
    "Option", "Result", "Vec", "bool", "char", "f32", "f64", "i128", "i16", "i32", "i64", "i8",
    "isize", "u128", "u16", "u32", "u64", "u8", "usize",
];

impl Library<'_> {
    /// What stands in a result whose type is an alias.
    pub(super) fn meaning_of_result(&self, module: &Rc<Module>, data: &Type) -> Meaning {
        let resolved = self.quietly(|| self.resolve(module, data));
        let (definition, arguments) = match resolved.shape {
            Shape::Named {
                definition,
                arguments,
            } => (definition, arguments),
            Shape::Unknown => return Meaning::Hidden,
            _ => return Meaning::Other,
        };
        let is_foreign = matches!(definition, Definition::Foreign { .. });
        let is_result = match &definition {
            Definition::Prelude(name) => name == "Result",
            Definition::Standard(path) | Definition::Foreign { path, .. } => {
                path.ends_with("Result")
            }
            Definition::Workspace(_) => false,
        };
        match arguments.first().map(|first| syn::parse_str(&first.text)) {
            Some(Ok(inner)) if is_result => Meaning::Result(Box::new(inner)),
            _ if is_result || is_foreign => Meaning::Hidden,
            _ => Meaning::Other,
        }
    }

    /// What is known about the error of a type that a node's function returns.
    pub fn failure(&self, module: &Rc<Module>, returns: &Type) -> Failure {
        if module.is_uncertain(returns.to_token_stream()) {
            return Failure::Unknown;
        }
        let returned = self.quietly(|| self.resolve(module, returns));
        let Shape::Named {
            definition,
            arguments,
        } = returned.shape
        else {
            return Failure::Unknown;
        };
        match (definition, arguments.get(1)) {
            (Definition::Prelude(name), Some(error)) if name == "Result" => self.judge(error),
            // The framework's, brought in by a glob, or one of std's own.
            (Definition::Prelude(name), None) if name == "Result" => Failure::Converts,
            (Definition::Standard(_), None) => Failure::Converts,
            (Definition::Foreign { path, .. }, None) if is_converting(&path) => Failure::Converts,
            (Definition::Foreign { path, .. }, Some(error)) if path == "framework::Result" => {
                self.judge(error)
            }
            _ => Failure::Unknown,
        }
    }

    fn judge(&self, error: &Resolved) -> Failure {
        let Shape::Named {
            definition,
            arguments,
        } = &error.shape
        else {
            return match error.shape {
                Shape::Tuple(_) | Shape::Array(..) => Failure::Never(error.text.clone()),
                Shape::Reference(_) if error.text.ends_with("str") => Failure::Converts,
                _ => Failure::Unknown,
            };
        };
        match definition {
            Definition::Prelude(name) if name == "String" => Failure::Converts,
            Definition::Prelude(name) if NO_ERRORS.contains(&name.as_str()) => {
                Failure::Never(error.text.clone())
            }
            Definition::Prelude(name) if name == "Box" => {
                let words = |word| arguments.iter().all(|inner| inner.text.contains(word));
                match words("Error") && words("Send") && words("Sync") {
                    true => Failure::Converts,
                    false => Failure::Unknown,
                }
            }
            // One with arguments is as they are.
            Definition::Standard(path) if path.ends_with("Error") && arguments.is_empty() => {
                Failure::Converts
            }
            Definition::Standard(path) if path == "convert::Infallible" => Failure::Converts,
            Definition::Foreign { path, .. } if is_converting(path) && is_named_error(path) => {
                Failure::Converts
            }
            Definition::Workspace(item)
                if item.module.library() == "framework" && item.name == "Error" =>
            {
                Failure::Converts
            }
            Definition::Workspace(item) => self.quietly(|| self.judge_own(item, error, arguments)),
            _ => Failure::Unknown,
        }
    }

    /// An error that the workspace defines.
    fn judge_own(&self, item: &ItemId, error: &Resolved, arguments: &[Resolved]) -> Failure {
        let (attributes, generics) = match item.item() {
            Item::Struct(item) => (&item.attrs, &item.generics),
            Item::Enum(item) => (&item.attrs, &item.generics),
            _ => return Failure::Unknown,
        };
        if attributes.iter().any(|one| one.path().is_ident("cfg")) {
            return Failure::Unknown;
        }
        if !item.public {
            return Failure::Private(item.clone());
        }
        // Of thiserror and others. The framework's error moves between threads, and so does what becomes one.
        if derives(attributes, "Error") || self.plainly_implements(item, "Error") {
            // It keeps nothing that is borrowed; what it keeps may be of a type that is given here.
            let has_lifetimes = generics.lifetimes().next().is_some();
            let is_given = generics.type_params().next().is_some() && !arguments.is_empty();
            return match !has_lifetimes && !is_given && self.is_free(item) {
                true => Failure::Converts,
                false => Failure::Unknown,
            };
        }
        let is_plain = attributes
            .iter()
            .all(|one| is_harmless(one) && !one.path().is_ident("cfg_attr"))
            && derives_nothing_unknown(attributes);
        let converts = ["Error", "Into", "From"];
        let may_convert = || converts.iter().any(|name| self.may_implement(item, name));
        match is_plain && !may_convert() {
            true => Failure::Never(error.text.clone()),
            false => Failure::Unknown,
        }
    }

    /// Whether the module of a type has an `impl` of this trait for it, under no condition.
    pub(super) fn plainly_implements(&self, item: &ItemId, name: &str) -> bool {
        let mut items = item.module.syntax.items.iter();
        items.any(|other| {
            let Item::Impl(block) = other else {
                return false;
            };
            let is_of = match &*block.self_ty {
                Type::Path(path) => path.path.is_ident(&item.name),
                _ => false,
            };
            let written = block
                .trait_
                .as_ref()
                .and_then(|(_, path, _)| path.segments.last());
            let is_always = block.attrs.iter().all(is_harmless);
            is_of && is_always && written.is_some_and(|last| last.ident == name)
        })
    }
}

fn is_named_error(path: &str) -> bool {
    path.ends_with("::Error") || path.ends_with("::Report")
}

fn is_converting(path: &str) -> bool {
    let mut names = path.split("::");
    names
        .next()
        .is_some_and(|first| CONVERTING.contains(&first))
}
