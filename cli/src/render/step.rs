//! One function for each node: its step in a cycle, and how it is created.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::context::{quote_before, quote_context};
use super::layout::{comment, doc};
use super::spelling::{ident, path, quote_accessor, quote_hardware};
use crate::model::CyclerModel;
use crate::model::frame::Hardware;
use crate::model::node::{Failure, NodeModel, Required, RequiredSource, StepOutput};

/// The function that a cycle calls for a node.
///
/// Inlined, so that what one node wrote and the next one reads can stay in registers.
pub(super) fn quote_step(cycler: &CyclerModel, node: &NodeModel) -> TokenStream {
    let step = &node.step;
    let (about, name) = (doc(&step.flow), ident(&node.name));
    let (parameters, frame) = quote_frame(cycler, &step.hardware);
    let clear = step
        .outputs
        .iter()
        .filter(|output| output.in_place)
        .map(quote_default);
    let renew = step.renews.then(|| quote_renew(cycler, node));
    let call = quote_call(node);
    let called = if step.required.is_empty() {
        call
    } else {
        let written = step.required.iter().map(quote_written);
        let required = step.required.iter().map(quote_required);
        let why = comment(if step.outputs.is_empty() {
            "A required input is absent."
        } else {
            "A required input is absent: the main outputs take their defaults."
        });
        let defaults = step
            .outputs
            .iter()
            .filter(|output| !output.in_place)
            .map(quote_default);
        quote! {
            #(#written)*
            if #(#required)&&* {
                #call
            } else {
                #why
                self.#name.skip();
                #(#defaults)*
            }
        }
    };
    let holds = matches!(step.failure, Failure::Holds);
    let injections = step.injects.then(|| match holds {
        true => quote_injections_to_held(&name, &step.outputs),
        false => quote_injections(&step.outputs),
    });
    quote! {
        #about
        #[inline(always)]
        fn #name #parameters(&mut self, frame: &mut #frame) -> ::framework::Result<()> {
            #(#clear)*
            #renew
            #called
            #injections
            Ok(())
        }
    }
}

/// The function that creates a node.
pub(super) fn quote_create(cycler: &CyclerModel, node: &NodeModel) -> TokenStream {
    let create = ident(&format!("create_{}", node.name));
    let state = path(&format!("{}::{}", node.path, node.type_name));
    let node_path = &node.path;
    let context = quote_context(node, "CreationContext", "creation", &node.creation.context);
    let (parameters, argument) = if node.creation.context.is_empty() {
        (quote!(), quote!())
    } else {
        quote_creation(cycler, &node.creation.hardware)
    };
    quote! {
        fn #create #parameters(#argument) -> ::framework::Result<#state> {
            let context = #context;
            #state::new(context).in_node(#node_path)
        }
    }
}

/// The type parameters of a function that is given a creation, and the argument.
pub(super) fn quote_creation(
    cycler: &CyclerModel,
    hardware: &Hardware,
) -> (TokenStream, TokenStream) {
    let (parameters, hardware) = quote_hardware(hardware);
    let creation = path(&format!("crate::databases::{}::Creation", cycler.module));
    (parameters, quote!(creation: &mut #creation<'_ #hardware>))
}

/// The type parameters of a function with a frame of this hardware, and the frame's type.
pub(super) fn quote_frame(cycler: &CyclerModel, hardware: &Hardware) -> (TokenStream, TokenStream) {
    let (parameters, hardware) = quote_hardware(hardware);
    let frame = path(&format!("crate::databases::{}::Frame", cycler.module));
    let arguments = cycler.frame_borrows().then(|| quote!(<'_ #hardware>));
    (parameters, quote!(#frame #arguments))
}

/// Clients' values in place of outputs.
pub(super) fn quote_injections(outputs: &[StepOutput]) -> TokenStream {
    if outputs.is_empty() {
        return quote!();
    }
    let replace = outputs.iter().map(quote_replace);
    quote! {
        if let Some(injections) = frame.injections {
            #(#replace;)*
        }
    }
}

/// The same for a node whose last good outputs are repeated when it fails: clients' values are none of them.
fn quote_injections_to_held(node: &Ident, outputs: &[StepOutput]) -> TokenStream {
    if outputs.is_empty() {
        return quote!();
    }
    let replace = outputs.iter().map(quote_replace);
    quote! {
        if let Some(injections) = frame.injections {
            let replaced = [#(#replace),*];
            self.#node.replaced(&replaced);
        }
    }
}

/// Tells whether the output was replaced.
fn quote_replace(output: &StepOutput) -> TokenStream {
    let (home, name) = (ident(output.home()), ident(&output.name));
    quote!(injections.#name.replace(&mut frame.#home.#name))
}

/// An output that is absent before the first cycle of its instance.
fn quote_written(required: &Required) -> TokenStream {
    let RequiredSource::Written { latest, path } = &required.source else {
        return quote!();
    };
    let (variable, latest, path) = (
        ident(&required.variable),
        ident(latest),
        quote_accessor(path),
    );
    quote!(let #variable = frame.latest.#latest.written().map(|outputs| #path);)
}

fn quote_required(required: &Required) -> TokenStream {
    let variable = ident(&required.variable);
    let value = match &required.source {
        RequiredSource::Option(accessor) => quote_accessor(accessor),
        RequiredSource::Written { .. } => quote!(#variable),
    };
    quote!(let Some(#variable) = #value)
}

fn quote_renew(cycler: &CyclerModel, node: &NodeModel) -> TokenStream {
    let (name, create) = (ident(&node.name), ident(&format!("create_{}", node.name)));
    let creation = if node.creation.context.is_empty() {
        quote!(Self::#create)
    } else {
        debug_assert!(
            cycler.renews,
            "a node that is renewed has a creation to be renewed from"
        );
        quote!(|| Self::#create(&mut frame.creation()))
    };
    quote!(self.#name.renew_if_broken(#creation)?;)
}

/// The call, and what becomes of its outputs.
fn quote_call(node: &NodeModel) -> TokenStream {
    let name = ident(&node.name);
    let step = &node.step;
    let before = quote_before(&step.context);
    let context = quote_context(node, "CycleContext", "frame", &step.context);
    let call = |method: &str| {
        let method = ident(method);
        quote!(self.#name.#method(&frame.cycle, |node| node.cycle(context))?)
    };
    let assign: Vec<TokenStream> = quote_assignments(node);
    let call = match step.failure {
        Failure::Ends if assign.is_empty() => {
            let call = call("call");
            quote!(#call;)
        }
        Failure::Ends => {
            let call = call("call");
            quote!(let outputs = #call; #(#assign)*)
        }
        Failure::Skips if step.outputs.is_empty() => {
            let call = call("call_or_skip");
            quote!(#call;)
        }
        Failure::Skips => quote_skipping(node, &call("call_or_skip"), &assign),
        Failure::Holds if step.outputs.is_empty() => {
            let call = call("call_or_hold");
            quote!(#call;)
        }
        Failure::Holds => quote_holding(node, &call("call_or_hold"), &assign),
    };
    quote! {
        #before
        let context = #context;
        #call
    }
}

fn quote_skipping(node: &NodeModel, call: &TokenStream, assign: &[TokenStream]) -> TokenStream {
    let defaults = node.step.outputs.iter().map(quote_default);
    if assign.is_empty() {
        return quote! {
            let outputs = #call;
            if outputs.is_none() {
                #(#defaults)*
            }
        };
    }
    quote! {
        let outputs = #call;
        if let Some(outputs) = outputs {
            #(#assign)*
        } else {
            #(#defaults)*
        }
    }
}

fn quote_holding(node: &NodeModel, call: &TokenStream, assign: &[TokenStream]) -> TokenStream {
    let outputs = &node.step.outputs;
    let hold = outputs.iter().map(|output| {
        let (home, name) = (ident(output.home()), ident(&output.name));
        quote!(frame.#home.#name.clone_from(&frame.previous.#home.#name);)
    });
    let defaults = outputs.iter().map(quote_default);
    let written = if assign.is_empty() {
        quote!(_)
    } else {
        quote!(outputs)
    };
    quote! {
        let outputs = #call;
        match outputs {
            ::framework::Held::Written(#written) => { #(#assign)* }
            ::framework::Held::Hold => { #(#hold)* }
            ::framework::Held::Skip => { #(#defaults)* }
        }
    }
}

/// What the node returned, put where it is read.
fn quote_assignments(node: &NodeModel) -> Vec<TokenStream> {
    let returned = node.step.outputs.iter().filter(|output| !output.in_place);
    let values = returned.map(|output| {
        let (home, name) = (ident(output.home()), ident(&output.name));
        quote!(frame.#home.#name = outputs.#name.value;)
    });
    let capture_time = node.step.capture_time.iter().map(|field| {
        let field = ident(field);
        quote!(*frame.capture_time = Some(outputs.#field.0);)
    });
    values.chain(capture_time).collect()
}

fn quote_default(output: &StepOutput) -> TokenStream {
    let (home, name) = (ident(output.home()), ident(&output.name));
    if output.in_place {
        quote!(::framework::Clear::clear(&mut frame.#home.#name);)
    } else {
        quote!(frame.#home.#name = Default::default();)
    }
}
