//! How generated Rust text looks: header, comments, empty lines, line breaks.
//!
//! Comments are not tokens, so `quote!` would drop them: [`comment`] makes an attribute of one,
//! which prettyplease prints as a `//` line. Items and methods are separated by an empty line.
//!
//! Invariant: formatting never changes meaning; the finished text is parsed again and compared
//! with the tokens that went in.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::visit_mut::VisitMut;

use super::imports;
use crate::model::DO_NOT_EDIT;

/// Lines of doc comments have no more letters.
const DOC_WIDTH: usize = 88;

/// Marks the place of an empty line until the text is finished.
const EMPTY_LINE: &str = "~ empty line";

/// A `//` comment before the item, field, statement or match arm whose tokens follow.
pub(super) fn comment(text: &str) -> TokenStream {
    let text = format!(" {text}");
    quote!(#[comment = #text])
}

/// An empty line before the field or statement whose tokens follow.
pub(super) fn empty_line() -> TokenStream {
    quote!(#[comment = #EMPTY_LINE])
}

/// A `///` comment before the item or field whose tokens follow, in lines that can be read.
pub(super) fn doc(text: &str) -> TokenStream {
    let lines = wrapped(text).into_iter().map(|line| format!(" {line}"));
    quote!(#(#[doc = #lines])*)
}

fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= DOC_WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The text of a Rust file: header, imports, items.
///
/// `modules` are the modules that are imported whole, as they stand in the quoted paths.
///
/// # Panics
/// On a bug in hulkgen: quoted items that are no Rust.
pub(super) fn rust_file(title: &str, modules: &[String], items: TokenStream) -> String {
    let mut file: syn::File = syn::parse2(items.clone())
        .unwrap_or_else(|error| panic!("hulkgen quoted no Rust ({error}): {items}"));
    let uses = imports::import(&mut file.items, modules);
    file.items.splice(0..0, uses);
    let meaning = meaning_of(&file.items);
    EmptyLines.visit_file_mut(&mut file);

    let mut text = format!("//! {title}\n//!\n//! {DO_NOT_EDIT}\n");
    let mut group = None;
    for item in file.items {
        let own_group = one_line_group(&item);
        if own_group.is_none() || own_group != group {
            text.push('\n');
        }
        group = own_group;
        text.push_str(&formatted(item));
    }
    let finished = syn::parse_file(&text).expect("formatted Rust is Rust");
    assert_eq!(
        meaning,
        meaning_of(&finished.items),
        "hulkgen changed the meaning of generated text while formatting it"
    );
    text
}

/// The text of items alone, each with an empty line before it.
pub(super) fn items(items: TokenStream) -> String {
    let mut file: syn::File = syn::parse2(items.clone())
        .unwrap_or_else(|error| panic!("hulkgen quoted no Rust ({error}): {items}"));
    EmptyLines.visit_file_mut(&mut file);
    let items = file.items.into_iter();
    items.map(|item| format!("\n{}", formatted(item))).collect()
}

/// Text of an item, its empty lines in place.
fn formatted(item: syn::Item) -> String {
    let file = syn::File {
        shebang: None,
        attrs: Vec::new(),
        items: vec![item],
    };
    let mut text = String::new();
    let mut pattern = SlicePattern::default();
    for line in prettyplease::unparse(&file).lines() {
        // prettyplease breaks an empty struct literal in two lines.
        if text.ends_with(" {\n") && matches!(line.trim_start(), "}" | "};" | "},") {
            text.pop();
            text.push_str(line.trim_start());
        } else if line.trim_start().strip_prefix("//") != Some(EMPTY_LINE) {
            text.push_str(&pattern.indented(line));
        }
        text.push('\n');
    }
    text
}

/// What prettyplease does not indent: a slice pattern of several lines.
#[derive(Default)]
struct SlicePattern {
    is_open: bool,
}

impl SlicePattern {
    fn indented(&mut self, line: &str) -> String {
        let written = line.trim_start();
        let margin = &line[..line.len() - written.len()];
        if self.is_open {
            self.is_open = written != "],";
            let further = if self.is_open { "    " } else { "" };
            return format!("{further}{line}");
        }
        match written.strip_prefix('[') {
            Some(first) if first.ends_with(',') && !first.contains(']') => {
                self.is_open = true;
                format!("{margin}[\n{margin}    {first}")
            }
            _ => line.to_owned(),
        }
    }
}

/// Items of one line stand together: each kind of `use`, and `mod`.
fn one_line_group(item: &syn::Item) -> Option<&'static str> {
    match item {
        syn::Item::Use(item) => Some(imports::origin(item)),
        syn::Item::Mod(_) => Some("mod"),
        _ => None,
    }
}

/// Puts an empty line before every method but the first.
struct EmptyLines;

impl VisitMut for EmptyLines {
    fn visit_item_impl_mut(&mut self, item: &mut syn::ItemImpl) {
        for inner in item.items.iter_mut().skip(1) {
            if let syn::ImplItem::Fn(function) = inner {
                function
                    .attrs
                    .insert(0, syn::parse_quote!(#[comment = #EMPTY_LINE]));
            }
        }
    }
}

/// What items say, layout aside.
fn meaning_of(items: &[syn::Item]) -> String {
    without_layout(items.iter().map(ToTokens::to_token_stream).collect())
}

/// Tokens as text, without comments and without what a formatter may add or take away: commas at
/// the end of a list or behind a match arm, braces around an expression.
fn without_layout(tokens: TokenStream) -> String {
    let mut text = String::new();
    write_without_layout(tokens, &mut text);
    text
}

fn write_without_layout(tokens: TokenStream, text: &mut String) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(punct) if punct.as_char() == ',' => {}
            TokenTree::Punct(punct) if punct.as_char() == '#' && is_comment(tokens.peek()) => {
                tokens.next();
            }
            TokenTree::Group(group) => write_group(&group, text),
            token => {
                text.push_str(&token.to_string());
                text.push(' ');
            }
        }
    }
}

fn write_group(group: &Group, text: &mut String) {
    let (open, close) = match group.delimiter() {
        Delimiter::Parenthesis => ("( ", ") "),
        Delimiter::Bracket => ("[ ", "] "),
        Delimiter::Brace | Delimiter::None => ("", ""),
    };
    text.push_str(open);
    write_without_layout(group.stream(), text);
    text.push_str(close);
}

/// Whether these are the brackets of a comment's attribute.
fn is_comment(token: Option<&TokenTree>) -> bool {
    let Some(TokenTree::Group(group)) = token else {
        return false;
    };
    matches!(group.stream().into_iter().next(), Some(TokenTree::Ident(name)) if name == "comment")
}

#[cfg(test)]
mod tests;
