//! Structs: named, with indices, without fields, and those that stand for their one field.

use quote::quote;
use syn::Fields;

use super::parts::{Part, quote_children, quote_content, quote_lookup, quote_pattern, read_parts};
use super::{Functions, Walk};
use crate::serde_names::Container;

pub(super) fn functions(fields: &Fields, container: &Container) -> syn::Result<Functions> {
    let parts = read_parts(fields, container)?;
    if let [part] = &parts[..]
        && (container.transparent || (matches!(fields, Fields::Unnamed(_)) && fields.len() == 1))
    {
        return Ok(transparent(part));
    }
    if matches!(fields, Fields::Unit) {
        return Ok(Functions {
            shape: quote!(framework_reflect::Shape::leaf::<Self>(
                framework_reflect::Leaf::Unit
            )),
            parts: None,
        });
    }
    let content = quote_content(&parts, matches!(fields, Fields::Named(_)));
    let pattern = quote_pattern(&parts);
    let child = quote_lookup(&parts, "child");
    let child_mut = quote_lookup(&parts, "child_mut");
    let children = quote_children(&parts, None);
    Ok(Functions {
        shape: quote!(framework_reflect::Shape::of::<Self>(|| #content)),
        parts: (!parts.is_empty()).then(|| Walk {
            child: quote!(let Self #pattern = self; #child),
            child_mut: quote!(let Self #pattern = self; #child_mut),
            children: quote!(let Self #pattern = self; #children),
        }),
    })
}

/// serde writes the field instead of the struct.
fn transparent(part: &Part) -> Functions {
    let shape = super::parts::quote_shape(&part.data);
    let pattern = quote_pattern(std::slice::from_ref(part));
    let binding = &part.binding;
    Functions {
        shape: quote!(framework_reflect::Shape::of::<Self>(|| #shape.content)),
        parts: Some(Walk {
            child: quote!(let Self #pattern = self; framework_reflect::Reflect::child(#binding, segment)),
            child_mut: quote! {
                let Self #pattern = self;
                framework_reflect::Reflect::child_mut(#binding, segment)
            },
            children: quote!(let Self #pattern = self; framework_reflect::Reflect::children(#binding)),
        }),
    }
}
