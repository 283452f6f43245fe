//! Enums: what is seen is the active variant.
//!
//! A variant with one field without a name is that field. Any other fields belong to the enum itself, for Rust has no
//! reference to a variant: its name then leads to the enum again, so that `Walk.speed` is found as in the serde form.

use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::{DataEnum, Fields, Ident};

use super::parts::{
    Part, documentation, quote_children, quote_content, quote_lookup, quote_pattern, quote_shape,
    read_parts,
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

pub(super) fn functions(data: &DataEnum, container: &Container) -> syn::Result<Functions> {
    let variants = read_variants(data, container)?;
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
    Ok(Functions {
        shape: quote!(framework_reflect::Shape::of::<Self>(|| #content)),
        parts: (!all_units).then(|| Walk {
            child: quote!(match self { #(#child)* #none }),
            child_mut: quote!(match self { #(#child_mut)* #none }),
            children: quote!(match self { #(#children)* #nothing }),
        }),
    })
}

fn read_variants<'item>(
    data: &'item DataEnum,
    container: &Container,
) -> syn::Result<Vec<Variant<'item>>> {
    let mut variants = Vec::new();
    for variant in &data.variants {
        let member = Member::read(&variant.attrs)?;
        if member.skip {
            continue;
        }
        let inside = Container::read(&variant.attrs)?.inside(container);
        let mut parts = read_parts(&variant.fields, &inside)?;
        let content = match &variant.fields {
            Fields::Unit => VariantContent::Unit,
            Fields::Unnamed(fields) if fields.unnamed.len() == 1 => match parts.pop() {
                Some(part) => VariantContent::Value(Box::new(part)),
                None => VariantContent::Unit,
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
    Ok(variants)
}

fn quote_variant_shape(variant: &Variant<'_>) -> Tokens {
    let Variant { name, docs, .. } = variant;
    let content = match &variant.content {
        VariantContent::Unit => quote!(Unit),
        VariantContent::Value(part) => {
            let shape = quote_shape(&part.data);
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
