//! What a path of names stands for, by rustc's rules.

use std::collections::BTreeSet;
use std::rc::Rc;

use syn::Item;

use super::library::{Globs, Library};
use super::module::{Entry, Import, Module, Visible};
use crate::workspace::Origin;

/// What a path stands for.
#[derive(Clone, Debug)]
pub(super) enum Found {
    Module(Rc<Module>),
    Item(ItemId),
    /// In scope everywhere: primitive types and the standard prelude.
    Prelude(String),
    /// Below `std`, `core` or `alloc`; without that first name.
    Standard(Vec<String>),
    /// Below a crate that is no member of the workspace, absolute.
    Foreign(Vec<String>),
}

/// An item of a module.
#[derive(Clone, Debug)]
pub struct ItemId {
    pub module: Rc<Module>,
    /// Position in the module's items.
    pub index: usize,
    pub name: String,
    /// Its own `pub`.
    pub public: bool,
}

/// `use` may lead in circles; no honest path is longer.
const DEEPEST: usize = 32;

impl ItemId {
    /// Where it is defined: `types::ball::Ball`.
    pub fn path(&self) -> String {
        format!("{}::{}", self.module.path, self.name)
    }

    pub(crate) fn item(&self) -> &Item {
        self.module.item(self.index)
    }
}

impl Found {
    pub(super) fn is(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Module(a), Self::Module(b)) => a.path == b.path,
            (Self::Item(a), Self::Item(b)) => a.path() == b.path(),
            (Self::Prelude(a), Self::Prelude(b)) => a == b,
            (Self::Standard(a), Self::Standard(b)) | (Self::Foreign(a), Self::Foreign(b)) => a == b,
            _ => false,
        }
    }
}

impl Library<'_> {
    /// What a path in a type or bound of a module stands for.
    pub(super) fn find(&self, module: &Rc<Module>, path: &syn::Path) -> Option<Found> {
        let segments: Vec<String> = path
            .segments
            .iter()
            .map(|one| one.ident.to_string())
            .collect();
        let absolute = path.leading_colon.is_some();
        self.follow(module, &segments, absolute, 0)
            .or_else(|| self.beyond(module, &segments, absolute, 0))
    }

    /// A module, also one that is brought in by `use`.
    pub(super) fn module_in(&self, parent: &Rc<Module>, name: &str) -> Option<Rc<Module>> {
        match self.look_in(parent, name, 0)? {
            Found::Module(module) => Some(module),
            _ => None,
        }
    }

    /// An item of a module under this name, also one that is brought in by `use`.
    pub(super) fn item_in(&self, parent: &Rc<Module>, name: &str) -> Option<ItemId> {
        match self.look_in(parent, name, 0)? {
            Found::Item(item) => Some(item),
            _ => None,
        }
    }

    pub(super) fn follow_import(&self, module: &Rc<Module>, import: &Import) -> Option<Found> {
        self.follow(module, &import.segments, import.absolute, 0)
    }

    pub(super) fn follow(
        &self,
        module: &Rc<Module>,
        segments: &[String],
        absolute: bool,
        depth: usize,
    ) -> Option<Found> {
        if depth > DEEPEST {
            return None;
        }
        let (first, rest) = segments.split_first()?;
        let mut found = if absolute {
            self.find_crate(module, first)?
        } else {
            self.begin(module, first, rest.is_empty(), depth)?
        };
        for name in rest {
            found = self.step(found, name, depth)?;
        }
        Some(found)
    }

    /// The first name of a path.
    fn begin(&self, module: &Rc<Module>, name: &str, alone: bool, depth: usize) -> Option<Found> {
        match name {
            "crate" => return self.root(module.library()).map(Found::Module),
            "self" => return Some(Found::Module(module.clone())),
            "super" => return self.module(module.parent()?).map(Found::Module),
            "Self" => return None,
            _ => {}
        }
        if let Some(found) = self.look_in(module, name, depth) {
            return Some(found);
        }
        // A name that is there but leads nowhere is not one of the names that are in scope everywhere.
        if module.entries.contains_key(name) {
            return None;
        }
        if alone && is_prelude(name) {
            return Some(Found::Prelude(name.to_owned()));
        }
        self.find_crate(module, name)
    }

    fn step(&self, found: Found, name: &str, depth: usize) -> Option<Found> {
        let longer = |mut path: Vec<String>| {
            path.push(name.to_owned());
            path
        };
        match found {
            Found::Module(module) if name == "self" => Some(Found::Module(module)),
            Found::Module(module) if name == "super" => {
                self.module(module.parent()?).map(Found::Module)
            }
            Found::Module(module) => self.look_in(&module, name, depth),
            Found::Standard(path) => Some(Found::Standard(longer(path))),
            Found::Foreign(path) => Some(Found::Foreign(longer(path))),
            Found::Item(_) | Found::Prelude(_) => None,
        }
    }

    /// A name in a module: its items, its `use` lines, then its globs.
    fn look_in(&self, module: &Rc<Module>, name: &str, depth: usize) -> Option<Found> {
        if depth > DEEPEST {
            return None;
        }
        match module.entries.get(name) {
            Some(Entry::Ambiguous) => None,
            Some(Entry::Item { index, visible }) => match module.item(*index) {
                Item::Mod(_) => self.declared(module, name).map(Found::Module),
                _ => Some(Found::Item(ItemId {
                    module: module.clone(),
                    index: *index,
                    name: name.to_owned(),
                    public: *visible == Visible::Everywhere,
                })),
            },
            Some(Entry::Import(import)) => self.imported(module, name, import, depth),
            None => self.look_in_globs(module, name, depth),
        }
    }

    /// `use types::types;` names the crate, not itself.
    fn imported(
        &self,
        module: &Rc<Module>,
        name: &str,
        import: &Import,
        depth: usize,
    ) -> Option<Found> {
        let itself = import.segments.first().is_some_and(|first| first == name);
        self.follow(
            module,
            &import.segments,
            import.absolute || itself,
            depth + 1,
        )
    }

    /// What all globs of a module agree on, as far as the module sees it.
    fn look_in_globs(&self, module: &Rc<Module>, name: &str, depth: usize) -> Option<Found> {
        let search = (module.path.clone(), name.to_owned());
        if module.globs.is_empty() || !self.searching.borrow_mut().insert(search.clone()) {
            return None;
        }
        let found = self.agreed(module, name, depth);
        self.searching.borrow_mut().remove(&search);
        found
    }

    /// The one thing of this name in all modules to which globs lead, whatever the ways between them are: every module
    /// is looked at once for each that names it.
    fn agreed(&self, start: &Rc<Module>, name: &str, depth: usize) -> Option<Found> {
        let mut found: Option<Found> = None;
        let mut judged = BTreeSet::new();
        let mut seen = BTreeSet::new();
        // With the module that looks into it.
        let mut waiting = vec![(start.clone(), start.clone())];
        while let Some((module, from)) = waiting.pop() {
            for (target, visible) in self.glob_targets(&module, depth).iter() {
                if !visible.reaches(&from, &module) || target.path == module.path {
                    continue;
                }
                let Some(entry) = target.entries.get(name) else {
                    if seen.insert((target.path.clone(), module.path.clone())) {
                        waiting.push((target.clone(), module.clone()));
                    }
                    continue;
                };
                if !entry.visible().reaches(&module, target) || !judged.insert(target.path.clone())
                {
                    continue;
                }
                let new = self.look_in(target, name, depth + 1);
                if matches!((&new, &found), (Some(new), Some(old)) if !new.is(old)) {
                    return None;
                }
                found = found.or(new);
            }
        }
        found
    }

    /// Where the globs of a module lead. A glob may name what another glob of the module brings in, so those that lead
    /// nowhere at first are tried again.
    fn glob_targets(&self, module: &Rc<Module>, depth: usize) -> Globs {
        if let Some(known) = self.glob_targets.borrow().get(&module.path) {
            return known.clone();
        }
        let mut targets = Globs::default();
        for _ in 0..2 {
            self.glob_targets
                .borrow_mut()
                .insert(module.path.clone(), targets.clone());
            let follow = |glob: &Import| match self.follow(
                module,
                &glob.segments,
                glob.absolute,
                depth + 1,
            )? {
                Found::Module(target) => Some((target, glob.visible)),
                _ => None,
            };
            targets = Rc::new(module.globs.iter().filter_map(follow).collect());
        }
        self.glob_targets
            .borrow_mut()
            .insert(module.path.clone(), targets.clone());
        targets
    }

    fn find_crate(&self, module: &Rc<Module>, name: &str) -> Option<Found> {
        if matches!(name, "std" | "core" | "alloc") {
            return Some(Found::Standard(Vec::new()));
        }
        let own = self.member(module.library());
        match own.and_then(|member| member.dependency(name)) {
            Some(Origin::Member(library)) => match self.root(library) {
                Some(root) => Some(Found::Module(root)),
                None => Some(Found::Foreign(vec![library.to_owned()])),
            },
            Some(Origin::Outside(name)) => Some(Found::Foreign(vec![name.to_owned()])),
            None => match self.named_by_root(module, name) {
                Some(found) => Some(found),
                None => self.root(name).map(Found::Module),
            },
        }
    }

    /// What `extern crate … as name` in the crate's root gives a name to for all of the crate.
    fn named_by_root(&self, module: &Rc<Module>, name: &str) -> Option<Found> {
        let root = self.root(module.library())?;
        let named = root.syntax.items.iter().find_map(|item| match item {
            Item::ExternCrate(item) => {
                let (_, given) = item.rename.as_ref()?;
                (given == name).then(|| item.ident.to_string())
            }
            _ => None,
        })?;
        match named.as_str() {
            "self" => Some(Found::Module(root)),
            other if other == name => None,
            other => self.find_crate(module, other),
        }
    }
}

/// Types and traits that no `use` has to bring in.
pub(crate) fn is_prelude(name: &str) -> bool {
    const NAMES: &[&str] = &[
        "Box",
        "Clone",
        "Copy",
        "Default",
        "Drop",
        "Eq",
        "Fn",
        "FnMut",
        "FnOnce",
        "From",
        "Into",
        "IntoIterator",
        "Iterator",
        "Option",
        "Ord",
        "PartialEq",
        "PartialOrd",
        "Result",
        "Send",
        "Sized",
        "String",
        "Sync",
        "ToOwned",
        "ToString",
        "Unpin",
        "Vec",
        "bool",
        "char",
        "f32",
        "f64",
        "i128",
        "i16",
        "i32",
        "i64",
        "i8",
        "isize",
        "str",
        "u128",
        "u16",
        "u32",
        "u64",
        "u8",
        "usize",
    ];
    NAMES.binary_search(&name).is_ok()
}
