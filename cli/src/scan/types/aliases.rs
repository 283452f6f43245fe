//! Aliases of the workspace by what they stand for, and what stands for the parameters of aliases and structs.

use std::rc::Rc;

use syn::{GenericParam, Generics, ItemType};

use super::{Resolved, Substitutions, named};
use crate::scan::library::Library;
use crate::scan::lookup::ItemId;
use crate::scan::module::Module;

impl Library<'_> {
    pub(super) fn alias(
        &self,
        item: &ItemId,
        alias: &ItemType,
        arguments: Vec<Resolved>,
        depth: usize,
    ) -> Resolved {
        let by_name = |shape| {
            let public = self.public_path(item);
            let text = public.clone().unwrap_or_else(|| item.path());
            let definition = super::Definition::Workspace(item.clone());
            let mut resolved = named(text, definition, arguments.clone());
            resolved.shape = shape;
            if public.is_none() {
                resolved.private.push(item.clone());
            }
            resolved
        };
        let all = self.with_defaults(&item.module, &alias.generics, arguments.clone(), depth);
        let Some(generics) = substitutions(&alias.generics, all) else {
            return by_name(super::Shape::Unknown);
        };
        let expanded = self.resolve_with(&item.module, &alias.ty, &generics, depth + 1);
        // What the alias stands for may be hidden, or be known to rustc alone; the alias is not.
        let is_hidden = !expanded.private.is_empty() && generics.is_empty();
        if (is_hidden || !expanded.is_known()) && self.public_path(item).is_some() {
            return by_name(expanded.shape);
        }
        expanded
    }

    /// Arguments, and what the parameters without one are by default.
    fn with_defaults(
        &self,
        module: &Rc<Module>,
        generics: &Generics,
        mut arguments: Vec<Resolved>,
        depth: usize,
    ) -> Vec<Resolved> {
        arguments.retain(|argument| !is_lifetime(argument));
        let missing = parameters(generics).skip(arguments.len());
        for (_, parameter) in missing.collect::<Vec<_>>() {
            let known = parameters(generics).map(|(name, _)| name);
            let known: Substitutions = known.zip(arguments.iter().cloned()).collect();
            let default = match parameter {
                GenericParam::Type(parameter) => parameter
                    .default
                    .as_ref()
                    .map(|data| self.resolve_with(module, data, &known, depth + 1)),
                GenericParam::Const(parameter) => parameter
                    .default
                    .as_ref()
                    .map(|value| self.constant(module, value, &known)),
                GenericParam::Lifetime(_) => None,
            };
            match default {
                Some(default) => arguments.push(default),
                None => break,
            }
        }
        arguments
    }
}

/// What the parameters of an alias or a struct stand for, lifetimes aside; `None` if their numbers differ.
pub(in crate::scan) fn substitutions(
    generics: &Generics,
    mut arguments: Vec<Resolved>,
) -> Option<Substitutions> {
    arguments.retain(|argument| !is_lifetime(argument));
    let names: Vec<String> = parameters(generics).map(|(name, _)| name).collect();
    (names.len() == arguments.len()).then(|| names.into_iter().zip(arguments).collect())
}

fn parameters(generics: &Generics) -> impl Iterator<Item = (String, &GenericParam)> {
    generics.params.iter().filter_map(|parameter| {
        let name = match parameter {
            GenericParam::Type(parameter) => &parameter.ident,
            GenericParam::Const(parameter) => &parameter.ident,
            GenericParam::Lifetime(_) => return None,
        };
        Some((name.to_string(), parameter))
    })
}

fn is_lifetime(argument: &Resolved) -> bool {
    argument.text.starts_with('\'') && !argument.text.ends_with('\'')
}
