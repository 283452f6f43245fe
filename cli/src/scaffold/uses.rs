//! Where the code of a node uses a field of one of its structs, as far as that can be told without rustc's types.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use proc_macro2::{TokenStream, TokenTree};
use syn::ext::IdentExt as _;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};
use syn::{Block, Expr, FnArg, Member, Pat, ReturnType, Signature, Token, Type};

use crate::scan::range;

/// Uses of one field.
#[derive(Debug, Default)]
pub(super) struct Uses {
    /// Its name: `context.field`, `MainOutputs { field: … }`.
    pub(super) names: Vec<Range<usize>>,
    /// Beginnings of `field` in `MainOutputs { field }`, where the name is a variable's, too.
    pub(super) shorthands: Vec<usize>,
    /// Fields of this name of something that cannot be told.
    pub(super) unclear: Vec<usize>,
}

/// Methods that give the struct if they are called on a result or an option of it.
const UNWRAPPING: [&str; 6] = [
    "as_mut",
    "as_ref",
    "clone",
    "expect",
    "unwrap",
    "unwrap_or_default",
];

/// Every use of `field` of the struct called `structure`.
pub(super) fn find(syntax: &syn::File, structure: &str, field: &str) -> Uses {
    let mut makers = Makers {
        structure,
        names: BTreeSet::new(),
    };
    if structure == "MainOutputs" {
        makers.names.insert("cycle".to_owned());
    }
    makers.visit_file(syntax);
    let mut finder = Finder {
        structure,
        field,
        makers: makers.names,
        scopes: vec![BTreeMap::new()],
        uses: Uses::default(),
    };
    finder.visit_file(syntax);
    finder.uses
}

/// Functions that return the struct.
struct Makers<'a> {
    structure: &'a str,
    names: BTreeSet<String>,
}

impl<'ast> Visit<'ast> for Makers<'_> {
    fn visit_signature(&mut self, signature: &'ast Signature) {
        if let ReturnType::Type(_, data) = &signature.output
            && mentions(data, self.structure)
        {
            self.names.insert(signature.ident.to_string());
        }
    }
}

struct Finder<'a> {
    structure: &'a str,
    field: &'a str,
    makers: BTreeSet<String>,
    /// Variables by name, innermost scope last: whether they are the struct. Unknown ones are in no scope or `None`.
    scopes: Vec<BTreeMap<String, Option<bool>>>,
    uses: Uses,
}

impl Finder<'_> {
    fn declare(&mut self, name: &syn::Ident, is_structure: Option<bool>) {
        if let Some(scope) = self.scopes.last_mut() {
            scope.insert(name.to_string(), is_structure);
        }
    }

    fn variable(&self, name: &str) -> Option<bool> {
        let scopes = self.scopes.iter().rev();
        scopes
            .filter_map(|scope| scope.get(name))
            .next()
            .copied()
            .flatten()
    }

    /// Whether an expression is the struct; `None` where that cannot be told.
    fn is_structure(&self, expression: &Expr) -> Option<bool> {
        match expression {
            Expr::Path(path) => self.variable(&path.path.get_ident()?.unraw().to_string()),
            Expr::Struct(literal) => Some(self.is_named(&literal.path)),
            Expr::Paren(inner) => self.is_structure(&inner.expr),
            Expr::Group(inner) => self.is_structure(&inner.expr),
            Expr::Reference(inner) => self.is_structure(&inner.expr),
            Expr::Try(inner) => self.is_structure(&inner.expr),
            Expr::Field(inner) => self.is_of_node(&inner.base).then_some(false),
            Expr::MethodCall(call) if self.makers.contains(&call.method.to_string()) => Some(true),
            Expr::MethodCall(call) if UNWRAPPING.contains(&call.method.to_string().as_str()) => {
                self.is_structure(&call.receiver)
            }
            Expr::Call(call) => match &*call.func {
                Expr::Path(path) => {
                    let last = path.path.segments.last()?;
                    self.makers
                        .contains(&last.ident.to_string())
                        .then_some(true)
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// The node itself or a part of it.
    fn is_of_node(&self, expression: &Expr) -> bool {
        match expression {
            Expr::Path(path) => path.path.is_ident("self") && self.variable("self") != Some(true),
            Expr::Field(inner) => self.is_of_node(&inner.base),
            _ => false,
        }
    }

    fn is_named(&self, path: &syn::Path) -> bool {
        let last = path.segments.last().map(|last| &last.ident);
        last.is_some_and(|last| {
            last == self.structure || last == "Self" && self.variable("self") == Some(true)
        })
    }

    fn declare_pattern(&mut self, pattern: &Pat, is_structure: Option<bool>) {
        match pattern {
            Pat::Ident(name) => self.declare(&name.ident, is_structure),
            Pat::Type(typed) => {
                let is_structure = named_type(&typed.ty).map(|name| name == self.structure);
                self.declare_pattern(&typed.pat, is_structure);
            }
            Pat::Paren(inner) => self.declare_pattern(&inner.pat, is_structure),
            Pat::Reference(inner) => self.declare_pattern(&inner.pat, is_structure),
            // What is taken out of a value may be anything.
            pattern => {
                let mut names = Names(Vec::new());
                names.visit_pat(pattern);
                for name in names.0 {
                    self.declare(name, None);
                }
            }
        }
    }

    /// A function sees no variable around it.
    fn function(&mut self, signature: &Signature, visit: impl FnOnce(&mut Self)) {
        let around = std::mem::replace(&mut self.scopes, vec![BTreeMap::new()]);
        self.declare_arguments(signature);
        visit(self);
        self.scopes = around;
    }

    fn within(&mut self, visit: impl FnOnce(&mut Self)) {
        self.scopes.push(BTreeMap::new());
        visit(self);
        self.scopes.pop();
    }

    fn declare_arguments(&mut self, signature: &Signature) {
        for argument in &signature.inputs {
            if let FnArg::Typed(typed) = argument {
                let is_structure = named_type(&typed.ty).map(|name| name == self.structure);
                self.declare_pattern(&typed.pat, is_structure);
            }
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_impl(&mut self, block: &'ast syn::ItemImpl) {
        let is_own = named_type(&block.self_ty).is_some_and(|name| name == self.structure);
        let around = std::mem::replace(&mut self.scopes, vec![BTreeMap::new()]);
        self.declare(
            &syn::Ident::new("self", block.impl_token.span),
            Some(is_own),
        );
        visit::visit_item_impl(self, block);
        self.scopes = around;
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        self.function(&function.sig, |finder| {
            visit::visit_item_fn(finder, function)
        });
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        self.within(|finder| {
            finder.declare_arguments(&function.sig);
            visit::visit_impl_item_fn(finder, function);
        });
    }

    fn visit_block(&mut self, block: &'ast Block) {
        self.within(|finder| visit::visit_block(finder, block));
    }

    fn visit_expr_closure(&mut self, closure: &'ast syn::ExprClosure) {
        self.within(|finder| {
            for input in &closure.inputs {
                finder.declare_pattern(input, None);
            }
            visit::visit_expr_closure(finder, closure);
        });
    }

    /// Names of a condition are known in the conditions behind it and in the block.
    fn visit_expr_if(&mut self, condition: &'ast syn::ExprIf) {
        self.within(|finder| {
            finder.visit_expr(&condition.cond);
            finder.visit_block(&condition.then_branch);
        });
        if let Some((_, otherwise)) = &condition.else_branch {
            self.visit_expr(otherwise);
        }
    }

    fn visit_expr_while(&mut self, repeated: &'ast syn::ExprWhile) {
        self.within(|finder| visit::visit_expr_while(finder, repeated));
    }

    fn visit_expr_let(&mut self, condition: &'ast syn::ExprLet) {
        visit::visit_expr_let(self, condition);
        self.declare_pattern(&condition.pat, None);
    }

    fn visit_expr_for_loop(&mut self, repeated: &'ast syn::ExprForLoop) {
        self.visit_expr(&repeated.expr);
        self.within(|finder| {
            finder.visit_pat(&repeated.pat);
            finder.declare_pattern(&repeated.pat, None);
            finder.visit_block(&repeated.body);
        });
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        self.within(|finder| {
            finder.declare_pattern(&arm.pat, None);
            visit::visit_arm(finder, arm);
        });
    }

    fn visit_local(&mut self, local: &'ast syn::Local) {
        visit::visit_local(self, local);
        let value = local.init.as_ref().map(|init| &*init.expr);
        if let (Some(Expr::Closure(closure)), Pat::Ident(name)) = (value, &local.pat)
            && last_value(&closure.body).is_some_and(|value| self.is_structure(value) == Some(true))
        {
            self.makers.insert(name.ident.to_string());
        }
        let is_structure = value.and_then(|value| self.is_structure(value));
        self.declare_pattern(&local.pat, is_structure);
    }

    fn visit_expr_struct(&mut self, literal: &'ast syn::ExprStruct) {
        let wanted = self.field;
        if self.is_named(&literal.path) {
            for value in literal
                .fields
                .iter()
                .filter(|value| names(&value.member, wanted))
            {
                let name = range(value.member.span());
                match value.colon_token {
                    Some(_) => self.uses.names.push(name),
                    None => self.uses.shorthands.push(name.start),
                }
            }
        }
        visit::visit_expr_struct(self, literal);
    }

    fn visit_pat_struct(&mut self, pattern: &'ast syn::PatStruct) {
        let wanted = self.field;
        if self.is_named(&pattern.path) {
            for field in pattern
                .fields
                .iter()
                .filter(|field| names(&field.member, wanted))
            {
                match field.colon_token {
                    Some(_) => self.uses.names.push(range(field.member.span())),
                    None => self.uses.shorthands.push(range(field.pat.span()).start),
                }
            }
        }
        visit::visit_pat_struct(self, pattern);
    }

    fn visit_expr_field(&mut self, access: &'ast syn::ExprField) {
        if names(&access.member, self.field) {
            let name = range(access.member.span());
            match self.is_structure(&access.base) {
                Some(true) => self.uses.names.push(name),
                None if !self.is_of_node(&access.base) => self.uses.unclear.push(name.start),
                _ => {}
            }
        }
        visit::visit_expr_field(self, access);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        // `assert_eq!(…)` and its like take expressions.
        let arguments = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated);
        match arguments {
            Ok(arguments) => arguments
                .iter()
                .for_each(|argument| Visit::visit_expr(&mut *self, argument)),
            // Patterns of a macro, or what it makes of words of its own.
            Err(_) => accesses(call.tokens.clone(), self.field, &mut self.uses.unclear),
        }
    }
}

/// Adds where `.field` stands among tokens.
fn accesses(tokens: TokenStream, field: &str, found: &mut Vec<usize>) {
    let mut is_behind_point = false;
    for token in tokens {
        let is_point = matches!(&token, TokenTree::Punct(mark) if mark.as_char() == '.');
        match token {
            TokenTree::Group(group) => accesses(group.stream(), field, found),
            // Words of macros are as they are written.
            TokenTree::Ident(name) if is_behind_point && name.unraw() == field => {
                found.push(range(name.span()).start);
            }
            _ => {}
        }
        is_behind_point = is_point;
    }
}

/// Every name that a pattern declares.
struct Names<'a>(Vec<&'a syn::Ident>);

impl<'ast> Visit<'ast> for Names<'ast> {
    fn visit_pat_ident(&mut self, pattern: &'ast syn::PatIdent) {
        self.0.push(&pattern.ident);
        visit::visit_pat_ident(self, pattern);
    }
}

fn names(member: &Member, field: &str) -> bool {
    matches!(member, Member::Named(name) if name.unraw() == field)
}

/// The value of a closure's body.
fn last_value(body: &Expr) -> Option<&Expr> {
    match body {
        Expr::Block(block) => match block.block.stmts.last()? {
            syn::Stmt::Expr(value, None) => Some(value),
            _ => None,
        },
        value => Some(value),
    }
}

/// The last name of a type, references aside.
fn named_type(data: &Type) -> Option<String> {
    match data {
        Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()),
        Type::Reference(reference) => named_type(&reference.elem),
        _ => None,
    }
}

/// Whether a type is a struct of this name, or a result or option of it.
fn mentions(data: &Type, name: &str) -> bool {
    let Type::Path(path) = data else {
        return false;
    };
    path.path.segments.last().is_some_and(|last| {
        let inner = match &last.arguments {
            syn::PathArguments::AngleBracketed(arguments) => arguments.args.first(),
            _ => None,
        };
        last.ident == name
            || matches!(inner, Some(syn::GenericArgument::Type(inner)) if mentions(inner, name))
    })
}

#[cfg(test)]
mod tests {
    use super::find;

    /// The text with every use in brackets, `<` before what stands for a variable, too, and `?` behind what is unclear.
    fn marked(text: &str, structure: &str) -> String {
        let syntax = syn::parse_file(text).expect("it is Rust");
        let uses = find(&syntax, structure, "ball");
        let mut marks: Vec<(usize, &str)> = Vec::new();
        for name in &uses.names {
            marks.extend([(name.start, "["), (name.end, "]")]);
        }
        marks.extend(uses.shorthands.iter().map(|start| (*start, "<")));
        marks.extend(uses.unclear.iter().map(|start| (*start, "?")));
        marks.sort_unstable();
        let mut marked = text.to_owned();
        for (place, mark) in marks.into_iter().rev() {
            marked.insert_str(place, mark);
        }
        marked
    }

    #[test]
    fn a_returned_output_is_found_where_it_is_made_and_where_tests_look_at_it() {
        let text = "impl Node { fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> { \
            let ball = self.ball + context.ball; let other = Other { ball }; \
            Ok(MainOutputs { ball: ball.into() }) } } \
            mod tests { fn run() -> MainOutputs { node.cycle(context()).unwrap() } \
            fn test() { let outputs = run(); assert_eq!(outputs.ball.value, 1); \
            let MainOutputs { ball, .. } = node.cycle(c)?; assert!(seen.ball); \
            node.cycle(c).unwrap().ball.value } }";
        let expected = "impl Node { fn cycle(&mut self, context: CycleContext) -> Result<MainOutputs> { \
            let ball = self.ball + context.ball; let other = Other { ball }; \
            Ok(MainOutputs { [ball]: ball.into() }) } } \
            mod tests { fn run() -> MainOutputs { node.cycle(context()).unwrap() } \
            fn test() { let outputs = run(); assert_eq!(outputs.[ball].value, 1); \
            let MainOutputs { <ball, .. } = node.cycle(c)?; assert!(seen.?ball); \
            node.cycle(c).unwrap().[ball].value } }";
        assert_eq!(marked(text, "MainOutputs"), expected);
    }

    #[test]
    fn an_output_in_place_is_found_in_the_context() {
        let text = "impl Node { fn cycle(&mut self, mut context: CycleContext<impl Eye>) -> Result<MainOutputs> { \
            self.ball = *context.ball; context.fill(); Ok(MainOutputs { ball: 1 }) } } \
            impl CycleContext<'_> { fn fill(&mut self) { self.ball.clear(); } } \
            fn test() { let context = |n| CycleContext { ball: &mut ball, n }; context(1).ball; }";
        let expected = "impl Node { fn cycle(&mut self, mut context: CycleContext<impl Eye>) -> Result<MainOutputs> { \
            self.ball = *context.[ball]; context.fill(); Ok(MainOutputs { ball: 1 }) } } \
            impl CycleContext<'_> { fn fill(&mut self) { self.[ball].clear(); } } \
            fn test() { let context = |n| CycleContext { [ball]: &mut ball, n }; context(1).[ball]; }";
        assert_eq!(marked(text, "CycleContext"), expected);
    }

    #[test]
    fn what_a_macro_makes_of_its_words_is_unclear() {
        let text = "macro_rules! seen { ($of:expr) => { $of.ball.value + ball } } \
            fn test() { seen!(seen.ball); select! { ball = node.ball => [1 - ball] } }";
        let expected = "macro_rules! seen { ($of:expr) => { $of.?ball.value + ball } } \
            fn test() { seen!(seen.?ball); select! { ball = node.?ball => [1 - ball] } }";
        assert_eq!(marked(text, "MainOutputs"), expected);
    }

    #[test]
    fn another_variable_of_the_same_name_is_not_the_struct() {
        let text = "fn test() { let seen = node.cycle(c).unwrap(); seen.ball; \
            if let Some((seen, 1)) = other && seen.ball { seen.ball; } seen.ball; \
            for seen in list { seen.ball; } while let Some(&seen) = next() { seen.ball; } \
            match other { Seen { seen, .. } => seen.ball, [seen @ 1, ..] if seen.ball => 1, _ => seen.ball }; \
            list.map(|(seen, _)| seen.ball); \
            fn inner(seen: u8) { seen.ball; } fn further() { seen.ball; } \
            let Some(seen) = other else { seen.ball }; seen.ball; \
            let (seen, other) = (node.cycle(c).unwrap(), 1); seen.ball; }";
        let expected = "fn test() { let seen = node.cycle(c).unwrap(); seen.[ball]; \
            if let Some((seen, 1)) = other && seen.?ball { seen.?ball; } seen.[ball]; \
            for seen in list { seen.?ball; } while let Some(&seen) = next() { seen.?ball; } \
            match other { Seen { seen, .. } => seen.?ball, [seen @ 1, ..] if seen.?ball => 1, _ => seen.[ball] }; \
            list.map(|(seen, _)| seen.?ball); \
            fn inner(seen: u8) { seen.ball; } fn further() { seen.?ball; } \
            let Some(seen) = other else { seen.[ball] }; seen.?ball; \
            let (seen, other) = (node.cycle(c).unwrap(), 1); seen.?ball; }";
        assert_eq!(marked(text, "MainOutputs"), expected);
    }
}
