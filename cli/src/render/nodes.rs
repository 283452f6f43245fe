//! `src/cyclers/<cycler>.rs`.

use proc_macro2::TokenStream;
use quote::quote;

use super::context::quote_context;
use super::layout::{self, doc};
use super::spelling::{ident, path};
use super::step::{quote_create, quote_creation, quote_frame, quote_injections, quote_step};
use crate::model::cycler::Calls;
use crate::model::frame::Hardware;
use crate::model::node::NodeModel;
use crate::model::{CyclerModel, OnFailure};

/// The nodes of one cycler, in which order they run, and one function for each.
///
/// The order shows in the calls alone; the rest is sorted by name, so that another order moves nothing but calls.
pub(super) fn render_nodes(cycler: &CyclerModel) -> String {
    let mut by_name: Vec<&NodeModel> = cycler.nodes.iter().collect();
    by_name.sort_by(|one, other| one.name.cmp(&other.name));
    let fields = by_name.iter().map(|node| {
        let name = ident(&node.name);
        let state = path(&format!("{}::{}", node.path, node.type_name));
        quote!(pub #name: ::framework::Guarded<#state>,)
    });
    let functions = [
        quote_new(cycler),
        quote_calls(
            cycler,
            &cycler.setup,
            "setup",
            "Setup nodes: wait for the data this cycle is about.",
        ),
        quote_inject(cycler),
        quote_calls(
            cycler,
            &cycler.cycle,
            "cycle",
            "Nodes: each call reads only what a call above it, or another cycler, wrote.",
        ),
        quote_closely(cycler),
        quote_restore(cycler),
    ];
    let steps = by_name.iter().map(|node| quote_step(cycler, node));
    let creates = by_name.iter().map(|node| quote_create(cycler, node));
    let about = doc("The nodes of one instance; they keep their state between cycles.");
    let items = quote! {
        use ::framework::InNode;

        #about
        pub struct Nodes {
            #(#fields)*
        }

        impl Nodes {
            #(#functions)*
            #(#steps)*
            #(#creates)*
        }
    };
    let modules: Vec<String> = cycler.nodes.iter().map(|node| node.path.clone()).collect();
    layout::rust_file(&cycler.title, &modules, items)
}

fn quote_new(cycler: &CyclerModel) -> TokenStream {
    let (parameters, argument) = creation(cycler, &cycler.creation_hardware);
    let fields = created(cycler).map(|node| {
        let (name, create) = (ident(&node.name), ident(&format!("create_{}", node.name)));
        let (node_path, on_failure) = (&node.path, quote_on_failure(node.on_failure));
        let creation = (!node.creation.context.is_empty()).then(|| quote!(creation));
        quote!(#name: ::framework::Guarded::new(#node_path, #on_failure, Self::#create(#creation)?),)
    });
    quote! {
        pub fn new #parameters(#argument) -> ::framework::Result<Self> {
            Ok(Self { #(#fields)* })
        }
    }
}

/// The nodes in the order they are created; Rust evaluates fields as they are written.
fn created(cycler: &CyclerModel) -> impl Iterator<Item = &NodeModel> {
    let order = cycler.creation_order.iter();
    order.map(|position| &cycler.nodes[*position])
}

/// The calls in the order they run.
fn quote_calls(cycler: &CyclerModel, calls: &Calls, name: &str, about: &str) -> TokenStream {
    if calls.nodes.is_empty() {
        return quote!();
    }
    let (about, name) = (doc(about), ident(name));
    let (parameters, frame) = quote_frame(cycler, &calls.hardware);
    let nodes = calls.nodes.iter().map(|node| ident(node));
    quote! {
        #about
        #[inline(always)]
        pub fn #name #parameters(&mut self, frame: &mut #frame) -> ::framework::Result<()> {
            #(self.#nodes(frame)?;)*
            Ok(())
        }
    }
}

/// The same calls for a cycle that is timed or injected: compiled apart, so that all others need not ask at every node.
fn quote_closely(cycler: &CyclerModel) -> TokenStream {
    if cycler.cycle.nodes.is_empty() {
        return quote!();
    }
    let about = doc("As `cycle`, when it is timed or clients replace outputs.");
    let (parameters, frame) = quote_frame(cycler, &cycler.cycle.hardware);
    quote! {
        #about
        #[cold]
        #[inline(never)]
        pub fn cycle_closely #parameters(&mut self, frame: &mut #frame) -> ::framework::Result<()> {
            self.cycle(frame)
        }
    }
}

/// Setup nodes run before a cycle begins, so clients' values replace theirs only then.
fn quote_inject(cycler: &CyclerModel) -> TokenStream {
    let outputs = cycler.setup_outputs();
    if outputs.is_empty() {
        return quote!();
    }
    let about = doc("Clients' values in place of what setup nodes wrote.");
    let injections = quote_injections(&outputs);
    let hardware = match &cycler.setup.hardware {
        Hardware::Absent => Hardware::Absent,
        Hardware::Asked(_) => Hardware::Asked(Vec::new()),
    };
    let (parameters, frame) = quote_frame(cycler, &hardware);
    quote! {
        #about
        pub fn inject #parameters(frame: &mut #frame) {
            #injections
        }
    }
}

/// Rebuilds what states do not hold, after they were loaded.
fn quote_restore(cycler: &CyclerModel) -> TokenStream {
    let restored: Vec<&NodeModel> = created(cycler).filter(|node| node.restores).collect();
    if restored.is_empty() {
        return quote!();
    }
    let about = doc("What the states of nodes do not hold is rebuilt, after they were loaded.");
    let (parameters, argument) = creation(cycler, &cycler.restore_hardware);
    let calls = restored.iter().map(|node| {
        let (name, node_path) = (ident(&node.name), &node.path);
        let context = quote_context(node, "CreationContext", "creation", &node.creation.context);
        quote! {
            let context = #context;
            self.#name.node_mut().restore(context).in_node(#node_path)?;
        }
    });
    let argument = (!argument.is_empty()).then(|| quote!(, #argument));
    quote! {
        #about
        pub fn restore #parameters(&mut self #argument) -> ::framework::Result<()> {
            #(#calls)*
            Ok(())
        }
    }
}

/// A creation as argument, if there is anything to create from.
fn creation(cycler: &CyclerModel, hardware: &Hardware) -> (TokenStream, TokenStream) {
    if cycler.creation.is_empty() {
        return (quote!(), quote!());
    }
    quote_creation(cycler, hardware)
}

/// A policy as the framework names it.
pub(super) fn quote_on_failure(on_failure: OnFailure) -> TokenStream {
    match on_failure {
        OnFailure::Stop => quote!(::framework::OnFailure::Stop),
        OnFailure::Restart => quote!(::framework::OnFailure::Restart),
        OnFailure::Skip => quote!(::framework::OnFailure::Skip),
        OnFailure::Hold => quote!(::framework::OnFailure::Hold),
    }
}
