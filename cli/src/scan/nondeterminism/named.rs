//! Which module of the workspace a path leads to, also where it ends at a function.

use std::rc::Rc;

use syn::Item;

use crate::scan::library::Library;
use crate::scan::lookup::Found;
use crate::scan::module::{Entry, Module};

/// `use` may lead in circles; no honest path is longer.
const DEEPEST: usize = 32;

impl Library<'_> {
    /// The module in which the thing is written that a path names.
    pub(super) fn home(
        &self,
        module: &Rc<Module>,
        segments: &[String],
        absolute: bool,
    ) -> Option<Rc<Module>> {
        self.home_within(module, segments, absolute, 0)
    }

    fn home_within(
        &self,
        module: &Rc<Module>,
        segments: &[String],
        absolute: bool,
        depth: usize,
    ) -> Option<Rc<Module>> {
        match self.follow(module, segments, absolute, 0) {
            Some(Found::Module(found)) => return Some(found),
            Some(Found::Item(item)) => return Some(item.module),
            Some(_) => return None,
            None if depth > DEEPEST => return None,
            None => {}
        }
        let (last, before) = segments.split_last()?;
        let parent = match self.follow(module, before, absolute, 0) {
            _ if before.is_empty() && !absolute => module.clone(),
            Some(Found::Module(parent)) => parent,
            // A function or constant of a type, or a variant.
            Some(Found::Item(item)) => return Some(item.module),
            _ => return None,
        };
        if has_function(&parent, last) {
            return Some(parent);
        }
        if let Some(Entry::Import(import)) = parent.entries.get(last) {
            return self.home_within(&parent, &import.segments, import.absolute, depth + 1);
        }
        parent
            .globs
            .iter()
            .filter_map(|glob| self.follow_import(&parent, glob))
            .find_map(|found| match found {
                Found::Module(target) if has_function(&target, last) => Some(target),
                _ => None,
            })
    }
}

fn has_function(module: &Module, name: &str) -> bool {
    let mut items = module.syntax.items.iter();
    items.any(|item| match item {
        Item::Fn(item) => item.sig.ident == name,
        Item::Static(item) => item.ident == name,
        _ => false,
    })
}
