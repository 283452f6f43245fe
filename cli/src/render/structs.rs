//! Structs of the trees of declared paths.

use proc_macro2::TokenStream;
use quote::quote;

use super::layout::doc;
use super::spelling::{data_type, ident};
use crate::model::structs::{FieldType, Hints, Struct, StructField};

/// A struct; `head` stands in front of it, `wrap` makes the type of a declared value.
pub(super) fn quote_struct(
    definition: &Struct,
    head: &TokenStream,
    wrap: &dyn Fn(TokenStream) -> TokenStream,
) -> TokenStream {
    let name = ident(&definition.name);
    let fields = definition
        .fields
        .iter()
        .map(|field| quote_field(field, wrap));
    quote! {
        #head
        pub struct #name {
            #(#fields)*
        }
    }
}

fn quote_field(field: &StructField, wrap: &dyn Fn(TokenStream) -> TokenStream) -> TokenStream {
    let name = ident(&field.name);
    let docs = doc(&field.docs);
    let hints = quote_hints(&field.hints);
    let content = match &field.content {
        FieldType::Data(data) => wrap(data_type(data)),
        FieldType::Struct(name) => {
            let name = ident(name);
            quote!(#name)
        }
    };
    quote! {
        #docs
        #hints
        pub #name: #content,
    }
}

/// `#[reflect(unit = "m", range = 0..=1)]`, as the fields of nodes say it.
fn quote_hints(hints: &Hints) -> Option<TokenStream> {
    let unit = hints.unit.as_ref().map(|unit| quote!(unit = #unit));
    let range = hints.range.as_ref().map(|range| {
        let range: TokenStream = range.parse().expect("it was read as a range");
        quote!(range = #range)
    });
    let creation_only = hints.creation_only.then(|| quote!(creation_only));
    let said: Vec<_> = [unit, range, creation_only].into_iter().flatten().collect();
    (!said.is_empty()).then(|| quote!(#[reflect(#(#said),*)]))
}
