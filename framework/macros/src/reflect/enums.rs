//! Enums: what is seen is the active variant.
//!
//! A variant with one field without a name is that field. Any other fields belong to the enum itself, for Rust has no
//! reference to a variant: its name then leads to the enum again, so that `Walk.speed` is found as in the serde form.

use grammar::documentation;
use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::{DataEnum, Fields, Ident};

use super::parts::{
    Part, Parts, quote_children, quote_content, quote_encode, quote_lookup, quote_part_shape,
    quote_pattern, read_parts,
};
use super::{Functions, Walk};
use crate::serde_names::{Container, Member};

/// A variant as serde shows it.
struct Variant<'item> {
    ident: &'item Ident,
    name: String,
    docs: String,
    content: VariantContent,
}

enum VariantContent {
    Unit,
    Value(Box<Part>),
    Fields { parts: Vec<Part>, named: bool },
}

pub(super) fn functions(
    data: &DataEnum,
    container: &Container,
    docs: &str,
) -> syn::Result<Functions> {
    let Variants { variants, is_open } = read_variants(data, container)?;
    let shapes = variants.iter().map(quote_variant_shape);
    let content = quote!(framework_reflect::Content::Enum(::std::vec![#(#shapes),*]));
    let all_units = variants
        .iter()
        .all(|variant| matches!(variant.content, VariantContent::Unit));
    let children = variants.iter().filter_map(quote_children_arm);
    let child = variants
        .iter()
        .filter_map(|variant| quote_lookup_arm(variant, "child"));
    let child_mut = variants
        .iter()
        .filter_map(|variant| quote_lookup_arm(variant, "child_mut"));
    // Without units, or variants that serde skips, there is nothing else.
    let others = (variants.len() < data.variants.len()
        || variants
            .iter()
            .any(|variant| matches!(variant.content, VariantContent::Unit)))
    .then_some(());
    let none = others.map(|()| quote!(_ => ::core::option::Option::None,));
    let nothing = others.map(|()| quote!(_ => framework_reflect::Children::default(),));
    let form = if is_open {
        quote!(Open)
    } else {
        quote_form(container)
    };
    let is_plain = form.to_string() == "Plain" && !data.variants.is_empty();
    let unwritten = (variants.len() < data.variants.len())
        .then(|| quote!(_ => ::core::result::Result::Err(framework_reflect::skipped_variant()),));
    let encode = (0_u32..).zip(&variants).map(quote_encode_arm);
    Ok(Functions {
        encode: is_plain.then(|| quote!(match self { #(#encode)* #unwritten })),
        shape: super::quote_shape(&content, &form, docs),
        parts: (!all_units).then(|| Walk {
            child: quote!(match self { #(#child)* #none }),
            child_mut: quote!(match self { #(#child_mut)* #none }),
            children: quote!(match self { #(#children)* #nothing }),
        }),
    })
}

/// The variants that serde writes.
struct Variants<'item> {
    variants: Vec<Variant<'item>>,
    /// Whether it writes them in another way than their parts tell.
    is_open: bool,
}

fn read_variants<'item>(
    data: &'item DataEnum,
    container: &Container,
) -> syn::Result<Variants<'item>> {
    let mut variants = Vec::new();
    let mut is_open = false;
    for variant in &data.variants {
        let member = Member::read(&variant.attrs)?;
        if member.skip {
            continue;
        }
        let inside = Container::read(&variant.attrs)?.inside(container);
        let read = read_parts(&variant.fields, &inside)?;
        is_open |= read.is_open || member.own_form;
        let Parts { mut parts, .. } = read;
        let content = match &variant.fields {
            Fields::Unit => VariantContent::Unit,
            Fields::Unnamed(fields) if fields.unnamed.len() == 1 => match parts.pop() {
                Some(part) if part.is_seen() => VariantContent::Value(Box::new(part)),
                _ => VariantContent::Unit,
            },
            fields => VariantContent::Fields {
                parts,
                named: matches!(fields, Fields::Named(_)),
            },
        };
        variants.push(Variant {
            ident: &variant.ident,
            name: container.variant_name(&variant.ident, &member),
            docs: documentation(&variant.attrs),
            content,
        });
    }
    Ok(Variants { variants, is_open })
}

/// Where the name of the active variant stands.
fn quote_form(container: &Container) -> Tokens {
    match (&container.tag, &container.content) {
        (Some(tag), Some(content)) => quote!(Adjacent { tag: #tag, content: #content }),
        (Some(tag), None) => quote!(Tagged { tag: #tag }),
        (None, _) if container.untagged => quote!(Untagged),
        (None, _) => quote!(Plain),
    }
}

fn quote_encode_arm((tag, variant): (u32, &Variant<'_>)) -> Tokens {
    let ident = variant.ident;
    let parts = match &variant.content {
        VariantContent::Unit => &[],
        VariantContent::Value(part) => std::slice::from_ref(&**part),
        VariantContent::Fields { parts, .. } => &parts[..],
    };
    let pattern = quote_pattern(parts);
    let encode = quote_encode(parts);
    quote! {
        Self::#ident #pattern => {
            framework_reflect::encode_tag(#tag, bytes);
            #encode
        }
    }
}

fn quote_variant_shape(variant: &Variant<'_>) -> Tokens {
    let Variant { name, docs, .. } = variant;
    let content = match &variant.content {
        VariantContent::Unit => quote!(Unit),
        VariantContent::Value(part) => {
            let shape = quote_part_shape(part);
            quote!(Value(#shape))
        }
        VariantContent::Fields { parts, named } => {
            let content = quote_content(parts, *named);
            quote!(Fields(#content))
        }
    };
    quote! {
        framework_reflect::VariantShape {
            name: #name,
            docs: #docs,
            content: framework_reflect::VariantContent::#content,
        }
    }
}

fn quote_lookup_arm(variant: &Variant<'_>, function: &str) -> Option<Tokens> {
    let Variant { ident, name, .. } = variant;
    let named = quote!(segment.name() == ::core::option::Option::Some(#name));
    match &variant.content {
        VariantContent::Unit => None,
        VariantContent::Value(part) => {
            let pattern = quote_pattern(std::slice::from_ref(&**part));
            let binding = &part.binding;
            let function = Ident::new(function, ident.span());
            Some(quote! {
                Self::#ident #pattern => {
                    if #named {
                        return ::core::option::Option::Some(#binding);
                    }
                    framework_reflect::Reflect::#function(#binding, segment)
                }
            })
        }
        VariantContent::Fields { parts, .. } => {
            let pattern = quote_pattern(parts);
            let lookup = quote_lookup(parts, function);
            Some(quote! {
                Self::#ident { .. } if #named => ::core::option::Option::Some(self),
                Self::#ident #pattern => #lookup,
            })
        }
    }
}

fn quote_children_arm(variant: &Variant<'_>) -> Option<Tokens> {
    let Variant { ident, name, .. } = variant;
    match &variant.content {
        VariantContent::Unit => None,
        VariantContent::Value(_) => {
            Some(quote!(Self::#ident { .. } => framework_reflect::Children::named([#name]),))
        }
        VariantContent::Fields { parts, .. } => {
            let pattern = quote_pattern(parts);
            let children = quote_children(parts, Some(name));
            Some(quote!(Self::#ident #pattern => #children,))
        }
    }
}
