//! The other ends of all that an instance reads: in a replay nobody else has them.

use proc_macro2::TokenStream;
use quote::quote;

use super::own;
use crate::model::CyclerModel;
use crate::model::cycler::Source;
use crate::model::frame::FrameField;
use crate::render::database::quote_shared_of;
use crate::render::layout::doc;
use crate::render::spelling::ident;

/// Whether there is anything to write.
pub(super) fn is_needed(cycler: &CyclerModel) -> bool {
    cycler.has(&FrameField::Injections)
        || cycler.has_parameters()
        || sources(cycler).next().is_some()
}

/// Instances that are read, latest ones first.
pub(super) fn sources(cycler: &CyclerModel) -> impl Iterator<Item = &Source> {
    let lanes = cycler.perception.iter().flat_map(|one| &one.lanes);
    cycler.latest.iter().chain(lanes)
}

/// The struct of them.
pub(super) fn quote_outside(cycler: &CyclerModel) -> TokenStream {
    let injections = own(cycler, "Injections");
    let injections = cycler
        .has(&FrameField::Injections)
        .then(|| quote!(pub injections: ::framework::Writer<::framework::Injected<#injections>>,));
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(pub parameters: ::framework::Writer<crate::parameters::Parameters>,));
    let sources = sources(cycler).map(|source| {
        let (writer, shared) = (ident(&source.writer), quote_shared_of(source));
        quote!(pub #writer: ::framework::Writer<#shared>,)
    });
    let about = doc("In a replay: who writes what an instance reads.");
    quote! {
        #about
        pub struct Outside {
            #injections
            #parameters
            #(#sources)*
        }
    }
}
