//! Structs of the trees of declared paths.

use proc_macro2::TokenStream;
use quote::quote;

use super::layout::doc;
use super::spelling::{data_type, ident};
use crate::model::structs::{FieldType, Struct, StructField};

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
    let content = match &field.content {
        FieldType::Data(data) => wrap(data_type(data)),
        FieldType::Struct(name) => {
            let name = ident(name);
            quote!(#name)
        }
    };
    quote! {
        #docs
        pub #name: #content,
    }
}
