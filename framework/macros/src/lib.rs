//! The macros of node files: `#[context]`, `#[derive(Reflect)]`, `#[derive(Clear)]`; and of generated databases: `#[derive(Outputs)]`.
//!
//! What a context may say is decided by the crate `grammar`, which the scanner of `hulkgen` reads node files with, too.

mod clear;
mod context;
mod outputs;
mod reflect;
mod serde_names;

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

/// Marks `CreationContext`, `CycleContext` or `MainOutputs` of a node.
///
/// Paths go, the lifetime comes: of `image: Input<Image, "image">` remains `pub image: Input<'context, Image>`. Every kind
/// keeps its own name and place, so an editor finds its documentation. A mistake is told at the field, which stays usable.
#[proc_macro_attribute]
pub fn context(attribute: TokenStream, item: TokenStream) -> TokenStream {
    context::expand(&attribute.into(), item.into()).into()
}

/// Makes the parts of a struct or enum known by path, named as serde names them.
///
/// Respects `#[serde(rename, rename_all, rename_all_fields, skip, skip_serializing, flatten, transparent)]`; types with
/// `from`, `try_from` or `into` are shown as a whole. `#[reflect(unit = "m")]` tells the unit of a field,
/// `#[reflect(skip)]` hides it. Of an enum the active variant is seen: `Walk.speed`.
#[proc_macro_derive(Reflect, attributes(reflect))]
pub fn derive_reflect(item: TokenStream) -> TokenStream {
    let item = parse_macro_input!(item as DeriveInput);
    reflect::expand(&item)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}

/// Makes a struct fit for being written in place: back to default field by field, heap capacity kept.
///
/// An enum takes its default as a whole.
#[proc_macro_derive(Clear)]
pub fn derive_clear(item: TokenStream) -> TokenStream {
    let item = parse_macro_input!(item as DeriveInput);
    clear::expand(&item)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}

/// Lets a recording have the handles of a struct of outputs, in place of copies of what they are handles of.
///
/// Of generated structs, which serde writes field by field.
#[proc_macro_derive(Outputs)]
pub fn derive_outputs(item: TokenStream) -> TokenStream {
    let item = parse_macro_input!(item as DeriveInput);
    outputs::expand(&item)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}
