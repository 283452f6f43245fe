//! `src/recording.rs` and `src/recording/<cycler>.rs`: what a recording takes of an instance, and the instance in a replay.
//!
//! Saving and loading are written from one list: the fields of what nodes may touch. A field of a new kind does not compile
//! before it is decided here what a recording keeps of it.

mod outside;
mod replay;
mod sink;
mod tape;

use proc_macro2::TokenStream;
use quote::quote;

use super::body::{argument, own, quote_generics, quote_shared};
use super::database::database_modules;
use super::layout::{self, doc};
use super::spelling::{ident, path};
use crate::model::cycler::OutputField;
use crate::model::{CyclerModel, RuntimeModel};
use outside::quote_outside;
use replay::quote_replays;
use sink::quote_sink;
pub use sink::render_stand_in;
use tape::{Tape, quote_tape};

/// One module for each cycler, what stands in for the hardware, and all instances that can be replayed.
pub(super) fn render_recording(model: &RuntimeModel) -> String {
    let mut modules: Vec<&str> = model
        .cyclers
        .iter()
        .map(|cycler| cycler.module.as_str())
        .collect();
    modules.sort_unstable();
    let modules = modules.into_iter().map(ident);
    let sink = quote_sink(
        "Sink",
        "The hardware of a replay: what it is told to do goes nowhere, and it cannot be asked.",
        &model.sink.traits,
    );
    let replayed = replay::replayed(model).map(|(instance, cycler)| {
        let (name, module) = (&instance.name, ident(&cycler.module));
        let create = replay::function(instance);
        let body = path(&format!(
            "crate::runtime::{}::{}",
            cycler.module, cycler.body
        ));
        let arguments = cycler.is_generic().then(|| quote!(<Sink>));
        quote! {
            ::framework::replay::Replayable {
                instance: #name,
                create: #module::#create,
                types: ::framework::recorded::describe::<#body #arguments>,
            },
        }
    });
    let about = doc("All instances that a recording can be replayed with, in manifest order.");
    let items = quote! {
        #(pub mod #modules;)*
        #about
        pub const INSTANCES: &[::framework::replay::Replayable] = &[#(#replayed)*];
        #sink
    };
    layout::rust_file("Recordings of the robot, and their replay.", &[], items)
}

/// What a recording takes of one cycler's instances, and each instance alone.
pub(super) fn render_recorded(model: &RuntimeModel, cycler: &CyclerModel) -> String {
    let outside = quote_outside(cycler);
    let recorded = quote_recorded(cycler);
    let nodes = quote_nodes(cycler);
    let replays = quote_replays(model, cycler);
    let items = quote!(#outside #recorded #nodes #replays);
    let title = format!(
        "Cycler `{}` in a recording: what its cycles take, saved and given back.",
        cycler.name
    );
    layout::rust_file(&title, &database_modules(cycler), items)
}

fn quote_recorded(cycler: &CyclerModel) -> TokenStream {
    let (bounded, arguments) = quote_generics(cycler, true);
    let name = path(&format!(
        "crate::runtime::{}::{}",
        cycler.module, cycler.body
    ));
    let values = quote_values(cycler);
    let save = quote_save(cycler);
    let describe = quote_describe(cycler);
    let load = quote_load(cycler);
    let digested = digested(cycler);
    let names = digested
        .iter()
        .map(|OutputField { node, name, .. }| quote!((#node, #name)));
    let digests = quote_digests(cycler, &digested);
    quote! {
        impl #bounded ::framework::recorded::Recorded for #name #arguments {
            type Outside = Outside;

            const DIGESTED: &'static [(&'static str, &'static str)] = &[#(#names),*];

            #values
            #save
            #describe
            #load
            #digests
        }
    }
}

/// Values of others: frames name them by number.
fn quote_values(cycler: &CyclerModel) -> TokenStream {
    let latest = cycler.latest.iter().map(|source| {
        let (instance, reader) = (&source.instance, ident(&source.reader));
        quote!(values.of(#instance, &self.#reader)?;)
    });
    let lanes = cycler.perception.iter().flat_map(|one| &one.lanes);
    let lanes = lanes.map(|lane| {
        let (instance, field) = (&lane.instance, ident(&lane.field));
        quote!(values.of(#instance, &self.perception.#field)?;)
    });
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(values.parameters(&self.parameters)?;));
    let body = quote!(#parameters #(#latest)* #(#lanes)*);
    let values = argument("values", !body.is_empty());
    quote! {
        fn values(
            &self,
            #values: &mut ::framework::recorded::Values<'_, '_>,
        ) -> Result<(), ::framework::recorded::SaveError> {
            #body
            Ok(())
        }
    }
}

fn quote_save(cycler: &CyclerModel) -> TokenStream {
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(self.parameters.save_version(out);));
    let nodes = cycler.nodes.iter().map(|node| {
        let name = ident(&node.name);
        quote!(self.nodes.#name.record(out);)
    });
    let tape = quote_tape(cycler, Tape::Save);
    let body = quote!(#parameters #(#nodes)* #tape);
    let shared = quote_shared(cycler);
    let slots = argument("slots", tape::uses_slots(cycler));
    let cycle = argument("cycle", tape::uses_cycle(cycler));
    let out = argument("out", !body.is_empty());
    let since = argument("since", cycler.historic().next().is_some());
    quote! {
        fn save(
            &self,
            #cycle: u64,
            #slots: ::framework::Slots<'_, #shared>,
            #since: Option<::framework::Timestamp>,
            #out: &mut ::framework::recorded::Saving<'_, '_>,
        ) {
            #body
        }
    }
}

/// The types of what is saved, in the same order.
fn quote_describe(cycler: &CyclerModel) -> TokenStream {
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(types.parameters(|body| &body.parameters);));
    let nodes = cycler.nodes.iter().map(|node| {
        let (name, node_path) = (ident(&node.name), &node.path);
        quote!(types.node(#node_path, |body| &body.nodes.#name);)
    });
    let tape = quote_tape(cycler, Tape::Describe);
    let body = quote!(#parameters #(#nodes)* #tape);
    let types = argument("types", !body.is_empty());
    quote! {
        fn describe(#types: &mut ::framework::recorded::Describing<Self>) {
            #body
        }
    }
}

fn quote_load(cycler: &CyclerModel) -> TokenStream {
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(self.parameters.load_version(from, &mut outside.parameters, stored)?;));
    let tape = quote_tape(cycler, Tape::Load);
    let restores = cycler.nodes.iter().any(|node| node.restores);
    // A copy of the cursor: `restore` may change what nodes share.
    let again = (restores && cycler.has_states()).then(|| quote!(let mut again = *from;));
    let before_states = quote!(#again);
    let restore = restores.then(|| quote!(::framework::Body::restore(self)?;));
    let states = again.map(|_| quote!(self.cycler_state = again.take()?;));
    let shared = quote_shared(cycler);
    let slots = argument("slots", tape::uses_slots(cycler));
    let cycle = argument("cycle", tape::uses_cycle(cycler));
    let reads = cycler.perception.is_some() || !cycler.latest.is_empty();
    let outside = argument("outside", outside::is_needed(cycler));
    let stored = argument("stored", reads || cycler.has_parameters());
    quote! {
        fn load(
            &mut self,
            #cycle: u64,
            #slots: ::framework::recorded::Loaded<'_, #shared>,
            #outside: &mut Outside,
            from: &mut ::framework::recorded::Loading<'_>,
            #stored: &::framework::recorded::Stored<'_>,
        ) -> ::framework::Result<()> {
            #parameters
            self.nodes = load_nodes(from)?;
            #before_states
            #tape
            #restore
            #states
            Ok(())
        }
    }
}

/// The nodes that `save` wrote.
fn quote_nodes(cycler: &CyclerModel) -> TokenStream {
    let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
    let fields = cycler.nodes.iter().map(|node| {
        let (name, node_path) = (ident(&node.name), &node.path);
        let on_failure = super::nodes::quote_on_failure(node.on_failure);
        quote!(#name: ::framework::Guarded::recorded(#node_path, #on_failure, from)?,)
    });
    let about = doc("The nodes as `save` wrote them, in manifest order.");
    quote! {
        #about
        fn load_nodes(
            from: &mut ::framework::recorded::Loading<'_>,
        ) -> ::framework::Result<#nodes> {
            Ok(#nodes { #(#fields)* })
        }
    }
}

/// What is digested at the end of a frame, in the order of the nodes' calls.
fn digested(cycler: &CyclerModel) -> Vec<&OutputField> {
    let called = cycler.cycle.nodes.iter().filter_map(|name| {
        let mut nodes = cycler.nodes.iter();
        nodes.find(|node| node.name == *name)
    });
    let outputs = called.flat_map(|node| {
        let outputs = cycler.outputs.iter();
        outputs.filter(|output| output.node == node.path)
    });
    outputs.collect()
}

fn quote_digests(cycler: &CyclerModel, digested: &[&OutputField]) -> TokenStream {
    let values = digested.iter().map(|output| {
        let field = ident(&output.name);
        match output.shared {
            true => quote!(digests.add(&shared.#field);),
            false => quote!(digests.add(&self.own.previous().#field);),
        }
    });
    let uses_shared = digested.iter().any(|output| output.shared);
    let shared = argument("shared", uses_shared);
    let digests = argument("digests", !digested.is_empty());
    let shared_type = quote_shared(cycler);
    quote! {
        fn digests(
            &self,
            #shared: &#shared_type,
            #digests: &mut ::framework::recorded::Digests<'_, '_>,
        ) {
            #(#values)*
        }
    }
}
