//! The names that serde gives to fields and variants, and which of them it leaves out.

mod case;

use proc_macro2::TokenStream as Tokens;
use syn::meta::ParseNestedMeta;
use syn::{Attribute, ExprPath, LitStr, Token, parenthesized, token};

use case::Case;

/// `#[serde(…)]` of a struct, an enum or a variant.
#[derive(Default)]
pub(crate) struct Container {
    /// For the names inside: fields of a struct or variant, variants of an enum.
    rename_all: Option<Case>,
    /// For the fields of the variants of an enum.
    rename_all_fields: Option<Case>,
    /// The one field stands for the struct.
    pub(crate) transparent: bool,
    /// Its serde form is that of another type.
    pub(crate) foreign: bool,
    /// Where the name of the variant stands.
    pub(crate) tag: Option<LitStr>,
    /// Where the variant stands beside its name.
    pub(crate) content: Option<LitStr>,
    /// The variant has no name.
    pub(crate) untagged: bool,
}

/// `#[serde(…)]` of a field or variant, for itself.
#[derive(Default)]
pub(crate) struct Member {
    rename: Option<String>,
    /// It does not stand in the serde form.
    pub(crate) skip: bool,
    /// Its parts stand among its neighbours.
    pub(crate) flatten: bool,
    /// The function that tells whether it stands in the serde form.
    pub(crate) is_left_out: Option<ExprPath>,
    /// It is not written by the implementation of its type, or, a variant, not by its name.
    pub(crate) own_form: bool,
}

impl Container {
    pub(crate) fn read(attributes: &[Attribute]) -> syn::Result<Self> {
        let mut container = Self::default();
        each(attributes, |meta| {
            if meta.path.is_ident("rename_all") {
                container.rename_all = case(&meta)?;
            } else if meta.path.is_ident("rename_all_fields") {
                container.rename_all_fields = case(&meta)?;
            } else if meta.path.is_ident("tag") {
                container.tag = Some(meta.value()?.parse()?);
            } else if meta.path.is_ident("content") {
                container.content = Some(meta.value()?.parse()?);
            } else {
                container.untagged |= meta.path.is_ident("untagged");
                container.transparent |= meta.path.is_ident("transparent");
                let foreign = ["from", "into", "remote", "try_from"];
                container.foreign |= foreign.iter().any(|name| meta.path.is_ident(name));
                skip_value(&meta)?;
            }
            Ok(())
        })?;
        Ok(container)
    }

    /// The container of a variant's fields, with what the enum says about all of them.
    #[must_use]
    pub(crate) fn inside(mut self, whole: &Self) -> Self {
        self.rename_all = self.rename_all.or(whole.rename_all_fields);
        self
    }

    pub(crate) fn field_name(&self, field: &syn::Ident, member: &Member) -> String {
        let written = written(field);
        match (&member.rename, self.rename_all) {
            (Some(name), _) => name.clone(),
            (None, Some(case)) => case.field(&written),
            (None, None) => written,
        }
    }

    pub(crate) fn variant_name(&self, variant: &syn::Ident, member: &Member) -> String {
        let written = written(variant);
        match (&member.rename, self.rename_all) {
            (Some(name), _) => name.clone(),
            (None, Some(case)) => case.variant(&written),
            (None, None) => written,
        }
    }
}

/// What writes a list of bytes in one piece.
const BYTES: &str = "framework::bytes";

impl Member {
    pub(crate) fn read(attributes: &[Attribute]) -> syn::Result<Self> {
        let mut member = Self::default();
        each(attributes, |meta| {
            if meta.path.is_ident("rename") {
                member.rename = serialized_value(&meta)?.map(|name| name.value());
                return Ok(());
            }
            if meta.path.is_ident("skip_serializing_if") {
                let function: LitStr = meta.value()?.parse()?;
                member.is_left_out = Some(function.parse()?);
                return Ok(());
            }
            if meta.path.is_ident("with") {
                let module: LitStr = meta.value()?.parse()?;
                // Another way to write the same.
                member.own_form |= module.value().trim_start_matches("::") != BYTES
                    && module.value() != "crate::bytes";
                return Ok(());
            }
            let own_form = ["getter", "serialize_with", "untagged"];
            member.own_form |= own_form.iter().any(|name| meta.path.is_ident(name));
            member.skip |= meta.path.is_ident("skip") || meta.path.is_ident("skip_serializing");
            member.flatten |= meta.path.is_ident("flatten");
            skip_value(&meta)
        })?;
        Ok(member)
    }
}

/// An identifier as serde writes it: without `r#`.
fn written(name: &syn::Ident) -> String {
    let text = name.to_string();
    text.strip_prefix("r#")
        .map(ToOwned::to_owned)
        .unwrap_or(text)
}

fn each(
    attributes: &[Attribute],
    mut take: impl FnMut(ParseNestedMeta<'_>) -> syn::Result<()>,
) -> syn::Result<()> {
    for attribute in attributes {
        if attribute.path().is_ident("serde") {
            attribute.parse_nested_meta(&mut take)?;
        }
    }
    Ok(())
}

fn case(meta: &ParseNestedMeta<'_>) -> syn::Result<Option<Case>> {
    // An unknown case is serde's to tell.
    Ok(serialized_value(meta)?.and_then(|name| Case::from_name(&name.value())))
}

/// `"x"` of `name = "x"` or `name(serialize = "x", deserialize = "y")`.
fn serialized_value(meta: &ParseNestedMeta<'_>) -> syn::Result<Option<LitStr>> {
    if meta.input.peek(Token![=]) {
        return meta.value()?.parse().map(Some);
    }
    let mut serialized = None;
    meta.parse_nested_meta(|nested| {
        let value = nested.value()?.parse()?;
        if nested.path.is_ident("serialize") {
            serialized = Some(value);
        }
        Ok(())
    })?;
    Ok(serialized)
}

/// Steps over the value of something that is serde's business alone.
fn skip_value(meta: &ParseNestedMeta<'_>) -> syn::Result<()> {
    if meta.input.peek(Token![=]) {
        meta.value()?.parse::<syn::Expr>()?;
    } else if meta.input.peek(token::Paren) {
        let content;
        parenthesized!(content in meta.input);
        content.parse::<Tokens>()?;
    }
    Ok(())
}
