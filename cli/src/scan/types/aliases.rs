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
        if !alias.generics.params.is_empty() {
            return self.expanded(item, alias, arguments, depth);
        }
        // Without parameters it always stands for the same.
        let path = item.path();
        if let Some(known) = self.aliases.borrow().get(&path) {
            return known.clone();
        }
        let found = self.expanded(item, alias, arguments, depth);
        self.aliases.borrow_mut().insert(path, found.clone());
        found
    }

    fn expanded(
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
            if self.is_sometimes_public(item) {
                resolved.unsure.extend(public.clone());
            }
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
        if expanded.is_huge() {
            return by_name(super::Shape::Unknown);
        }
        // What the alias stands for may be hidden, or be known to rustc alone; the alias is not.
        let has_arguments = generics.keys().any(|name| !name.starts_with('\''));
        let is_hidden = !expanded.private.is_empty() && !has_arguments;
        if (is_hidden || !expanded.is_known()) && self.public_path(item).is_some() {
            return by_name(expanded.shape);
        }
        expanded
    }

    /// Arguments, and what the parameters without one are by default, up to the first of which that cannot be told.
    pub(in crate::scan) fn with_defaults(
        &self,
        module: &Rc<Module>,
        generics: &Generics,
        arguments: Vec<Resolved>,
        depth: usize,
    ) -> Vec<Resolved> {
        let (lifetimes, mut arguments): (Vec<_>, Vec<_>) =
            arguments.into_iter().partition(is_lifetime);
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
                // One may double the one before it.
                Some(default) if !default.is_huge() => arguments.push(default),
                _ => break,
            }
        }
        arguments.extend(lifetimes);
        arguments
    }
}

/// What the parameters of an alias or a struct stand for; `None` if their numbers differ. A lifetime that is not written
/// is whatever it may be.
pub(in crate::scan) fn substitutions(
    generics: &Generics,
    arguments: Vec<Resolved>,
) -> Option<Substitutions> {
    let (lifetimes, arguments): (Vec<_>, Vec<_>) = arguments.into_iter().partition(is_lifetime);
    let mut lifetimes = lifetimes.into_iter();
    let any = || Resolved::constant("'_".to_owned(), "'_".to_owned());
    let declared = generics.lifetimes().map(|one| one.lifetime.to_string());
    let lifetimes: Substitutions = declared
        .map(|name| (name, lifetimes.next().unwrap_or_else(any)))
        .collect();
    let names: Vec<String> = parameters(generics).map(|(name, _)| name).collect();
    let is_whole = names.len() == arguments.len();
    is_whole.then(|| names.into_iter().zip(arguments).chain(lifetimes).collect())
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
