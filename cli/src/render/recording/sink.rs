//! What stands in for the hardware.

use proc_macro2::TokenStream;
use quote::quote;

use crate::model::Sink;
use crate::model::recording::Answer;
use crate::render::layout::doc;
use crate::render::spelling::{make_absolute, path};

/// A type that takes every command and knows nothing.
pub(super) fn quote_sink(sink: &Sink) -> TokenStream {
    let traits = sink.traits.iter().map(|one| {
        let name = path(&one.path);
        let methods = one.methods.iter().map(|method| {
            let signature = make_absolute(&method.signature);
            let body = match method.answer {
                Answer::Nothing => quote!(),
                Answer::ResultOfNothing => quote!(Ok(())),
                Answer::Something => quote!(::framework::replay::no_hardware()),
            };
            quote!(#signature { #body })
        });
        quote!(impl #name for Sink { #(#methods)* })
    });
    let about = doc(
        "The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.",
    );
    quote! {
        #about
        #[derive(Clone, Copy, Debug)]
        pub struct Sink;

        #(#traits)*
    }
}
