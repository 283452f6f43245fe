//! `src/databases/<cycler>.rs`.

use proc_macro2::TokenStream;
use quote::quote;

use super::layout::{self, doc};
use super::spelling::{data_type, ident, path};
use super::structs::quote_struct;
use crate::model::cycler::{OutputField, Source};
use crate::model::frame::{FrameField, InstanceParameters};
use crate::model::structs::FieldType;
use crate::model::{CyclerModel, Outside};

/// The database of one cycler, and everything its nodes may touch.
pub(super) fn render_database(cycler: &CyclerModel) -> String {
    let title = format!(
        "What cycler `{}` writes, and what its nodes see.",
        cycler.name
    );
    let items = [
        quote_outputs(cycler),
        quote_additional_outputs(cycler),
        quote_injections(cycler),
        quote_states(cycler),
        quote_procedures(cycler),
        quote_historic(cycler),
        quote_perception(cycler),
        quote_latest(cycler),
        quote_previous(cycler),
        quote_creation(cycler),
        quote_frame(cycler),
    ];
    layout::rust_file(
        &title,
        &database_modules(cycler),
        items.into_iter().collect(),
    )
}

/// The database of a cycler that is left out: what others read of it.
pub(super) fn render_outside(cycler: &Outside) -> String {
    let title = format!(
        "What others read of cycler `{}`, which {}.",
        cycler.name, cycler.reason
    );
    let about = "Main outputs that come from outside; each names the node that writes it in the whole robot.";
    let outputs = cycler.outputs.iter();
    layout::rust_file(&title, &[], quote_shared_part(about, outputs))
}

/// Modules of other cyclers' databases, which are imported whole.
pub(super) fn database_modules(cycler: &CyclerModel) -> Vec<String> {
    let lanes = cycler
        .perception
        .iter()
        .flat_map(|perception| &perception.lanes);
    let sources = cycler
        .latest
        .iter()
        .chain(lanes)
        .filter(|source| source.module != cycler.module);
    sources
        .map(|source| format!("crate::databases::{}", source.module))
        .collect()
}

/// The shared outputs of an instance that is read.
pub(super) fn quote_shared_of(source: &Source) -> TokenStream {
    path(&format!(
        "crate::databases::{}::SharedOutputs",
        source.module
    ))
}

fn quote_outputs(cycler: &CyclerModel) -> TokenStream {
    let outputs = |shared: bool| {
        let outputs = cycler.outputs.iter();
        outputs.filter(move |output| output.shared == shared)
    };
    let about = format!(
        "Main outputs that only nodes of `{}` read: they stay with the instance.",
        cycler.name
    );
    let own = quote_part("OwnOutputs", &about, quote!(), outputs(false));
    let shared = quote_shared_part(
        "Main outputs that other instances read, too: written in the slot that those will read.",
        outputs(true),
    );
    quote!(#own #shared)
}

/// Recordings of those who read them have them, too.
fn quote_shared_part<'a>(
    about: &str,
    outputs: impl Iterator<Item = &'a OutputField>,
) -> TokenStream {
    let recorded = quote!(::framework::recorded::Outputs,);
    quote_part("SharedOutputs", about, recorded, outputs)
}

/// A struct of main outputs with these derives besides the others', if there are any.
fn quote_part<'a>(
    name: &str,
    about: &str,
    derives: TokenStream,
    outputs: impl Iterator<Item = &'a OutputField>,
) -> TokenStream {
    let fields: Vec<TokenStream> = outputs
        .map(|output| quote_output(output, &|data| data))
        .collect();
    if fields.is_empty() {
        return quote!();
    }
    let (name, about) = (ident(name), doc(about));
    quote! {
        #about
        #[derive(Clone, Debug, Default, ::serde::Deserialize, #derives ::framework::Reflect, ::serde::Serialize)]
        pub struct #name { #(#fields)* }
    }
}

fn quote_output(output: &OutputField, wrap: &dyn Fn(TokenStream) -> TokenStream) -> TokenStream {
    let (about, name) = (doc(&output.node), ident(&output.name));
    let data = wrap(data_type(&output.data));
    quote!(#about pub #name: #data,)
}

fn quote_additional_outputs(cycler: &CyclerModel) -> TokenStream {
    let structs = cycler
        .additional_structs
        .iter()
        .enumerate()
        .map(|(position, definition)| {
            let root = (position == 0).then(|| doc("Computed only while somebody listens."));
            let head = quote!(#root #[derive(Debug, Default)]);
            quote_struct(
                definition,
                &head,
                &|data| quote!(::framework::AdditionalSlot<#data>),
            )
        });
    let flags: Vec<_> = cycler
        .additional_outputs
        .iter()
        .map(|output| ident(&output.flag))
        .collect();
    let about = doc("Who listens to which additional output, decided once per cycle.");
    let subscribed = (!flags.is_empty()).then(|| {
        quote! {
            #about
            #[derive(Clone, Copy, Debug, Default, ::serde::Deserialize, ::serde::Serialize)]
            pub struct Subscribed {
                #(pub #flags: bool,)*
            }
        }
    });
    quote!(#(#structs)* #subscribed)
}

/// The framework's table of injections; without main outputs there is nothing in it.
fn quote_injections(cycler: &CyclerModel) -> TokenStream {
    let fields = cycler.outputs.iter().map(|output| {
        let (name, data) = (ident(&output.name), data_type(&output.data));
        quote!(pub #name: ::framework::Injection<#data>,)
    });
    let arms = cycler.outputs.iter().map(|output| {
        let (text, name) = (&output.name, ident(&output.name));
        quote!(#text => Some(&mut self.#name),)
    });
    let (output, found) = if cycler.outputs.is_empty() {
        (quote!(_output), quote!(None))
    } else {
        (
            quote!(output),
            quote!(match output { #(#arms)* _ => None, }),
        )
    };
    let about = doc("Values of clients in place of main outputs.");
    quote! {
        #about
        #[derive(Clone, Debug, Default, ::serde::Deserialize, ::framework::recorded::Outputs, ::serde::Serialize)]
        pub struct Injections {
            #(#fields)*
        }

        impl ::framework::InjectionTable for Injections {
            fn get_mut(&mut self, #output: &str) -> Option<&mut dyn ::framework::InjectionCell> {
                #found
            }
        }
    }
}

fn quote_states(cycler: &CyclerModel) -> TokenStream {
    let structs = cycler.state_structs.iter().enumerate().map(|(position, definition)| {
        let root =
            (position == 0).then(|| doc("Shared by the nodes of one instance, kept between cycles."));
        let head = quote! {
            #root
            #[derive(Clone, Debug, Default, ::serde::Deserialize, ::framework::Reflect, ::serde::Serialize)]
        };
        quote_struct(definition, &head, &|data| data)
    });
    quote!(#(#structs)*)
}

fn quote_procedures(cycler: &CyclerModel) -> TokenStream {
    if cycler.procedures.is_empty() {
        return quote!();
    }
    let fields = cycler.procedures.iter().map(|procedure| {
        let (about, name) = (doc(&procedure.node), ident(&procedure.name));
        let (request, response) = (
            data_type(&procedure.request),
            data_type(&procedure.response),
        );
        quote!(#about pub #name: ::framework::Answerer<#request, #response>,)
    });
    let about = doc("Calls that nodes answer, at most one of each in a cycle.");
    quote!(#about pub struct Procedures { #(#fields)* })
}

fn quote_historic(cycler: &CyclerModel) -> TokenStream {
    let fields: Vec<TokenStream> = cycler
        .historic()
        .map(|output| quote_output(output, &|data| quote!(::framework::History<#data>)))
        .collect();
    if fields.is_empty() {
        return quote!();
    }
    let about = doc("Main outputs that are read by time.");
    quote!(#about pub struct Historic { #(#fields)* })
}

fn quote_perception(cycler: &CyclerModel) -> TokenStream {
    let Some(perception) = &cycler.perception else {
        return quote!();
    };
    let interleavings = perception
        .interleavings
        .iter()
        .map(|interleaving| ident(&interleaving.field));
    let lanes = perception.lanes.iter().map(|lane| {
        let (name, shared) = (ident(&lane.field), quote_shared_of(lane));
        quote!(pub #name: ::framework::Consumer<#shared>,)
    });
    let about = doc("Perception instances in one order of time.");
    let horizon = ident(&perception.horizon);
    quote! {
        #about
        pub struct Perception {
            pub #horizon: ::framework::Horizon,
            #(pub #interleavings: ::framework::Interleaving,)*
            #(#lanes)*
        }
    }
}

fn quote_latest(cycler: &CyclerModel) -> TokenStream {
    if cycler.latest.is_empty() {
        return quote!();
    }
    let fields = cycler.latest.iter().map(|source| {
        let (name, shared) = (ident(&source.field), quote_shared_of(source));
        quote!(pub #name: ::framework::View<'a, #shared>,)
    });
    let about = doc("The newest finished cycle of other instances.");
    quote!(#about #[derive(Clone, Copy)] pub struct Latest<'a> { #(#fields)* })
}

fn quote_previous(cycler: &CyclerModel) -> TokenStream {
    if !cycler.has(&FrameField::Previous) {
        return quote!();
    }
    let own = cycler
        .previous
        .own
        .then(|| quote!(pub own: &'a OwnOutputs,));
    let shared = cycler
        .previous
        .shared
        .then(|| quote!(pub shared: &'a SharedOutputs,));
    let about = doc("What the last finished cycle wrote.");
    quote!(#about #[derive(Clone, Copy)] pub struct Previous<'a> { #own #shared })
}

fn quote_creation(cycler: &CyclerModel) -> TokenStream {
    if cycler.creation.is_empty() {
        return quote!();
    }
    let hardware = cycler
        .creation
        .contains(&FrameField::HardwareInterface)
        .then(|| quote!(, Hardware));
    let fields = cycler.creation.iter().map(quote_frame_field);
    let about = doc("Everything a node may ask for when it is created.");
    quote!(#about pub struct Creation<'a #hardware> { #(#fields)* })
}

fn quote_frame(cycler: &CyclerModel) -> TokenStream {
    let hardware = cycler
        .has(&FrameField::HardwareInterface)
        .then(|| quote!(, Hardware));
    let lifetime = cycler.frame_borrows().then(|| quote!(<'a #hardware>));
    let fields = cycler.frame.iter().map(quote_frame_field);
    let about = doc("Everything the nodes of one cycle may touch, borrowed.");
    let creation = cycler.renews.then(|| quote_creation_of_frame(cycler));
    quote! {
        #about
        pub struct Frame #lifetime {
            #(#fields)*
        }

        #creation
    }
}

/// Only what a creation context needs, to create a node anew in the middle of a cycle.
fn quote_creation_of_frame(cycler: &CyclerModel) -> TokenStream {
    let generic = cycler.has(&FrameField::HardwareInterface);
    let parameter = generic.then(|| quote!(<Hardware>));
    let in_frame = generic.then(|| quote!(, Hardware));
    let created_with_hardware = cycler.creation.contains(&FrameField::HardwareInterface);
    let in_creation = created_with_hardware.then(|| quote!(, Hardware));
    let fields = cycler.creation.iter().map(|field| {
        let name = ident(field.name());
        quote!(#name: self.#name,)
    });
    let about = doc("What a node needs that is created anew after a panic.");
    quote! {
        impl #parameter Frame<'_ #in_frame> {
            #about
            pub fn creation(&mut self) -> Creation<'_ #in_creation> {
                Creation { #(#fields)* }
            }
        }
    }
}

fn quote_frame_field(field: &FrameField) -> TokenStream {
    let name = ident(field.name());
    let content = match field {
        FrameField::AdditionalOutputs => quote!(&'a mut AdditionalOutputs),
        FrameField::CaptureTime => quote!(&'a mut Option<::framework::Timestamp>),
        FrameField::Cycle => quote!(::framework::Cycle),
        FrameField::CyclerState => quote!(&'a mut CyclerState),
        FrameField::HardwareInterface => quote!(&'a ::std::sync::Arc<Hardware>),
        FrameField::Historic => quote!(&'a Historic),
        FrameField::Injections => quote!(Option<&'a Injections>),
        FrameField::Instance(part) => quote_instance_parameters(part, &quote!(&'a)),
        FrameField::Latest => quote!(Latest<'a>),
        FrameField::Own => quote!(&'a mut OwnOutputs),
        FrameField::Parameters => quote!(&'a crate::parameters::Parameters),
        FrameField::Perception => quote!(&'a Perception),
        FrameField::Previous => quote!(Previous<'a>),
        FrameField::Procedures => quote!(&'a mut Procedures),
        FrameField::Shared => quote!(&'a mut SharedOutputs),
        FrameField::Subscribed => quote!(Subscribed),
    };
    quote!(pub #name: #content,)
}

/// The type of what stands in place of `$cycler_instance`, behind such a reference.
pub(super) fn quote_instance_parameters(
    part: &InstanceParameters,
    reference: &TokenStream,
) -> TokenStream {
    let content = match &part.content {
        FieldType::Struct(name) => path(&format!("crate::parameters::{name}")),
        FieldType::Data(data) => data_type(data),
    };
    match part.may_be_absent() {
        true => quote!(Option<#reference #content>),
        false => quote!(#reference #content),
    }
}
