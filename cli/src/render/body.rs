//! `src/runtime/<cycler>.rs`: a cycler between its buffers and its nodes.

mod calls;
mod observe;

use proc_macro2::TokenStream;
use quote::quote;

use super::database::{database_modules, quote_instance_parameters, quote_shared_of};
use super::instance::quote_description;
use super::layout::{self, doc};
use super::spelling::{bound, ident, path};
use crate::model::frame::{FrameField, Hardware, is_marker};
use crate::model::{CyclerModel, Runtime};

/// The body of one cycler's instances, and what the manifest says about each.
pub(super) fn render_body(cycler: &CyclerModel, runtime: &Runtime) -> String {
    let descriptions = runtime
        .instances
        .iter()
        .filter(|instance| instance.description.cycler == cycler.name)
        .map(quote_description);
    let body = quote_body(cycler);
    let frame = quote_frame_function(cycler);
    let calls = calls::quote_calls(cycler);
    let observe = observe::quote_observe(cycler);
    let shared = quote_shared(cycler);
    let (parameter, argument) = quote_generics(cycler, false);
    let (bounded, _) = quote_generics(cycler, true);
    let name = ident(&cycler.body);
    let additional_outputs = quote_additional_outputs(cycler);
    let items = quote! {
        #(#descriptions)*

        #additional_outputs

        #body

        impl #parameter #name #argument {
            #frame
        }

        impl #bounded ::framework::Body for #name #argument {
            type Shared = #shared;

            #calls
            #observe
        }
    };
    let title = format!(
        "Cycler `{}` between its buffers and its nodes.",
        cycler.name
    );
    layout::rust_file(&title, &database_modules(cycler), items)
}

/// The constant with the names of additional outputs, where all instances have the same.
fn quote_additional_outputs(cycler: &CyclerModel) -> Option<TokenStream> {
    let mut names = cycler.additional_outputs.iter().map(|output| &output.names);
    if !cycler.names_are_shared() || names.len() == 0 {
        return None;
    }
    let names = names.by_ref().flatten();
    let constant = ident(&cycler.additional_names);
    let about = doc("What clients can listen to, in the order of `Subscribed`.");
    Some(quote! {
        #about
        pub const #constant: &[&str] = &[#(#names),*];
    })
}

/// A type of the cycler's own database.
pub(super) fn own(cycler: &CyclerModel, name: &str) -> TokenStream {
    path(&format!("crate::databases::{}::{name}", cycler.module))
}

/// What a slot of the instance's buffer holds.
pub(super) fn quote_shared(cycler: &CyclerModel) -> TokenStream {
    if cycler.has_shared() {
        own(cycler, "SharedOutputs")
    } else {
        quote!(())
    }
}

/// Type parameters and type arguments of the body.
pub(super) fn quote_generics(cycler: &CyclerModel, bounded: bool) -> (TokenStream, TokenStream) {
    match &cycler.hardware {
        Hardware::Absent => (quote!(), quote!()),
        Hardware::Asked(_) if !bounded => (quote!(<Hardware>), quote!(<Hardware>)),
        Hardware::Asked(traits) => {
            let is_static = traits.iter().any(|one| one == "'static");
            let lifetime = is_static.then(|| quote!(+ 'static));
            let traits = traits.iter().filter(|one| !is_marker(one));
            let traits = traits.map(|one| bound(one));
            (
                quote!(<Hardware: #(#traits +)* Send + Sync #lifetime>),
                quote!(<Hardware>),
            )
        }
    }
}

fn quote_body(cycler: &CyclerModel) -> TokenStream {
    let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
    let fields = quote_fields(cycler);
    let readers = cycler.latest.iter().map(|source| {
        let (name, shared) = (ident(&source.reader), quote_shared_of(source));
        quote!(pub #name: ::framework::Reader<#shared>,)
    });
    let selects = cycler.instance_parameters.iter().map(|part| {
        let (name, content) = (
            ident(&part.select),
            quote_instance_parameters(part, &quote!(&)),
        );
        quote!(pub #name: fn(&crate::parameters::Parameters) -> #content,)
    });
    let about = doc("One instance: its nodes, and its ends of all buffers.");
    let (name, (parameter, _)) = (ident(&cycler.body), quote_generics(cycler, false));
    quote! {
        #about
        pub struct #name #parameter {
            pub nodes: #nodes,
            #fields
            #(#readers)*
            #(#selects)*
        }
    }
}

/// What a body may have, as far as this one needs it.
fn quote_fields(cycler: &CyclerModel) -> TokenStream {
    let has = |field: FrameField| cycler.has(&field);
    let own = |name: &str| own(cycler, name);
    let (own_outputs, injections) = (own("OwnOutputs"), own("Injections"));
    let capture_time = quote!(Option<::framework::Timestamp>);
    let hardware = quote!(::std::sync::Arc<Hardware>);
    let injections = quote!(::framework::Reader<::framework::Injected<#injections>>);
    let swap = quote!(::framework::Swap<#own_outputs>);
    let parameters = quote!(::framework::Reader<crate::parameters::Parameters>);
    let subscriptions = quote!(::framework::Subscriptions);
    let fields = [
        (
            has(FrameField::AdditionalOutputs),
            "additional_outputs",
            own("AdditionalOutputs"),
        ),
        (has(FrameField::CaptureTime), "capture_time", capture_time),
        (cycler.has_states(), "cycler_state", own("CyclerState")),
        (cycler.is_generic(), "hardware_interface", hardware),
        (has(FrameField::Historic), "historic", own("Historic")),
        (has(FrameField::Injections), "injections", injections),
        (cycler.has_own(), "own", swap),
        (cycler.has_parameters(), "parameters", parameters),
        (has(FrameField::Perception), "perception", own("Perception")),
        (has(FrameField::Procedures), "procedures", own("Procedures")),
        (has(FrameField::Subscribed), "subscribed", own("Subscribed")),
        (has(FrameField::Subscribed), "subscriptions", subscriptions),
    ];
    let needed = fields.into_iter().filter(|(needed, ..)| *needed);
    let quoted = needed.map(|(_, name, content)| {
        let name = ident(name);
        quote!(pub #name: #content,)
    });
    quoted.collect()
}

/// The function that borrows everything the nodes may touch.
fn quote_frame_function(cycler: &CyclerModel) -> TokenStream {
    let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
    let frame = own(cycler, "Frame");
    let hardware = cycler
        .has(&FrameField::HardwareInterface)
        .then(|| quote!(, Hardware));
    let arguments = cycler.frame_borrows().then(|| quote!(<'a #hardware>));
    let shared = quote_shared(cycler);
    let slots = cycler
        .has_shared()
        .then(|| quote!(slots: ::framework::Slots<'a, #shared>,));
    let in_frame =
        |field: &FrameField| matches!(field, FrameField::Parameters | FrameField::Instance(_));
    let parameters = cycler
        .frame
        .iter()
        .any(in_frame)
        .then(|| quote!(let parameters = self.parameters.view().value();));
    let split = cycler
        .previous
        .own
        .then(|| quote!(let (own, previous_own) = self.own.both();));
    let fields = cycler.frame.iter().map(|field| quote_filled(cycler, field));
    let about = doc("The nodes, and everything they may touch in this cycle.");
    quote! {
        #about
        #[inline(always)]
        fn frame<'a>(&'a mut self, #slots cycle: ::framework::Cycle) -> (&'a mut #nodes, #frame #arguments) {
            #parameters
            #split
            let frame = #frame { #(#fields)* };
            (&mut self.nodes, frame)
        }
    }
}

/// What a field of the frame is filled with.
fn quote_filled(cycler: &CyclerModel, field: &FrameField) -> TokenStream {
    let name = ident(field.name());
    match field {
        FrameField::Cycle | FrameField::Parameters => quote!(#name,),
        FrameField::AdditionalOutputs
        | FrameField::CaptureTime
        | FrameField::CyclerState
        | FrameField::Procedures => quote!(#name: &mut self.#name,),
        FrameField::HardwareInterface | FrameField::Historic | FrameField::Perception => {
            quote!(#name: &self.#name,)
        }
        FrameField::Injections => quote!(#name: self.injections.view().value().get(),),
        FrameField::Instance(part) => {
            let select = ident(&part.select);
            quote!(#name: (self.#select)(parameters),)
        }
        FrameField::Latest => {
            let latest = own(cycler, "Latest");
            let fields = cycler.latest.iter().map(|source| {
                let (field, reader) = (ident(&source.field), ident(&source.reader));
                quote!(#field: self.#reader.view(),)
            });
            quote!(#name: #latest { #(#fields)* },)
        }
        FrameField::Own if cycler.previous.own => quote!(#name,),
        FrameField::Own => quote!(#name: self.own.both().0,),
        FrameField::Previous => {
            let previous = own(cycler, "Previous");
            let own = cycler.previous.own.then(|| quote!(own: previous_own,));
            let shared = cycler
                .previous
                .shared
                .then(|| quote!(shared: slots.previous,));
            quote!(#name: #previous { #own #shared },)
        }
        FrameField::Shared => quote!(#name: slots.current,),
        FrameField::Subscribed => quote!(#name: self.subscribed,),
    }
}

/// A name for an argument, with an underscore in front where the function does not need it.
pub(super) fn argument(name: &str, needed: bool) -> proc_macro2::Ident {
    if needed {
        ident(name)
    } else {
        ident(&format!("_{name}"))
    }
}
