//! What stands in for the hardware.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::{FnArg, Pat, Signature};

use crate::model::recording::{Answer, Method, SinkTrait};
use crate::render::layout::{self, doc};
use crate::render::spelling::{ident, path, signature};

/// A type that takes every command, tells of it whoever listens, and knows nothing.
pub(super) fn quote_sink(name: &str, about: &str, traits: &[SinkTrait]) -> TokenStream {
    let name = ident(name);
    let traits = traits.iter().map(|one| {
        let of = path(&one.path);
        let last = one.path.rsplit("::").next().unwrap_or_default();
        let methods = one.methods.iter().map(|method| quote_method(last, method));
        quote!(impl #of for #name { #(#methods)* })
    });
    let about = doc(about);
    quote! {
        #about
        #[derive(Clone, Copy, Debug)]
        pub struct #name;

        #(#traits)*
    }
}

/// The same as text, with absolute paths: for a test that brings its own hardware.
pub fn render_stand_in(name: &str, about: &str, traits: &[SinkTrait]) -> String {
    layout::items(quote_sink(name, about, traits))
}

fn quote_method(of: &str, method: &Method) -> TokenStream {
    let mut signature = signature(&method.signature);
    let is_command = method.answer != Answer::Something;
    let arguments = name_arguments(&mut signature, is_command);
    let command = format!("{of}::{}", signature.ident);
    let told = quote!(::framework::commanded!(#command #(, #arguments)*););
    let body = match method.answer {
        Answer::Nothing => told,
        Answer::ResultOfNothing => quote!(#told Ok(())),
        Answer::Something => quote!(::framework::replay::no_hardware()),
    };
    quote!(#signature { #body })
}

/// The names of the arguments, where they are wanted; else none has one.
fn name_arguments(signature: &mut Signature, wanted: bool) -> Vec<Ident> {
    let mut names = Vec::new();
    for input in &mut signature.inputs {
        let FnArg::Typed(argument) = input else {
            continue;
        };
        let name = match &*argument.pat {
            Pat::Ident(named) => named.ident.clone(),
            _ => format_ident!("argument_{}", names.len() + 1),
        };
        *argument.pat = match wanted {
            true => syn::parse_quote!(#name),
            false => syn::parse_quote!(_),
        };
        names.push(name);
    }
    names
}
