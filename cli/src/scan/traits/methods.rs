//! What a type must write to implement a hardware trait, as far as the workspace shows it.

use std::rc::Rc;

use quote::ToTokens;
use serde::Serialize;
use syn::{
    FnArg, GenericArgument, Item, Pat, PathArguments, ReturnType, Signature, TraitItem,
    TraitItemFn, Type, TypeParamBound,
};

use super::MARKERS;
use crate::scan::library::Library;
use crate::scan::lookup::{Found, ItemId};
use crate::scan::module::Module;
use crate::scan::types::Resolved;

/// A method without a body of its own.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Method {
    /// With absolute types: `fn write(&self, angles: &[f32]) -> framework::Result<()>`.
    pub signature: String,
    pub answer: Answer,
}

/// What a method gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum Answer {
    Nothing,
    /// `Result<()>`
    ResultOfNothing,
    /// What the hardware would have to know.
    Something,
}

impl Library<'_> {
    /// All methods that a trait asks for; `None` where an implementation may need anything else.
    pub(super) fn methods(&self, item: &ItemId) -> Option<Vec<Method>> {
        let Item::Trait(definition) = item.item() else {
            return None;
        };
        let is_plain = definition.unsafety.is_none()
            && definition.generics.params.is_empty()
            && definition.generics.where_clause.is_none();
        let supertraits = definition.supertraits.iter().all(|bound| match bound {
            TypeParamBound::Trait(bound) => matches!(
                self.find(&item.module, &bound.path),
                Some(Found::Prelude(name)) if MARKERS.contains(&name.as_str())
            ),
            TypeParamBound::Lifetime(_) => true,
            _ => false,
        });
        if !is_plain || !supertraits {
            return None;
        }
        let asked = definition.items.iter().filter_map(|one| match one {
            TraitItem::Fn(method) if method.default.is_some() => None,
            TraitItem::Fn(method) => Some(self.method(&item.module, method)),
            _ => Some(None),
        });
        asked.collect()
    }

    fn method(&self, module: &Rc<Module>, method: &TraitItemFn) -> Option<Method> {
        let Signature {
            ident,
            generics,
            inputs,
            output,
            ..
        } = &method.sig;
        let is_plain = method.sig.constness.is_none()
            && method.sig.asyncness.is_none()
            && method.sig.unsafety.is_none()
            && method.sig.abi.is_none()
            && generics.params.is_empty()
            && generics.where_clause.is_none()
            && !method.attrs.iter().any(|one| one.path().is_ident("cfg"));
        if !is_plain {
            return None;
        }
        let arguments: Vec<String> = inputs
            .iter()
            .map(|input| match input {
                FnArg::Receiver(receiver) if receiver.colon_token.is_none() => {
                    Some(receiver.to_token_stream().to_string())
                }
                FnArg::Receiver(_) => None,
                FnArg::Typed(typed) => {
                    let data = nameable(self.resolve(module, &typed.ty))?;
                    let name = match &*typed.pat {
                        Pat::Ident(name) => name.ident.to_string(),
                        _ => "_".to_owned(),
                    };
                    Some(format!("{name}: {data}"))
                }
            })
            .collect::<Option<_>>()?;
        let arguments = self.by_root(module, &arguments.join(", "));
        let (result, answer) = match output {
            ReturnType::Default => (String::new(), Answer::Nothing),
            ReturnType::Type(_, data) => {
                let text = self.result(module, data)?;
                let answer = self.answer(module, output);
                (format!(" -> {}", self.by_root(module, &text)), answer)
            }
        };
        Some(Method {
            signature: format!("fn {ident}({arguments}){result}"),
            answer,
        })
    }
}

impl Library<'_> {
    /// The text of what a method gives; an alias `Result` by its own name, since the error is often a default.
    fn result(&self, module: &Rc<Module>, data: &Type) -> Option<String> {
        let Type::Path(path) = data else {
            return nameable(self.resolve(module, data));
        };
        let last = path.path.segments.last()?;
        let PathArguments::AngleBracketed(arguments) = &last.arguments else {
            return nameable(self.resolve(module, data));
        };
        if last.ident != "Result" || path.qself.is_some() {
            return nameable(self.resolve(module, data));
        }
        let base = match self.find(module, &path.path)? {
            Found::Item(item) => self.public_path(&item)?,
            Found::Prelude(name) => name,
            Found::Standard(path) => format!("std::{}", path.join("::")),
            Found::Foreign(path) => path.join("::"),
            Found::Module(_) => return None,
        };
        let arguments = arguments.args.iter().map(|argument| match argument {
            GenericArgument::Type(data) => nameable(self.resolve(module, data)),
            _ => None,
        });
        let arguments: Vec<String> = arguments.collect::<Option<_>>()?;
        Some(format!("{base}<{}>", arguments.join(", ")))
    }
}

impl Library<'_> {
    /// Types of the framework as it exports them at its root, wherever the robot's workspace has it: `framework::Result`.
    fn by_root(&self, module: &Rc<Module>, text: &str) -> String {
        let is_of_path = |letter: char| letter.is_alphanumeric() || "_:".contains(letter);
        let pieces = text.split_inclusive(|letter| !is_of_path(letter));
        let pieces = pieces.map(|piece| {
            let path = piece.trim_end_matches(|letter| !is_of_path(letter));
            let rest = &piece[path.len()..];
            let root = self.root_of_framework(module, path);
            format!("{}{rest}", root.as_deref().unwrap_or(path))
        });
        pieces.collect()
    }

    fn root_of_framework(&self, module: &Rc<Module>, path: &str) -> Option<String> {
        let (_, name) = path.strip_prefix("framework::")?.rsplit_once("::")?;
        let root = format!("framework::{name}");
        let item = |path: &str| match self.find(module, &syn::parse_str(path).ok()?)? {
            Found::Item(item) => Some((item.module.path.clone(), item.index)),
            _ => None,
        };
        (item(&root)? == item(path)?).then_some(root)
    }
}

/// The text of a type that generated code can name.
fn nameable(resolved: Resolved) -> Option<String> {
    (resolved.is_known() && resolved.private.is_empty()).then_some(resolved.text)
}
