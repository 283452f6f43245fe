//! What is there only under a `#[cfg(…)]`, so that rustc alone knows whether it is.

use std::rc::Rc;

use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, ExprLit, Lit, Meta, Token};

use super::library::Library;
use super::lookup::Found;
use super::module::{Entry, Module, attributes, is_conditional};

/// `use` may lead in circles; no honest path is longer.
const DEEPEST: usize = 32;

impl Library<'_> {
    /// Whether a condition decides about one of the names of an absolute path, or of those that lead there by `use`.
    pub(super) fn is_path_conditional(&self, path: &str) -> bool {
        let names: Vec<String> = path.split("::").map(str::to_owned).collect();
        let Some((library, rest)) = names.split_first() else {
            return false;
        };
        self.root(library)
            .is_some_and(|root| self.is_way_conditional(&root, rest, false, 0))
    }

    /// The same for names that are written in a module.
    pub(super) fn is_way_conditional(
        &self,
        module: &Rc<Module>,
        names: &[String],
        absolute: bool,
        depth: usize,
    ) -> bool {
        let conditional = |(index, name): (usize, &String)| {
            let place = match index {
                0 if absolute => return false,
                0 => module.clone(),
                _ => match self.follow(module, &names[..index], absolute, 0) {
                    Some(Found::Module(place)) => place,
                    _ => return false,
                },
            };
            match place.entries.get(name) {
                Some(Entry::Ambiguous) => true,
                Some(Entry::Item { index, .. }) => is_conditional(attributes(place.item(*index))),
                Some(Entry::Import(import)) => {
                    let itself = import.segments.first() == Some(name);
                    let absolute = import.absolute || itself;
                    import.is_conditional
                        || depth < DEEPEST
                            && self.is_way_conditional(
                                &place,
                                &import.segments,
                                absolute,
                                depth + 1,
                            )
                }
                // A glob under a condition may be what brings it in.
                None => {
                    let is_special = matches!(name.as_str(), "crate" | "self" | "super");
                    !is_special && place.globs.iter().any(|glob| glob.is_conditional)
                }
            }
        };
        names.iter().enumerate().any(conditional)
    }
}

/// Whether a `#[cfg(…)]` surely does not hold on this machine.
pub(super) fn is_elsewhere(attributes: &[Attribute]) -> bool {
    let conditions = attributes.iter().filter(|one| one.path().is_ident("cfg"));
    conditions
        .filter_map(|one| one.parse_args().ok())
        .any(|condition| holds(&condition) == Some(false))
}

/// The file that a `#[cfg_attr(…, path = "…")]` names, if it surely holds on this machine.
pub(super) fn conditional_path(attribute: &Attribute) -> Option<String> {
    let parts = parts_of_cfg_attr(attribute)?;
    let mut parts = parts.iter();
    let holds_here = holds(parts.next()?) == Some(true);
    parts.filter(|_| holds_here).find_map(named_path)
}

/// Whether a condition decides about the file of a module.
pub(super) fn has_conditional_path(attributes: &[Attribute]) -> bool {
    let mut parts = attributes.iter().filter_map(parts_of_cfg_attr);
    parts.any(|parts| parts.iter().any(|part| named_path(part).is_some()))
}

/// The text of `path = "…"`.
pub(super) fn named_path(meta: &Meta) -> Option<String> {
    match meta {
        Meta::NameValue(meta) if meta.path.is_ident("path") => text(&meta.value),
        _ => None,
    }
}

fn parts_of_cfg_attr(attribute: &Attribute) -> Option<Punctuated<Meta, Token![,]>> {
    let is_it = attribute.path().is_ident("cfg_attr");
    let parser = Punctuated::parse_terminated;
    is_it.then(|| attribute.parse_args_with(parser).ok())?
}

/// Whether a condition holds on this machine; `None`: nobody here can tell.
fn holds(condition: &Meta) -> Option<bool> {
    match condition {
        Meta::Path(path) if path.is_ident("unix") => Some(cfg!(unix)),
        Meta::Path(path) if path.is_ident("windows") => Some(cfg!(windows)),
        Meta::NameValue(meta) if meta.path.is_ident("target_os") => {
            Some(text(&meta.value)? == std::env::consts::OS)
        }
        Meta::NameValue(meta) if meta.path.is_ident("target_family") => {
            Some(text(&meta.value)? == std::env::consts::FAMILY)
        }
        Meta::List(list) => {
            let parser = Punctuated::<Meta, Token![,]>::parse_terminated;
            let parts = list.parse_args_with(parser).ok()?;
            let answers: Vec<Option<bool>> = parts.iter().map(holds).collect();
            let decides = |one| answers.contains(&Some(one));
            let is_whole = !answers.contains(&None);
            match list.path.get_ident()?.to_string().as_str() {
                "not" => answers.first()?.map(|holds| !holds),
                "all" if decides(false) => Some(false),
                "all" => is_whole.then_some(true),
                "any" if decides(true) => Some(true),
                "any" => is_whole.then_some(false),
                _ => None,
            }
        }
        _ => None,
    }
}

fn text(value: &Expr) -> Option<String> {
    match value {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) => Some(text.value()),
        _ => None,
    }
}
