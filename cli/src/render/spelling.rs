//! Names, types and accessors of the model as tokens.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::visit_mut::VisitMut;

use crate::model::accessor::Accessor;
use crate::model::frame::Hardware;
use crate::model::names::begins_with_type;

/// A keyword since edition 2024, that of the generated crate, and a name for syn and in crates of older editions.
const LATEST_KEYWORD: &str = "gen";

/// A name, raw where it is a keyword.
pub(super) fn ident(name: &str) -> Ident {
    let name = name.trim_start_matches("r#");
    match syn::parse_str::<Ident>(name) {
        Ok(ident) if name != LATEST_KEYWORD => ident,
        _ => Ident::new_raw(name, Span::call_site()),
    }
}

/// An absolute path, to be imported.
pub(super) fn path(text: &str) -> TokenStream {
    let names = text.split("::").map(|name| match name {
        "crate" => Ident::new(name, Span::call_site()),
        name => ident(name),
    });
    let root = (!text.starts_with("crate::")).then(|| quote!(::));
    quote!(#root #(#names)::*)
}

/// A trait with its arguments, all of whose paths are absolute, or `'static`.
pub(super) fn bound(text: &str) -> TokenStream {
    let mut bound: syn::TypeParamBound = syn::parse_str(text)
        .unwrap_or_else(|error| panic!("hulkgen resolved no trait ({error}): {text}"));
    MakeAbsolute.visit_type_param_bound_mut(&mut bound);
    quote!(#bound)
}

/// A type whose paths are absolute; names without a path are the prelude's.
pub(super) fn data_type(text: &str) -> TokenStream {
    let mut data: syn::Type = syn::parse_str(text)
        .unwrap_or_else(|error| panic!("hulkgen resolved no type ({error}): {text}"));
    MakeAbsolute.visit_type_mut(&mut data);
    quote!(#data)
}

/// A function's signature whose paths are absolute.
pub(super) fn signature(text: &str) -> syn::Signature {
    let mut signature: syn::Signature = syn::parse_str(text)
        .unwrap_or_else(|error| panic!("hulkgen resolved no signature ({error}): {text}"));
    MakeAbsolute.visit_signature_mut(&mut signature);
    signature
}

struct MakeAbsolute;

impl VisitMut for MakeAbsolute {
    fn visit_path_mut(&mut self, path: &mut syn::Path) {
        let first = path.segments.first().map(|first| first.ident.to_string());
        let first = first.unwrap_or_default();
        if path.segments.len() > 1 && first != "crate" && !begins_with_type(&first) {
            path.leading_colon.get_or_insert_default();
        }
        syn::visit_mut::visit_path_mut(self, path);
    }

    fn visit_ident_mut(&mut self, name: &mut Ident) {
        if *name == LATEST_KEYWORD {
            *name = Ident::new_raw(LATEST_KEYWORD, name.span());
        }
    }
}

/// `frame.own.balls`
pub(super) fn place<S: AsRef<str>>(names: &[S]) -> TokenStream {
    let names = names.iter().map(|name| member(name.as_ref()));
    quote!(#(#names).*)
}

/// A field by name, or by number.
fn member(name: &str) -> syn::Member {
    match name.parse::<usize>() {
        Ok(index) => syn::Member::Unnamed(index.into()),
        Err(_) => syn::Member::Named(ident(name)),
    }
}

/// A reference to a value, or an option of one where the value may be absent.
pub(super) fn quote_accessor(accessor: &Accessor) -> TokenStream {
    let value = place(&accessor.place);
    if !accessor.optional {
        return if accessor.reference {
            value
        } else {
            quote!(&#value)
        };
    }
    let mut tokens = quote!(#value.as_ref());
    for look in &accessor.looks {
        let name = ident(&look.name);
        let fields = place(&look.fields);
        tokens = if look.optional {
            quote!(#tokens.and_then(|#name| #name.#fields.as_ref()))
        } else {
            quote!(#tokens.map(|#name| &#name.#fields))
        };
    }
    tokens
}

/// The type parameters of a function whose argument has the hardware as last type argument, and
/// that type argument: `<Hardware>` and `, Hardware`, or nothing and `, impl CameraInterface`.
pub(super) fn quote_hardware(hardware: &Hardware) -> (TokenStream, TokenStream) {
    match hardware {
        Hardware::Absent => (quote!(), quote!()),
        Hardware::Asked(traits) if traits.is_empty() => (quote!(<Hardware>), quote!(, Hardware)),
        Hardware::Asked(traits) => {
            let traits = traits.iter().map(|one| bound(one));
            (quote!(), quote!(, impl #(#traits)+*))
        }
    }
}
