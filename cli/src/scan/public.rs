//! The path by which another crate can name an item.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::library::Library;
use super::lookup::{Found, ItemId};
use super::module::{Entry, Module, Visible, attributes, is_conditional};

impl Library<'_> {
    /// Where the item is defined if that is public, else the first `pub use` of it from the crate's root; `None` if
    /// no other crate can name it.
    pub fn public_path(&self, item: &ItemId) -> Option<String> {
        self.public_way(item).map(|(path, _)| path)
    }

    /// Whether the only paths by which another crate can name it are there under a condition.
    pub(super) fn is_sometimes_public(&self, item: &ItemId) -> bool {
        self.public_way(item)
            .is_some_and(|(_, sometimes)| sometimes)
    }

    /// The public path of an item, and whether a condition decides about it: one that none decides about comes first.
    fn public_way(&self, item: &ItemId) -> Option<(String, bool)> {
        let definition = item.path();
        if let Some(known) = self.public_paths.borrow().get(&definition) {
            return known.clone();
        }
        let path = if item.public && self.is_public(&item.module) {
            Some((definition.clone(), false))
        } else {
            let is_it = |module: &Rc<Module>, name: &str| {
                let found = self.item_in(module, name);
                found.is_some_and(|found| found.path() == definition)
            };
            self.search_all(item.module.library(), &item.name, item.public, &is_it)
        };
        self.public_paths
            .borrow_mut()
            .insert(definition, path.clone());
        path
    }

    /// Whether a module and all modules around it are public.
    pub(super) fn is_public(&self, module: &Module) -> bool {
        let Some((parent, name)) = module.path.rsplit_once("::") else {
            return true;
        };
        self.module(parent).is_some_and(|parent| {
            parent.entries.get(name).is_some_and(Entry::is_public) && self.is_public(&parent)
        })
    }

    /// The public path of what a macro may define in a module, and whether a condition decides about it.
    pub(super) fn public_way_of_made(
        &self,
        module: &Rc<Module>,
        name: &str,
    ) -> Option<(String, bool)> {
        if self.is_public(module) {
            return Some((format!("{}::{name}", module.path), false));
        }
        let is_it = |place: &Rc<Module>, given: &str| match place.entries.get(given) {
            Some(Entry::Import(import)) => {
                import.segments.split_last().is_some_and(|(last, front)| {
                    let front = self.follow(place, front, import.absolute, 0);
                    last == name
                        && matches!(front, Some(Found::Module(front)) if front.path == module.path)
                })
            }
            Some(_) => false,
            None => place.path == module.path,
        };
        self.search_all(module.library(), name, true, &is_it)
    }

    fn search_all(
        &self,
        library: &str,
        name: &str,
        by_globs: bool,
        is_it: IsIt<'_>,
    ) -> Option<(String, bool)> {
        let mut search = Search {
            name,
            by_globs,
            is_it,
            conditional: false,
        };
        if let Some(path) = self.search(library, &search) {
            return Some((path, false));
        }
        search.conditional = true;
        self.search(library, &search).map(|path| (path, true))
    }

    /// Whether another crate is certainly refused a name of a module that stands for an item or module of the
    /// workspace.
    pub(super) fn is_hidden(&self, module: &Rc<Module>, name: &str) -> bool {
        !self.may_be_seen(module, name, &mut BTreeSet::new())
    }

    fn may_be_seen(&self, module: &Rc<Module>, name: &str, seen: &mut BTreeSet<String>) -> bool {
        match module.entries.get(name) {
            Some(Entry::Ambiguous) => true,
            Some(Entry::Import(import)) if import.is_conditional => true,
            Some(entry) => entry.is_public(),
            // What a macro defines hides what a glob brings in.
            None if module.calls_macros() => true,
            None => {
                let globs = module.globs.iter();
                let mut public = globs.filter(|glob| glob.visible == Visible::Everywhere);
                public.any(|glob| match self.follow_import(module, glob) {
                    Some(Found::Module(target)) => {
                        seen.insert(target.path.clone()) && self.may_be_seen(&target, name, seen)
                    }
                    _ => true,
                })
            }
        }
    }

    /// Breadth first through the public modules of a crate.
    fn search(&self, library: &str, sought: &Search<'_>) -> Option<String> {
        let root = self.root(library)?;
        let mut seen: BTreeSet<String> = BTreeSet::from([root.path.clone()]);
        let mut layer: Vec<(String, Rc<Module>)> = vec![(root.path.clone(), root)];
        while !layer.is_empty() {
            if let Some(path) = layer
                .iter()
                .find_map(|(path, module)| self.name_in(sought, path, module))
            {
                return Some(path);
            }
            layer = layer
                .iter()
                .flat_map(|(path, module)| self.public_modules(sought, path, module))
                .filter(|(_, module)| {
                    module.library() == library && seen.insert(module.path.clone())
                })
                .collect();
        }
        None
    }

    /// The path of what is sought if this module makes it public under any name.
    fn name_in(&self, sought: &Search<'_>, path: &str, module: &Rc<Module>) -> Option<String> {
        let name = sought.name;
        let imported = module.entries.iter().find(|(given, entry)| match entry {
            Entry::Import(import) => {
                entry.is_public()
                    && (sought.conditional || !import.is_conditional)
                    && import.segments.last().is_some_and(|last| last == name)
                    && (sought.is_it)(module, given)
            }
            _ => false,
        });
        if let Some((given, _)) = imported {
            return Some(format!("{path}::{given}"));
        }
        let mut globs = module.globs.iter().filter(|glob| {
            glob.visible == Visible::Everywhere && (sought.conditional || !glob.is_conditional)
        });
        let public_glob = sought.by_globs
            && globs.any(|glob| match self.follow_import(module, glob) {
                Some(Found::Module(target)) => (sought.is_it)(&target, name),
                _ => false,
            });
        let is_hidden = module.entries.contains_key(name) && !(sought.is_it)(module, name);
        (public_glob && !is_hidden).then(|| format!("{path}::{name}"))
    }

    fn public_modules(
        &self,
        sought: &Search<'_>,
        path: &str,
        module: &Rc<Module>,
    ) -> Vec<(String, Rc<Module>)> {
        let is_sometimes = |entry: &Entry| match entry {
            Entry::Item { index, .. } => is_conditional(attributes(module.item(*index))),
            Entry::Import(import) => import.is_conditional,
            Entry::Ambiguous => true,
        };
        let public = module
            .entries
            .iter()
            .filter(|(_, entry)| entry.is_public() && (sought.conditional || !is_sometimes(entry)));
        public
            .filter_map(|(name, _)| {
                let below = self.module_in(module, name)?;
                Some((format!("{path}::{name}"), below))
            })
            .collect()
    }
}

/// Whether a name of a module is what is sought.
type IsIt<'a> = &'a dyn Fn(&Rc<Module>, &str) -> bool;

/// What is sought in the public modules of a crate.
struct Search<'a> {
    /// Where it is defined.
    name: &'a str,
    /// It is public where it is defined, so that a glob brings it in.
    by_globs: bool,
    is_it: IsIt<'a>,
    /// Also what stands under a condition.
    conditional: bool,
}
