//! The path by which another crate can name an item.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::{Entry, Module, Visible};

impl Library<'_> {
    /// Where the item is defined if that is public, else the first `pub use` of it from the crate's root; `None` if
    /// no other crate can name it.
    pub fn public_path(&self, item: &ItemId) -> Option<String> {
        let definition = item.path();
        if let Some(known) = self.public_paths.borrow().get(&definition) {
            return known.clone();
        }
        let path = if item.public && self.is_public(&item.module) {
            Some(definition.clone())
        } else {
            self.search(item)
        };
        self.public_paths
            .borrow_mut()
            .insert(definition, path.clone());
        path
    }

    /// Whether a module and all modules around it are public.
    fn is_public(&self, module: &Module) -> bool {
        let Some((parent, name)) = module.path.rsplit_once("::") else {
            return true;
        };
        self.module(parent).is_some_and(|parent| {
            parent.entries.get(name).is_some_and(Entry::is_public) && self.is_public(&parent)
        })
    }

    /// Breadth first through the public modules of the item's crate.
    fn search(&self, item: &ItemId) -> Option<String> {
        let root = self.root(item.module.library())?;
        let mut seen: BTreeSet<String> = BTreeSet::from([root.path.clone()]);
        let mut layer: Vec<(String, Rc<Module>)> = vec![(root.path.clone(), root)];
        while !layer.is_empty() {
            if let Some(path) = layer
                .iter()
                .find_map(|(path, module)| self.name_in(item, path, module))
            {
                return Some(path);
            }
            layer = layer
                .iter()
                .flat_map(|(path, module)| self.public_modules(path, module))
                .filter(|(_, module)| {
                    module.library() == item.module.library() && seen.insert(module.path.clone())
                })
                .collect();
        }
        None
    }

    /// The item's path if this module makes it public under any name.
    fn name_in(&self, item: &ItemId, path: &str, module: &Rc<Module>) -> Option<String> {
        let is_item = |name: &str| {
            self.item_in(module, name)
                .is_some_and(|found| found.path() == item.path())
        };
        let imported = module.entries.iter().find(|(name, entry)| {
            let last = match entry {
                Entry::Import(import) if entry.is_public() => import.segments.last(),
                _ => None,
            };
            last.is_some_and(|last| *last == item.name) && is_item(name)
        });
        if let Some((name, _)) = imported {
            return Some(format!("{path}::{name}"));
        }
        let public_glob = module
            .globs
            .iter()
            .filter(|glob| glob.visible == Visible::Everywhere)
            .any(|glob| match self.follow_import(module, glob) {
                Some(Found::Module(target)) => {
                    item.public
                        && self
                            .item_in(&target, &item.name)
                            .is_some_and(|found| found.path() == item.path())
                }
                _ => false,
            });
        (public_glob && is_item(&item.name)).then(|| format!("{path}::{}", item.name))
    }

    fn public_modules(&self, path: &str, module: &Rc<Module>) -> Vec<(String, Rc<Module>)> {
        let public = module.entries.iter().filter(|(_, entry)| entry.is_public());
        public
            .filter_map(|(name, _)| {
                let below = self.module_in(module, name)?;
                Some((format!("{path}::{name}"), below))
            })
            .collect()
    }
}
