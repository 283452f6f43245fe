//! What stands in for instances that do not run here.

use proc_macro2::TokenStream;
use quote::quote;

use crate::model::runtime::{Runtime, StubModel};
use crate::render::instance::quote_duration;
use crate::render::layout::doc;
use crate::render::spelling::{ident, path};

/// The struct of all stubs, if there are any.
pub(super) fn quote_stubs(runtime: &Runtime) -> TokenStream {
    if runtime.stubs.is_empty() {
        return quote!();
    }
    let fields = runtime.stubs.iter().map(|stub| {
        let (about, name) = (doc(&stub.about), ident(&stub.variable));
        let outputs = path(&format!("crate::databases::{}::SharedOutputs", stub.module));
        quote!(#about pub #name: ::framework::Stub<#outputs>,)
    });
    let about = doc(
        "What stands in for the instances that are left out and read: until one is fed nobody has written it.",
    );
    quote!(#about pub struct Stubs { #(#fields)* })
}

/// The statement that makes them.
pub(super) fn quote_new_stubs(runtime: &Runtime) -> TokenStream {
    let fields = runtime
        .stubs
        .iter()
        .map(|StubModel { name, variable, .. }| {
            let (field, writer) = (ident(variable), ident(&format!("{variable}_writer")));
            quote!(#field: ::framework::Stub::new(#name, #writer, start.clock.clone()),)
        });
    quote!(let stubs = Stubs { #(#fields)* };)
}

/// What other machines feed.
pub(super) fn quote_remotes(runtime: &Runtime) -> TokenStream {
    if runtime.remotes.is_empty() {
        return quote!(Vec::new());
    }
    let remotes = runtime.remotes.iter().map(|remote| {
        let (name, timeout) = (&remote.name, quote_duration(remote.pending_timeout));
        let writer = ident(&format!("{}_writer", remote.variable));
        quote!(Box::new(::framework::Remote::new(#name, #writer, #timeout, start.clock.clone())))
    });
    quote!(vec![#(#remotes),*])
}
