//! `#[derive(Outputs)]`.

use proc_macro2::TokenStream as Tokens;
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Fields};

pub(crate) fn expand(item: &DeriveInput) -> syn::Result<Tokens> {
    let Data::Struct(data) = &item.data else {
        return Err(refused(item));
    };
    let Fields::Named(fields) = &data.fields else {
        return Err(refused(item));
    };
    let serde = item
        .attrs
        .iter()
        .chain(fields.named.iter().flat_map(|field| &field.attrs));
    if let Some(attribute) = serde.into_iter().find(|one| one.path().is_ident("serde")) {
        let message = "`Outputs` writes field by field, whatever serde is told";
        return Err(syn::Error::new(attribute.span(), message));
    }
    let saved = fields.named.iter().map(|field| {
        let name = &field.ident;
        quote_spanned!(field.ty.span()=> out.output(&self.#name);)
    });
    let out = match fields.named.is_empty() {
        true => quote!(_out),
        false => quote!(out),
    };
    let name = &item.ident;
    let (parameters, arguments, clause) = item.generics.split_for_impl();
    Ok(quote! {
        #[automatically_derived]
        impl #parameters ::framework::recorded::Outputs for #name #arguments #clause {
            fn save(&self, #out: &mut ::framework::recorded::Saving<'_, '_>) {
                #(#saved)*
            }
        }
    })
}

fn refused(item: &DeriveInput) -> syn::Error {
    syn::Error::new(
        item.ident.span(),
        "`Outputs` is for structs with named fields",
    )
}

#[cfg(test)]
mod tests {
    use super::expand;

    fn error(item: &str) -> String {
        let item = syn::parse_str(item).expect("it is an item");
        expand(&item).expect_err("it is refused").to_string()
    }

    #[test]
    fn what_serde_may_write_otherwise_is_refused() {
        let named = "`Outputs` is for structs with named fields";
        assert_eq!(error("enum E { A }"), named);
        assert_eq!(error("struct S(u8);"), named);
        let serde = "`Outputs` writes field by field, whatever serde is told";
        assert_eq!(error("struct S { #[serde(skip)] a: u8 }"), serde);
        assert_eq!(error("#[serde(transparent)] struct S { a: u8 }"), serde);
    }
}
