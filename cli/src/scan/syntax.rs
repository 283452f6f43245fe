//! The syntax of a file with names as rustc compares them: `r#ball` is `ball`, and `r#gen` of edition 2024 the `gen` of
//! crates of older editions.
//!
//! Invariant: what is raw in it is a keyword in every edition. Places are those of the text.

use std::borrow::Cow;

use proc_macro2::Ident;
use syn::ext::IdentExt as _;
use syn::visit_mut::VisitMut;

pub(crate) fn parse(text: &str) -> syn::Result<syn::File> {
    let mut file = syn::parse_file(&without_shebang(text))?;
    if text.contains("r#") {
        Unmark.visit_file_mut(&mut file);
    }
    Ok(file)
}

/// Spaces in place of a line that the shell reads; syn would count places from behind it.
fn without_shebang(text: &str) -> Cow<'_, str> {
    let is_attribute = |rest: &str| rest.trim_start().starts_with('[');
    match text.strip_prefix("#!") {
        Some(rest) if !is_attribute(rest) => {
            let end = text.find('\n').unwrap_or(text.len());
            format!("{}{}", " ".repeat(end), &text[end..]).into()
        }
        _ => text.into(),
    }
}

struct Unmark;

impl VisitMut for Unmark {
    fn visit_ident_mut(&mut self, name: &mut Ident) {
        let plain = name.unraw();
        // syn does not know `gen` as a keyword.
        if plain != *name && syn::parse_str::<Ident>(&plain.to_string()).is_ok() {
            *name = plain;
        }
    }
}
