//! Sources of nondeterminism: what a node's file, and a module of the workspace that it names, may get another answer
//! from in a replay.
//!
//! Names are followed as rustc would follow them. Code for tests is not looked at, and the framework is trusted: it is
//! where time and threads are at home.

mod named;
mod sources;
mod statics;

use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use camino::Utf8PathBuf;
use syn::parse::Parser as _;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};
use syn::{Attribute, Block, Expr, Item, Macro, PathArguments, Stmt, Token};

use super::library::Library;
use super::lookup::Found;
use super::module::{Entry, Import, Module, attributes, only_for_tests};
use super::{Sources, range};

pub use sources::Chance;

/// The library of the framework, by the name that every node uses.
const FRAMEWORK: &str = "framework";

/// A place that gives another answer in every run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    pub file: Utf8PathBuf,
    pub range: Range<usize>,
    /// As written there.
    pub name: String,
    pub chance: Chance,
}

impl Sources<'_> {
    /// Every place of the nodes' files and of the modules that they name.
    pub fn nondeterminism(&self) -> Vec<Place> {
        self.library.quietly(|| {
            let mut places = Vec::new();
            let mut named = BTreeMap::new();
            for node in self.nodes.values() {
                named.extend(look(&self.library, &node.module, &mut places));
            }
            named.retain(|path, _| !self.nodes.contains_key(path));
            for module in named.values() {
                look(&self.library, module, &mut places);
            }
            places
        })
    }
}

/// Adds the places of a module; gives the modules of the workspace that it names, by path.
fn look(
    library: &Library<'_>,
    module: &Rc<Module>,
    places: &mut Vec<Place>,
) -> BTreeMap<String, Rc<Module>> {
    let mut looking = Looking {
        library,
        module: module.clone(),
        blocks: Vec::new(),
        places,
        named: BTreeMap::new(),
    };
    looking.imports(module);
    looking.visit_file(&module.syntax);
    looking.named
}

struct Looking<'a> {
    library: &'a Library<'a>,
    /// Around the place that is looked at.
    module: Rc<Module>,
    /// Blocks of it around the place with `use` lines or items of their own, innermost last.
    blocks: Vec<(Rc<Module>, Vec<Import>)>,
    places: &'a mut Vec<Place>,
    named: BTreeMap<String, Rc<Module>>,
}

impl Looking<'_> {
    fn add(&mut self, span: proc_macro2::Span, name: String, chance: Chance) {
        let file = self.module.file.clone();
        self.places.push(Place {
            file,
            range: range(span),
            name,
            chance,
        });
    }

    /// The innermost block that knows this name, else the module.
    fn scope(&self, name: &str) -> Rc<Module> {
        let mut blocks = self.blocks.iter().rev();
        let block = blocks.find(|(block, _)| block.entries.contains_key(name));
        block.map_or(&self.module, |(block, _)| block).clone()
    }

    /// What a block brings in with `use` and defines, as a module of its own.
    fn block_scope(&self, block: &Block) -> Option<(Rc<Module>, Vec<Import>)> {
        let items = block.stmts.iter().filter_map(|statement| match statement {
            Stmt::Item(item) => Some(item.clone()),
            _ => None,
        });
        let items: Vec<Item> = items.collect();
        if items.is_empty() {
            return None;
        }
        let syntax = syn::File {
            shebang: None,
            attrs: Vec::new(),
            items,
        };
        let around = &self.module;
        let (path, file, folder) = (&around.path, &around.file, &around.folder);
        let mut scope = Module::new(path.clone(), file.clone(), folder.clone(), Rc::new(syntax));
        scope.inline = around.inline;
        // Where the globs of a module lead is known by its path, which is the one of the module around.
        let globs = std::mem::take(&mut scope.globs);
        Some((Rc::new(scope), globs))
    }

    /// A module that is written within the file.
    fn visit_inline(&mut self, item: &syn::ItemMod) {
        let declared = self.library.declared(&self.module, &item.ident.to_string());
        let Some((inner, (_, items))) = declared.zip(item.content.as_ref()) else {
            return;
        };
        self.imports(&inner);
        let around = std::mem::replace(&mut self.module, inner);
        let blocks = std::mem::take(&mut self.blocks);
        items.iter().for_each(|item| self.visit_item(item));
        self.blocks = blocks;
        self.module = around;
    }

    fn imports(&mut self, module: &Rc<Module>) {
        for entry in module.entries.values() {
            if let Entry::Import(import) = entry {
                self.name(module, &import.segments, import.absolute);
            }
        }
    }

    /// Notes the module that a path leads to.
    fn name(&mut self, scope: &Rc<Module>, segments: &[String], absolute: bool) {
        if let Some(home) = self.library.home(scope, segments, absolute)
            && home.library() != FRAMEWORK
            // A variable may be called like a crate, which alone is no expression.
            && segments != [home.path.as_str()]
        {
            self.named.insert(home.path.clone(), home);
        }
    }

    fn chance(&self, scope: &Rc<Module>, path: &syn::Path, segments: &[String]) -> Option<Chance> {
        match self.library.find(scope, path) {
            Some(Found::Standard(path)) => Chance::of_standard(&path),
            Some(Found::Foreign(path)) => Chance::of_foreign(&path),
            Some(_) => None,
            None => self.chance_of_unknown(scope, segments),
        }
    }

    /// A name that comes by the glob of another crate, or of a crate that is no dependency yet.
    fn chance_of_unknown(&self, scope: &Rc<Module>, segments: &[String]) -> Option<Chance> {
        let first = segments.first()?;
        match scope.entries.get(first) {
            Some(Entry::Import(import)) => {
                let path = [&import.segments, &segments[1..]].concat();
                return Chance::of_foreign(&path);
            }
            Some(_) => return None,
            None => {}
        }
        let inner = self.blocks.iter().rev().flat_map(|(_, globs)| globs);
        let globs = inner.chain(&self.module.globs);
        let found = globs.filter_map(|glob| self.library.follow_import(&self.module, glob));
        let by_glob = found.filter_map(|found| match found {
            Found::Standard(path) => Chance::by_glob(&path, segments),
            Found::Foreign(path) => Chance::by_foreign_glob(&path, segments),
            _ => None,
        });
        let by_crate = (segments.len() > 1).then(|| Chance::of_foreign(segments));
        by_glob.chain(by_crate.flatten()).next()
    }
}

impl<'ast> Visit<'ast> for Looking<'_> {
    fn visit_attribute(&mut self, _: &'ast Attribute) {}

    fn visit_item(&mut self, item: &'ast Item) {
        if is_for_tests(attributes(item)) {
            return;
        }
        match item {
            Item::Mod(inner) => self.visit_inline(inner),
            Item::Use(_) => {}
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        if !is_for_tests(&function.attrs) {
            visit::visit_impl_item_fn(self, function);
        }
    }

    fn visit_item_static(&mut self, item: &'ast syn::ItemStatic) {
        if self.library.can_change(&self.module, item) {
            self.add(item.ident.span(), item.ident.to_string(), Chance::Static);
        }
        visit::visit_item_static(self, item);
    }

    fn visit_block(&mut self, block: &'ast Block) {
        let scope = self.block_scope(block);
        let blocks = self.blocks.len();
        if let Some((scope, _)) = &scope {
            self.imports(scope);
        }
        self.blocks.extend(scope);
        visit::visit_block(self, block);
        self.blocks.truncate(blocks);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        if call.path.is_ident("thread_local") {
            self.add(call.path.span(), "thread_local!".to_owned(), Chance::Static);
        } else {
            self.visit_path(&call.path);
        }
        // Most macros take expressions; what another one takes cannot be read.
        let expressions = Punctuated::<Expr, Token![,]>::parse_terminated;
        if let Ok(expressions) = expressions.parse2(call.tokens.clone()) {
            for expression in &expressions {
                self.visit_expr(expression);
            }
        }
    }

    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        match &*call.func {
            Expr::Path(function) => visit::visit_expr_path(self, function),
            function => self.visit_expr(function),
        }
        for argument in &call.args {
            self.visit_expr(argument);
        }
    }

    fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
        // Statics have names in capitals: this is a variable, whatever a glob has under its name.
        let is_variable = path.path.get_ident().is_some_and(|name| {
            name.to_string()
                .starts_with(|first: char| first.is_lowercase() || first == '_')
        });
        if !is_variable {
            visit::visit_expr_path(self, path);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names = path.segments.iter().map(|one| one.ident.to_string());
        let segments: Vec<String> = names.collect();
        if let Some(first) = segments.first() {
            let scope = self.scope(first);
            self.name(&scope, &segments, path.leading_colon.is_some());
            if let Some(chance) = self.chance(&scope, path, &segments)
                && !has_own_hasher(path, chance)
            {
                self.add(path.span(), segments.join("::"), chance);
            }
        }
        visit::visit_path(self, path);
    }
}

/// A map or set whose hasher is written as its last argument.
fn has_own_hasher(path: &syn::Path, chance: Chance) -> bool {
    let arguments = path
        .segments
        .iter()
        .map(|segment| match &segment.arguments {
            PathArguments::AngleBracketed(arguments) => arguments.args.len(),
            _ => 0,
        });
    match chance {
        Chance::HashedMap => arguments.max() >= Some(3),
        Chance::HashedSet => arguments.max() >= Some(2),
        _ => false,
    }
}

fn is_for_tests(attributes: &[Attribute]) -> bool {
    only_for_tests(attributes) || attributes.iter().any(|one| one.path().is_ident("test"))
}
