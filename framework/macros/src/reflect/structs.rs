//! Structs: named, with indices, without fields, and those that stand for their one field.

use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::Fields;

use super::parts::{
    Key, Part, Parts, quote_children, quote_content, quote_encode, quote_lookup, quote_pattern,
    read_parts,
};
use super::{Functions, Walk, opaque, quote_shape};
use crate::serde_names::Container;

pub(super) fn functions(
    fields: &Fields,
    container: &Container,
    docs: &str,
    pixels: Option<Tokens>,
) -> syn::Result<Functions> {
    let Parts { parts, is_open } = read_parts(fields, container)?;
    if let [part] = &parts[..]
        && (container.transparent || (matches!(fields, Fields::Unnamed(_)) && fields.len() == 1))
    {
        return Ok(match part.key {
            Key::Hidden => opaque(),
            _ if part.own_form => opaque(),
            _ => transparent(part, docs),
        });
    }
    if matches!(fields, Fields::Unit) && container.tag.is_none() {
        return Ok(Functions {
            shape: quote!(framework_reflect::Shape::leaf::<Self>(
                framework_reflect::Leaf::Unit
            )),
            parts: None,
            encode: Some(quote!(::core::result::Result::Ok(()))),
        });
    }
    // A struct with a tag of its own has one field more.
    let is_open = is_open || container.tag.is_some();
    let content = quote_content(&parts, !matches!(fields, Fields::Unnamed(_)));
    let form = if is_open { quote!(Open) } else { quote!(Plain) };
    let pattern = quote_pattern(&parts);
    let child = quote_lookup(&parts, "child");
    let child_mut = quote_lookup(&parts, "child_mut");
    let children = quote_children(&parts, None);
    let encode = quote_encode(&parts);
    Ok(Functions {
        shape: match pixels {
            Some(pixels) => quote_image(&quote_shape(&content, &form, docs), &pixels),
            None => quote_shape(&content, &form, docs),
        },
        parts: parts.iter().any(Part::is_seen).then(|| Walk {
            child: quote!(let Self #pattern = self; #child),
            child_mut: quote!(let Self #pattern = self; #child_mut),
            children: quote!(let Self #pattern = self; #children),
        }),
        encode: (!is_open).then(|| quote!(let Self #pattern = self; #encode)),
    })
}

/// The shape of a struct that says that it is an image.
fn quote_image(shape: &Tokens, pixels: &Tokens) -> Tokens {
    quote! {
        framework_reflect::Shape {
            pixels: ::core::option::Option::Some(#pixels),
            ..#shape
        }
    }
}

/// serde writes the field instead of the struct.
fn transparent(part: &Part, docs: &str) -> Functions {
    let inner = super::parts::quote_shape(&part.data);
    let shape = if docs.is_empty() {
        inner
    } else {
        quote!(framework_reflect::Shape { docs: #docs, ..#inner })
    };
    let pattern = quote_pattern(std::slice::from_ref(part));
    let binding = &part.binding;
    Functions {
        shape: quote!(framework_reflect::Shape::of::<Self>(|| #shape)),
        parts: Some(Walk {
            child: quote!(let Self #pattern = self; framework_reflect::Reflect::child(#binding, segment)),
            child_mut: quote! {
                let Self #pattern = self;
                framework_reflect::Reflect::child_mut(#binding, segment)
            },
            children: quote!(let Self #pattern = self; framework_reflect::Reflect::children(#binding)),
        }),
        encode: Some(
            quote!(let Self #pattern = self; framework_reflect::Reflect::encode(#binding, bytes)),
        ),
    }
}
