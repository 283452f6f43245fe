//! Turns absolute paths into short names and the `use` lines that they need.
//!
//! Quoted code names everything absolutely (`::framework::Result`, `crate::parameters::Parameters`).
//! Here each path is shortened to the name it ends in, with one `use` line per name, sorted. So
//! nothing is imported that is not used, and nothing is forgotten. Where two paths end in the same
//! name, or a name would hide another, the path stays whole.

use std::collections::{BTreeMap, BTreeSet};

use syn::punctuated::Punctuated;
use syn::visit_mut::{self, VisitMut};
use syn::{GenericArgument, Item, ItemUse, Path, Token};

use crate::model::names::{PRELUDE, is_primitive, last};

/// Shortens the absolute paths of these items and returns the `use` lines for them.
///
/// A path is imported up to its first capitalised name, a path without one whole; `modules` are
/// imported as modules, so that `control::motion::CycleContext` stays `motion::CycleContext`.
/// `use` items among them (of traits, whose names code does not say) join the others.
pub(super) fn import(items: &mut Vec<Item>, modules: &[String]) -> Vec<Item> {
    let mut collect = Collect {
        modules,
        found: take_uses(items),
    };
    for item in items.iter_mut() {
        collect.visit_item_mut(item);
    }
    let own_names = own_names(items);
    let imported = choose(collect.found, &own_names);
    let mut names = own_names;
    names.extend(imported.iter().map(|path| last(path).to_owned()));
    let mut shorten = Shorten {
        modules,
        imported: &imported,
        names: &names,
    };
    for item in items.iter_mut() {
        shorten.visit_item_mut(item);
    }
    let mut uses: Vec<ItemUse> = imported
        .iter()
        .map(|path| quote_use(path, &names))
        .collect();
    uses.sort_by_key(|item| (origin_rank(origin(item)), imported_path(item)));
    uses.into_iter().map(Item::Use).collect()
}

/// Takes the `use` items out: their paths.
fn take_uses(items: &mut Vec<Item>) -> BTreeSet<String> {
    let is_use = |item: &mut Item| matches!(item, Item::Use(_));
    let uses = items.extract_if(.., is_use).filter_map(|item| match item {
        Item::Use(item) => Some(imported_path(&item).replace(' ', "")),
        _ => None,
    });
    uses.collect()
}

/// Where an imported name comes from: `std`, `crate` or another crate.
pub(super) fn origin(item: &ItemUse) -> &'static str {
    match &item.tree {
        syn::UseTree::Path(path) if path.ident == "std" => "std",
        syn::UseTree::Path(path) if path.ident == "crate" => "crate",
        _ => "crates",
    }
}

fn origin_rank(origin: &str) -> usize {
    ["std", "crates", "crate"]
        .iter()
        .position(|known| *known == origin)
        .unwrap_or(0)
}

/// The path of a `use` line without a leading `::`, which orders nothing.
fn imported_path(item: &ItemUse) -> String {
    quote::ToTokens::to_token_stream(&item.tree).to_string()
}

fn quote_use(path: &str, names: &BTreeSet<String>) -> ItemUse {
    let path = spelled(path, names);
    syn::parse_quote!(use #path;)
}

/// The path as code writes it: with a leading `::` where its first name means something else here.
fn spelled(path: &str, names: &BTreeSet<String>) -> Path {
    let first = path.split("::").next().unwrap_or(path);
    let text = if names.contains(first) {
        format!("::{path}")
    } else {
        path.to_owned()
    };
    syn::parse_str(&text).expect("an imported path is a path")
}

/// Of all paths that end in the same name one may be imported: of this crate before the
/// framework's and std's before any other's. What is called `f32` is not: the file may mean the primitive elsewhere.
fn choose(found: BTreeSet<String>, own_names: &BTreeSet<String>) -> BTreeSet<String> {
    let mut by_name: BTreeMap<String, BTreeMap<u8, Vec<String>>> = BTreeMap::new();
    for path in found {
        let rank = match path.split("::").next() {
            Some("crate") => 0,
            Some("framework" | "serde" | "std") => 1,
            _ => 2,
        };
        by_name
            .entry(last(&path).to_owned())
            .or_default()
            .entry(rank)
            .or_default()
            .push(path);
    }
    let mut chosen = BTreeSet::new();
    for (name, ranks) in by_name {
        if let Some((rank, mut paths)) = ranks.into_iter().next()
            && paths.len() == 1
            && !own_names.contains(&name)
            && !is_primitive(&name)
            && (rank < 2 || !PRELUDE.contains(&name.as_str()))
        {
            chosen.extend(paths.pop());
        }
    }
    chosen
}

/// Names that the items themselves bring: theirs, and their type parameters.
fn own_names(items: &mut [Item]) -> BTreeSet<String> {
    let mut names = OwnNames(BTreeSet::new());
    for item in items {
        names.visit_item_mut(item);
    }
    names.0
}

struct OwnNames(BTreeSet<String>);

impl VisitMut for OwnNames {
    fn visit_item_mut(&mut self, item: &mut Item) {
        let name = match item {
            Item::Const(item) => Some(&item.ident),
            Item::Enum(item) => Some(&item.ident),
            Item::Fn(item) => Some(&item.sig.ident),
            Item::Mod(item) => Some(&item.ident),
            Item::Struct(item) => Some(&item.ident),
            _ => None,
        };
        self.0.extend(name.map(ToString::to_string));
        visit_mut::visit_item_mut(self, item);
    }

    fn visit_type_param_mut(&mut self, parameter: &mut syn::TypeParam) {
        self.0.insert(parameter.ident.to_string());
    }
}

/// The parts of `<u8>::MAX` and `<T as Trait>::Out`, which stay whole.
fn visit_qualified(qself: &mut syn::QSelf, path: &mut Path, visitor: &mut impl VisitMut) {
    visitor.visit_qself_mut(qself);
    for segment in &mut path.segments {
        visitor.visit_path_segment_mut(segment);
    }
}

struct Collect<'a> {
    modules: &'a [String],
    found: BTreeSet<String>,
}

impl VisitMut for Collect<'_> {
    fn visit_type_path_mut(&mut self, data: &mut syn::TypePath) {
        match &mut data.qself {
            Some(qself) => visit_qualified(qself, &mut data.path, self),
            None => self.visit_path_mut(&mut data.path),
        }
    }

    fn visit_expr_path_mut(&mut self, value: &mut syn::ExprPath) {
        match &mut value.qself {
            Some(qself) => visit_qualified(qself, &mut value.path, self),
            None => self.visit_path_mut(&mut value.path),
        }
    }

    fn visit_path_mut(&mut self, path: &mut Path) {
        if let Some((imported, _)) = split(path, self.modules) {
            self.found.insert(imported);
        }
        visit_mut::visit_path_mut(self, path);
    }

    fn visit_attribute_mut(&mut self, attribute: &mut syn::Attribute) {
        visit_derive(attribute, |path| self.visit_path_mut(path));
    }

    fn visit_macro_mut(&mut self, invocation: &mut syn::Macro) {
        self.visit_path_mut(&mut invocation.path);
        visit_vec(invocation, |element| self.visit_expr_mut(element));
    }
}

struct Shorten<'a> {
    modules: &'a [String],
    imported: &'a BTreeSet<String>,
    names: &'a BTreeSet<String>,
}

impl VisitMut for Shorten<'_> {
    fn visit_type_path_mut(&mut self, data: &mut syn::TypePath) {
        match &mut data.qself {
            Some(qself) => visit_qualified(qself, &mut data.path, self),
            None => self.visit_path_mut(&mut data.path),
        }
    }

    fn visit_expr_path_mut(&mut self, value: &mut syn::ExprPath) {
        match &mut value.qself {
            Some(qself) => visit_qualified(qself, &mut value.path, self),
            None => self.visit_path_mut(&mut value.path),
        }
    }

    fn visit_path_mut(&mut self, path: &mut Path) {
        visit_mut::visit_path_mut(self, path);
        let Some((imported, length)) = split(path, self.modules) else {
            return;
        };
        if self.imported.contains(&imported) {
            path.leading_colon = None;
            path.segments = path.segments.iter().skip(length - 1).cloned().collect();
        } else if !self.names.contains(&path.segments[0].ident.to_string()) {
            path.leading_colon = None;
        }
    }

    fn visit_generic_argument_mut(&mut self, argument: &mut GenericArgument) {
        visit_mut::visit_generic_argument_mut(self, argument);
        // A constant of one name needs no braces.
        if let GenericArgument::Const(value) = argument
            && let Some(path) = path_in_braces(value)
            && path.path.get_ident().is_some()
        {
            *argument = syn::parse_quote!(#path);
        }
    }

    fn visit_type_array_mut(&mut self, array: &mut syn::TypeArray) {
        visit_mut::visit_type_array_mut(self, array);
        if let Some(path) = path_in_braces(&array.len) {
            array.len = syn::Expr::Path(path);
        }
    }

    fn visit_attribute_mut(&mut self, attribute: &mut syn::Attribute) {
        visit_derive(attribute, |path| self.visit_path_mut(path));
    }

    fn visit_macro_mut(&mut self, invocation: &mut syn::Macro) {
        self.visit_path_mut(&mut invocation.path);
        visit_vec(invocation, |element| self.visit_expr_mut(element));
    }
}

/// The path of a block that is nothing but one.
fn path_in_braces(value: &syn::Expr) -> Option<syn::ExprPath> {
    let syn::Expr::Block(block) = value else {
        return None;
    };
    match block.block.stmts.as_slice() {
        [syn::Stmt::Expr(syn::Expr::Path(path), None)] => Some(path.clone()),
        _ => None,
    }
}

/// The part of an absolute path that is imported, and its number of segments.
fn split(path: &Path, modules: &[String]) -> Option<(String, usize)> {
    let own = path.segments.len() > 1 && path.segments[0].ident == "crate";
    if path.leading_colon.is_none() && !own {
        return None;
    }
    let mut imported = String::new();
    for (position, segment) in path.segments.iter().enumerate() {
        let name = segment.ident.to_string();
        if position > 0 {
            imported.push_str("::");
        }
        imported.push_str(&name);
        if modules.contains(&imported) || name.starts_with(char::is_uppercase) {
            return Some((imported, position + 1));
        }
    }
    Some((imported, path.segments.len()))
}

/// Visits the traits of a `derive`, which are mere tokens to syn.
fn visit_derive(attribute: &mut syn::Attribute, mut visit: impl FnMut(&mut Path)) {
    let syn::Meta::List(list) = &mut attribute.meta else {
        return;
    };
    if list.path.is_ident("derive") {
        let parser = Punctuated::<Path, Token![,]>::parse_terminated;
        let mut traits = syn::parse::Parser::parse2(parser, list.tokens.clone())
            .expect("a quoted derive lists paths");
        traits.iter_mut().for_each(&mut visit);
        list.tokens = quote::ToTokens::into_token_stream(traits);
    }
}

/// Visits the elements of a `vec!`, which are mere tokens to syn.
fn visit_vec(invocation: &mut syn::Macro, mut visit: impl FnMut(&mut syn::Expr)) {
    if invocation.path.is_ident("vec") {
        let parser = Punctuated::<syn::Expr, Token![,]>::parse_terminated;
        let mut elements = syn::parse::Parser::parse2(parser, invocation.tokens.clone())
            .expect("a quoted vec lists expressions");
        elements.iter_mut().for_each(&mut visit);
        invocation.tokens = quote::ToTokens::into_token_stream(elements);
    }
}

#[cfg(test)]
mod tests;
