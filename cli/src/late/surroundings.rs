//! What stands around a place of a generated file.

use proc_macro2::{LineColumn, Span};
use syn::Member;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::scan::doc;

/// Names around a place, as far as there are any.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Surroundings {
    /// The function.
    pub(super) function: Option<String>,
    /// The fields and bindings, innermost first, then what else its statement names.
    pub(super) names: Vec<String>,
    /// What the comment of the field says, or the texts that the call is given: paths of nodes.
    pub(super) texts: Vec<String>,
}

impl Surroundings {
    /// Of a line and a column, both from 1.
    pub(super) fn of(text: &str, line: usize, column: usize) -> Self {
        let place = LineColumn {
            line,
            column: column.saturating_sub(1),
        };
        let mut search = Search {
            place,
            around: Vec::new(),
            beside: Vec::new(),
            found: Self::default(),
        };
        if let Ok(file) = syn::parse_file(text) {
            search.visit_file(&file);
        }
        let Search {
            mut found,
            around,
            beside,
            ..
        } = search;
        found.names = around.into_iter().rev().chain(beside).collect();
        found
    }
}

struct Search {
    place: LineColumn,
    /// Outermost first.
    around: Vec<String>,
    beside: Vec<String>,
    found: Surroundings,
}

impl Search {
    fn is_in(&self, span: Span) -> bool {
        (span.start()..=span.end()).contains(&self.place)
    }
}

impl<'ast> Visit<'ast> for Search {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        if self.is_in(item.span()) {
            visit::visit_item(self, item);
        }
    }

    fn visit_signature(&mut self, signature: &'ast syn::Signature) {
        self.found.function = Some(signature.ident.to_string());
        visit::visit_signature(self, signature);
    }

    fn visit_impl_item(&mut self, item: &'ast syn::ImplItem) {
        if self.is_in(item.span()) {
            visit::visit_impl_item(self, item);
        }
    }

    fn visit_field(&mut self, field: &'ast syn::Field) {
        if self.is_in(field.span()) {
            self.around
                .extend(field.ident.iter().map(ToString::to_string));
            let docs = field.attrs.iter().filter_map(doc);
            self.found.texts.extend(docs.flat_map(|doc| words(&doc)));
        }
    }

    fn visit_stmt(&mut self, statement: &'ast syn::Stmt) {
        if self.is_in(statement.span()) {
            self.beside.clear();
            visit::visit_stmt(self, statement);
        }
    }

    fn visit_local(&mut self, local: &'ast syn::Local) {
        self.visit_pat(&local.pat);
        if let Some(start) = &local.init {
            self.visit_expr(&start.expr);
        }
    }

    fn visit_expr_let(&mut self, binding: &'ast syn::ExprLet) {
        if self.is_in(binding.span()) {
            visit::visit_expr_let(self, binding);
        }
    }

    fn visit_pat_ident(&mut self, pattern: &'ast syn::PatIdent) {
        self.around.push(pattern.ident.to_string());
    }

    fn visit_field_value(&mut self, value: &'ast syn::FieldValue) {
        if self.is_in(value.span()) {
            self.around.push(name(&value.member));
            visit::visit_field_value(self, value);
        }
    }

    fn visit_expr_field(&mut self, field: &'ast syn::ExprField) {
        visit::visit_expr_field(self, field);
        self.beside.push(name(&field.member));
    }

    fn visit_lit_str(&mut self, text: &'ast syn::LitStr) {
        self.found.texts.push(text.value());
    }
}

fn name(member: &Member) -> String {
    match member {
        Member::Named(name) => name.to_string(),
        Member::Unnamed(index) => index.index.to_string(),
    }
}

/// `vision::eye, control::legs (reads)`: the paths in it.
fn words(doc: &str) -> Vec<String> {
    let words = doc.split([' ', ',']).filter(|word| !word.is_empty());
    words.map(str::to_owned).collect()
}
