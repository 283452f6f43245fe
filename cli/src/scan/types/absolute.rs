//! Types and constants whose meaning hulkgen does not know, with every name in them as generated code has to write it.
//!
//! Invariant: what comes back as `lost` is the only part of a text that means something else elsewhere.

use std::collections::BTreeSet;
use std::rc::Rc;

use quote::{ToTokens, quote};
use syn::visit::{self, Visit};
use syn::visit_mut::{self, VisitMut};
use syn::{Expr, Item, Lifetime, PatIdent, Path, PathArguments, PathSegment, QSelf, Type};

use super::{Resolved, Shape, Substitutions, lifetime_text, written};
use crate::scan::beyond::{makes, may_make};
use crate::scan::library::Library;
use crate::scan::lookup::{Found, ItemId};
use crate::scan::module::{Entry, Module, Visible};

/// Functions and variants that are in scope everywhere, as constants use them.
const EVERYWHERE: &[&str] = &[
    "Err",
    "None",
    "Ok",
    "Some",
    "align_of",
    "align_of_val",
    "drop",
    "size_of",
    "size_of_val",
];

impl Library<'_> {
    pub(super) fn absolute_type(
        &self,
        module: &Rc<Module>,
        data: &Type,
        generics: &Substitutions,
    ) -> Resolved {
        let mut data = data.clone();
        let mut absolute = Absolute::new(self, module, generics);
        absolute.visit_type_mut(&mut data);
        absolute.resolved(&data)
    }

    pub(in crate::scan) fn absolute_path(
        &self,
        module: &Rc<Module>,
        path: &Path,
        generics: &Substitutions,
    ) -> Resolved {
        let data = Type::Path(syn::TypePath {
            qself: None,
            path: path.clone(),
        });
        self.absolute_type(module, &data, generics)
    }

    pub(super) fn absolute_constant(
        &self,
        module: &Rc<Module>,
        value: &Expr,
        generics: &Substitutions,
    ) -> Resolved {
        let mut absolute = Absolute::new(self, module, generics);
        absolute.visit_expr(value);
        let mut value = value.clone();
        absolute.visit_expr_mut(&mut value);
        absolute.resolved(&value)
    }

    /// What stands between `<` and `>` of a bound, with its brackets; the bound itself is of no matter.
    pub(in crate::scan) fn absolute_arguments(
        &self,
        module: &Rc<Module>,
        arguments: &PathArguments,
    ) -> Resolved {
        let mut arguments = arguments.clone();
        let generics = Substitutions::new();
        let mut absolute = Absolute::new(self, module, &generics);
        absolute.visit_path_arguments_mut(&mut arguments);
        absolute.resolved(&arguments)
    }
}

/// Makes names absolute.
struct Absolute<'a> {
    library: &'a Library<'a>,
    module: &'a Rc<Module>,
    generics: &'a Substitutions,
    /// Variables of a block within a constant.
    variables: BTreeSet<String>,
    private: Vec<ItemId>,
    lost: Vec<String>,
    unsure: Vec<String>,
}

impl<'ast> Visit<'ast> for Absolute<'_> {
    fn visit_pat_ident(&mut self, pattern: &'ast PatIdent) {
        self.variables.insert(pattern.ident.to_string());
        visit::visit_pat_ident(self, pattern);
    }
}

impl VisitMut for Absolute<'_> {
    fn visit_type_mut(&mut self, data: &mut Type) {
        if let Type::Path(path) = data {
            if let Some(text) = self.argument(path.qself.as_ref(), &path.path) {
                *data = syn::parse_str(&text).unwrap_or_else(|_| data.clone());
                return;
            }
            self.qualify(&mut path.qself, &mut path.path);
            return;
        }
        visit_mut::visit_type_mut(self, data);
    }

    fn visit_expr_mut(&mut self, value: &mut Expr) {
        match value {
            Expr::Path(path) => {
                if let Some(text) = self.argument(path.qself.as_ref(), &path.path) {
                    *value = syn::parse_str(&text).unwrap_or_else(|_| value.clone());
                } else {
                    self.qualify(&mut path.qself, &mut path.path);
                }
            }
            // What a macro does with its names is its own.
            Expr::Macro(call) => self.lost.push(written(call)),
            _ => visit_mut::visit_expr_mut(self, value),
        }
    }

    fn visit_lifetime_mut(&mut self, lifetime: &mut Lifetime) {
        let text = lifetime_text(lifetime, self.generics);
        if let Ok(given) = syn::parse_str(&text) {
            *lifetime = given;
        }
    }

    fn visit_path_mut(&mut self, path: &mut Path) {
        visit_mut::visit_path_mut(self, path);
        self.rewrite(path);
    }
}

impl<'a> Absolute<'a> {
    fn new(library: &'a Library<'a>, module: &'a Rc<Module>, generics: &'a Substitutions) -> Self {
        Self {
            library,
            module,
            generics,
            variables: BTreeSet::new(),
            private: Vec::new(),
            lost: Vec::new(),
            unsure: Vec::new(),
        }
    }

    fn resolved(self, tokens: &impl ToTokens) -> Resolved {
        Resolved {
            text: written(tokens),
            shape: Shape::Unknown,
            private: self.private,
            lost: self.lost,
            unsure: self.unsure,
        }
    }

    /// What the parameter of an alias stands for, if the path is one.
    fn argument(&mut self, qself: Option<&QSelf>, path: &Path) -> Option<String> {
        let name = path.get_ident().filter(|_| qself.is_none())?;
        let argument = self.generics.get(&name.to_string())?;
        self.private.extend(argument.private.iter().cloned());
        self.lost.extend(argument.lost.iter().cloned());
        self.unsure.extend(argument.unsure.iter().cloned());
        Some(argument.text.clone())
    }

    /// A path that may belong to a type: `<T as Trait>::Out`, `T::Out` of a parameter.
    fn qualify(&mut self, qself: &mut Option<QSelf>, path: &mut Path) {
        if let Some(own) = qself {
            self.visit_type_mut(&mut own.ty);
            let mut bound: Path = path.clone();
            bound.segments = path.segments.iter().take(own.position).cloned().collect();
            let rest: Vec<PathSegment> = path.segments.iter().skip(own.position).cloned().collect();
            let rest = self.arguments_of(rest);
            let bound = (own.position > 0).then(|| {
                self.visit_path_mut(&mut bound);
                quote!(as #bound)
            });
            let data = own.ty.clone();
            replace(qself, path, quote!(<#data #bound>::#(#rest)::*));
            return;
        }
        let first = path.segments.first().cloned();
        let is_short = path.segments.len() > 1 && path.leading_colon.is_none();
        if let Some(first) = first.filter(|first| is_short && self.is_parameter(first)) {
            let rest = self.arguments_of(path.segments.iter().skip(1).cloned().collect());
            let mut data: Type = syn::parse_quote!(#first);
            self.visit_type_mut(&mut data);
            replace(qself, path, quote!(<#data>::#(#rest)::*));
            return;
        }
        self.visit_path_mut(path);
    }

    fn arguments_of(&mut self, mut segments: Vec<PathSegment>) -> Vec<PathSegment> {
        for segment in &mut segments {
            self.visit_path_arguments_mut(&mut segment.arguments);
        }
        segments
    }

    fn is_parameter(&self, first: &PathSegment) -> bool {
        self.generics.contains_key(&first.ident.to_string())
    }

    fn rewrite(&mut self, path: &mut Path) {
        let names: Vec<String> = path
            .segments
            .iter()
            .map(|one| one.ident.to_string())
            .collect();
        let is_variable = names.len() == 1 && self.variables.contains(&names[0]);
        if names.is_empty() || is_variable {
            return;
        }
        for end in (1..=names.len()).rev() {
            let mut front = path.clone();
            front.segments = path.segments.iter().take(end).cloned().collect();
            let text = match self.library.find(self.module, &front) {
                Some(Found::Item(item)) => self.name(item),
                Some(Found::Module(module)) if end < names.len() => {
                    if let Some(text) = self.trace(&module, &names[end], &mut BTreeSet::new()) {
                        begin_with(path, end + 1, &text);
                        return;
                    }
                    self.name_in(&module, &names[end]);
                    module.path.clone()
                }
                Some(Found::Standard(rest)) => format!("std::{}", rest.join("::")),
                Some(Found::Foreign(rest)) => rest.join("::"),
                Some(Found::Prelude(_)) => return,
                _ => continue,
            };
            begin_with(path, end, &text);
            return;
        }
        let first = &names[0];
        if names.len() == 1 && EVERYWHERE.contains(&first.as_str()) {
            return;
        }
        match self.trace(self.module, first, &mut BTreeSet::new()) {
            Some(text) => begin_with(path, 1, &text),
            None => self.lost.push(written(path)),
        }
    }

    /// Where a name comes from that is no type's, or that several items of one module have, or that a macro may define.
    /// Imports and globs may lead in circles: nothing is looked for twice.
    fn trace(
        &mut self,
        module: &Rc<Module>,
        name: &str,
        seen: &mut BTreeSet<(String, String)>,
    ) -> Option<String> {
        if !seen.insert((module.path.clone(), name.to_owned())) {
            return None;
        }
        let own = self.library.unlisted(module, name);
        // A glob passes over what is private.
        if let Some(item) = own.filter(|item| item.public || module.path == self.module.path) {
            return Some(self.name(item));
        }
        if let Some(Entry::Import(import)) = module.entries.get(name) {
            let (last, front) = import.segments.split_last()?;
            return match self.library.follow(module, front, import.absolute, 0)? {
                Found::Module(module) => self.trace(&module, last, seen),
                _ => None,
            };
        }
        if may_make(module, name) {
            return Some(self.made(module, name));
        }
        let globs: Vec<_> = module.globs.clone();
        globs.iter().find_map(|glob| {
            let is_seen = glob.visible.reaches(self.module, module);
            match self
                .library
                .follow_import(module, glob)
                .filter(|_| is_seen)?
            {
                Found::Module(target) if target.path != module.path => {
                    self.trace(&target, name, seen)
                }
                _ => None,
            }
        })
    }

    /// The path of what a macro may define.
    fn made(&mut self, module: &Rc<Module>, name: &str) -> String {
        let definition = format!("{}::{name}", module.path);
        let found = self.library.public_way_of_made(module, name);
        let mut items = module.syntax.items.iter();
        let call = items.position(|item| makes(item, name));
        // A macro may speak of what a glob brings in from where nobody here can look.
        let is_certain = module.globs.iter().all(|glob| {
            let target = self.library.follow_import(module, glob);
            matches!(target, Some(Found::Module(_)))
        });
        match (found, call) {
            (None, Some(index)) if is_certain => self.private.push(ItemId {
                module: module.clone(),
                index,
                name: name.to_owned(),
                public: false,
            }),
            (Some((path, _)), _) => {
                self.unsure.push(path.clone());
                return path;
            }
            (None, _) => self.unsure.push(definition.clone()),
        }
        definition
    }

    fn name(&mut self, item: ItemId) -> String {
        if self.library.is_sometimes_public(&item) {
            self.unsure.push(item.path());
        }
        let public = self.library.public_path(&item);
        public.unwrap_or_else(|| {
            let path = item.path();
            self.private.push(item);
            path
        })
    }

    /// Notes a function or the like of another module that generated code cannot name.
    fn name_in(&mut self, module: &Rc<Module>, name: &str) {
        match self.library.unlisted(module, name) {
            Some(item) => drop(self.name(item)),
            None => self.unsure.push(format!("{}::{name}", module.path)),
        }
    }
}

impl Library<'_> {
    /// What has a name in a module and is no type: a function, a static, or one of several items that `cfg` chooses from.
    pub(in crate::scan) fn unlisted(&self, module: &Rc<Module>, name: &str) -> Option<ItemId> {
        let items = module.syntax.items.iter().enumerate();
        let mut found = items.filter_map(|(index, item)| {
            let (ident, visibility) = match item {
                Item::Fn(item) => (&item.sig.ident, &item.vis),
                Item::Static(item) => (&item.ident, &item.vis),
                Item::Struct(item) => (&item.ident, &item.vis),
                Item::Enum(item) => (&item.ident, &item.vis),
                Item::Union(item) => (&item.ident, &item.vis),
                Item::Type(item) => (&item.ident, &item.vis),
                Item::Trait(item) => (&item.ident, &item.vis),
                Item::Const(item) => (&item.ident, &item.vis),
                _ => return None,
            };
            (ident == name).then(|| ItemId {
                module: module.clone(),
                index,
                name: name.to_owned(),
                public: Visible::new(visibility) == Visible::Everywhere,
            })
        });
        found.next()
    }
}

/// Puts another beginning in the place of the first names; the arguments of the last of them stay.
fn begin_with(path: &mut Path, end: usize, text: &str) {
    let arguments = path.segments[end - 1].arguments.clone();
    let rest: Vec<PathSegment> = path.segments.iter().skip(end).cloned().collect();
    let Ok(mut front) = syn::parse_str::<Path>(text) else {
        return;
    };
    if let Some(last) = front.segments.last_mut() {
        last.arguments = arguments;
    }
    front.segments.extend(rest);
    *path = front;
}

fn replace(qself: &mut Option<QSelf>, path: &mut Path, tokens: proc_macro2::TokenStream) {
    if let Ok(parsed) = syn::parse2::<syn::ExprPath>(tokens) {
        *qself = parsed.qself;
        *path = parsed.path;
    }
}
