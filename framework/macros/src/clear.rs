//! `#[derive(Clear)]`.

use proc_macro2::TokenStream as Tokens;
use quote::{ToTokens, format_ident, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Index, parse_quote};

pub(crate) fn expand(item: &DeriveInput) -> syn::Result<Tokens> {
    let assign = match &item.data {
        Data::Struct(data) if !data.fields.is_empty() => quote_assign(&data.fields),
        Data::Struct(_) | Data::Enum(_) => Tokens::new(),
        Data::Union(data) => {
            let message = "`Clear` is for structs and enums";
            return Err(syn::Error::new(data.union_token.span, message));
        }
    };
    let name = &item.ident;
    let mut generics = item.generics.clone();
    for parameter in generics.type_params_mut() {
        parameter.bounds.push(parse_quote!(::framework::Clear));
    }
    let (parameters, arguments, clause) = generics.split_for_impl();
    Ok(quote! {
        #[automatically_derived]
        impl #parameters ::framework::Clear for #name #arguments #clause {
            #assign
        }
    })
}

/// Field by field, so that each keeps its own heap memory.
fn quote_assign(fields: &syn::Fields) -> Tokens {
    let mut pattern = Tokens::new();
    let mut assignments = Tokens::new();
    for (position, field) in fields.iter().enumerate() {
        let member = match &field.ident {
            Some(name) => name.to_token_stream(),
            None => Index::from(position).to_token_stream(),
        };
        let value = format_ident!("value_{position}");
        pattern.extend(quote!(#member: #value,));
        assignments.extend(quote_spanned! {field.ty.span()=>
            ::framework::Clear::assign(&mut self.#member, #value);
        });
    }
    quote! {
        fn assign(&mut self, value: Self) {
            let Self { #pattern } = value;
            #assignments
        }
    }
}

#[cfg(test)]
mod tests {
    use super::expand;

    #[test]
    fn a_union_is_told_where_it_stands() {
        let item = syn::parse_str("union U { a: u8, b: f32 }").expect("it is a union");
        let error = expand(&item).expect_err("unions have no default");
        assert_eq!(error.to_string(), "`Clear` is for structs and enums");
    }

    #[test]
    fn an_enum_takes_its_default_as_a_whole() {
        let item = syn::parse_str("enum E<T> { A(T), B }").expect("it is an enum");
        let tokens = expand(&item).expect("enums have defaults").to_string();
        assert!(tokens.ends_with("Clear for E < T > { }"), "{tokens}");
    }
}
