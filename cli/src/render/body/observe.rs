//! What drivers, recordings and clients see of a body.

use proc_macro2::TokenStream;
use quote::quote;

use super::{argument, quote_shared};
use crate::model::CyclerModel;
use crate::render::spelling::{ident, place};

pub(super) fn quote_observe(cycler: &CyclerModel) -> TokenStream {
    [
        quote_references(cycler),
        quote_main_outputs(cycler),
        quote_additional_output(cycler),
        quote_outputs(cycler),
        quote_nodes(cycler),
        quote_queues(cycler),
        quote_states(cycler),
    ]
    .into_iter()
    .collect()
}

fn quote_references(cycler: &CyclerModel) -> TokenStream {
    let latest = cycler.latest.iter().map(|source| {
        let (instance, reader) = (&source.instance, ident(&source.reader));
        quote!(self.#reader.references(#instance, visit);)
    });
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(self.parameters.references("parameters", visit);));
    let lanes = cycler
        .perception
        .iter()
        .flat_map(|perception| &perception.lanes)
        .map(|lane| {
            let (instance, field) = (&lane.instance, ident(&lane.field));
            quote!(self.perception.#field.references(#instance, visit);)
        });
    let body = quote!(#(#latest)* #(#lanes)* #parameters);
    let visit = argument("visit", !body.is_empty());
    quote! {
        fn references(&self, #visit: &mut dyn FnMut(::framework::Reference)) {
            #body
        }
    }
}

fn quote_main_outputs(cycler: &CyclerModel) -> TokenStream {
    let names = &cycler.output_names;
    let shared_type = quote_shared(cycler);
    let shared = argument("shared", cycler.has_shared());
    let name = argument("name", !names.is_empty());
    let arms = cycler.output_names.iter().map(|output| {
        let field = ident(output);
        let known = cycler.outputs.iter().find(|known| known.name == *output);
        if known.is_some_and(|known| known.shared) {
            quote!(#output => Some(&shared.#field),)
        } else {
            quote!(#output => Some(&self.own.previous().#field),)
        }
    });
    let found = if names.is_empty() {
        quote!(None)
    } else {
        quote!(match name { #(#arms)* _ => None, })
    };
    quote! {
        fn main_outputs(&self) -> &'static [&'static str] {
            &[#(#names),*]
        }

        fn main_output<'a>(
            &'a self,
            #shared: &'a #shared_type,
            #name: &str,
        ) -> Option<&'a dyn ::framework::Reflect> {
            #found
        }
    }
}

fn quote_additional_output(cycler: &CyclerModel) -> TokenStream {
    let needed = !cycler.additional_outputs.is_empty();
    let (name, cycle) = (argument("name", needed), argument("cycle", needed));
    let arms = cycler.additional_outputs.iter().map(|output| {
        let (names, slot) = (&output.names, place(&output.place));
        quote!(#(#names)|* => Some(self.additional_outputs.#slot.get(cycle)?),)
    });
    let found = if needed {
        quote!(match name { #(#arms)* _ => None, })
    } else {
        quote!(None)
    };
    quote! {
        fn additional_output(&self, #name: &str, #cycle: u64) -> Option<&dyn ::framework::Reflect> {
            #found
        }
    }
}

/// Every output with its type, in the order of the names.
fn quote_outputs(cycler: &CyclerModel) -> TokenStream {
    let main = cycler.output_names.iter().map(|output| {
        let field = ident(output);
        let known = cycler.outputs.iter().find(|known| known.name == *output);
        if known.is_some_and(|known| known.shared) {
            quote!(visitor.output(Some(&shared.#field));)
        } else {
            quote!(visitor.output(Some(&self.own.previous().#field));)
        }
    });
    let additional = cycler.additional_outputs.iter().map(|output| {
        let slot = place(&output.place);
        quote!(visitor.output(self.additional_outputs.#slot.get(cycle));)
    });
    let body = quote!(#(#main)* #(#additional)*);
    let shared_type = quote_shared(cycler);
    let shared = argument("shared", cycler.has_shared());
    let cycle = argument("cycle", !cycler.additional_outputs.is_empty());
    let visitor = argument("visitor", !body.is_empty());
    quote! {
        fn outputs<'a>(
            &'a self,
            #shared: &'a #shared_type,
            #cycle: u64,
            #visitor: &mut impl ::framework::OutputVisitor<'a>,
        ) {
            #body
        }
    }
}

fn quote_nodes(cycler: &CyclerModel) -> TokenStream {
    let nodes = cycler.nodes.iter().map(|node| ident(&node.name));
    quote! {
        fn nodes(&self, visit: &mut dyn FnMut(::framework::NodeReport)) {
            #(visit(self.nodes.#nodes.report());)*
        }
    }
}

fn quote_queues(cycler: &CyclerModel) -> TokenStream {
    let visit = argument("visit", cycler.perception.is_some());
    let lanes = cycler
        .perception
        .iter()
        .flat_map(|perception| &perception.lanes)
        .map(|lane| {
            let (from, field) = (&lane.instance, ident(&lane.field));
            quote! {
                visit(::framework::QueueReport {
                    from: #from,
                    counts: self.perception.#field.report(),
                });
            }
        });
    quote! {
        fn queues(&self, #visit: &mut dyn FnMut(::framework::QueueReport)) {
            #(#lanes)*
        }
    }
}

fn quote_states(cycler: &CyclerModel) -> TokenStream {
    let nodes = cycler.nodes.iter().map(|node| {
        let (path, name) = (&node.path, ident(&node.name));
        quote!(visit(#path, &mut self.nodes.#name);)
    });
    let state = cycler
        .has_states()
        .then(|| quote!(visit("cycler_state", &mut self.cycler_state);));
    quote! {
        fn states(&mut self, visit: &mut dyn FnMut(&'static str, &mut dyn ::framework::State)) {
            #(#nodes)*
            #state
        }
    }
}
