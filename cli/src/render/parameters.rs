//! `src/parameters.rs`.

use quote::quote;

use super::layout::{self, doc};
use super::structs::quote_struct;
use crate::model::Parameters;

/// The parameter tree as structs.
pub(super) fn render_parameters(parameters: &Parameters) -> String {
    let derive = quote! {
        #[derive(Clone, Debug, ::serde::Deserialize, ::framework::Reflect, ::serde::Serialize)]
    };
    let closed = quote!(#[serde(deny_unknown_fields)]);
    let structs = parameters
        .structs
        .iter()
        .enumerate()
        .map(|(position, definition)| {
            let root =
                (position == 0).then(|| doc("Everything that the parameter files say to nodes."));
            let closed = (!definition.open).then_some(&closed);
            quote_struct(definition, &quote!(#root #derive #closed), &|data| data)
        });
    layout::rust_file(
        "The parameter tree; each field names the nodes that read it.",
        &[],
        quote!(#(#structs)*),
    )
}
