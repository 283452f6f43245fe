//! One instance in `create`: its cycler around its body, a struct literal.

use proc_macro2::TokenStream;
use quote::quote;

use super::database;
use crate::model::frame::FrameField;
use crate::model::runtime::{InstanceModel, end, queue};
use crate::model::{CyclerModel, RuntimeModel};
use crate::render::instance::quote_duration;
use crate::render::layout::empty_line;
use crate::render::spelling::{ident, path, quote_accessor};

/// An instance around its body.
pub(super) fn quote_instance(model: &RuntimeModel, instance: &InstanceModel) -> TokenStream {
    let cycler = model.cycler_of(instance.id);
    let (module, name) = (ident(&cycler.module), ident(&cycler.body));
    let (constant, variable) = (ident(&instance.constant), ident(&instance.variable));
    let writer = ident(&format!("{}_writer", instance.variable));
    let creation = quote_creation(cycler, instance);
    let argument = (!cycler.creation.is_empty()).then(|| quote!(&mut creation));
    let nodes = path(&format!("crate::cyclers::{}::Nodes", cycler.module));
    let created = cycler.creation.contains(&FrameField::CyclerState);
    let state = created.then(|| quote!(cycler_state));
    let fields = quote_body_fields(
        model,
        cycler,
        instance,
        &quote!(#nodes::new(#argument)?),
        state,
    );
    let paragraph = empty_line();
    let body = quote! {
        let #variable = ::framework::Cycler::new(
            #module::#constant,
            #module::#name { #fields },
            #writer,
            start.clock.clone(),
        );
    };
    quote!(#paragraph #creation #body)
}

/// What the nodes of an instance are created from.
fn quote_creation(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    if cycler.creation.is_empty() {
        return quote!();
    }
    let state = cycler.creation.contains(&FrameField::CyclerState).then(|| {
        let content = database(cycler, "CyclerState");
        quote!(let mut cycler_state = #content::default();)
    });
    let creation = database(cycler, "Creation");
    let fields = cycler.creation.iter().map(|field| {
        let name = ident(field.name());
        match field {
            FrameField::CyclerState => quote!(#name: &mut #name,),
            FrameField::HardwareInterface => quote!(#name: hardware,),
            FrameField::Instance(part) => {
                let part = part.of_instance(&["start", "parameters"], &instance.name);
                let part = quote_accessor(&part);
                quote!(#name: #part,)
            }
            _ => quote!(#name: &start.parameters,),
        }
    });
    quote! {
        #state
        let mut creation = #creation { #(#fields)* };
    }
}

/// All fields of a body, of these nodes and this cycler state, by default the default.
pub(in crate::render) fn quote_body_fields(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
    nodes: &TokenStream,
    state: Option<TokenStream>,
) -> TokenStream {
    let variable = &instance.variable;
    let fields = quote_fields(model, cycler, instance, state);
    let readers = cycler.latest.iter().map(|source| {
        let producer = &model.runtime.buffer(source.id).variable;
        let (field, reader) = (ident(&source.reader), ident(&end(producer, variable)));
        quote!(#field: #reader,)
    });
    let selects = cycler.instance_parameters.iter().map(|part| {
        let select = ident(&part.select);
        let part = quote_accessor(&part.of_instance(&["parameters"], &instance.name));
        quote!(#select: |parameters| #part,)
    });
    quote! {
        nodes: #nodes,
        #fields
        #(#readers)*
        #(#selects)*
    }
}

/// What a body may have, as far as this one needs it.
fn quote_fields(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
    state: Option<TokenStream>,
) -> TokenStream {
    let has = |field: FrameField| cycler.has(&field);
    let end_of = |suffix: &str| {
        let end = ident(&format!("{}_{suffix}", instance.variable));
        quote!(#end)
    };
    let default = |name: &str| {
        let content = database(cycler, name);
        quote!(#content::default())
    };
    let parameters = ident(&end("parameters", &instance.variable));
    let state = state.unwrap_or_else(|| default("CyclerState"));
    let perception = quote_perception(model, cycler, instance);
    let swap = quote!(::framework::Swap::default());
    let subscriptions = end_of("subscriptions");
    let fields = [
        (
            has(FrameField::AdditionalOutputs),
            "additional_outputs",
            default("AdditionalOutputs"),
        ),
        (has(FrameField::CaptureTime), "capture_time", quote!(None)),
        (cycler.has_states(), "cycler_state", state),
        (
            cycler.is_generic(),
            "hardware_interface",
            quote!(hardware.clone()),
        ),
        (
            has(FrameField::Historic),
            "historic",
            quote_historic(cycler, instance),
        ),
        (
            has(FrameField::Injections),
            "injections",
            end_of("injected"),
        ),
        (cycler.has_own(), "own", swap),
        (cycler.has_parameters(), "parameters", quote!(#parameters)),
        (has(FrameField::Perception), "perception", perception),
        (
            has(FrameField::Procedures),
            "procedures",
            quote_procedures(cycler, instance),
        ),
        (
            has(FrameField::Subscribed),
            "subscribed",
            default("Subscribed"),
        ),
        (
            has(FrameField::Subscribed),
            "subscriptions",
            quote!(#subscriptions.clone()),
        ),
    ];
    let needed = fields.into_iter().filter(|(needed, ..)| *needed);
    let quoted = needed.map(|(_, name, value)| {
        let name = ident(name);
        // As a person would write it: `cycler_state`, not `cycler_state: cycler_state`.
        let same = name == value.to_string();
        if same {
            quote!(#name,)
        } else {
            quote!(#name: #value,)
        }
    });
    quoted.collect()
}

fn quote_historic(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    let historic = database(cycler, "Historic");
    let reach = quote_duration(instance.description.history);
    let outputs = cycler.historic().map(|output| {
        let name = ident(&output.name);
        quote!(#name: ::framework::History::new(#reach),)
    });
    quote!(#historic { #(#outputs)* })
}

fn quote_perception(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
) -> TokenStream {
    let Some(perception) = &cycler.perception else {
        return quote!();
    };
    let whole = database(cycler, "Perception");
    let horizon = ident(&perception.horizon);
    let orders = perception
        .interleavings
        .iter()
        .map(|interleaving| ident(&interleaving.field));
    let lanes = perception.lanes.iter().map(|lane| {
        let producer = model.runtime.buffer(lane.id);
        let (name, queue) = (
            ident(&lane.field),
            ident(&queue(&producer.variable, &instance.variable)),
        );
        let pending_timeout = quote_duration(producer.pending_timeout);
        quote!(#name: ::framework::Consumer::new(#queue, #pending_timeout),)
    });
    quote! {
        #whole {
            #horizon: ::framework::Horizon::new(),
            #(#orders: ::framework::Interleaving::new(),)*
            #(#lanes)*
        }
    }
}

fn quote_procedures(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    let procedures = database(cycler, "Procedures");
    let named = cycler.procedures.iter().zip(&instance.procedures);
    let answerers = named.map(|(procedure, ends)| {
        let (name, answerer) = (ident(&procedure.name), ident(&ends.answerer));
        quote!(#name: #answerer,)
    });
    quote!(#procedures { #(#answerers)* })
}
