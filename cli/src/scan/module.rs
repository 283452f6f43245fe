//! One module of a crate: its items, and what it brings in with `use`.

use std::collections::BTreeMap;
use std::rc::Rc;

use camino::{Utf8Path, Utf8PathBuf};
pub(crate) use grammar::{is_conditional, only_for_tests};
use proc_macro2::{Span, TokenStream, TokenTree};
use syn::{Attribute, Ident, Item, UseTree, Visibility};

use super::conditional::is_elsewhere;

/// A module and everything that has a name in it.
#[derive(Debug)]
pub struct Module {
    /// Absolute: `types::ball`.
    pub path: String,
    /// The file it stands in.
    pub file: Utf8PathBuf,
    /// Where files of its own modules lie.
    pub(crate) folder: Utf8PathBuf,
    /// It is written within the file of another.
    pub(super) inline: bool,
    pub syntax: Rc<syn::File>,
    pub(super) entries: BTreeMap<String, Entry>,
    pub(super) globs: Vec<Import>,
}

/// What a name in a module stands for.
#[derive(Clone, Debug)]
pub(super) enum Entry {
    /// Position in the items of the module.
    Item {
        index: usize,
        visible: Visible,
    },
    Import(Import),
    /// Several items of one name, chosen by `cfg`.
    Ambiguous,
}

/// A path behind `use`.
#[derive(Clone, Debug)]
pub(super) struct Import {
    pub(super) segments: Vec<String>,
    /// It begins with `::`.
    pub(super) absolute: bool,
    pub(super) visible: Visible,
    /// It, or another one of this name, is there only sometimes.
    pub(super) is_conditional: bool,
}

/// Who can see a name of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Visible {
    /// `pub`.
    Everywhere,
    /// `pub(…)`: taken for the whole crate.
    InCrate,
    /// Only the module and those inside of it.
    Inside,
}

impl Module {
    pub(super) fn new(
        path: String,
        file: Utf8PathBuf,
        folder: Utf8PathBuf,
        syntax: Rc<syn::File>,
    ) -> Self {
        let mut module = Self {
            path,
            file,
            folder,
            inline: false,
            entries: BTreeMap::new(),
            globs: Vec::new(),
            syntax: syntax.clone(),
        };
        for (index, item) in syntax.items.iter().enumerate() {
            module.add(index, item);
        }
        module
    }

    /// Name of the crate it belongs to.
    pub fn library(&self) -> &str {
        self.path.split("::").next().unwrap_or(&self.path)
    }

    /// The module around it; `None` for the crate's root.
    pub fn parent(&self) -> Option<&str> {
        self.path.rsplit_once("::").map(|(parent, _)| parent)
    }

    /// The item of an [`Entry::Item`].
    pub(super) fn item(&self, index: usize) -> &Item {
        &self.syntax.items[index]
    }

    /// Names of the modules that are declared in it.
    pub(super) fn module_names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().filter_map(|(name, entry)| match entry {
            Entry::Item { index, .. } => {
                matches!(self.item(*index), Item::Mod(_)).then_some(name.as_str())
            }
            _ => None,
        })
    }

    /// Whether macros write some of its items.
    pub(super) fn calls_macros(&self) -> bool {
        let mut items = self.syntax.items.iter();
        items.any(|item| matches!(item, Item::Macro(call) if call.ident.is_none()))
    }

    /// Where a `use` or `extern crate` brings a name in.
    pub(super) fn import_span(&self, name: &str) -> Option<Span> {
        self.syntax.items.iter().find_map(|item| match item {
            Item::Use(item) => named(&item.tree, None, name),
            Item::ExternCrate(item) => {
                let ident = item.rename.as_ref().map_or(&item.ident, |(_, ident)| ident);
                (ident == name).then(|| ident.span())
            }
            _ => None,
        })
    }

    /// Whether a name among these may stand for something else under another condition.
    pub(super) fn is_uncertain(&self, tokens: TokenStream) -> bool {
        tokens.into_iter().any(|token| match token {
            TokenTree::Group(group) => self.is_uncertain(group.stream()),
            TokenTree::Ident(name) => {
                let entry = self.entries.get(&name.to_string());
                matches!(entry, Some(Entry::Import(import)) if import.is_conditional)
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => false,
        })
    }

    /// Names that other crates can see.
    pub(super) fn public_names(&self) -> Vec<String> {
        let public = self.entries.iter().filter(|(_, entry)| entry.is_public());
        public.map(|(name, _)| name.clone()).collect()
    }

    fn add(&mut self, index: usize, item: &Item) {
        let (name, visibility, attributes) = match item {
            Item::Use(item) => {
                if !only_for_tests(&item.attrs) {
                    let absolute = item.leading_colon.is_some();
                    let visible = Visible::new(&item.vis);
                    let start = Import {
                        segments: Vec::new(),
                        absolute,
                        visible,
                        is_conditional: is_conditional(&item.attrs),
                    };
                    self.add_use(&start, &item.tree);
                }
                return;
            }
            Item::ExternCrate(item) => {
                let name = item.rename.as_ref().map_or(&item.ident, |(_, name)| name);
                let is_self = item.ident == "self";
                let first = if is_self {
                    "crate".to_owned()
                } else {
                    item.ident.to_string()
                };
                let visible = Visible::new(&item.vis);
                let import = Import {
                    segments: vec![first],
                    absolute: !is_self,
                    visible,
                    is_conditional: is_conditional(&item.attrs),
                };
                self.insert(name.to_string(), Entry::Import(import));
                return;
            }
            Item::Struct(item) => (&item.ident, &item.vis, &item.attrs),
            Item::Enum(item) => (&item.ident, &item.vis, &item.attrs),
            Item::Union(item) => (&item.ident, &item.vis, &item.attrs),
            Item::Type(item) => (&item.ident, &item.vis, &item.attrs),
            Item::Trait(item) => (&item.ident, &item.vis, &item.attrs),
            Item::Mod(item) => (&item.ident, &item.vis, &item.attrs),
            Item::Const(item) => (&item.ident, &item.vis, &item.attrs),
            _ => return,
        };
        if !only_for_tests(attributes) {
            let visible = Visible::new(visibility);
            self.insert(name.to_string(), Entry::Item { index, visible });
        }
    }

    fn insert(&mut self, name: String, entry: Entry) {
        let entry = match (self.entries.get(&name), entry) {
            // Of a type that is imported rustc would not allow another here: the import is of a function or macro.
            (None | Some(Entry::Import(_)), entry) => entry,
            (Some(_), Entry::Import(_)) => return,
            (Some(Entry::Item { index: first, .. }), Entry::Item { index, visible })
                if self.is_module_of_others(*first) && matches!(self.item(index), Item::Mod(_)) =>
            {
                Entry::Item { index, visible }
            }
            (Some(Entry::Item { index: first, .. }), Entry::Item { index, .. })
                if self.is_module_of_others(index) && matches!(self.item(*first), Item::Mod(_)) =>
            {
                return;
            }
            (Some(_), _) => Entry::Ambiguous,
        };
        self.entries.insert(name, entry);
    }

    /// A module that is there on other machines alone.
    fn is_module_of_others(&self, index: usize) -> bool {
        matches!(self.item(index), Item::Mod(item) if is_elsewhere(&item.attrs))
    }

    fn add_use(&mut self, before: &Import, tree: &UseTree) {
        let with = |name: &syn::Ident| {
            let mut import = before.clone();
            import.segments.push(name.to_string());
            import
        };
        match tree {
            UseTree::Path(path) => self.add_use(&with(&path.ident), &path.tree),
            UseTree::Name(name) if name.ident == "self" => {
                if let Some(name) = before.segments.last().cloned() {
                    self.add_import(name, before.clone());
                }
            }
            UseTree::Name(name) => self.add_import(name.ident.to_string(), with(&name.ident)),
            UseTree::Rename(rename) if rename.ident == "self" => {
                self.add_import(rename.rename.to_string(), before.clone());
            }
            UseTree::Rename(rename) => {
                self.add_import(rename.rename.to_string(), with(&rename.ident));
            }
            UseTree::Glob(_) => self.globs.push(before.clone()),
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.add_use(before, tree);
                }
            }
        }
    }

    fn add_import(&mut self, name: String, import: Import) {
        if name == "_" {
            return;
        }
        let is_conditional = import.is_conditional;
        // A macro or function of the same name is none of ours: the first import stays.
        let entry = self.entries.entry(name).or_insert(Entry::Import(import));
        if let Entry::Import(first) = entry {
            first.is_conditional |= is_conditional;
        }
    }
}

impl Entry {
    pub(super) fn visible(&self) -> Visible {
        match self {
            Self::Item { visible, .. } => *visible,
            Self::Import(import) => import.visible,
            Self::Ambiguous => Visible::Inside,
        }
    }

    pub(super) fn is_public(&self) -> bool {
        self.visible() == Visible::Everywhere
    }
}

impl Visible {
    pub(super) fn new(visibility: &Visibility) -> Self {
        match visibility {
            Visibility::Public(_) => Self::Everywhere,
            Visibility::Restricted(_) => Self::InCrate,
            Visibility::Inherited => Self::Inside,
        }
    }

    /// Whether code in the module `from` sees what has this visibility in the module `of`.
    pub(super) fn reaches(self, from: &Module, of: &Module) -> bool {
        let inside = from.path == of.path || from.path.starts_with(&format!("{}::", of.path));
        match self {
            Self::Everywhere => true,
            Self::InCrate => from.library() == of.library(),
            Self::Inside => inside,
        }
    }
}

/// Where a tree of `use` names this; `last` stands right before the tree.
fn named(tree: &UseTree, last: Option<&Ident>, name: &str) -> Option<Span> {
    let found = match tree {
        UseTree::Path(path) => return named(&path.tree, Some(&path.ident), name),
        UseTree::Group(group) => {
            let mut trees = group.items.iter();
            return trees.find_map(|tree| named(tree, last, name));
        }
        UseTree::Name(own) if own.ident == "self" => last?,
        UseTree::Name(own) => &own.ident,
        UseTree::Rename(rename) => &rename.rename,
        UseTree::Glob(_) => return None,
    };
    (found == name).then(|| found.span())
}

/// Where the modules of a file lie: beside `lib.rs` and `mod.rs`, else in the folder of the file's name.
pub(crate) fn folder_of(file: &Utf8Path, is_root: bool) -> Utf8PathBuf {
    let beside = file.parent().unwrap_or(Utf8Path::new(""));
    match file.file_stem() {
        Some(stem) if !is_root && stem != "mod" => beside.join(stem),
        _ => beside.to_owned(),
    }
}

/// The attributes of an item that can be for tests alone.
pub(crate) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        _ => &[],
    }
}
