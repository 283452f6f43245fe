//! One instance alone, as a frame has it.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::outside::sources;
use crate::model::frame::FrameField;
use crate::model::runtime::{InstanceModel, end, queue};
use crate::model::{CyclerModel, RuntimeModel};
use crate::render::layout::doc;
use crate::render::runtime::{quote_body_fields, quote_subscriptions, quote_subscriptions_of};
use crate::render::spelling::{ident, path};

/// Instances that can be replayed.
pub(super) fn replayed(
    model: &RuntimeModel,
) -> impl Iterator<Item = (&InstanceModel, &CyclerModel)> {
    let instances = model.runtime.instances.iter();
    let instances = instances.map(|instance| (instance, model.cycler_of(instance.id)));
    instances.filter(|(_, cycler)| model.sink.serves(cycler))
}

/// What makes an instance.
pub(super) fn function(instance: &InstanceModel) -> Ident {
    ident(&format!("replay_{}", instance.variable))
}

/// The functions of one cycler's instances.
pub(super) fn quote_replays(model: &RuntimeModel, cycler: &CyclerModel) -> TokenStream {
    let own = replayed(model).filter(|(_, own)| own.position == cycler.position);
    own.map(|(instance, cycler)| quote_replay(model, cycler, instance))
        .collect()
}

fn quote_replay(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
) -> TokenStream {
    let about = doc(&format!(
        "`{}` alone, with the nodes of the frame that is loaded first.",
        instance.name
    ));
    let name = function(instance);
    let stored = super::argument("stored", cycler.has_parameters());
    let parameters = cycler.has_parameters().then(|| {
        let reader = ident(&end("parameters", &instance.variable));
        quote! {
            let start: crate::parameters::Parameters = stored.parameters(from)?;
            let (parameters_writer, [#reader], []) =
                ::framework::buffer_of(|| start.clone(), []);
        }
    });
    let hardware = cycler
        .is_generic()
        .then(|| quote!(let hardware = ::std::sync::Arc::new(crate::recording::Sink);));
    let inputs = quote_inputs(model, cycler, instance);
    let ends = quote_ends(cycler, instance);
    let nodes = quote!(load_nodes(from)?);
    let fields = quote_body_fields(model, cycler, instance, &nodes, None);
    let body = path(&format!(
        "crate::runtime::{}::{}",
        cycler.module, cycler.body
    ));
    let constant = path(&format!(
        "crate::runtime::{}::{}",
        cycler.module, instance.constant
    ));
    let outside = quote_outside_of(cycler);
    let subscriptions = quote_subscriptions_of(cycler, instance);
    quote! {
        #about
        pub fn #name(
            from: &mut ::framework::recorded::Loading<'_>,
            #stored: &::framework::recorded::Stored<'_>,
        ) -> ::framework::Result<Box<dyn ::framework::replay::Replay>> {
            #parameters
            #hardware
            #inputs
            #ends
            let (writer, [], []) = ::framework::buffer([]);
            let cycler = ::framework::Cycler::new(
                #constant,
                #body { #fields },
                writer,
                ::framework::Clock::stepped(),
            );
            Ok(Box::new(::framework::replay::Alone::new(cycler, #outside, #subscriptions)))
        }
    }
}

/// A buffer for each thing that it reads.
fn quote_inputs(
    model: &RuntimeModel,
    cycler: &CyclerModel,
    instance: &InstanceModel,
) -> TokenStream {
    let variable = &instance.variable;
    let latest = cycler.latest.iter().map(|source| {
        let producer = &model.runtime.buffer(source.id).variable;
        let writer = ident(&format!("{}_writer", source.writer));
        let reader = ident(&end(producer, variable));
        quote!(let (#writer, [#reader], []) = ::framework::buffer([]);)
    });
    let lanes = cycler.perception.iter().flat_map(|one| &one.lanes);
    let lanes = lanes.map(|lane| {
        let producer = model.runtime.buffer(lane.id);
        let writer = ident(&format!("{}_writer", lane.writer));
        let queue = ident(&queue(&producer.variable, variable));
        let window = Literal::usize_unsuffixed(producer.queue);
        quote!(let (#writer, [], [#queue]) = ::framework::buffer([#window]);)
    });
    let injections = cycler.has(&FrameField::Injections).then(|| {
        let reader = ident(&format!("{variable}_injected"));
        quote!(let (injections_writer, [#reader], []) = ::framework::buffer([]);)
    });
    quote!(#injections #(#latest)* #(#lanes)*)
}

/// What clients listen to and call.
fn quote_ends(cycler: &CyclerModel, instance: &InstanceModel) -> TokenStream {
    let subscriptions = quote_subscriptions(cycler, instance, |module, names| {
        path(&format!("crate::runtime::{module}::{names}"))
    });
    let procedures = instance.procedures.iter().map(|procedure| {
        let answerer = ident(&procedure.answerer);
        quote!(let (_, #answerer) = ::framework::procedure();)
    });
    quote!(#subscriptions #(#procedures)*)
}

fn quote_outside_of(cycler: &CyclerModel) -> TokenStream {
    let injections = cycler
        .has(&FrameField::Injections)
        .then(|| quote!(injections: injections_writer,));
    let parameters = cycler
        .has_parameters()
        .then(|| quote!(parameters: parameters_writer,));
    let sources = sources(cycler).map(|source| {
        let (field, writer) = (
            ident(&source.writer),
            ident(&format!("{}_writer", source.writer)),
        );
        quote!(#field: #writer,)
    });
    quote!(Outside { #injections #parameters #(#sources)* })
}
